// Arguments, results, errors, files and memory of the calls in one thread.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { gzipSync } from 'node:zlib';
import { JamError, at, load } from './package.mjs';

const jam = await load();
const text = (bytes) => new TextDecoder().decode(bytes);
const bytes = (content) => new TextEncoder().encode(content);
/** The call fails with this status and a text that has all the words. */
const fails = (work, status, ...words) =>
  assert.throws(work, (error) => error instanceof JamError && error.status === status && words.every((word) => error.message.includes(word)));
// Two sizes: equal spheres so few would order, and a crystal has many states of self-stress.
const start = { n: 64, seed: 2, diameters: Float64Array.from({ length: 64 }, (_, k) => 1 + 0.4 * (k % 2)) };
const packing = jam.random(start);
packing.compress();
const report = packing.crunch();

test('reports have words, flags and whole numbers', () => {
  assert.equal(report.jammed, true);
  assert.equal(report.stopReason, 'converged');
  assert.equal(report.lpSolver, 'ipm');
  assert.equal(report.status, 'ok');
  assert.equal(report.contacts, report.isostaticContacts + report.excessContacts);
  assert.equal(report.stable + report.rattlers, 64);
  assert.deepEqual(packing.crunchReport().packingFraction, report.packingFraction);
});

test('arrays have the shapes of the header', () => {
  const m = report.contacts;
  const [stable, d] = [report.stable, packing.dim];
  assert.equal(packing.contacts().length, 2 * m);
  assert.ok(packing.contacts() instanceof Int32Array);
  assert.equal(packing.contactVectors().length, d * m);
  const { rowStart, column, value } = packing.hessian();
  assert.equal(rowStart.length, d * stable + 1);
  assert.equal(rowStart.at(-1), column.length);
  assert.equal(value.length, column.length);
  const { lambda, vector } = packing.modes({ count: 4 });
  assert.equal(lambda.length, 4);
  assert.equal(vector.length, 4 * stable * d);
  const { force, basis, residual } = packing.stressStates();
  assert.equal(force.length, m);
  assert.equal(basis.length, m);
  assert.ok(residual < 1e-12); // balance to rounding of some hundred terms
  const { affine } = packing.elasticTensor();
  assert.equal(affine.length, d ** 4);
});

test('forces balance on each stable sphere', () => {
  const [pairs, vectors, forces] = [packing.contacts(), packing.contactVectors(), packing.forces()];
  const sums = new Float64Array(3 * 64);
  forces.forEach((f, k) => {
    for (let c = 0; c < 3; ++c) {
      sums[3 * pairs[2 * k] + c] += f * vectors[3 * k + c];
      sums[3 * pairs[2 * k + 1] + c] -= f * vectors[3 * k + c];
    }
  });
  assert.ok(Math.max(...sums.map(Math.abs)) < 1e-12);
});

test('check and proof say it in a paragraph', () => {
  const check = packing.check({ prove: true });
  assert.equal(check.jammed, 'yes');
  assert.match(check.text, /^Collectively jammed/);
  const proof = packing.prove();
  assert.equal(proof.theorem, 'exact');
  assert.match(proof.text, /^proved, radius/);
  assert.match(text(packing.writeProof('a.jamproof')), /jamproof/);
});

test('what is written is read with the same bits', async () => {
  for (const name of ['a.xyz', 'a.data', 'a.dat']) {
    const again = await jam.read(packing.write(name), { name });
    assert.deepEqual(again.diameters, packing.diameters, name);
    assert.equal(again.check({ crunch: false }).contacts, report.contacts, name);
  }
  const again = jam.readCheckpoint(packing.checkpoint());
  assert.deepEqual(again.positions, packing.positions);
  assert.deepEqual(again.forces(), packing.forces());
  const csv = text(packing.writeContacts('c.csv'));
  assert.equal(csv.trim().split('\n').length, report.contacts + 1);
  assert.match(text(packing.writePage('p.html', 'Title', false, '')), /<title>/);
  assert.equal(packing.writeStl('m.stl').bytes.length, packing.writeStl('m.stl').report.bytes);
});

test('compressed files are unpacked, and damaged ones are refused by name', async () => {
  const packed = gzipSync(packing.write('a.xyz'));
  assert.deepEqual((await jam.read(packed, { name: 'a.xyz.gz' })).positions, packing.positions);
  await assert.rejects(jam.read(packed.subarray(0, 500), { name: 'cut.xyz.gz' }), { status: 'format', message: /cut\.xyz\.gz/ });
  fails(() => packing.write('a.xyz.gz'), 'unsupported', 'a.xyz.gz', 'without .gz');
  assert.throws(() => packing.write('a.hoomd'), (error) => error.message.includes('.extxyz') && !error.message.includes('.gz'));
});

