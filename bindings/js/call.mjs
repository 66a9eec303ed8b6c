// Calls a function of the header by its conventions: words for enums, options by name, arrays by count and fill.
import { CALLS, STRUCTS, WORDS } from './api.mjs';
import { JamError } from './errors.mjs';

const INPUTS = ['scalar', 'string', 'file', 'array_in', 'handle'];
const FILLED = ['ok', 'ambiguous', 'not_converged', 'not_jammed'];

function isOptional([, role, , , kind]) {
  return role === 'array_in' || (role === 'scalar' && kind !== '');
}

/** Plain arguments by name, and the options behind them. */
function taken(name, rows, args) {
  const plain = rows.filter((row) => INPUTS.includes(row[1]));
  const last = args.at(-1);
  const isObject = last !== null && typeof last === 'object' && Object.getPrototypeOf(last) === Object.prototype;
  const options = isObject ? last : {};
  const values = isObject ? args.slice(0, -1) : args;
  if (values.length > plain.length)
    throw new JamError('argument', `${name} takes ${plain.map((row) => row[0]).join(', ') || 'no arguments'} and an object of options`);
  const given = {};
  plain.forEach((row, k) => {
    given[row[0]] = values[k];
    if (values[k] === undefined && !isOptional(row)) throw new JamError('argument', `${name} needs ${row[0]}`);
  });
  return [given, options];
}

/** Options by the struct that has them. */
function sorted(name, rows, options) {
  const structs = rows.filter((row) => row[1] === 'struct_in');
  const made = new Map(structs.map((row) => [row[0], row[4] ? options[row[4]] ?? null : {}]));
  const names = (struct) => STRUCTS[struct].members.map((m) => m[0]);
  for (const [key, value] of Object.entries(options)) {
    if (key === 'progress' || structs.some((row) => row[4] === key)) continue;
    const owner = structs.find((row) => !row[4] && names(row[2]).includes(key));
    if (!owner) {
      const known = structs.flatMap((row) => (row[4] ? [row[4]] : names(row[2])));
      throw new JamError('argument', `${name} has no option ${key}; it has ${[...known, 'progress'].join(', ')}`);
    }
    made.get(owner[0])[key] = value;
  }
  for (const row of structs)
    for (const key of Object.keys((row[4] && made.get(row[0])) || {}))
      if (!names(row[2]).includes(key)) throw new JamError('argument', `${name}: ${row[4]} has no option ${key}; it has ${names(row[2]).join(', ')}`);
  return made;
}

/** Numbers of elements, by the header's shapes; `count` stands for the extent that the call gives. */
function elements(extents, count, columns, packing) {
  const one = (extent) => {
    if (/^\d+$/.test(extent)) return Number(extent);
    if (extent === 'd') return packing.dim;
    if (extent === 'n') return packing.n;
    if (extent === "N'") return packing.counted('jam_hessian_map');
    if (extent === "d N' + 1") return packing.dim * packing.counted('jam_hessian_map') + 1;
    if (extent === 'n_c') return packing.counted('jam_contact_gaps');
    return extent in WORDS ? columns : count;
  };
  return extents.reduce((product, extent) => product * one(extent), 1);
}

/** What of the arguments goes to C: numbers and addresses in C's order, and places of what comes back. */
function passed(core, arena, rows, call, given, structs) {
  const out = [];
  const places = {};
  for (const [name, role, type, , kind] of rows) {
    const value = given[name];
    if (role === 'scalar') out.push(core.scalar(type, kind, value ?? 0, name));
    else if (role === 'string') out.push(arena.string(String(value)));
    else if (role === 'file') out.push(value === null ? 0 : arena.string(value));
    else if (role === 'handle') out.push(value.handle);
    else if (role === 'array_in') out.push(value == null ? 0 : arena.array(value, type, name), value?.length ?? 0);
    else if (role === 'struct_in') out.push(structs.get(name) === null ? 0 : arena.options(type, structs.get(name)));
    else if (role === 'columns') out.push(call.columns.length);
    else if (role === 'array_out') {
      places[name] = out.length;
      out.push(0, 0);
    } else if (role === 'scalar_out' || role === 'struct_out') {
      places[name] = out.length;
      out.push(role === 'scalar_out' ? arena.room(8) : type.endsWith('_options') ? arena.options(type, {}) : arena.report(type));
    }
  }
  return [out, places];
}

