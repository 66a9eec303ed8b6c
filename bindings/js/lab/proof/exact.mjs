// Exact numbers for the proof checker: a whole number over a power of two and an odd whole number. Most numbers of a
// proof are binary fractions, whose odd part is 1, so that no common divisors are looked for.

/** The file cannot be read, or nothing was proved, and why. */
export class Refused extends Error {}
export function refuse(wrong, words) {
  if (wrong) throw new Refused(typeof words === "function" ? words() : words);
}

export const absolute = (n) => (n < 0n ? -n : n);
export const power = (k) => 1n << BigInt(k);
export const floorOver = (n, d) => (n % d !== 0n && n < 0n !== d < 0n ? n / d - 1n : n / d);
export function bitLength(n) {
  const digits = absolute(n).toString(16);
  return n === 0n ? 0 : 4 * digits.length - Math.clz32(parseInt(digits[0], 16)) + 28;
}

/** The whole part of the root of a whole number. */
export function root(n) {
  if (n < 2n) return n;
  let x = power((bitLength(n) + 1) >> 1);
  for (;;) {
    const y = (x + n / x) >> 1n;
    if (y >= x) return x;
    x = y;
  }
}

/** n / (2^k q), q odd and positive. */
export class Exact {
  constructor(n, k = 0, q = 1n) {
    [this.n, this.k, this.q] = [n, k, q];
  }
  static ratio(n, d) {
    return new Exact(n).over(new Exact(d));
  }
  static double(x) {
    let k = 0;
    for (; !Number.isInteger(x); ++k) x *= 2;
    return new Exact(BigInt(x), k);
  }
  plus(o) {
    if (this.q === o.q) {
      const k = Math.max(this.k, o.k);
      return new Exact((this.n << BigInt(k - this.k)) + (o.n << BigInt(k - o.k)), k, this.q);
    }
    const a = new Exact(this.n * o.q, this.k), b = new Exact(o.n * this.q, o.k), sum = a.plus(b);
    return new Exact(sum.n, sum.k, this.q * o.q);
  }
  negated() {
    return new Exact(-this.n, this.k, this.q);
  }
  minus(o) {
    return this.plus(o.negated());
  }
  times(o) {
    return new Exact(this.n * o.n, this.k + o.k, this.q * o.q);
  }
  over(o) {
    refuse(o.n === 0n, () => `Fraction(${this.n}, 0)`);
    let odd = absolute(o.n), k = 0;
    while (!(odd & 0xffffffffn)) [odd, k] = [odd >> 32n, k + 32];
    while (!(odd & 1n)) [odd, k] = [odd >> 1n, k + 1];
    const n = this.n * o.q;
    return new Exact(o.n < 0n ? -n : n, this.k - o.k + k, this.q * odd);
  }
  scaled(e) { // times 2^e
    return new Exact(this.n, this.k - e, this.q);
  }
  abs() {
    return this.n < 0n ? this.negated() : this;
  }
  compare(o) {
    const d = this.minus(o).n;
    return d < 0n ? -1 : d > 0n ? 1 : 0;
  }
  below(o) {
    return this.compare(o) < 0;
  }
  /** Numerator and denominator, with common divisors. */
  parts() {
    return this.k < 0 ? [this.n << BigInt(-this.k), this.q] : [this.n, this.q << BigInt(this.k)];
  }
  floor() {
    return floorOver(...this.parts());
  }
  ceil() {
    return -this.negated().floor();
  }
  truncated() {
    return this.n < 0n ? this.ceil() : this.floor();
  }
  /** To the nearest whole number, halves to the even one. */
  round() {
    const [n, d] = this.parts(), low = floorOver(n, d), twice = 2n * (n - low * d);
    return twice > d || (twice === d && low & 1n) ? low + 1n : low;
  }
  /** The nearest double. */
  number() {
    const [n, d] = this.parts();
    if (n === 0n) return 0;
    const shift = 66 - bitLength(n) + bitLength(d);
    const [a, b] = shift >= 0 ? [absolute(n) << BigInt(shift), d] : [absolute(n), d << BigInt(-shift)];
    const sticky = ((a / b) << 1n) | (a % b ? 1n : 0n);
    let x = Number(sticky), e = -shift - 1;
    for (; e < -1000; e += 900) x *= 2 ** -900;
    for (; e > 900; e -= 900) x *= 2 ** 900;
    x *= 2 ** e;
    refuse(x === Infinity, "integer division result too large for a float");
    return n < 0n ? -x : x;
  }
}
/** The root in 400 digits from below, or with up = 1 from above. */
export const rooted = (v, up = 0) => new Exact(root(v.scaled(800).floor()) + BigInt(up), 400);
export const ZERO = new Exact(0n), ONE = new Exact(1n), TWO = new Exact(2n);
export const least = (list) => list.reduce((a, b) => (b.below(a) ? b : a));
export const most = (list) => list.reduce((a, b) => (a.below(b) ? b : a));
export const total = (list) => list.reduce((a, b) => a.plus(b), ZERO);
export const products = (a, b) => total(a.map((x, k) => x.times(b[k])));

/** Fractions over powers of two as whole numbers over one of them. */
export function whole(values) {
  const k = Math.max(0, ...values.map((v) => v.k));
  const all = values.map((v) => v.n << BigInt(k - v.k));
  let less = 0;
  for (let some = all.reduce((a, b) => a | b, 0n); less < k && !((some >> BigInt(less)) & 1n);) ++less;
  return [all.map((n) => n >> BigInt(less)), power(k - less)];
}

/** As text of `count` digits, of the form of C's %.3g; `way`: -1 rounded down, 1 up, 0 to the nearest. */
export function digits(x, way = 0, count = 3) {
  if (typeof x === "number") x = Exact.double(x);
  if (x.n === 0n) return "0";
  const [n, d] = x.parts(), size = absolute(n), sign = n < 0n ? -1 : 1;
  let e = Math.floor((bitLength(size) - bitLength(d)) * Math.log10(2)) - 1;
  const tens = (k) => 10n ** BigInt(k);
  const reaches = (k) => (k >= 0 ? size >= d * tens(k) : size * tens(-k) >= d);
  while (reaches(e + 1)) ++e;
  const lowest = Math.max(e, -307), up = count - 1 - lowest; // -307: of the doubles
  const shifted = new Exact(BigInt(sign)).times(up >= 0 ? Exact.ratio(size * tens(up), d) : Exact.ratio(size, d * tens(-up)));
  const m = way < 0 ? shifted.floor() : way > 0 ? shifted.ceil() : shifted.round();
  const [mantissa, exponent] = Number(`${m}e${-up}`).toExponential(count - 1).split("e").map(Number);
  if (m === 0n) return "0";
  if (exponent >= -4 && exponent < count) return String(Number(`${m}e${-up}`));
  return `${mantissa}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
}