test('errors are the sentences of the library and leave the packing as it was', async () => {
  const before = packing.positions;
  await assert.rejects(jam.read(bytes('hello'), { name: 'a.xyz' }), { name: 'JamError', status: 'format', message: /a\.xyz line 1/ });
  fails(() => jam.from({ positions: [0, 0, 0, 0.1, 0, 0], diameters: 0.5 }), 'overlap', '0 and 1');
  fails(() => jam.random({ dim: 4, n: 10 }), 'dimension');
  fails(() => jam.random({ n: 10, packingFraction: NaN }), 'argument', 'packing_fraction');
  fails(() => jam.random({ n: 10 }).forces(), 'state', 'crunch');
  fails(() => packing.setPositions(before.subarray(1)), 'argument', 'positions');
  assert.deepEqual(packing.positions, before);
});

test('wrong arguments are named before C sees them', () => {
  fails(() => packing.crunch({ method: 'x' }), 'argument', 'method', 'barrier_path');
  fails(() => packing.crunch({ maxLPs: 3 }), 'argument', 'maxLPs', 'maxLps');
  fails(() => packing.crunch({ maxLps: 2.5 }), 'argument', 'maxLps', '2.5');
  fails(() => packing.crunch({ maxLps: 2 ** 40 }), 'argument', 'maxLps', '32 bits');
  fails(() => packing.crunch({ polish: 2 }), 'argument', 'polish');
  fails(() => packing.crunch({ gainTolerance: '1' }), 'argument', 'gainTolerance');
  fails(() => packing.bondOrder(6), 'argument', 'cutoff');
  fails(() => packing.forces(1), 'argument', 'no arguments');
  fails(() => packing.floppyModes([0.5]), 'argument', 'contact[0]');
  fails(() => jam.random({ n: 8, sead: 1 }), 'argument', 'sead', 'seed');
  fails(() => packing.write('a\0b.xyz'), 'argument', 'code 0');
  fails(() => packing.write(), 'argument', 'path');
});

test('what is no file is refused by what it must be', async () => {
  await assert.rejects(jam.read('disks.xyz'), { status: 'argument', message: 'read takes the bytes of a file, a Uint8Array, not "disks.xyz"' });
  await assert.rejects(jam.read(new Float64Array(3)), { status: 'argument', message: /Uint8Array, not Float64Array/ });
  fails(() => jam.readCheckpoint(undefined), 'argument', 'readCheckpoint', 'Uint8Array', 'Undefined');
  await assert.rejects(jam.read(packing.checkpoint(), { name: 'a.jam' }), { status: 'format', message: /readCheckpoint reads it/ });
});

test('arrays are arrays of numbers', () => {
  const p = jam.random({ n: 5, dim: 2 });
  for (const wrong of [5, {}, true, '1234', new DataView(new ArrayBuffer(16)), new Set([0.1, 0.2])]) {
    fails(() => jam.from({ positions: wrong, diameters: 0.1, dim: 2 }), 'argument', 'positions must be an array');
    if (typeof wrong !== 'number') fails(() => jam.random({ n: 4, diameters: wrong }), 'argument', 'diameters must be an array');
    fails(() => jam.random({ n: 4, cell: wrong }), 'argument', 'cell must be an array');
    if (Object.getPrototypeOf(wrong) !== Object.prototype) // an object of options
      fails(() => p.setPositions(wrong), 'argument', 'positions must be an array');
    fails(() => p.tile(wrong), 'argument', 'count must be an array');
  }
  for (const wrong of [['0.1', 0.2], [[0.1, 0.2]], [true, 0.2], [null, 0.2], [0.1, 2n], [, 0.2]])
    fails(() => jam.from({ positions: wrong, diameters: 0.1, dim: 2 }), 'argument', 'positions[', 'must be a number');
  for (const empty of [[], new Float64Array(0)]) {
    fails(() => jam.from({ positions: empty, diameters: 0.1 }), 'argument', 'positions has no numbers');
    fails(() => jam.random({ n: 4, diameters: empty }), 'argument', 'diameters has no numbers');
  }
  const one = jam.from({ positions: new Float32Array([0.25, 0.5]), diameters: [0.125], dim: 2 });
  assert.deepEqual([...one.positions, ...one.diameters], [0.25, 0.5, 0.125]);
});

test('whole numbers are numbers: a text or a truth is none, nor has it a fraction', () => {
  for (const seed of ['', '5', true, 2.5, null]) fails(() => jam.random({ n: 8, seed }), 'argument', 'seed must be a whole number');
  fails(() => jam.random({ n: 8, overlap: 0.7 }), 'argument', 'overlap is 0.7');
  assert.equal(jam.random({ n: 8, seed: 3n }).n, 8);
});

test('lists of options have those that the call takes', () => {
  fails(() => jam.random({ n: 8, ratio: 1.4 }), 'argument', 'ratio', 'diameters', 'cell', 'seed');
  assert.throws(() => jam.random({ n: 8, ratio: 1.4 }), (error) => !error.message.includes('positions'));
  fails(() => jam.from({ positions: [0, 0, 0], ratio: 1.4 }), 'argument', 'positions', 'diameters');
});

