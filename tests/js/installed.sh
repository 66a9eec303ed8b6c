#!/bin/sh
# installed.sh PACKAGE: packed by npm, installed in an empty folder without a network, imported by name, the bundles
# too.
set -eu
package=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export npm_config_cache="$folder/cache" npm_config_offline=true npm_config_audit=false npm_config_fund=false \
  npm_config_update_notifier=false
packed=$(npm pack --silent "$package")
echo '{"private": true}' >package.json
npm install --silent "./$packed"
cat >try.mjs <<'END'
import { readFileSync } from 'node:fs';
import vm from 'node:vm';
import { load, spawn } from 'jamming';
import { load as loadBundle } from 'jamming/bundle';
import { createRequire } from 'node:module';

const p = (await load()).random({ n: 32, seed: 1 });
p.compress();
const phi = p.crunch().packingFraction;
const jam = await spawn();
const q = await jam.random({ n: 32, seed: 1 });
await q.compress();
if ((await q.crunch()).packingFraction !== phi) throw new Error('another packing in the worker');
jam.end();
const require = createRequire(import.meta.url);
const wasm = readFileSync(require.resolve('jamming/jam.wasm'));
const r = (await loadBundle(wasm)).random({ n: 32, seed: 1 });
r.compress();
if (r.crunch().packingFraction !== phi) throw new Error('another packing by the bundle');
// The worker's bundle is a classic script: it compiles as one, and no code is made of text at run time.
const text = readFileSync(require.resolve('jamming/worker.bundle.js'), 'utf8');
new vm.Script(text);
if (/\beval\(|new Function\(/.test(text)) throw new Error('a page with a strict policy refuses eval');
console.log(phi);
END
node try.mjs
