// More contacts than unknowns: crystals that close exactly as written, and packings whose spheres are trapped. The
// theorems are in the head of jamproof_trapped.py; names are those there.
import { Exact, ONE, TWO, ZERO, Refused, digits, least, most, products, refuse, rooted,
  total, whole } from './exact.mjs';
import { bounds, gap, inverseOf, largestEntry } from './inverse.mjs';

const PRIME = (1n << 61n) - 1n;
const GAMMA = 400, FORCE = 120; // binary digits of gamma; more of forces
const FINEST = 7; // units of ways are down to 2^-FINEST of the longest
const OFF = new Exact(1n, 10); // the file's gamma may be off by this part of it

const modulo = (v) => ((v % PRIME) + PRIME) % PRIME;
function reciprocal(v) {
  let [a, b, x, y] = [v, PRIME, 1n, 0n];
  while (b) [a, b, x, y] = [b, a % b, y, x - (a / b) * y];
  return modulo(x);
}
/** Modulo a prime: at most the rank of the whole numbers. */
function rank(rows) {
  const pivots = new Map();
  for (const given of rows) {
    const row = new Map([...given].map(([k, v]) => [k, modulo(v)]).filter(([, v]) => v));
    while (row.size) {
      const c = Math.min(...row.keys()), factor = row.get(c);
      if (!pivots.has(c)) {
        const inverse = reciprocal(factor);
        pivots.set(c, [...row].map(([k, v]) => [k, (v * inverse) % PRIME]));
        break;
      }
      for (const [k, v] of pivots.get(c)) {
        const left = modulo((row.get(k) || 0n) - factor * v);
        if (left) row.set(k, left);
        else row.delete(k);
      }
    }
  }
  return pivots.size;
}

/** F = 0 exactly, with any number of contacts. */
export function closed(s, columns) {
  const rows = s.contacts.map(() => new Map());
  columns.forEach((column, unknown) => column.forEach(([c, v]) => rows[c].set(unknown, v)));
  refuse(rank(rows) < s.unknowns, `singular: the rank modulo a prime is below ${s.unknowns}`);
  const smallest = least(s.force), rest = s.unbalanced(columns, s.force);
  refuse(smallest.n <= 0n, "force: not all are positive");
  // In balance they may have any size: strict with an equal pressure on all axes, R^T f = p b.
  const pressure = s.gradient.size ? [...s.gradient].map(([k, b]) => rest[k].plus(b).over(b)) : [ONE];
  const equal = pressure.every((p) => p.compare(pressure[0]) === 0) && pressure[0].n > 0n;
  if (!equal || rest.some((v, k) => v.n && !s.gradient.has(k))) {
    const j = s.rounded(columns), inverse = inverseOf(s, j, rows.length);
    const delta = most(bounds(s, rows.map(() => ZERO), j, inverse, Array(s.unknowns).fill(1)).delta);
    const off = total(rest.map((v) => v.abs())).times(largestEntry(inverse));
    refuse(!off.below(ONE.minus(delta).times(smallest)), () =>
      `force: the least is ${digits(smallest.number())}, what balances them ${digits(off.number())}`);
  }
  s.within = s.strict ? [] : ZERO;
  return { radius: ZERO, gamma_error: ZERO, least_gap: gap(s.leastOpening(ZERO, s.gamma)) };
}

/** The forces after a step of Newton as whole numbers, and over which. */
function balanced(s, columns, { e, columns: inverse }) {
  let [forces, per] = whole(s.force);
  forces = forces.map((m) => m << BigInt(FORCE));
  per <<= BigInt(FORCE);
  const scale = new Exact(s.one * per), one = new Exact(s.one);
  const rest = s.unbalanced(columns, forces.map((m) => Exact.ratio(m, per))).map((v) => v.times(scale).round());
  const step = (column) => {
    let sum = 0n;
    column.forEach((a, k) => (sum += BigInt(a) * rest[k]));
    return new Exact(sum, -e).over(one).round();
  };
  return [forces.map((m, c) => m - step(inverse[c])), per];
}

/** How much shorter than of the sphere that is held least the ways of others are, as powers of two: a hint. */
function looselyHeld(s, { columns }, stress) {
  const way = new Float64Array(s.unknowns);
  columns.forEach((column, c) => {
    const part = 1 / Number(stress[c]);
    column.forEach((v, k) => (way[k] = Math.max(way[k], Math.abs(v) * part)));
  });
  const ways = new Map();
  s.sphereOf.forEach((i, k) => ways.set(i, Math.max(1e-300, way[k], ways.get(i) || 0)));
  const top = Math.max(...ways.values());
  return s.sphereOf.map((i) => 1 << Math.trunc(Math.min(FINEST, Math.log2(top / ways.get(i)))));
}

