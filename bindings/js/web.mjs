// For pages and their workers.
import { load as loadFrom } from './jam.mjs';
import { spawnOn, webPort } from './remote.mjs';

export { JamError } from './errors.mjs';

const fetched = async () => (await fetch(new URL('jam.wasm', import.meta.url))).arrayBuffer();

/** Loads the library into this thread. source: bytes of jam.wasm or a compiled module; else it is fetched. */
export async function load(source) {
  return loadFrom(source ?? (await fetched()));
}

/** Loads it into a worker. */
export async function spawn({ source, ...options } = {}) {
  const start = () => webPort(new Worker(new URL('web_worker.mjs', import.meta.url), { type: 'module' }));
  return spawnOn(start, source ?? (await fetched()), options);
}
