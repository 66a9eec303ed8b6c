// Checks a proof file of a jammed packing, apart from libjam: the rules, words and answers of jamproof.py. Here are
// Theorem A of its head, and the packing fraction that follows. Whole numbers and fractions decide; the
// inverse is a hint: a bad one loses the proof, it cannot make one.
import { Exact, ONE, TWO, ZERO, Refused, digits, least, most, power, products, refuse, rooted, total, whole } from './exact.mjs';
import { BITS, Scene } from './scene.mjs';
import { bounds, gap, inverseOf, largestEntry } from './inverse.mjs';
import { keptContacts } from './implied.mjs';
import { closed, trapped } from './trapped.mjs';

const AT_LEAST = ["outer", "least_gap", "least_force"]; // bounds from below; all others are bounds from above

/** The forces, unless strict scaled to sum f sigma^2 = 1, and what they miss of it and of balance. */
function stateOf(s, sigma2, columns, forces) {
  let off = ZERO;
  if (!s.strict) {
    const weight = products(sigma2, forces);
    forces = forces.map((m) => new Exact(m.scaled(90).over(weight).truncated(), 90));
    off = ONE.minus(products(sigma2, forces)).abs();
  }
  return [forces, off.plus(total(s.unbalanced(columns, forces).map((v) => v.abs())))];
}

/** Theorem A: what is proved. */
function check(s) {
  const every = s.contacts.map((_, c) => c), kept = s.tiles.length ? keptContacts(s) : every;
  let { f, sigma2, columns } = s.equations(kept);
  if (kept.length === every.length && f.every((v) => v.n === 0n)) return closed(s, columns);
  const count = s.unknowns + !s.strict, few = kept.length < count ? ", too few" : "";
  refuse(kept.length !== count, `excess: ${kept.length} contacts, ${count} unknowns${few}`);
  const j = s.rounded(columns);
  if (!s.strict) j.push(sigma2.map((v, c) => [c, Number(v.negated().scaled(BITS).round())]));
  const inverse = inverseOf(s, j, count), found = bounds(s, f, j, inverse, j.map(() => 1));
  const [row, deltaG] = s.strict ? [[ZERO], ZERO] : stateOf(s, sigma2, columns, kept.map((c) => s.row[c]));
  // the row of G is minus a state of self-stress
  const etaG = s.strict ? ZERO : products(f, row).abs(), alphaG = total(row.map((v) => v.abs()));
  const largest = most([largestEntry(inverse), ...row.map((v) => v.abs())]);
  const [delta, eta, alpha] = [[...found.delta, deltaG], [...found.eta, etaG], [...found.alpha, alphaG]].map(most);
  const images = s.strict ? Math.max(...s.contacts.map(({ n }) => n.reduce((sum, m) => sum + Math.abs(m), 0))) : 0;
  const ways = 2 + images, largest2 = s.round ? most(s.contacts.map(({ i, j }) => s.sigma2(i, j))) : ZERO;
  const wide = new Exact(BigInt(s.dim * ways ** 2)).plus(largest2); // D; a contact vector moves by ways r at most
  const beta = wide.times(alpha), left = ONE.minus(delta), room = left.times(left);
  const curved = new Exact(4n).times(beta).times(eta);
  refuse(!delta.below(ONE) || !curved.below(room), () => `singular: delta ${digits(delta.number())}, ` +
    `4 beta eta ${digits(curved.number())}`);
  const r = eta.over(left).times(ONE.plus(curved.over(room)));
  const again = eta.plus(delta.times(r)).plus(beta.times(r).times(r)), slope = delta.plus(TWO.times(beta).times(r));
  refuse(r.below(again) || !slope.below(ONE), () => `singular: radius ${digits(r.number())}, ` +
    `beta ${digits(beta.number())}`); // (1)
  if (s.tiles.length) {
    const way = r.times(new Exact(BigInt(ways))), ratio = least(s.ratio);
    refuse(s.gamma.times(ratio).times(ratio).below(way.times(way).times(new Exact(10n ** 12n))),
      () => `excess: radius ${digits(r.number())} is too large for the angles of tiles`);
    // Forces on implied contacts are free: those of the file. The others balance them, with this A.
    ({ sigma2, columns } = s.equations(every));
  }
  let rG = etaG.plus(deltaG.times(r)).plus(wide.times(alphaG).times(r).times(r));
  if (s.round) rG = rG.times(TWO.times(s.growth).plus(rG)); // now of G
  const [forces, missed] = stateOf(s, sigma2, columns, s.force);
  const edges = [...s.gradient.values()].map((b) => ONE.over(b)), size = total(forces.map((v) => v.abs()));
  const smallest = least(forces);
  refuse(edges.some((h) => !r.below(h)), "singular: the cell is not larger than the radius");
  const off = missed.plus(total(edges.map((h) => r.over(h.times(h.minus(r))))));
  const error = off.plus(TWO.times(wide).times(size).times(r)).over(ONE.minus(slope)).times(largest); // (2)
  const mean = size.over(new Exact(BigInt(forces.length)));
  refuse(!error.below(smallest), () => `force: the least is ${digits(smallest.over(mean).number())}, ` +
    `its error ${digits(error.over(mean).number())}`);
  s.within = s.strict ? [...s.gradient.values()].map((v) => v.times(r)) : rG.over(s.gamma);
  return { radius: r.times(s.unit), ...(s.strict ? {} : { gamma_error: rG.over(s.gamma) }),
    least_gap: gap(s.leastOpening(r, s.gamma.plus(rG))), delta, least_force: smallest.over(mean),
    force_error: error.over(mean) };
}

