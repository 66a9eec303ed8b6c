// The library in a worker: promises, frames, stops, with memory that is shared and without.
import assert from 'node:assert/strict';
import test from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { JamError, load, spawn } from './package.mjs';

const alone = await load();
const start = { n: 64, seed: 2, diameters: Float64Array.from({ length: 64 }, (_, k) => 1 + 0.4 * (k % 2)) };
const whole = alone.random(start);
whole.compress();
const end = whole.crunch();

for (const shared of [true, false]) {
  const how = shared ? 'shared memory' : 'no shared memory';
  test(`${how}: a stopped call fails, and goes on to the same bits`, async () => {
    const jam = await spawn({ shared, every: 0.05 });
    assert.equal(jam.version, alone.version);
    const p = await jam.random(start);
    assert.equal(p.n, 64);
    let reports = 0;
    const stopped = p.compress({ progress: () => { reports += 1; return true; } });
    await assert.rejects(stopped, (error) => error instanceof JamError && error.status === 'cancelled');
    assert.ok(reports > 0);
    const { paused } = await p.info();
    const report = await p.compress(paused === 'compress' ? { resume: true } : {});
    assert.equal(report.stopReason, 'pressure');
    const crunched = await p.crunch({ progress() {} });
    assert.equal(crunched.packingFraction, end.packingFraction);
    assert.deepEqual(await p.positions, whole.positions);
    assert.deepEqual(await p.forces(), whole.forces());
    jam.end();
  });

  test(`${how}: a stop ends all calls that wait, and other packings stay`, async () => {
    const jam = await spawn({ shared, every: 0.05 });
    const [first, second] = [await jam.random(start), await jam.read(whole.write('a.xyz'), { name: 'a.xyz' })];
    const calls = Promise.allSettled([first.compress(), first.crunch(), second.crunch()]);
    await jam.stop();
    const answers = await calls;
    assert.deepEqual(answers.map((one) => one.reason?.status), ['cancelled', 'cancelled', 'cancelled']);
    assert.equal((await second.check()).jammed, 'yes');
    assert.equal((await first.info()).n, 64);
    jam.end();
  });
}

test('frames show the packing as it moves', async () => {
  const jam = await spawn();
  const p = await jam.random({ n: 256, seed: 1 });
  const before = await p.diameters;
  let frame;
  await assert.rejects(p.compress({ frames: 1e-9, progress: (now) => (frame = now.frame ?? frame)?.diameters[0] > before[0] }), { status: 'cancelled' });
  assert.equal(frame.positions.length, 3 * 256);
  assert.equal(frame.cell.length, 9);
  jam.end();
});

test('packings that nothing refers to are freed in the worker', async () => {
  setFlagsFromString('--expose-gc');
  const jam = await spawn({ shared: false });
  await (async () => { for (let k = 0; k < 4; ++k) await jam.random(start); })();
  const last = await jam.random(start);
  assert.equal(jam.kept.size, 5);
  for (let k = 0; k < 100 && jam.kept.size > 1; ++k) {
    runInNewContext('gc')();
    await new Promise((resolve) => setTimeout(resolve, 10)); // finalisers run between tasks
  }
  assert.equal(jam.kept.size, 1);
  assert.equal((await last.positions).length, 3 * 64);
  jam.end();
});

test('errors, arguments and disposal cross the border', async () => {
  const jam = await spawn();
  const p = await jam.random(start);
  await assert.rejects(p.forces(), { name: 'JamError', status: 'state' });
  await assert.rejects(p.crunch({ method: 'x' }), { status: 'argument' });
  const other = await p.copy();
  assert.equal((await p.compare(other)).comparison.displacementMax, 0);
  assert.equal(await p.setMemoryLimit(1e9), p);
  await p.dispose();
  await assert.rejects(p.info(), { status: 'argument', message: /disposed/ });
  await assert.rejects(other.compare(p), { status: 'argument', message: /disposed/ });
  jam.end();
  await assert.rejects(other.info(), { status: 'cancelled' });
});
