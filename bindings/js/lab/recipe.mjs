// What makes one packing: its form, and the same work as calls of this page, as a command line and as lines of Python.
export const RECIPE = { n: 256, dim: 3, seed: 1, law: 'equal', items: '', curve: '', walls: 'none', density: '', protocol: 'usual' };
const RATES = { fast: '3e-2', slow: '1e-3' };
const ROUND = ['ball', 'cylinder'];

/** Of rows of two numbers, as a law takes them. */
function rowsOf(curve) {
  const rows = curve.split('\n').map((line) => line.replace(/#.*/, '').trim()).filter((line) => line);
  return rows.map((line) => line.split(/[\s,;=]+/).join('='));
}
/** The law as a text for the library; '' for equal spheres, and for two sizes, which are no draw of a law. */
export function lawOf(r) {
  if (r.law === 'equal' || r.law === 'two') return '';
  const items = r.law === 'list' || r.law === 'sieve' ? rowsOf(r.curve) : [];
  return [r.law, [...items, ...(r.items.trim() ? [r.items.trim()] : [])].join(',')].filter((part) => part).join(':');
}
export const ratioOf = (r) => (r.law === 'two' ? Number(r.items || 1.4) : 1);
/** Half of the spheres are `ratio` times as large. */
export const twoSizes = (n, ratio) => Float64Array.from({ length: n }, (_, k) => (k < Math.floor(n / 2) ? 1 : ratio));

/** Options of a random start, without diameters. */
export function startOf(r) {
  const flat = r.walls === 'none' || ROUND.includes(r.walls) ? '' : r.walls;
  const walls = [...flat].reduce((sum, axis) => sum + 2 ** 'xyz'.indexOf(axis), 0);
  return { n: r.n, dim: r.dim, seed: r.seed, walls, container: ROUND.includes(r.walls) ? r.walls : 'brick' };
}
/** Options of the growth. */
export function growthOf(r) {
  const rate = RATES[r.protocol] ? { growthRate: Number(RATES[r.protocol]) } : {};
  return r.density === '' ? rate : { ...rate, packingFraction: Number(r.density) };
}
export const isCrunched = (r) => r.density === '';

const quotedShell = (text) => (/^[\w.:=,+-]*$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`);
export function commandOf(r) {
  const words = ['jam-pack', '--n', r.n, '--dim', r.dim, '--seed', r.seed], law = lawOf(r);
  if (r.law === 'two') words.push('--diameters-ratio', ratioOf(r));
  if (law) words.push('--sizes', quotedShell(law));
  if (ROUND.includes(r.walls)) words.push('--container', r.walls);
  else if (r.walls !== 'none') words.push('--walls', r.walls);
  if (RATES[r.protocol]) words.push('--growth', RATES[r.protocol]);
  if (r.density !== '') words.push('--packing-fraction', r.density);
  return [...words, '--output', 'packing.xyz'].join(' ');
}
export function pythonOf(r) {
  const more = [], law = lawOf(r), half = Math.floor(r.n / 2);
  if (r.law === 'two') more.push(`diameters=[1.0] * ${half} + [${ratioOf(r)}] * ${r.n - half}`);
  if (law) more.push(`diameters=jam.sizes(${JSON.stringify(law)}, ${r.n}, dim=${r.dim}, seed=${r.seed})`);
  if (ROUND.includes(r.walls)) more.push(`container="${r.walls}"`);
  else if (r.walls !== 'none') more.push(`walls="${r.walls}"`);
  const growth = [];
  if (RATES[r.protocol]) growth.push(`growth_rate=${RATES[r.protocol]}`);
  if (r.density !== '') growth.push(`packing_fraction=${r.density}`);
  return ['import jam', '', `packing = jam.System.random(${[`n=${r.n}`, `dim=${r.dim}`, `seed=${r.seed}`, ...more].join(', ')})`,
    `packing.compress(${growth.join(', ')})`, ...(isCrunched(r) ? ['packing.crunch()'] : []), 'packing.write("packing.xyz")'].join('\n');
}
