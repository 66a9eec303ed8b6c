// libjam: makes and analyses jammed packings of hard spheres.
import { CALLS, STRUCTS } from './api.mjs';
import { invoke } from './call.mjs';
import { Core } from './core.mjs';
import { JamError } from './errors.mjs';

const freed = new FinalizationRegistry(({ core, handle }) => core.broken || core.exports.jam_destroy(handle));

/** Spheres in a cell. Every call of jam.h on a system is a method; packings are made by a Jam. */
export class Packing {
  #core;
  #handle;
  #running = false;
  #log = null;

  constructor(core, handle) {
    this.#core = core;
    this.#handle = handle;
    freed.register(this, { core, handle }, this);
    const info = this.info();
    this.dim = info.dim;
    this.n = info.n;
  }

  get handle() {
    if (this.#handle === 0) throw new JamError('argument', 'this packing was disposed of');
    return this.#handle;
  }
  /** Frees the memory at once. Without it the packing is freed when nobody refers to it any more. */
  dispose() {
    if (this.#handle === 0) return;
    if (this.#running) throw new JamError('busy', 'a call is running on this packing');
    freed.unregister(this);
    this.#core.call('jam_destroy', this.#handle);
    this.#log?.end();
    this.#handle = 0;
  }

  /** Copies: the packing may move and the memory of the module grow. */
  get positions() { return this.#shown(0); }
  get diameters() { return this.#shown(1); }
  get velocities() { return this.#shown(2); }
  #shown(which) {
    const core = this.#core;
    return core.use((arena) => {
      const [at, length] = [arena.room(4), arena.room(4)];
      core.check(core.call('jam_view', this.handle, which, at, length));
      return core.array(core.view().getUint32(at, true), core.view().getUint32(length, true), 'double');
    });
  }

  /** What was changed or assumed when the packing was made, a sentence each. */
  get notes() {
    return this.#core.string(this.#core.call('jam_notes', this.handle)).split('\n').filter((line) => line !== '');
  }
  /** The status of the last call on this packing, also of one that threw, and its reason unless it is 'ok'. */
  status = 'ok';
  statusText = '';
  noted(status, text = status === 'ok' ? '' : this.#core.reason()) {
    this.status = status;
    this.statusText = text;
  }

  /** All that the packing is, as bytes for Jam.readCheckpoint. A progress function may call it. */
  checkpoint() {
    return invoke(this.#core, this, 'writeCheckpoint', ['checkpoint']);
  }
  copy() { return this.#made((out) => this.#core.call('jam_copy', this.handle, out)); }
  /** Copies side by side, count[c] along cell vector c. */
  tile(count) {
    return this.#core.use((arena) => {
      const at = arena.array(count, 'int32_t', 'count');
      return this.#made((out) => this.#core.call('jam_tile', this.handle, at, count.length, out));
    });
  }
  #made(call) { return new Packing(this.#core, newHandle(this.#core, call)); }

  /** Sends lines of the log to work(level, line), or to nobody. */
  logTo(work, level = 'info') {
    const core = this.#core;
    const next = work ? core.callback((at, line) => { work(at, line); }) : null;
    const number = work ? core.number('jam_log_level', level, 'level') : 0;
    core.check(core.call('jam_set_log', this.handle, work ? core.call('jam_wasm_log') : 0, number, next?.id ?? 0));
    this.#log?.end();
    this.#log = next;
  }

  /** Runs work() while `progress` is called; calls within a progress function report nothing themselves. */
  reporting(progress, work) {
    const core = this.#core;
    if (progress !== undefined && typeof progress !== 'function') throw new JamError('argument', 'progress must be a function');
    const watch = [progress, core.watch].filter(Boolean);
    if (watch.length === 0 || this.#running) return work();
    const callback = core.callback((now) => watch.map((one) => one(now, this)).includes(true));
    core.check(core.call('jam_set_progress', this.handle, core.call('jam_wasm_progress'), callback.id));
    this.#running = true;
    try {
      return work();
    } finally {
      this.#running = false;
      if (!core.broken) core.call('jam_set_progress', this.handle, 0, 0);
      callback.end();
    }
  }

  /** How many elements an array of the network has. */
  counted(name) {
    return this.#core.use((arena) => {
      const needed = arena.room(4);
      this.#core.check(this.#core.call(name, this.handle, 0, 0, needed));
      return this.#core.view().getUint32(needed, true);
    });
  }
  call(name, args) { return invoke(this.#core, this, name, args); }
}
if (Symbol.dispose) Packing.prototype[Symbol.dispose] = Packing.prototype.dispose;

function newHandle(core, call) {
  return core.use((arena) => {
    const out = arena.room(4);
    const status = core.check(call(out));
    if (status !== 'ok') throw new JamError(status, core.reason());
    return core.view().getUint32(out, true);
  });
}

/** The content of a file, as all who read take it. */
function content(bytes, call) {
  if (ArrayBuffer.isView(bytes) && bytes.BYTES_PER_ELEMENT === 1) return bytes;
  const given = typeof bytes === 'string' ? JSON.stringify(bytes) : Object.prototype.toString.call(bytes).slice(8, -1);
  throw new JamError('argument', `${call} takes the bytes of a file, a Uint8Array, not ${given}`);
}

/** A file's bytes as they are before gzip. */
async function unpacked(bytes, name) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  if (typeof DecompressionStream === 'undefined')
    throw new JamError('unsupported', `${name} is a gzip file, which this JavaScript cannot unpack: unpack it first`);
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch (error) {
    throw new JamError('format', `${name}: not a whole gzip file of one part: unpack it first (${error.message})`);
  }
}

/** The library, loaded. */
export class Jam {
  #core;
  constructor(core) { this.#core = core; }

  /** Made once and for all workers. */
  get module() { return this.#core.module; }
  get version() { return this.#core.string(this.#core.call('jam_version')); }
  get commit() { return this.#core.string(this.#core.call('jam_commit')); }
  /** The table of file formats of the library. */
  get formats() {
    const keys = ['contains', 'number', 'word', 'name', 'endings', 'largestDimension', 'holds', 'ways'];
    const lines = this.#core.string(this.#core.call('jam_formats')).split('\n').filter((line) => line !== '');
    return lines.map((line) => Object.fromEntries(line.split('\t').map((field, k) => [keys[k], field])));
  }

  /** A random start. `diameters`: ratios alone. */
  random(options = {}) {
    if (options.positions) throw new JamError('argument', 'a random start has no positions: use from()');
    return this.#create(options);
  }
  /** A packing from positions (n, d) and diameters, one or n of them. */
  from(options) {
    if (!options?.positions) throw new JamError('argument', 'from() needs positions: use random() for a random start');
    return this.#create(options);
  }
  #create({ positions, diameters, cell, progress, ...options }) {
    const core = this.#core;
    return core.use((arena) => this.#reporting(progress, (from, user) => {
      const start = arena.report('jam_start');
      const place = (key) => start + STRUCTS.jam_start.members.find((m) => m[0] === key)[1];
      const given = { positions, diameters: typeof diameters === 'number' ? [diameters] : diameters, cell };
      const written = { progress: from, user };
      for (const [key, values] of Object.entries(given)) {
        if (values == null) continue;
        written[key] = arena.array(values, 'double', key);
        written[`${key}Len`] = values.length;
      }
      for (const [key, value] of Object.entries(written)) core.view().setUint32(place(key), value, true);
      const o = arena.options('jam_create_options', this.#known(options, 'jam_create_options', [...Object.keys(given).filter((key) => key !== 'positions' || positions), 'progress']));
      return new Packing(core, newHandle(core, (out) => core.call('jam_create', o, start, out)));
    }));
  }
  #known(options, struct, more) {
    const names = [...more, ...STRUCTS[struct].members.map((m) => m[0])];
    const wrong = Object.keys(options).find((key) => !names.includes(key));
    if (wrong) throw new JamError('argument', `there is no option ${wrong}; there are ${names.join(', ')}`);
    return options;
  }
  #reporting(progress, work) {
    const core = this.#core;
    const watch = [progress, core.watch].filter(Boolean);
    if (watch.length === 0) return work(0, 0);
    const callback = core.callback((now) => watch.map((one) => one(now, null)).includes(true));
    try {
      return work(core.call('jam_wasm_progress'), callback.id);
    } finally {
      callback.end();
    }
  }

  /** Reads a file of any format that libjam reads, compressed or not. `name` stands in errors; `layout` as of jam_read_as. */
  async read(bytes, { name = 'packing', layout = '', progress, ...options } = {}) {
    const plain = await unpacked(content(bytes, 'read'), name);
    return this.#opened(plain, plain === bytes ? name : name.replace(/\.gz$/i, ''), (core, arena, path) => {
      const o = arena.options('jam_create_options', this.#known(options, 'jam_create_options', ['name', 'layout', 'progress']));
      const words = arena.string(layout);
      return this.#reporting(progress, (from, user) =>
        newHandle(core, (out) => core.call('jam_read_as', path, words, o, from, user, out)));
    });
  }
  readCheckpoint(bytes) {
    return this.#opened(content(bytes, 'readCheckpoint'), 'checkpoint', (core, arena, path) => newHandle(core, (out) => core.call('jam_read_checkpoint', path, 0, 0, out)));
  }
  #opened(bytes, name, open) {
    const core = this.#core;
    core.put(name, bytes);
    try {
      return core.use((arena) => new Packing(core, open(core, arena, arena.string(name))));
    } finally {
      if (!core.broken) core.take(name);
    }
  }

  /** For workers: called with each progress of every call; true stops it. */
  set watch(work) { this.#core.watch = work; }
  call(name, args) { return invoke(this.#core, null, name, args); }
}

for (const [name, call] of Object.entries(CALLS)) {
  const kind = call.system ? Packing : Jam;
  if (name === 'writeCheckpoint') continue;  // checkpoint()
  Object.defineProperty(kind.prototype, name, { writable: true, configurable: true, value(...args) { return this.call(name, args); } });
}

/** Loads the library from the bytes of jam.wasm, or from a module that was compiled before. */
export async function load(source) {
  return new Jam(await Core.load(source));
}
