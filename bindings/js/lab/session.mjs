// What all panels share: the library, the packing that is shown, one piece of work at a time, and what is told.
import { TEXT } from './texts.mjs';
import { byId } from './parts.mjs';
import { canKeep, keepPacking } from './keep.mjs';
import { showPacking } from './view.mjs';

/** about: recipe or null, what the crunch and the check said, name. */
export const session = { jam: null, packing: null, about: {}, running: false, listeners: [] };

export function tell(text) {
  byId('status').textContent = text;
}
export function fault(text) {
  const place = byId('error');
  place.textContent = text;
  place.hidden = !text;
}
export const failed = (error) => fault(error.status === 'memory' ? `${error.message}. ${TEXT.noMemory}` : error.message);
export function progress(share, secondsLeft = NaN) {
  if (Number.isFinite(share)) byId('bar').value = share;
  else byId('bar').removeAttribute('value');
  byId('left').textContent = TEXT.left(secondsLeft);
}
export function whenPacking(work) {
  session.listeners.push(work);
}

/** Shows a packing as the one that all panels speak of, and keeps it. */
export async function adopt(packing, about, view = {}) {
  const old = session.packing;
  [session.packing, session.about] = [packing, about];
  await showPacking(packing, { title: about.title ?? '', ...view });
  for (const work of session.listeners) work();
  if (old && old !== packing) old.dispose();
  await store(await packing.checkpoint(), about);
}
/** Into the browser's storage; where that refuses, the foot of the page says so. */
export async function store(bytes, about) {
  try {
    if (canKeep()) await keepPacking(bytes, about);
  } catch {
    byId('kept').textContent = TEXT.notKept;
  }
}

/** Runs one piece of work; its failures are told in the library's sentence. */
export async function run(text, work) {
  if (session.running) return fault(TEXT.busy);
  session.running = true;
  fault('');
  tell(text);
  byId('work').hidden = false;
  byId('bar').removeAttribute('value');
  byId('left').textContent = '';
  try {
    return await work();
  } catch (error) {
    const stopped = error.status === 'cancelled';
    tell(stopped ? TEXT.stopped : '');
    if (!stopped) failed(error);
  } finally {
    session.running = false;
    byId('work').hidden = true;
  }
}
export const needed = (work) => () => (session.packing ? work() : fault(TEXT.noPacking));
