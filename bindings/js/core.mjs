// The WebAssembly module with its memory: what it imports, texts, arrays, structs and files in it.
import { CALLS, DEFAULTS, STRUCTS, WORDS } from './api.mjs';
import { JamError } from './errors.mjs';

const text = new TextDecoder();
const bytes = new TextEncoder();
/** What the methods are called that jam.mjs has beside CALLS. */
const BY_HAND = { jam_create: 'random() or from()', jam_read: 'read', jam_read_checkpoint: 'readCheckpoint', jam_write_checkpoint: 'checkpoint' };

/** What the module imports: clocks, callbacks, and an environment without variables. */
function imports(core) {
  const words = (at, ...values) => values.forEach((v, k) => core.view().setUint32(at[k], v, true)) || 0;
  return {
    jam: {
      progress: (at, id) => core.calledBack(id, () => core.struct('jam_progress', at)),
      log: (level, line, id) => core.calledBack(id, () => [core.word('jam_log_level', level), core.string(line)]),
    },
    env: { emscripten_notify_memory_growth() {} },
    wasi_snapshot_preview1: {
      clock_time_get(clock, precision, at) {
        const now = clock === 0 ? Date.now() : performance.now();
        core.view().setBigUint64(at, BigInt(Math.round(now * 1e6)), true);
        return 0;
      },
      proc_exit: () => core.stopped(),
      environ_sizes_get: (count, size) => words([count, size], 0, 0),
      environ_get: () => 0,
    },
  };
}

export class Core {
  /** @param {BufferSource | WebAssembly.Module} source */
  static async load(source) {
    const core = new Core();
    const made = await WebAssembly.instantiate(source, imports(core)).catch((error) => {
      throw error instanceof RangeError ? new JamError('memory', `WebAssembly is given no memory here (${error.message})`) : error;
    });
    core.exports = (made.instance ?? made).exports;
    core.module = made.module ?? source;
    core.exports._initialize();
    return core;
  }

  callbacks = new Map();
  nextCallback = 1;
  broken = false;
  #view = null;

