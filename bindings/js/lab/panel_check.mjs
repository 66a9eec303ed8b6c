// Check a file or the packing that is shown, and prove.
import { TEXT } from './texts.mjs';
import { checked, checkedProof, opened } from './engine.mjs';
import { adopt, fault, needed, progress, run, session, tell } from './session.mjs';
import { button, byId, make, saveFile, shown, table } from './parts.mjs';

const T = TEXT.check, P = TEXT.prove, MOST = 20; // rattlers that are named
const PROOF = /\.jamproof$/i;
const follow = (now) => progress(now.fraction, now.secondsLeft);

export function checkPanel() {
  const input = make('input', { type: 'file', id: 'file', ariaLabel: T.choose });
  input.addEventListener('change', () => input.files.length && takeFile(input.files[0]));
  return make('section', {}, make('h2', { textContent: T.title }),
    make('div', { id: 'drop' }, make('p', { textContent: T.drop }), input, make('p', { className: 'hint', textContent: T.formats })),
    make('div', { className: 'row' }, button(T.own, needed(() => run(T.running, checkShown)), 'check-own', true)),
    make('div', { id: 'check-result', ariaLive: 'polite' }));
}
export function watchDrops(openTab) {
  const over = (on) => (event) => {
    event.preventDefault();
    document.body.classList.toggle('over', on);
  };
  document.addEventListener('dragover', over(true));
  document.addEventListener('dragleave', over(false));
  document.addEventListener('drop', (event) => {
    over(false)(event);
    const [file] = event.dataTransfer.files;
    if (file) takeFile(file, openTab);
  });
}

/** A proof file goes to the checker, any other file to the library. */
export function takeFile(file, openTab = () => {}) {
  if (PROOF.test(file.name)) {
    openTab('prove');
    return run(P.running2, () => checkProofFile(file));
  }
  openTab('check');
  byId('check-result').replaceChildren();
  return run(T.reading(file.name), async () => {
    const packing = await opened(session.jam, file), { packingFraction: phi } = await packing.info();
    await adopt(packing, { recipe: null, name: file.name, title: file.name, phi });
    await checkShown();
  });
}

async function checkShown() {
  const { packing } = session, notes = await packing.notes;
  const found = await checked(packing, follow), { report } = found, place = byId('check-result');
  const name = (k) => (k < 0 ? T.wall(-1 - k) : String(k));
  const { text } = report, first = text.slice(0, text.indexOf('. ') + 1 || text.length);
  const parts = [make('p', { id: 'verdict' }, make('b', { textContent: first }), text.slice(first.length))];
  if (found.motion) parts.push(make('p', { textContent: T.flex }));
  if (found.weakest) {
    const { i, j, force } = found.weakest;
    parts.push(make('p', { id: 'weakest', textContent: T.weakest(name(i), name(j), shown(force, 3)) }), make('h3', { textContent: T.contacts }),
      table([T.pair, T.force, T.gap], found.strongest.map((c) => [`${name(c.i)}, ${name(c.j)}`, shown(c.force, 4), shown(c.gap, 3)])));
    const some = found.rattlers.slice(0, MOST).join(', '), more = found.rattlers.length - MOST;
    parts.push(make('p', { textContent: some ? T.rattlers(some, more > 0 ? T.andMore(more) : '') : T.noRattlers }));
  }
  parts.push(make('h3', { textContent: T.assumed }), make('ul', { id: 'notes' }, ...(notes.length ? notes : [T.nothing]).map((line) => make('li', { textContent: line }))));
  place.replaceChildren(...parts);
  session.about.check = { jammed: report.jammed, contacts: report.contacts, rattlers: report.rattlers };
  await adopt(packing, session.about, { motion: found.motion });
  tell(first);
}

export function provePanel() {
  const input = make('input', { type: 'file', id: 'proof-file', accept: '.jamproof', ariaLabel: P.other });
  input.addEventListener('change', () => input.files.length && run(P.running2, () => checkProofFile(input.files[0])));
  return make('section', {}, make('h2', { textContent: P.title }),
    make('div', { className: 'row' }, button(P.go, needed(() => run(P.running, prove)), 'prove-go', true),
      button(P.save, needed(() => run(P.running, saveProof)), 'prove-save')),
    make('div', { id: 'proof', ariaLive: 'polite' }), make('h2', { textContent: P.other }), make('p', { className: 'hint', textContent: P.hint }),
    input, make('div', { id: 'proof-answer', ariaLive: 'polite' }));
}
async function prove() {
  const report = await session.packing.prove('collective', null, { progress: follow });
  const radius = report.theorem === 'trapped' ? report.inner : report.radius, parts = [make('p', { className: 'verdict', textContent: report.text })];
  if (Number.isFinite(radius) && radius > 0)
    parts.push(make('p', { textContent: P.radius(radius.toExponential(2), Math.floor(-Math.log10(radius))) }));
  byId('proof').replaceChildren(...parts);
  tell(report.text);
}
async function saveProof() {
  const answer = await session.packing.writeProof('packing.jamproof', 'collective');
  saveFile('packing.jamproof', answer.bytes ?? answer);
  tell('');
}
async function checkProofFile(file) {
  const answer = await checkedProof(new Uint8Array(await file.arrayBuffer()));
  byId('proof-answer').replaceChildren(make('p', { className: 'verdict', id: 'answer', textContent: answer.text }), make('p', { textContent: answer.summary }));
  tell(`${file.name}: ${P.words[answer.status]}`);
  fault('');
}