/** Of any network with positive forces: inner and outer, and the least gap. */
export function trapped(s) {
  const every = s.contacts.map((_, c) => c), file = s.gamma, number = (v) => new Exact(BigInt(v));
  const smallest = least(s.contacts.map((c) => most([ZERO, s.left(c.j, s.vector(c), ZERO)]).over(s.sigma2(c.i, c.j))));
  const opening = s.leastOpening(ZERO, smallest, new Exact(1n, 1)); // pairs without force may be closed too
  const own = smallest.times(least([ONE, opening && opening.n ? opening : ONE]));
  refuse(OFF.times(file).below(file.minus(own).abs()),
    () => `gamma: without overlap it is ${digits(own.number(), 0, 6)}, not that of the file`);
  // The smaller of both, as spheres of a smaller gamma have more room. What is shown of it is true of a larger one.
  s.gamma = new Exact(least([own, file]).scaled(GAMMA).floor(), GAMMA); // no pair overlaps: F >= 0
  if (s.round) [s.growth, s.gamma] = [rooted(s.gamma), rooted(s.gamma).times(rooted(s.gamma))];
  const { f, sigma2, columns } = s.equations(every), j = s.rounded(columns), inverse = inverseOf(s, j, every.length);
  const [stress, per] = balanced(s, columns, inverse), forces = stress.map((m) => Exact.ratio(m, per));
  refuse(stress.some((m) => m <= 0n), "force: not all are positive");
  const rest = total(s.unbalanced(columns, forces).map((v) => v.abs())), opened = products(f, forces);
  // Strict: log V falls by no more than the sum of (way / edge)^2 below its gradient, for ways up to half an edge.
  const edges = [...s.gradient.values()].map((b) => ONE.over(b));
  const tries = [Array(s.unknowns).fill(1), ...(s.strict ? [] : [looselyHeld(s, inverse, stress)])];
  let found = null, left, twice;
  for (const grown of tries) {
    const top = Math.max(...grown), over = number(top);
    const rows = bounds(s, f, j, inverse, grown.map((g) => Math.floor(top / g)));
    const [delta, eta] = [rows.delta, rows.eta].map((list) => most(list.map((v, k) => v.times(number(grown[k])))));
    const size = curvature(s, inverse, stress, per, grown, top, edges);
    left = ONE.minus(delta.over(over)).minus(size.largest.times(rest));
    const constant = size.largest.times(opened).plus(eta);
    const second = size.largest.times(size.square).plus(size.alpha.over(over.times(over)));
    twice = number(4).times(constant).times(second);
    if (left.n <= 0n || !twice.below(left.times(left))) continue;
    found = { delta: delta.over(over), constant, second, top: over, square: size.square };
    break;
  }
  if (!found) throw new Refused(`singular: left ${digits(left.number())}, 4 a0 a2 ${digits(twice.number())}`);
  const inner = TWO.times(found.constant).over(left), weight = products(sigma2, forces);
  // above: over weight above s.gamma of the densest packing within inner
  const above = opened.plus(rest.times(inner)).plus(found.square.times(inner).times(inner));
  // With a round wall g grows: at the wall -dF / dg falls to no less than half while W - g s stays positive.
  const grown = TWO.times(above).over(weight), climb = grown.times(TWO.times(s.growth).plus(grown));
  const error = file.minus(s.gamma).plus(s.strict ? ZERO : s.round ? climb : above.over(weight)).over(file);
  const outer = least([left.over(TWO.times(found.second).times(found.top)), ...edges.map((h) => h.over(TWO))]);
  s.within = s.strict ? [TWO.times(above).plus(number(s.dim).times(error))] : TWO.times(error); // s.gamma: the file's less error
  refuse(s.strict && !inner.below(outer), () =>
    `singular: inner ${digits(inner.number())} is not below outer ${digits(outer.number())}`);
  const open = gap(opening && opening.n ? opening.times(smallest).over(file) : null);
  return { inner: inner.times(s.unit), ...(inner.below(outer) ? { outer: outer.times(s.unit) } : {}),
    ...(s.strict ? { volume_error: above } : {}), gamma_error: error, least_gap: most([ZERO, open]), delta: found.delta };
}

/** Of the units `grown`: M, the second-order term of forces, and that of A. */
function curvature(s, { e, columns }, stress, per, grown, top, edges) {
  const units = new Map(s.sphereOf.map((i, at) => [i, top / grown[at]]));
  const unit = (i) => units.get(i) || 1; // over top
  const alpha = grown.map(() => 0n);
  let square = total(edges.map((h) => ONE.over(h.times(h)))), largest = ZERO;
  let sum = 0n;
  s.contacts.forEach(({ i, j, n }, c) => {
    const images = s.strict ? n.reduce((all, m) => all + Math.abs(m), 0) : 0;
    const ways = unit(i) + unit(j < 0 ? i : j) + images * top, wide = BigInt(s.dim * ways ** 2); // over top^2: |w|^2 of length 1
    sum += wide * stress[c];
    let longest = 0;
    columns[c].forEach((v, k) => {
      const part = Math.abs(v) * grown[k];
      longest = Math.max(longest, part);
      alpha[k] += wide * BigInt(part);
    });
    const one = Exact.ratio(BigInt(longest) * per, stress[c]);
    if (largest.below(one)) largest = one;
  });
  square = square.plus(Exact.ratio(sum, per * BigInt(top * top)));
  const highest = alpha.reduce((a, b) => (a < b ? b : a), 0n);
  return { square, largest: largest.scaled(e), alpha: new Exact(highest, -e) };
}