  view() {
    const buffer = this.exports.memory.buffer;
    if (this.#view?.buffer !== buffer) this.#view = new DataView(buffer);
    return this.#view;
  }

  /** Calls a function of C. What stops the module itself (no stack, a trap) leaves its memory in no defined state. */
  call(name, ...args) {
    if (this.broken) throw new JamError('internal', `the module has stopped: ${this.broken}; load it again`);
    try {
      return this.exports[name](...args);
    } catch (error) {
      this.broken = error.message || String(error);
      throw new JamError('internal', `${name} has stopped the module: ${this.broken}`, { cause: error });
    }
  }
  stopped() {
    throw new Error('it has ended itself');
  }

  /** Numbers of C's memory that are freed together: use(arena => ...). */
  use(work) {
    const taken = [];
    const arena = {
      room: (size) => {
        const at = this.call('malloc', Math.max(size, 1));
        if (at === 0) throw new JamError('memory', `WebAssembly has no memory for an array of ${size} bytes`);
        taken.push(at);
        new Uint8Array(this.view().buffer, at, size).fill(0);
        return at;
      },
      string: (value) => {
        const coded = bytes.encode(value);
        if (coded.includes(0)) throw new JamError('argument', 'a text must not contain the character of code 0');
        const at = arena.room(coded.length + 1);
        new Uint8Array(this.view().buffer, at, coded.length).set(coded);
        return at;
      },
      array: (values, type, name) => {
        if (!Array.isArray(values) && !(ArrayBuffer.isView(values) && 'length' in values))
          throw new JamError('argument', `${name} must be an array of numbers`);
        const size = type === 'int32_t' ? 4 : 8;
        const at = arena.room(values.length * size);
        this.fill(at, values, type, name);
        return at;
      },
      options: (struct, given) => {
        const at = arena.room(STRUCTS[struct].size);
        this.check(this.call(DEFAULTS[struct], at, STRUCTS[struct].size));
        for (const [name, value] of Object.entries(given)) if (value !== undefined) this.setMember(struct, at, name, value);
        return at;
      },
      report: (struct) => {
        const at = arena.room(STRUCTS[struct].size);
        this.view().setUint32(at, STRUCTS[struct].size, true);
        return at;
      },
    };
    try {
      return work(arena);
    } finally {
      if (!this.broken) taken.forEach((at) => this.call('free', at));
    }
  }

  fill(at, values, type, name) {
    const { buffer } = this.view();
    if (type === 'double') {
      const wrong = Array.prototype.findIndex.call(values, (v) => typeof v !== 'number');
      if (wrong >= 0) throw new JamError('argument', `${name}[${wrong}] must be a number, not ${typeof values[wrong]}`);
      new Float64Array(buffer, at, values.length).set(values);
    } else {
      const wrong = Array.prototype.findIndex.call(values, (v) => !Number.isSafeInteger(Number(v)));
      if (wrong >= 0) throw new JamError('argument', `${name}[${wrong}] must be a whole number, not ${values[wrong]}`);
      if (type === 'int32_t') {
        const far = Array.prototype.findIndex.call(values, (v) => v !== (v | 0));
        if (far >= 0) throw new JamError('argument', `${name}[${far}] = ${values[far]} is beyond 32 bits`);
        new Int32Array(buffer, at, values.length).set(values);
      } else new BigInt64Array(buffer, at, values.length).set(Array.from(values, (v) => BigInt(v)));
    }
  }

  /** A copy of an array. Whole numbers of 64 bits come as doubles, exact below 2^53. */
  array(at, length, type) {
    const { buffer } = this.view();
    if (type === 'double') return new Float64Array(buffer, at, length).slice();
    if (type === 'int32_t') return new Int32Array(buffer, at, length).slice();
    return Float64Array.from(new BigInt64Array(buffer, at, length), Number);
  }

  string(at) {
    const all = new Uint8Array(this.view().buffer);
    return text.decode(all.subarray(at, all.indexOf(0, at)));
  }

  /** The word of an enum's number; a number that has none stays one. */
  word(of, value) {
    return Object.keys(WORDS[of]).find((w) => WORDS[of][w] === value) ?? value;
  }
  number(of, value, name) {
    const found = typeof value === 'string' ? WORDS[of][value] : value;
    if (Number.isInteger(found)) return found;
    throw new JamError('argument', `${name} is ${JSON.stringify(value)}: one of ${Object.keys(WORDS[of]).join(', ')} is wanted`);
  }

  /** A whole number of C, checked: JavaScript would cut what does not fit. */
  integer(value, name, bits) {
    if (!Number.isInteger(value) && typeof value !== 'bigint')
      throw new JamError('argument', `${name} must be a whole number, not ${JSON.stringify(value)}`);
    const exact = BigInt(value);
    if (BigInt.asIntN(bits, exact) !== exact) throw new JamError('argument', `${name} = ${value} is beyond ${bits} bits`);
    return bits === 64 ? exact : Number(exact);
  }
  flag(value, name) {
    if (typeof value === 'boolean' || value === 0 || value === 1) return Number(value);
    throw new JamError('argument', `${name} must be true or false, not ${value}`);
  }
  real(value, name) {
    if (typeof value === 'number') return value;
    throw new JamError('argument', `${name} must be a number, not ${JSON.stringify(value)}`);
  }

  /** The value of an argument or member that stands for C's number. */
  scalar(type, kind, value, name) {
    if (kind === 'bool') return this.flag(value, name);
    if (kind && kind !== 'optional') return this.number(kind, value, name);
    if (type === 'double') return this.real(value, name);
    return this.integer(value, name, type === 'int64_t' ? 64 : 32);
  }

  setMember(struct, at, name, value) {
    const member = STRUCTS[struct].members.find((m) => m[0] === name);
    const [, offset, type, kind] = member;
    const number = this.scalar(type, kind, value, name);
    const view = this.view();
    if (type === 'double') view.setFloat64(at + offset, number, true);
    else if (type === 'int64_t') view.setBigInt64(at + offset, number, true);
    else view.setInt32(at + offset, number, true);
  }

  /** A struct as an object. Whole numbers that a double does not hold are BigInts. */
  struct(name, at) {
    const view = this.view();
    const object = {};
    for (const [key, offset, type, kind] of STRUCTS[name].members) {
      let value;
      if (type === 'double') value = view.getFloat64(at + offset, true);
      else if (type === 'int64_t') {
        const exact = view.getBigInt64(at + offset, true);
        value = Number.isSafeInteger(Number(exact)) ? Number(exact) : exact;
      } else value = view.getInt32(at + offset, true);
      if (kind === 'bool') value = value !== 0;
      else if (kind) value = this.word(kind, value);
      object[key] = value;
    }
    return object;
  }

  /** Why the last call gave a status other than 'ok', with JavaScript's names of calls. */
  reason() {
    const named = (c) => BY_HAND[c] ?? Object.keys(CALLS).find((name) => CALLS[name].c === c) ?? c;
    return this.string(this.call('jam_last_error')).replace(/\bjam_\w+/g, named).replaceAll('(sys, ', '(');
  }
  /** Throws where a call failed; gives the word of its status. */
  check(status) {
    const word = this.word('jam_status_code', status);
    if (status < 0) throw new JamError(word, this.reason());
    return word;
  }

  /** A JavaScript function for C: its number, which C passes back. An error in it stops the call and is thrown by it. */
  callback(work) {
    const id = this.nextCallback++;
    const entry = { work, error: null };
    this.callbacks.set(id, entry);
    return {
      id,
      end: () => {
        this.callbacks.delete(id);
        if (entry.error) throw entry.error;
      },
    };
  }
  calledBack(id, given) {
    const entry = this.callbacks.get(id);
    try {
      const args = given();
      return entry.work(...(Array.isArray(args) ? args : [args])) === true ? 1 : 0;
    } catch (error) {
      entry.error ??= error;
      return 1;
    }
  }

  // ---- files: each is in memory under a name while a call needs it
  put(name, content) {
    return this.use((arena) => {
      const at = this.call('jam_wasm_put', arena.string(name), content.length);
      if (at === 0) throw new JamError('memory', `WebAssembly has no memory for a file of ${content.length} bytes`);
      new Uint8Array(this.view().buffer, at, content.length).set(content);
    });
  }
  take(name) {
    return this.use((arena) => {
      const path = arena.string(name);
      const size = arena.room(4);
      const at = this.call('jam_wasm_get', path, size);
      const found = at === 0 ? null : new Uint8Array(this.view().buffer, at, this.view().getUint32(size, true)).slice();
      this.call('jam_wasm_remove', path);
      return found;
    });
  }
}
