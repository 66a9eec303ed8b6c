// The library in a worker, from what the page holds, and the work that takes several of its calls.
import { growthOf, isCrunched, lawOf, ratioOf, startOf, twoSizes } from './recipe.mjs';
import { TEXT } from './texts.mjs';
import { unpacked } from './unpack.mjs';

const FRAMES = 0.25; // seconds between pictures of a packing that grows
const LARGEST = 2 ** 26, ROOM = 2 ** 31; // bytes of a file; of memory that a crunch may take
const SHOWN = 8; // contacts in the table of the strongest

const workerOf = (script) => new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })));

export async function startEngine() {
  const script = await unpacked('engine').text();
  return spawnOn(() => webPort(workerOf(script)), new Uint8Array(await unpacked('wasm').arrayBuffer()));
}

/** Answer of the checker, which is a worker of its own. */
export async function checkedProof(bytes) {
  const worker = workerOf(await unpacked('checker').text());
  return new Promise((resolve, reject) => {
    worker.onmessage = ({ data }) => resolve(data);
    worker.onerror = (event) => reject(new Error(event.message));
    worker.postMessage(bytes);
  }).finally(() => worker.terminate());
}

async function diametersOf(jam, r) {
  if (r.law === 'two') return twoSizes(r.n, ratioOf(r));
  const law = lawOf(r);
  if (!law) return undefined;
  const { options, curve } = await jam.parseDiameters(law);
  const given = Object.fromEntries(Object.entries(options).filter(([, v]) => v !== 0 && !Number.isNaN(v)));
  return jam.diameters(curve.length ? curve : null, { ...given, n: r.n, dim: r.dim, seed: r.seed });
}

export async function started(jam, r) {
  const diameters = await diametersOf(jam, r);
  return jam.random({ ...startOf(r), ...(diameters ? { diameters } : {}) });
}
/** Growth and crunch, from a start or from where they were stopped; `shown(frame)` and `told(phase, progress)` follow. */
export async function made(packing, r, { shown, told }) {
  const { paused, pressure } = await packing.info(), resume = paused === 'compress';
  const follow = (phase) => (now) => {
    if (now.frame) shown(now.frame);
    told(phase, now);
  };
  if (resume || (paused !== 'crunch' && !Number.isFinite(pressure))) // growth that has ended leaves its pressure
    await packing.compress({ ...growthOf(r), resume, progress: follow('growing'), frames: FRAMES });
  if (!isCrunched(r)) return null;
  const estimate = await packing.estimateCrunch();
  if (estimate.memory > ROOM) throw new Error(TEXT.make.memory(Math.round(estimate.memory / 1e6), Math.round(ROOM / 1e6)));
  return packing.crunch({ progress: follow('crunching'), frames: FRAMES });
}

/** A packing of a file, and what was assumed. */
export async function opened(jam, file) {
  if (file.size > LARGEST) throw new Error(TEXT.tooLarge(Math.round(file.size / 1e6)));
  if (file.size === 0) throw new Error(TEXT.empty(file.name));
  return jam.read(new Uint8Array(await file.arrayBuffer()), { name: file.name });
}

/** The report of the check, and what a reader wants to see of it: strongest and weakest contacts, rattlers, the flex. */
export async function checked(packing, progress) {
  const report = await packing.check({ progress });
  const found = { report, strongest: [], weakest: null, rattlers: [], motion: null };
  if (report.jammed !== 'yes') {
    if (report.flexes > 0) found.motion = await flexOf(packing);
    if (!found.motion) return found;
  }
  const status = await networkOf(packing);
  if (!status) return found;
  const [pairs, forces, gaps, counts] = await Promise.all(['contacts', 'forces', 'contactGaps', 'coordination'].map((name) => packing[name]()));
  const order = Array.from(forces.keys()).filter((k) => Number.isFinite(forces[k])).sort((a, b) => forces[b] - forces[a]);
  const row = (k) => ({ i: pairs[2 * k], j: pairs[2 * k + 1], force: forces[k], gap: gaps[k] });
  found.strongest = order.slice(0, SHOWN).map(row);
  if (order.length) found.weakest = row(order.at(-1));
  found.rattlers = Array.from(counts.keys()).filter((i) => counts[i] === 0);
  return found;
}
/** A motion that the contacts leave, d rows of n numbers; null where there is none. */
async function flexOf(packing) {
  try {
    const { out: flat } = await packing.flex('collective');
    if (!flat.length) return null;
    return Float64Array.from({ length: flat.length }, (_, k) => flat[(k % packing.n) * packing.dim + Math.floor(k / packing.n)]);
  } catch {
    return null; // the network has none: the paragraph of the check says what there is
  }
}
/** Contacts of a file's packing come from its geometry, where they balance. */
async function networkOf(packing) {
  try {
    await packing.contacts();
    return true;
  } catch {
    try {
      await packing.contactsFromGeometry();
      return true;
    } catch {
      return false; // the check says why
    }
  }
}

/** The page of a packing, as the library writes it. */
export async function pageOf(packing, title, small, motion) {
  const none = { names: '', values: null }, more = motion ? { names: `${TEXT.check.flexName}[]`, values: motion } : none;
  const answer = await packing.writePage('page.html', title, small, more.names, more.values);
  return new TextDecoder().decode(answer.bytes ?? answer);
}