/** Arrays are asked for their size, then filled. */
function filled(core, arena, rows, call, packing, out, places, run) {
  const arrays = rows.filter((row) => row[1] === 'array_out');
  let status = run();
  if (arrays.length === 0 || !FILLED.includes(status)) return status;
  const counter = rows.find((row) => row[1] === 'scalar_out' && (row[0] === 'needed' || row[0] === 'rows'));
  const count = core.view().getUint32(out[places[counter[0]]], true);
  for (const [name, , type, extents] of arrays) {
    const length = arrays.length === 1 && counter[0] === 'needed' ? count : elements(extents, count, call.columns?.length, packing);
    out[places[name]] = arena.room(length * (type === 'int32_t' ? 4 : 8));
    out[places[name] + 1] = length;
  }
  status = run();
  return status;
}

function results(core, rows, call, out, places, status) {
  const made = {};
  for (const [name, role, type] of rows) {
    const at = out[places[name]];
    if (role === 'array_out') {
      const flat = core.array(at, out[places[name] + 1], type);
      if (name !== 'table') made[name] = flat;
      else {
        const width = call.columns.length;
        call.columns.forEach((key, k) => (made[key] = Float64Array.from({ length: flat.length / width }, (_, i) => flat[i * width + k])));
      }
    } else if (role === 'struct_out') {
      const report = core.struct(type, at);
      const options = type.endsWith('_options');
      if (!options) {
        report.status = status;
        report.statusText = status === 'ok' ? '' : core.reason();
      }
      if (type === 'jam_check_report') report.text = core.string(core.call('jam_check_text', at));
      if (type === 'jam_proof_report') {
        const number = (key, of) => WORDS[of][report[key]];
        report.text = core.string(core.call('jam_proof_text', number('theorem', 'jam_theorem'), number('cause', 'jam_proof_cause'),
          report.theorem === 'trapped' ? report.inner : report.radius, report.causeValue, report.causeBound));
      }
      made[name] = report;
    } else if (role === 'scalar_out' && name !== 'needed' && name !== 'rows') made[name] = core.view().getFloat64(at, true);
  }
  return made;
}

/** packing: null for calls that need none. Gives one result as it is, several as an object, and the packing for none. */
export function invoke(core, packing, name, args) {
  const outcome = { last: null };
  try {
    return made(core, packing, name, args, outcome);
  } catch (error) {
    if (error instanceof JamError) packing?.noted(error.status, error.message);
    else if (outcome.last) packing?.noted(outcome.last); // a progress function threw, which has stopped the call
    throw error;
  }
}
function made(core, packing, name, args, outcome) {
  const call = CALLS[name];
  const [given, options] = taken(name, call.args, args);
  const structs = sorted(name, call.args, options);
  return core.use((arena) => {
    const [out, places] = passed(core, arena, call.args, call, given, structs);
    const handle = call.system ? [packing.handle] : [];
    const run = () => (outcome.last = core.check(core.call(call.c, ...handle, ...out)));
    const status = call.system
      ? packing.reporting(options.progress, () => filled(core, arena, call.args, call, packing, out, places, run))
      : filled(core, arena, call.args, call, null, out, places, run);
    const found = results(core, call.args, call, out, places, status);
    if (packing) packing.noted(outcome.last);
    const partial = Object.values(found).some((value) => value.stopReason !== undefined);
    if (outcome.last === 'cancelled' && !partial) throw new JamError(outcome.last, core.reason());
    const file = call.args.find((row) => row[1] === 'file');
    if (file && given[file[0]] !== null) {
      const bytes = core.take(given[file[0]]);
      return Object.keys(found).length ? { bytes, ...found } : bytes;
    }
    const keys = Object.keys(found);
    return keys.length === 0 ? packing : keys.length === 1 ? found[keys[0]] : found;
  });
}
