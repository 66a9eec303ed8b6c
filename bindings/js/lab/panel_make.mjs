// Make: the form of a packing, and its growth on the screen.
import { TEXT, STEPS } from './texts.mjs';
import { RECIPE, isCrunched } from './recipe.mjs';
import { made } from './engine.mjs';
import { canKeep, keep, keepPacking, keptValue } from './keep.mjs';
import { adopt, fault, progress, run, session, tell } from './session.mjs';
import { showMoment, showPacking } from './view.mjs';
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
  return make('section', {}, make('h2', { textContent: M.title }), form);
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
  return run(TEXT.make.growing(0), async () => {
    let started = null;
    let stored = null;
    const told = (phase, now) => {
      const reached = started && session.jam.kept.get(started.id); // what a closed page finds again
      if (reached && reached !== stored && canKeep()) keepPacking((stored = reached), { recipe: null, phi: now.packingFraction });
      const share = isCrunched(r) ? (phase === 'growing' ? GROWS * now.fraction : GROWS + (1 - GROWS) * now.fraction) : now.fraction;
      progress(share, now.secondsLeft);
      tell(M[phase](now.packingFraction));
    };
    const begun = async (packing) => {
      started = packing;
      if (window.matchMedia('(max-width: 900px)').matches) document.getElementById('stage').scrollIntoView();
      await showPacking(packing, { small: true });
    };
    try {
      const { packing, report } = await made(session.jam, r, { begun, shown: showMoment, told });
      const { packingFraction: phi } = await packing.info();
      const about = { recipe: r, phi, made: report && { phi, contacts: report.contacts, rattlers: report.rattlers, jammed: report.jammed } };
      await adopt(packing, about);
      tell(resultOf(report, phi));
    } catch (error) {
      // What was reached is kept: after a stop the packing is as its last checkpoint has it.
      if (error.status === 'cancelled' && started) await adopt(started, { recipe: null, phi: (await started.info()).packingFraction });
      throw error;
    }
  });
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
