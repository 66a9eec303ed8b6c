// Look: the page in a window of its own, and the results of a class with their histogram. Save: files and lines.
import { TEXT } from './texts.mjs';
import { pageOf } from './engine.mjs';
import { commandOf, pythonOf } from './recipe.mjs';
import { keep, keptValue } from './keep.mjs';
import { fault, needed, run, session, tell, whenPacking } from './session.mjs';
import { button, byId, choice, field, make, saveFile, shown, table } from './parts.mjs';

const L = TEXT.look, S = TEXT.save, HEAD = 'n,dim,seed,phi,contacts,rattlers', BARS = 12;
const KEYS = HEAD.split(',');

let rows = [];
export function lookPanel() {
  rows = keptValue('class', []);
  const input = make('input', { type: 'file', id: 'class-file', accept: '.csv', ariaLabel: L.load });
  input.addEventListener('change', async () => input.files.length && loadCsv(await input.files[0].text()));
  const which = choice('class-which', L.quantities, 'phi');
  which.addEventListener('change', showClass);
  return make('section', {}, make('h2', { textContent: L.title }),
    make('div', { className: 'row' }, button(L.page, needed(() => run('', openPage)), 'look-page')),
    make('h3', { textContent: L.table }),
    make('div', { className: 'row' }, button(L.add, needed(addRow), 'class-add', true), button(L.csv, saveCsv, 'class-csv'),
      button(L.clear, () => setRows([]), 'class-clear')),
    field(L.load, input), field(L.which, which), make('div', { id: 'class', ariaLive: 'polite' }));
}
async function openPage() {
  const text = await pageOf(session.packing, session.about.title ?? '', false, null);
  window.open(URL.createObjectURL(new Blob([text], { type: 'text/html' })));
  tell('');
}
function addRow() {
  const { recipe, made, check, phi } = session.about, counted = made ?? check;
  if (!counted) return fault(TEXT.noPacking);
  const row = [session.packing.n, session.packing.dim, recipe ? recipe.seed : '', phi, counted.contacts, counted.rattlers];
  return setRows([...rows, row]);
}
function setRows(list) {
  const known = new Set();
  rows = list.filter((row) => !known.has(String(row)) && known.add(String(row))); // one packing counts once
  keep('class', rows);
  showClass();
}
const saveCsv = () => saveFile('class.csv', [HEAD, ...rows.map((row) => row.join(','))].join('\n') + '\n', 'text/csv');
function loadCsv(text) {
  const [head, ...lines] = text.split(/\r?\n/).filter((line) => line.trim());
  if (head !== HEAD) return fault(L.badCsv);
  return setRows([...rows, ...lines.map((line) => line.split(',').map((word) => (word === '' ? '' : Number(word))))]);
}

export function showClass() {
  const place = byId('class'), at = KEYS.indexOf(byId('class-which').value), name = L.quantities[KEYS[at]];
  const values = rows.map((row) => row[at]).filter((x) => Number.isFinite(x));
  const parts = [make('p', { textContent: rows.length < 2 ? L.few : L.rows(rows.length) })];
  if (values.length > 1) {
    const mean = values.reduce((a, b) => a + b, 0) / values.length;
    const spread = Math.sqrt(values.reduce((sum, x) => sum + (x - mean) ** 2, 0) / (values.length - 1));
    parts.push(make('p', { textContent: L.mean(shown(mean), shown(spread, 3)) }), histogram(values, name));
  }
  if (rows.length) parts.push(table(KEYS, rows.slice(-30).map((row) => row.map((x) => (typeof x === 'number' ? shown(x, 8) : x)))));
  place.replaceChildren(...parts);
}
/** Bars as SVG, with a sentence for readers of the screen. */
function histogram(values, name) {
  const low = Math.min(...values), high = Math.max(...values), wide = (high - low) / BARS || 1, counts = Array(BARS).fill(0);
  for (const x of values) ++counts[Math.min(BARS - 1, Math.floor((x - low) / wide))];
  const most = Math.max(...counts), step = 380 / BARS;
  const bars = counts.map((c, k) => `<rect x="${10 + k * step}" y="${110 - (90 * c) / most}" width="${step - 2}" height="${(90 * c) / most}"/>`);
  const holder = make('div');
  holder.innerHTML = `<svg viewBox="0 0 400 130" role="img" aria-label="${name}: ${values.length} values from ${shown(low)} to ` +
    `${shown(high)}, most in one bar: ${most}">${bars.join('')}<text x="10" y="126">${shown(low)}</text>` +
    `<text x="390" y="126" text-anchor="end">${shown(high)}</text><text x="200" y="12" text-anchor="middle">${name}</text></svg>`;
  return holder;
}

const FILES = [
  ['xyz', 'packing.xyz', (p) => p.write('packing.xyz', 'auto')],
  ['lammps', 'packing.data', (p) => p.write('packing.data', 'auto')],
  ['csv', 'contacts.csv', (p) => p.writeContacts('contacts.csv', 'auto')],
  ['stl', 'packing.stl', (p) => p.writeStl('packing.stl')],
  ['html', 'packing.html', async (p) => new TextEncoder().encode(await pageOf(p, session.about.title ?? '', false, null))],
];
export function savePanel() {
  const files = FILES.map(([key, name, write]) => button(S[key], needed(() => run('', async () => {
    const answer = await write(session.packing);
    saveFile(name, answer.bytes ?? answer);
    tell('');
  })), `save-${key}`));
  whenPacking(showLines);
  return make('section', {}, make('h2', { textContent: S.title }), make('div', { className: 'row' }, ...files), make('div', { id: 'lines' }));
}
function showLines() {
  const { recipe, name } = session.about, file = name ?? 'packing.xyz';
  const program = recipe ? commandOf(recipe) : `jam-pack check ${file}`;
  const python = recipe ? pythonOf(recipe) : `import jam\n\npacking = jam.System.read(${JSON.stringify(file)})\nprint(packing.check())`;
  byId('lines').replaceChildren(make('h3', { textContent: recipe ? S.again : S.fromFile }), make('p', { textContent: S.program }),
    make('pre', { id: 'command', tabIndex: 0, textContent: program }), make('p', { textContent: S.python }), make('pre', { id: 'python', tabIndex: 0, textContent: python }));
}