test('the status is that of the call that threw', () => {
  const p = jam.random(start);
  assert.equal(p.rigidity('collective').status, 'not_jammed');
  const error = new Error('of the page');
  assert.throws(() => p.compress({ progress: () => { throw error; } }), error);
  assert.equal(p.status, 'cancelled');
  assert.match(p.statusText, /resume = 1 continues/);
  fails(() => p.run({ collisionsPerParticle: -1 }), 'argument');
  assert.equal(p.status, 'argument');
  assert.match(p.statusText, /collisions_per_particle is -1/);
  fails(() => p.forces(), 'state');
  assert.equal(p.status, 'state');
  fails(() => p.compress({ colour: 1 }), 'argument');
  assert.match(p.statusText, /colour/);
  p.scaleDiameters(0.9);
  assert.deepEqual([p.status, p.statusText], ['ok', '']);
});

test('seeds of 64 bits come back whole', () => {
  const seed = 2n ** 62n + 1n;
  assert.equal(jam.random({ n: 8, seed }).info().seed, seed);
});

test('progress stops a call, which goes on to the same bits; what it throws is thrown', () => {
  const whole = jam.random(start);
  whole.compress();
  const p = jam.random(start);
  const words = new Set();
  assert.equal(p.compress({ progress: (now) => words.add(now.phase) && true }).status, 'cancelled');
  assert.deepEqual([...words], ['compress']);
  assert.equal(p.info().paused, 'compress');
  assert.equal(p.compress({ resume: true }).status, 'ok');
  assert.deepEqual(p.positions, whole.positions);
  const error = new Error('of the page');
  assert.throws(() => p.crunch({ progress: () => { throw error; } }), error);
  assert.equal(p.crunch().jammed, true);
  fails(() => p.forces({ progress: 1 }), 'argument', 'function');
});

test('size laws give diameters', () => {
  const { options, curve } = jam.parseDiameters('sieve:0.5=0,1=1');
  assert.equal(options.law, 'sieve');
  const diameters = jam.diameters(curve, { ...options, n: 50 });
  assert.equal(diameters.length, 50);
  assert.ok(diameters.every((s) => s >= 0.5 && s <= 1));
  assert.equal(jam.sizeReport(3, diameters).n, 50);
});

test('memory is refused before it is taken, and the module lives on', () => {
  fails(() => jam.random({ n: 1e9 }), 'memory');
  const p = jam.random({ n: 400, seed: 1 });
  p.setMemoryLimit(1e5);
  fails(() => p.crunch(), 'memory');
  assert.equal(p.n, 400);
});

setFlagsFromString('--expose-gc');
const collect = async () => {
  runInNewContext('gc')();
  await new Promise((resolve) => setTimeout(resolve)); // finalisers run between tasks
};
const ends = { dispose: (p) => p.dispose(), 'Symbol.dispose, as by using': (p) => p[Symbol.dispose](), 'nothing, as finalisers free': () => {} };
for (const [name, end] of Object.entries(ends))
  test(`memory of packings is used again after ${name}`, async () => {
    const round = () => end(jam.random({ n: 2000, packingFraction: 0.1 }));
    const size = () => process.memoryUsage().arrayBuffers + process.memoryUsage().external;
    const some = async (count) => {
      for (let k = 0; k < count; ++k) round();
      await collect();
    };
    for (let k = 0; k < 5; ++k) await some(10);
    const before = size();
    for (let k = 0; k < 8; ++k) await some(10); // 80 packings of 64 kB and their lists, of which ten are there at once
    assert.ok(size() - before < 2e6);
  });
test('disposed packings are refused', () => {
  const p = jam.random({ n: 20, packingFraction: 0.1 });
  p.dispose();
  p[Symbol.dispose]();
  fails(() => p.positions, 'argument', 'disposed');
});

test('the module imports a clock and callbacks alone', () => {
  const imports = WebAssembly.Module.imports(new WebAssembly.Module(readFileSync(at('jam.wasm')))).map((one) => one.name);
  assert.deepEqual(imports.sort(), ['clock_time_get', 'emscripten_notify_memory_growth', 'environ_get', 'environ_sizes_get', 'log', 'proc_exit', 'progress']);
});

test('a log arrives line by line', () => {
  const lines = [];
  packing.logTo((level, line) => lines.push([level, line]));
  packing.crunch();
  packing.logTo(null);
  assert.ok(lines.length > 0 && lines.every(([level, line]) => ['warning', 'info'].includes(level) && !line.includes('\n')));
});

test('a large network is dissected within the stack', () => {
  const p = jam.random({ dim: 2, n: 20000, seed: 1, packingFraction: 0.3 });
  assert.ok(p.estimateCrunch().bytes > 0); // orders the graph, by recursion
});
