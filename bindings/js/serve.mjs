// The end of the worker: it has the library and does what messages ask. remote.mjs is the other end.
import { CALLS } from './api.mjs';
import { JamError } from './errors.mjs';
import { load } from './jam.mjs';

/** Buffers of all arrays in a value: they are given away, not copied. */
function buffers(value) {
  if (ArrayBuffer.isView(value)) return [value.buffer];
  if (value === null || typeof value !== 'object') return [];
  return Object.values(value).flatMap(buffers);
}

/** port: postMessage(message, buffers), and onMessage(work). */
export function serve(port) {
  const packings = new Map();
  let jam = null;
  let flag = null; // shared with the other end, where memory can be shared: calls up to this number stop
  let keep = 0; // seconds between checkpoints that are sent to the other end; 0: it needs none
  let running = 0;
  const send = (message) => port.postMessage(message, buffers(message));
  const isStopped = () => flag !== null && Atomics.load(flag, 0) >= running;
  const kept = (id, packing) => keep > 0 && send({ kept: id, bytes: packing.checkpoint() });

  /** What a running call reports: to who asked, with frames of the packing, and checkpoints. */
  function watcher({ id, packing: number, reports, frames }) {
    let framed = performance.now();
    let saved = performance.now();
    return (progress, packing) => {
      const now = performance.now();
      const frame = reports && frames > 0 && packing && now - framed > 1000 * frames;
      const save = keep > 0 && packing && now - saved > 1000 * keep;
      const bytes = frame || save ? packing.checkpoint() : null;
      if (frame) {
        const shown = jam.readCheckpoint(bytes);
        progress.frame = { positions: shown.positions, diameters: shown.diameters, cell: shown.cell() };
        shown.dispose();
        framed = performance.now() + 10 * (performance.now() - now);
      }
      if (reports) send({ id, progress });
      if (save) {
        send({ kept: number, bytes });
        saved = performance.now() + 10 * (performance.now() - now);
      }
      return isStopped();
    };
  }

  const held = (id) => {
    if (packings.has(id)) return packings.get(id);
    throw new JamError('argument', 'this packing was disposed of');
  };
  function born(id, packing) {
    packings.set(id, packing);
    kept(id, packing);
    return { n: packing.n, dim: packing.dim };
  }
  const given = (args) => args.map((one) => (one?.isPacking ? held(one.isPacking) : one));

  const work = {
    async load({ source, shared, every }) {
      jam = await load(source);
      [flag, keep] = [shared, every];
      return { module: jam.module, version: jam.version, commit: jam.commit, formats: jam.formats };
    },
    async make({ made, how, from, args }) {
      const parent = from ? held(from) : jam;
      return born(made, await parent[how](...given(args)));
    },
    async call({ packing, name, args }) {
      if (!packing) return jam.call(name, given(args));
      const on = held(packing);
      let value;
      try {
        value = on[name](...given(args));
      } finally {
        if (CALLS[name] && !CALLS[name].fixed) kept(packing, on);
      }
      if (value?.status === 'cancelled') throw Object.assign(new JamError('cancelled', value.statusText), { report: value });
      return value === on ? undefined : value;
    },
    async get({ packing, name }) { return held(packing)[name]; },
    async dispose({ packing }) {
      held(packing).dispose();
      packings.delete(packing);
    },
  };

  let queue = Promise.resolve();
  port.onMessage((message) => {
    queue = queue.then(async () => {
      running = message.id;
      try {
        if (isStopped()) throw new JamError('cancelled', 'stopped before it began');
        if (jam) jam.watch = watcher(message);
        send({ id: message.id, value: await work[message.op](message) });
      } catch (error) {
        const { status = 'internal', report } = error;
        send({ id: message.id, error: { status, message: error.message, report } });
      }
    });
  });
}
