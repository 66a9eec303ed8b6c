// index.d.ts by the compiler of TypeScript, TSC or tsc: a program of the guide's calls, and calls that it must refuse.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { at } from './package.mjs';

const tsc = process.env.TSC ?? 'tsc', found = spawnSync(tsc, ['--version']).status === 0;
const program = `import { load, spawn, JamError, type CrunchReport } from 'jamming';
const jam = await load();
const packing = jam.random({ n: 8, dim: 3, seed: 1 });
packing.compress({ progress: (now) => { const phi: number = now.packingFraction; return phi > 1; } });
const report: CrunchReport = packing.crunch({ method: 'sequential_lp' });
const words: string = report.stopReason, text: string | undefined = packing.check({ prove: true }).text;
const bytes: Uint8Array = packing.write('packing.xyz');
const { gap, pair } = packing.gaps(1e-3), first: number = gap[0] + pair[0];
const read = await jam.read(bytes, { name: 'a.xyz' }), notes: string[] = read.notes;
packing.dispose();
const remote = await spawn(), far = await remote.random({ n: 8 });
await far.compress({ frames: 0.2, progress: (now) => { now.frame?.positions.length; }, resume: true });
const positions: Float64Array = await far.positions;
try { await remote.stop(); } catch (error) { if (error instanceof JamError && error.status === 'cancelled') remote.end(); }
// @ts-expect-error
packing.crunch({ method: 'no such word' });
// @ts-expect-error
packing.crunch({ maxLPs: 3 });
// @ts-expect-error
const none: string = packing.n;
// @ts-expect-error
far.positions.length;
export { words, text, first, notes, positions, none };
`;

test('a program in TypeScript', { skip: !found && `there is no compiler ${tsc}` }, () => {
  const folder = mkdtempSync(join(tmpdir(), 'types-'));
  try {
    const home = join(folder, 'node_modules/jamming');
    for (const name of ['index.d.ts', 'package.json']) cpSync(fileURLToPath(at(name)), join(home, name));
    writeFileSync(join(folder, 'package.json'), '{"type": "module"}');
    writeFileSync(join(folder, 'program.ts'), program);
    const { status, stdout } = spawnSync(tsc, ['--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022,dom',
      'program.ts'], { cwd: folder, encoding: 'utf8' });
    assert.equal(status, 0, stdout);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
