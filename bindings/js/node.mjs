// For Node.
import { readFile } from 'node:fs/promises';
import { Worker } from 'node:worker_threads';
import { load as loadFrom } from './jam.mjs';
import { spawnOn } from './remote.mjs';

export { JamError } from './errors.mjs';

const found = () => readFile(new URL('jam.wasm', import.meta.url));

/** Loads the library into this thread. source: bytes of jam.wasm or a compiled module; else the package's own. */
export async function load(source) {
  return loadFrom(source ?? (await found()));
}

/** Loads it into a worker, which does not keep the process alive while it has nothing to do. */
export async function spawn({ source, ...options } = {}) {
  const start = () => {
    const worker = new Worker(new URL('node_worker.mjs', import.meta.url));
    worker.unref();
    return {
      postMessage: (message) => worker.postMessage(message),
      onMessage: (work) => worker.on('message', work),
      onError: (work) => worker.on('error', (error) => work(error.message)),
      end: () => worker.terminate(),
    };
  };
  return spawnOn(start, source ?? (await found()), options);
}