/** As text of three digits, rounded so that each is a bound still. */
const shown = (found) => Object.entries(found).map(([name, value]) =>
  `${name} ${digits(value, AT_LEAST.includes(name) ? -1 : 1)}`).join(", ");

/** Two fractions about pi, 10^-120 apart: 16 atan(1/5) - 4 atan(1/239) (Machin). */
function piBetween() {
  const one = 10n ** 130n;
  let sum = 0n;
  for (const [times, x] of [[16n, 5n], [-4n, 239n]])
    for (let part = one / x, k = 0n, sign = times; part; part /= x * x, ++k, sign = -sign)
      sum += sign * (part / (2n * k + 1n));
  return [-1n, 1n].map((way) => Exact.ratio(sum + way * 10n ** 10n, one));
}
const raised = (x, k) => Array(k).fill(x).reduce((a, b) => a.times(b), ONE);

/** The packing fraction, rattlers included, from below and above: pi^(d/2) / (2^d Gamma(d/2 + 1)) sum sigma^d / V.
 * sigma^2 of a sphere is G ratio^2, G known to `within`; strict V is known to that part of each edge. */
function fraction(s) {
  const d = s.dim, half = Math.floor(d / 2);
  const product = (list) => list.reduce((a, b) => a * BigInt(b), 1n);
  const volume = Exact.ratio(product(s.cell.map((row, q) => row[q])), s.one ** BigInt(d));
  const ball = (m) => { // of diameter 1, over pi^floor(m / 2)
    const list = Array.from({ length: m % 2 ? (m + 1) / 2 : m / 2 }, (_, k) => (m % 2 ? m - 2 * k : k + 1));
    return Exact.ratio(m % 2 ? power((m + 1) / 2) : 1n, product(list)).scaled(-m);
  };
  const [sizes, per] = whole(s.ratio), sum = sizes.reduce((a, v) => a + v ** BigInt(d), 0n);
  const balls = Exact.ratio(sum, per ** BigInt(d)).times(ball(d)).over(ball(s.round));
  return piBetween().map((pi, up) => {
    const wide = s.strict ? s.within : [];
    const change = wide.reduce((c, v) => c.times(ONE.over(up ? ONE.minus(v) : ONE.plus(v))), ONE);
    const gamma = s.strict ? s.gamma : s.gamma.times(up ? ONE.plus(s.within) : ONE.minus(s.within));
    return balls.times(raised(pi, half - Math.floor(s.round / 2))).times(raised(gamma, half)).times(d % 2 ? rooted(gamma, up) : ONE)
      .times(change).over(volume);
  });
}

/** What packing that is; the digits of phi are those that both bounds share. */
function summary(s) {
  const ends = s.within === null ? [] : fraction(s).map((v) => String(v.times(new Exact(10n ** 100n)).floor()).padStart(101, "0"));
  const [low, high] = ends.length ? ends : ["", ""], point = low.length - 100;
  let same = 0;
  while (same < low.length && same < high.length && low[same] === high[same]) ++same;
  const phi = same > point && point > 0 ? `, phi = ${low.slice(0, point)}.${low.slice(point, same)}...` : "";
  const loose = s.stable.filter((yes) => !yes).length;
  return `d = ${s.dim}, N = ${s.x.length}, ${s.contacts.length} contacts, ${loose} rattler${loose === 1 ? "" : "s"}${phi}`;
}

function conclusion(s) {
  const strictly = s.strict ? " strictly" : "", attempt = (proof) => {
    try {
      return { found: proof(s) };
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return { why: error.message };
    }
  };
  const whole = attempt(check), answer = (status, text) => ({ status, text, summary: summary(s) });
  if (whole.found) return answer(0, `proved${strictly}: ${shown(whole.found)}`);
  const text = `not proved: ${whole.why}`;
  if (!whole.why.startsWith("excess")) return answer(1, text);
  const part = attempt(trapped);
  if (part.found) return answer(3, `trapped${strictly}: ${shown(part.found)}; ${text}`);
  return answer(1, `${text}; not trapped: ${part.why}`);
}

/** { status, text, summary } of a file's bytes: 0 proved, 1 not proved, 2 cannot be read, 3 trapped but not proved. */
export const checkProof = (bytes) => Scene.read(bytes).then(conclusion, (error) =>
  ({ status: 2, text: `cannot be read: ${error.message}`, summary: "" }));
globalThis.onmessage = async ({ data }) => postMessage(await checkProof(data)); // in a worker
