// The recipes of tests/platforms/bits.c for d = 2 and 3, which the package has: each hash is the one that bits.txt has
// for every processor.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { load } from './package.mjs';

const jam = await load();
const lines = readFileSync(new URL('../platforms/bits.txt', import.meta.url), 'utf8').split('\n');
const recorded = new Map(lines.filter((line) => / d=[23] /.test(line)).map((line) => [line.slice(0, line.lastIndexOf(' ')), line.slice(line.lastIndexOf(' ') + 1)]));
const compared = new Set();

/** FNV-1a of the bytes of doubles, in two halves of 32 bits. */
function hashOf(...arrays) {
  let hash = 14695981039346656037n;
  for (const array of arrays)
    for (const byte of new Uint8Array(array.buffer, array.byteOffset, array.byteLength))
      hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 1099511628211n);
  return hash.toString(16).padStart(16, '0');
}
function same(name, ...arrays) {
  compared.add(name);
  assert.equal(hashOf(...arrays), recorded.get(name), name);
}
const packing = (name, p) => same(name, p.positions, p.diameters, p.cell());

const scenes = [
  ['d=2 disks 1 : 1.4', { dim: 2, n: 100, seed: 1, packingFraction: 0.4 }, 1.4, {}, true],
  ['d=3 equal spheres', { n: 100, seed: 2, packingFraction: 0.3 }, 1, {}, true],
  ['d=3 spheres 1 : 4', { n: 90, seed: 3, packingFraction: 0.2 }, 4, {}, false],
  ['d=2 disks by LPs alone', { dim: 2, n: 80, seed: 4, packingFraction: 0.3 }, 1.4, { method: 'sequential_lp' }, false],
  ['d=3 spheres in a free cell', { n: 60, seed: 5, packingFraction: 0.3 }, 1.4, { strain: 'free' }, true],
  ['d=2 disks in a free cell', { dim: 2, n: 60, seed: 6, packingFraction: 0.3 }, 1.4, { strain: 'free' }, false],
  ['d=3 spheres in a slit', { n: 80, seed: 7, packingFraction: 0.25, walls: 4 }, 1.4, {}, true],
  ['d=2 disks in a circle', { dim: 2, n: 60, seed: 8, packingFraction: 0.3, container: 'ball' }, 1.4, {}, true],
  ['d=3 spheres in a tube', { n: 80, seed: 9, packingFraction: 0.2, container: 'cylinder' }, 1.4, {}, false],
  ['d=3 Mari-Kurchan spheres', { n: 60, seed: 10, packingFraction: 1, model: 'mk' }, 1, {}, true],
];
const sizes = (n, largest) => Float64Array.from({ length: n }, (_, k) => 1 + ((largest - 1) * (k % 4)) / 3);

for (const [name, options, largest, crunch, moves] of scenes)
  test(name, () => {
    const p = jam.random({ ...options, diameters: sizes(options.n, largest) });
    packing(`md ${name}, start`, p);
    if (moves) {
      p.run({ collisionsPerParticle: 30 });
      packing(`md ${name}, run`, p);
      p.compress({ growthRate: 0.02, pressure: 1e4 });
      packing(`md ${name}, compression`, p);
    }
    p.crunch(crunch);
    packing(`crunch ${name}, jamming point`, p);
    same(`crunch ${name}, forces`, p.forces());
    p.dispose();
  });

for (const [dim, name] of [[2, 'd=2 disks'], [3, 'd=3 spheres']])
  test(`${name}, Monte Carlo and relaxation`, () => {
    const start = (packingFraction, overlap) => jam.random({ dim, n: 100, seed: 5, packingFraction, overlap, diameters: sizes(100, 1.4) });
    for (const [kind, alpha] of [['hard', 0], ['soft', 2.7]]) {
      const p = start(0.2, alpha ? 'allow' : 'refuse');
      p.monteCarlo({ alpha, sweeps: 20, temperature: 0.1 });
      packing(`md ${name}, ${kind} Monte Carlo`, p);
    }
    const p = start(1, 'allow');
    p.relax({ alpha: 2.7 });
    packing(`crunch ${name}, relaxation`, p);
  });

test('every recorded line was compared', () => assert.deepEqual([...compared].sort(), [...recorded.keys()].sort()));
