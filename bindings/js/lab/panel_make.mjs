// Make: the form of a packing, and its growth on the screen.
import { TEXT, STEPS } from './texts.mjs';
import { RECIPE, isCrunched } from './recipe.mjs';
import { made, started } from './engine.mjs';
import { keep, keptValue } from './keep.mjs';
import { adopt, fault, progress, run, session, store, tell, whenPacking } from './session.mjs';
import { showMoment } from './view.mjs';
import { button, byId, choice, field, make, shown } from './parts.mjs';

const M = TEXT.make, LONG = ['list', 'sieve'];
const GROWS = 0.5; // share of the bar for the growth, the rest for the crunch
const NUMBERS = { n: [1, 100000], dim: [2, 3], seed: [0, 9007199254740991] };

function numberBox(name, value) {
  const [min, max] = NUMBERS[name];
  return make('input', { id: `make-${name}`, type: 'number', min, max, step: 1, value, required: true });
}
export function readForm() {
  const of = (name) => byId(`make-${name}`).value.trim(), r = { ...RECIPE };
  for (const name of Object.keys(NUMBERS)) r[name] = Number(of(name));
  for (const name of ['law', 'items', 'curve', 'walls', 'protocol']) r[name] = of(name);
  const porosity = of('porosity');
  r.density = porosity === '' ? of('density') : String(+(1 - Number(porosity)).toPrecision(15));
  return r;
}
export function fillForm(given) {
  const r = { ...RECIPE, ...given };
  for (const name of [...Object.keys(NUMBERS), 'law', 'items', 'curve', 'walls', 'protocol', 'density']) byId(`make-${name}`).value = r[name];
  byId('make-porosity').value = '';
  followLaw();
}
function followLaw() {
  const law = byId('make-law').value, items = byId('make-items');
  items.placeholder = M.hints[law] ?? '';
  items.closest('label').hidden = law === 'equal';
  byId('make-curve').closest('label').hidden = !LONG.includes(law);
}

export function makePanel() {
  const law = choice('make-law', M.laws, 'equal');
  law.addEventListener('change', () => {
    byId('make-items').value = '';
    followLaw();
  });
  const density = make('input', { id: 'make-density', inputMode: 'decimal', size: 8 });
  const form = make('form', { id: 'make-form', noValidate: false },
    field(M.n, numberBox('n', RECIPE.n)), field(M.dim, numberBox('dim', RECIPE.dim)), field(M.seed, numberBox('seed', RECIPE.seed)),
    field(M.law, law), field(M.items, make('input', { id: 'make-items' })),
    field(M.curve, make('textarea', { id: 'make-curve', rows: 5 }), M.curveHint),
    field(M.walls, choice('make-walls', M.enclosures, 'none')), field(M.density, density, M.densityHint),
    field(M.porosity, make('input', { id: 'make-porosity', inputMode: 'decimal', size: 8 })),
    field(M.protocol, choice('make-protocol', M.protocols, 'usual')),
    make('div', { className: 'row' }, make('button', { id: 'make-go', className: 'main', textContent: M.go }),
      button(M.example, () => (fillForm({ n: 500, density: '0.57' }), makeIt()), 'make-example')));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    makeIt();
  });
  const again = make('div', { className: 'row', hidden: true }, button(M.goOn, goOn, 'make-on', true));
  whenPacking(() => (again.hidden = !session.about.unfinished));
  return make('section', {}, make('h2', { textContent: M.title }), again, form);
}
export const restoreForm = () => fillForm(keptValue('form', RECIPE));

export function resultOf(report, phi) {
  if (!report) return M.grown(shown(phi, 12));
  if (!report.jammed) return M.unjammed(shown(report.packingFraction, 12), report.stopReason);
  return M.made(shown(report.packingFraction, 12), report.contacts, report.excessContacts, report.rattlers);
}

export function makeIt() {
  const r = readForm();
  keep('form', r);
  return run(M.growing(0), async () => grow(await started(session.jam, r), r));
}
/** What was stopped, or was running when the page was closed. */
function goOn() {
  const { packing, about } = session;
  return run(M.growing(about.phi), () => grow(packing, about.unfinished));
}
/** `r` makes `packing`, which may be half made. Each state that is kept is one that the button goes on from. */
async function grow(packing, r) {
  const { paused } = await packing.info(), half = (phi) => ({ recipe: null, unfinished: r, phi });
  let stored = null;
  const told = (phase, now) => {
    const reached = session.jam.kept.get(packing.id);
    if (reached !== stored) store((stored = reached), half(now.packingFraction));
    const share = isCrunched(r) ? (phase === 'growing' ? GROWS * now.fraction : GROWS + (1 - GROWS) * now.fraction) : now.fraction;
    progress(share, now.secondsLeft);
    tell(M[phase](now.packingFraction));
  };
  if (window.matchMedia('(max-width: 900px)').matches) byId('stage').scrollIntoView();
  await adopt(packing, half((await packing.info()).packingFraction), { small: true });
  try {
    const report = await made(packing, r, { shown: showMoment, told }), { packingFraction: phi } = await packing.info();
    const counted = report && { phi, contacts: report.contacts, rattlers: report.rattlers, jammed: report.jammed };
    // Growth goes on to the same bits, a crunch need not.
    await adopt(packing, { recipe: paused === 'crunch' ? null : r, phi, made: counted });
    tell(resultOf(report, phi));
  } catch (error) {
    if (error.status === 'cancelled') await adopt(packing, half((await packing.info()).packingFraction));
    throw error;
  }
}

export function learnPanel(openTab) {
  const steps = STEPS.map(({ title, text, task, form, tab }) => make('article', {}, make('h3', { textContent: title }),
    make('p', { textContent: text }), make('p', { className: 'verdict', textContent: task }),
    button(TEXT.done, () => {
      openTab(tab ?? 'make');
      if (form) (fillForm(form), makeIt());
      fault('');
    })));
  return make('section', {}, make('h2', { textContent: TEXT.learn }), ...steps);
}
