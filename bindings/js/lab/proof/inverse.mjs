// The inverse A of the equations, a hint, and bounds of 1 - A J and A F by whole numbers.
import { Exact, ONE, absolute, bitLength, power, refuse, rooted } from './exact.mjs';
import { BITS } from './scene.mjs';

const CHUNK = 128, HALF = 2 ** 14; // terms and digits whose sums a double holds: 2^31 HALF CHUNK = 2^52
const SAFE = 2 ** 51;

/** Of a square matrix, row by row, by Gauss and Jordan with pivots. */
function inverted(rows) {
  const n = rows.length;
  const a = rows.map((row, k) => Float64Array.from({ length: 2 * n }, (_, c) => (c < n ? row[c] : +(c - n === k))));
  for (let c = 0; c < n; ++c) {
    let p = c;
    for (let r = c; r < n; ++r) if (Math.abs(a[r][c]) > Math.abs(a[p][c])) p = r;
    refuse(!a[p][c], "singular: Singular matrix");
    [a[p], a[c]] = [a[c], a[p]];
    const pivot = a[c], scale = 1 / pivot[c];
    for (let k = c; k < 2 * n; ++k) pivot[k] *= scale;
    for (let r = 0; r < n; ++r) {
      const row = a[r], times = row[c];
      if (r === c || !times) continue;
      for (let k = c; k < 2 * n; ++k) row[k] -= times * pivot[k];
    }
  }
  return a.map((row) => row.subarray(n));
}
/** (R^T R)^-1 R^T. */
function leftInverse(rows) {
  const m = rows[0].length;
  if (rows.length === m) return inverted(rows);
  const square = Array.from({ length: m }, () => new Float64Array(m));
  for (const row of rows)
    for (let p = 0; p < m; ++p) if (row[p]) for (let q = 0; q < m; ++q) square[p][q] += row[p] * row[q];
  return inverted(square).map((line) => rows.map((row) => line.reduce((sum, v, k) => sum + v * row[k], 0)));
}
function evenly(x) {
  const low = Math.floor(x), rest = x - low;
  return rest > 0.5 || (rest === 0.5 && low % 2) ? low + 1 : low;
}

/** A without its row of G: its columns of 32-bit numbers in units of 2^e; `count`: rows of J. */
export function inverseOf(s, j, count) {
  const n = s.unknowns;
  let { e, flat } = s.inverse || {};
  if (!flat) {
    const rows = Array.from({ length: count }, () => new Float64Array(j.length));
    j.forEach((column, l) => column.forEach(([c, v]) => (rows[c][l] += v / 2 ** BITS)));
    const a = leftInverse(rows).slice(0, n);
    const largest = a.reduce((top, row) => row.reduce((t, v) => Math.max(t, Math.abs(v)), top), 0);
    refuse(!Number.isFinite(largest), "singular: the inverse has no finite entries");
    e = bitLength(BigInt(Math.trunc(largest))) - 30;
    flat = Int32Array.from({ length: n * count }, (_, k) => evenly(a[k % n][Math.floor(k / n)] * 2 ** -e));
  }
  refuse(flat.length !== count * n || e < -10000, "singular: the inverse does not fit the equations");
  return { e, columns: Array.from({ length: count }, (_, c) => flat.subarray(c * n, (c + 1) * n)) };
}
export const largestEntry = ({ e, columns }) =>
  new Exact(BigInt(columns.reduce((top, column) => column.reduce((t, v) => Math.max(t, Math.abs(v)), top), 0)), -e);

/** A times one column of [row, whole number below 2^27]: doubles where they are exact, else whole numbers. */
function applied(inverse, column, n) {
  const high = new Float64Array(n), low = new Float64Array(n);
  let large = null;
  const fold = () => {
    large = large || Array(n).fill(0n);
    for (let k = 0; k < n; ++k) large[k] += BigInt(high[k]) * BigInt(HALF) + BigInt(low[k]);
    high.fill(0);
    low.fill(0);
  };
  column.forEach(([c, v], at) => {
    if (at && at % CHUNK === 0) fold();
    const a = inverse[c], v1 = Math.floor(v / HALF), v0 = v - v1 * HALF;
    for (let k = 0; k < n; ++k) (high[k] += a[k] * v1), (low[k] += a[k] * v0);
  });
  if (large) fold();
  return (k) => {
    if (large) return large[k];
    const sum = high[k] * HALF + low[k];
    return Math.abs(high[k]) < SAFE / HALF && Math.abs(sum) < SAFE ? sum : BigInt(high[k]) * BigInt(HALF) + BigInt(low[k]);
  };
}

/** delta, eta and alpha of A's rows; column l of 1 - A J counts weights_l times. */
export function bounds(s, f, columns, { e, columns: inverse }, weights) {
  const n = inverse[0].length, large = columns.some((column) => column.some(([, v]) => Math.abs(v) >= 2 ** 27));
  refuse(e > BITS || large, "singular: entries are too large for the digits");
  const low = f.reduce((top, v) => (v.n ? Math.max(top, bitLength(v.n) - v.k - bitLength(v.q) - 24) : top), -Infinity);
  const unit = Number.isFinite(low) ? low : -600;
  const short = f.map((v, c) => [c, Number(v.scaled(-unit).round())]); // 25 bits, off by half a unit
  const alpha = new Float64Array(n), near = new Float64Array(n), far = Array(n).fill(0n), one = power(BITS - e);
  for (const column of inverse) for (let k = 0; k < n; ++k) alpha[k] += Math.abs(column[k]);
  columns.forEach((column, l) => {
    const of = applied(inverse, column, n);
    for (let k = 0; k < n; ++k) {
      const v = k === l ? BigInt(of(k)) - one : of(k), some = Math.abs(Number(v)) * weights[l];
      if (some < SAFE) near[k] += some;
      else far[k] += absolute(BigInt(v)) * BigInt(weights[l]);
      if (near[k] < SAFE) continue;
      far[k] += BigInt(near[k]);
      near[k] = 0;
    }
  });
  const last = applied(inverse, short, n), exact = (v, k = 0) => new Exact(v, k);
  // J was rounded: half a unit in each entry of a row. Of the cell it has d (d + 1) / 2, or else one of G.
  const width = BigInt(2 * s.dim + (s.strict ? (s.dim * (s.dim + 1)) / 2 : 1)) * BigInt(Math.max(...weights));
  const sum = (k) => 2n * (far[k] + BigInt(near[k])) + width * BigInt(alpha[k]);
  return {
    delta: far.map((_, k) => exact(sum(k), BITS + 1 - e)),
    eta: far.map((_, k) => exact(absolute(BigInt(last(k))) + BigInt(alpha[k]), -e - unit)),
    alpha: far.map((_, k) => exact(BigInt(alpha[k]), -e)),
  };
}

/** The root less one, from below; a thousandth if no pair was seen. */
export function gap(square) {
  if (!square || square.n === 0n) return Exact.ratio(1n, 1000n);
  return rooted(square).minus(ONE);
}
