// libjam in a worker: the same calls, each a promise, while the page or the program goes on.
import { CALLS } from './api.mjs';
import { JamError } from './errors.mjs';

/** A packing in a worker. */
export class RemotePacking {
  constructor(owner, id) {
    this.owner = owner;
    this.id = id;
  }
  get positions() { return this.get('positions'); }
  get diameters() { return this.get('diameters'); }
  get velocities() { return this.get('velocities'); }
  get notes() { return this.get('notes'); }
  get status() { return this.get('status'); }
  get statusText() { return this.get('statusText'); }
  get(name) { return this.owner.ask({ op: 'get', packing: this.id, name }); }
  call(name, args) { return this.owner.asked({ op: 'call', packing: this.id, name }, args).then((value) => value ?? this); }
  checkpoint() { return this.call('checkpoint', []); }
  copy() { return this.owner.make('copy', [], this.id); }
  tile(count) { return this.owner.make('tile', [count], this.id); }
  dispose() {
    forgotten.unregister(this);
    return this.owner.free(this.id);
  }
}
const forgotten = new FinalizationRegistry(({ owner, id }) => owner.free(id).catch(() => {})); // ended workers hold nothing
if (Symbol.asyncDispose) RemotePacking.prototype[Symbol.asyncDispose] = RemotePacking.prototype.dispose;

/** The library in a worker. */
export class RemoteJam {
  #start;
  #port;
  #waiting = new Map();
  #next = 1;
  #flag = null;
  #every;
  #source;
  #restart = null; // while another worker begins, calls wait for it
  kept = new Map();

  constructor(start, source, every) {
    [this.#start, this.#source, this.#every] = [start, source, every];
  }

  async begin() {
    if (typeof SharedArrayBuffer !== 'undefined' && this.#every === 0) this.#flag = new Int32Array(new SharedArrayBuffer(4));
    this.#port = this.#start();
    this.#port.onMessage((message) => this.#heard(message));
    this.#port.onError((text) => this.#fail(new JamError('internal', `the worker ended: ${text}`)));
    const loaded = await this.#post({ op: 'load', source: this.#source, shared: this.#flag, every: this.#every });
    this.#source = loaded.module;
    ({ version: this.version, commit: this.commit, formats: this.formats } = loaded);
    return this;
  }

  ask(message, options) {
    return this.#restart ? this.#restart.then(() => this.#post(message, options)) : this.#post(message, options);
  }
  #post(message, options = {}) {
    if (!this.#port) return Promise.reject(new JamError('cancelled', 'the worker was ended'));
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, progress: options.progress });
      this.#port.postMessage({ ...message, id, reports: Boolean(options.progress), frames: options.frames ?? 0 });
    });
  }
  /** Functions stay here; `frames`: seconds between pictures of the packing in progress.frame. */
  asked(message, args, last = args.at(-1)) {
    const isObject = last !== null && typeof last === 'object' && Object.getPrototypeOf(last) === Object.prototype;
    const { progress, frames, ...rest } = isObject ? last : {};
    const plain = (isObject ? [...args.slice(0, -1), rest] : args).map((one) => (one instanceof RemotePacking ? { isPacking: one.id } : one));
    return this.ask({ ...message, args: plain }, { progress, frames });
  }
  #heard({ id, value, error, progress, kept, bytes }) {
    if (kept) {
      this.kept.set(kept, bytes);
      return;
    }
    const call = this.#waiting.get(id);
    if (!call) return;
    if (progress) {
      if (call.progress(progress) === true) this.stop();
      return;
    }
    this.#waiting.delete(id);
    if (error) call.reject(Object.assign(new JamError(error.status, error.message), error.report ? { report: error.report } : {}));
    else call.resolve(value);
  }
  #fail(error) {
    const calls = [...this.#waiting.values()];
    this.#waiting.clear();
    calls.forEach((call) => call.reject(error));
  }

  async make(how, args, from = 0) {
    const made = this.#next++;
    const { n, dim } = await this.asked({ op: 'make', how, made, from }, args);
    const packing = Object.assign(new RemotePacking(this, made), { n, dim });
    forgotten.register(packing, { owner: this, id: made }, packing);
    return packing;
  }
  free(id) {
    this.kept.delete(id);
    return this.ask({ op: 'dispose', packing: id });
  }
  random(options = {}) { return this.make('random', [options]); }
  from(options) { return this.make('from', [options]); }
  read(bytes, options = {}) { return this.make('read', [bytes, options]); }
  readCheckpoint(bytes) { return this.make('readCheckpoint', [bytes]); }
  call(name, args) { return this.asked({ op: 'call', packing: 0, name }, args); }

  /**
   * Stops all calls that wait: their promises fail with status 'cancelled', and packings stay valid. Where memory is
   * shared they are as far as they came. Elsewhere the worker is ended and another one begins with the last checkpoint
   * of each packing.
   */
  async stop() {
    if (this.#restart) await this.#restart;
    if (this.#waiting.size === 0) return;
    if (this.#flag) {
      Atomics.store(this.#flag, 0, this.#next - 1);
      await Promise.allSettled([...this.#waiting.values()].map((call) => new Promise((resolve) => {
        const { resolve: done, reject: failed } = call;
        call.resolve = (value) => { done(value); resolve(); };
        call.reject = (error) => { failed(error); resolve(); };
      })));
      return;
    }
    this.#port.end();
    this.#fail(new JamError('cancelled', 'stopped: the packing is as its last checkpoint has it'));
    this.#restart = this.begin().then(() =>
      Promise.all([...this.kept].map(([made, bytes]) => this.#post({ op: 'make', how: 'readCheckpoint', made, from: 0, args: [bytes] }))));
    await this.#restart.finally(() => (this.#restart = null));
  }
  /** Ends the worker with all its packings. */
  end() {
    this.#port?.end();
    this.#port = null;
    this.#fail(new JamError('cancelled', 'the worker was ended'));
  }
}

for (const [name, call] of Object.entries(CALLS)) {
  const kind = call.system ? RemotePacking : RemoteJam;
  if (name === 'writeCheckpoint') continue; // checkpoint()
  Object.defineProperty(kind.prototype, name, { writable: true, configurable: true, value(...args) { return this.call(name, args); } });
}

/** A port to a Worker of a page. */
export function webPort(worker) {
  return {
    postMessage: (message) => worker.postMessage(message),
    onMessage: (work) => { worker.onmessage = (event) => work(event.data); },
    onError: (work) => { worker.onerror = (event) => work(event.message ?? 'it could not be loaded'); },
    end: () => worker.terminate(),
  };
}

/**
 * Loads the library into a worker. source: bytes of jam.wasm or a compiled module. start: makes the port of a worker
 * that runs serve.mjs. shared: false never shares memory, though it could; then a checkpoint is kept every `every` seconds.
 */
export function spawnOn(start, source, { shared = typeof SharedArrayBuffer !== 'undefined', every = 1 } = {}) {
  return new RemoteJam(start, source, shared ? 0 : every).begin();
}
