// A proof file: its exact numbers, and the equations of its contacts. The rules are those of the head of jamproof.py.
import { Exact, ONE, TWO, floorOver, refuse, root, rooted, whole, total, most } from './exact.mjs';

export const BITS = 24; // digits of J
const MOST_IMAGES = 1000000n, FARTHEST = 10000n; // of a pair; exponents of two
export const SEEN = Exact.ratio(9n, 8n); // gaps are those of pairs closer than SEEN times their sigma
const ONE_NUMBER = ["dim", "unit", "non_additivity"], SIZE = ["gamma", "growth"]; // a file has one of SIZE
const HEADER = [...ONE_NUMBER, ...SIZE, "cell"];
const WORDS = new Set([...ONE_NUMBER, ..."cell walls round pin sphere contact wall tile implied inverse strict".split(" ")]);

const quoted = (word) => (word.includes("'") && !word.includes('"') ? `"${word}"` : `'${word.replace(/['\\]/g, "\\$&")}'`);
/** As libjam writes one: digits alone, no plus sign, no leading zero. */
function integer(word) {
  refuse(!/^(0|-?[1-9][0-9]*)$/.test(word), () => `${quoted(word)} is not a whole number`);
  return BigInt(word);
}
/** m p e is m 2^e; several with commas are a sum. */
function number(word) {
  const parts = word.split(",").map((part) => part.split("p").map(integer));
  refuse(parts.some((part) => part.length !== 2), () => `${quoted(word)} is not of the form m p e`);
  refuse(parts.some(([, e]) => e > FARTHEST || -e > FARTHEST), `an exponent of two is beyond ${FARTHEST}`);
  return total(parts.map(([m, e]) => new Exact(m, -Number(e))));
}
export const keyOf = (i, j, n) => `${i},${j},${n}`;
const spheresOf = ({ i, j }) => (j < 0 ? [i] : [i, j]);
const reversed = (n) => n.map((v) => -v);

/** Text of the bytes, or what is wrong with them. */
function textOf(bytes) {
  const at = bytes.findIndex((b) => b > 127), hex = at < 0 ? "" : bytes[at].toString(16);
  refuse(at >= 0, `'ascii' codec can't decode byte 0x${hex} in position ${at}: ordinal not in range(128)`);
  return new TextDecoder().decode(bytes);
}

/** What zlib packed, but for one byte more than `size` no more than that. */
async function unpacked(text, size) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate")).getReader(), all = [];
  for (let have = 0; ;) {
    const { value, done } = await reader.read();
    if (done) break;
    all.push(value);
    have += value.length;
    refuse(have > size, "the line 'inverse' has more numbers than the equations, or too few");
  }
  return new Int32Array(await new Blob(all).arrayBuffer());
}

/** The file. Lengths `x` and `cell` are whole numbers over `one`, `size` of spheres over `per`. */
export class Scene {
  static async read(bytes) {
    const s = new Scene(textOf(bytes));
    if (s.packed) {
      const [e, data] = s.packed;
      s.inverse = { flat: await unpacked(data, 4 * s.unknowns * s.contacts.length), e: Number(integer(e)) };
    }
    return s;
  }
  constructor(text) {
    refuse(/[^ -~\n]/.test(text), "a character, such as a carriage return, is neither printable ASCII nor a line feed");
    const lines = text.replace(/\n$/, "").split("\n").map((line) => line.split(" ").filter((w) => w));
    refuse(lines[0].join(" ") !== "jamproof 1", "the first line is not 'jamproof 1'");
    refuse(lines.some((line) => !line.length), "a line is empty");
    this.readLines(lines.slice(1));
    this.test();
    this.count();
  }
  readLines(lines) {
    // What follows a word in its lines, as many numbers as it must; in the header there is one line of it.
    const take = (name, ...counts) => {
      const rows = lines.filter((line) => line[0] === name).map((line) => line.slice(1));
      const what = `${HEADER.includes(name) ? "the" : "a"} line '${name}'`;
      refuse(HEADER.includes(name) && rows.length !== 1, `${what} is there ${rows.length} times, not once`);
      refuse(rows.some((rest) => !counts.includes(rest.length)),
        `${what} has not as many numbers as ${HEADER.slice(0, -1).includes(name) ? "it must, one" : "dim asks for"}`);
      return rows;
    };
    for (const name of ["sum", "symmetry"])
      refuse(lines.some((line) => line[0] === name), `files with '${name}', of a largest sum of radii, need jamproof.py`);
    const curved = take("round", 1);
    this.round = curved.reduce((sum, [m]) => sum + Number(integer(m)), 0); // axes of the round wall
    const name = SIZE[Number(this.round > 0)];
    const [dim, unit, cross, size] = [...ONE_NUMBER, name].map((word) => take(word, 1)[0][0]);
    const d = (this.dim = Number(integer(dim)));
    refuse(d < 1, "dim is not 1 or more");
    const [cell] = take("cell", (d * (d + 1)) / 2), spheres = take("sphere", d + 2);
    take("contact", d + 3, d + 4);
    take("wall", 4, 5);
    const contacts = lines.filter(([word]) => word === "contact" || word === "wall");
    const walled = take("walls", ...Array.from({ length: d }, (_, c) => c + 1));
    this.pins = take("pin", 2).map((rest) => rest.map(integer).map(Number));
    this.flat = walled.flat().map(integer).map(Number);
    this.walled = [...Array(Math.max(0, this.round)).keys(), ...this.flat]; // axes with walls
    [this.unit, this.growth, this.add] = [number(unit), number(size), ONE.plus(number(cross))];
    this.gamma = this.round ? this.growth.times(this.growth) : this.growth;
    refuse(spheres.some((s) => s[0] !== "0" && s[0] !== "1"), "a sphere is neither 1, stable, nor 0, a rattler");
    this.stable = spheres.map((s) => s[0] === "1");
    this.ratio = spheres.map((s) => number(s[1]));
    const head = (word) => (word === "wall" ? 3 : d + 2);
    this.contacts = contacts.map(([word, ...row]) => this.ends(word, row.slice(0, head(word)).map(integer).map(Number)));
    const forces = contacts.map(([word, ...row]) => row.slice(head(word)).map(number));
    [this.force, this.row] = [forces.map((f) => f[0]), forces.map((f) => f[f.length - 1])]; // row: without implied ones
    this.tiles = lines.filter(([name]) => name === "tile" || name === "implied")
      .map(([word, ...ring]) => ({ word, ring: ring.map((c) => Number(integer(c))) }));
    const packed = take("inverse", 2), strict = take("strict", 0);
    [this.packed, this.strict] = [packed.pop(), strict.length > 0];
    refuse(strict.length > 1 || packed.length, "a line 'strict' or 'inverse' is there twice");
    refuse(walled.length > 1, "a line 'walls' or 'sum' is there twice");
    this.inverse = this.within = null;
    for (const [word] of lines) refuse(!WORDS.has(word) && word !== name, `unknown word ${word}`);
    this.rounds = curved.length;
    const [lengths, one] = whole([cell, ...spheres.map((s) => s.slice(2))].flat().map(number));
    this.one = one;
    this.cell = Array.from({ length: d }, (_, r) =>
      Array.from({ length: d }, (_, c) => (c <= r ? lengths[(r * (r + 1)) / 2 + c] : 0n)));
    this.x = spheres.map((_, k) => lengths.slice(cell.length + d * k, cell.length + d * (k + 1)));
  }
  /** A contact; of a wall j is -1 - 2 axis - side, and r twice the way from it. */
  ends(word, [i, j, ...n]) {
    if (word === "contact") return { i, j, n };
    refuse((n[0] !== 0 && n[0] !== 1) || j < 0, "a wall is on side 0 or 1 of an axis");
    return { i, j: -1 - 2 * j - n[0], n: Array(this.dim).fill(0) };
  }
  testWalls() {
    const { walled, dim: d, cell } = this;
    const leans = cell.some((row, q) => row.some((v, c) => c < q && v && (walled.includes(q) || walled.includes(c))));
    refuse(leans || (this.strict && walled.length), "an axis with walls leans, or the file is strict");
    refuse(walled.some((c) => c < 0 || c >= d) || new Set(walled).size < walled.length, "'walls' names no axes");
    refuse(this.contacts.some(({ n }) => walled.some((c) => n[c])), "a contact reaches through a wall");
    const widths = new Set(cell.slice(0, Math.max(0, this.round)).map((row, c) => row[c]));
    refuse(this.round && (widths.size > 1 || this.round < 2 || this.round > d || this.rounds > 1),
      "a round wall is not one, about the first axes of a cell with equal edges");
    [this.width, this.rim] = [cell[0][0], -2 - 2 * d]; // of the round wall, and its partner of contacts
    this.walls = [...this.flat.flatMap((c) => [-1 - 2 * c, -2 - 2 * c]), ...(this.round ? [this.rim] : [])];
  }
  test() {
    const { contacts, dim: d, x } = this, again = new Set();
    for (const { i, j, n } of contacts) again.add(keyOf(i, j, n)).add(keyOf(j, i, reversed(n)));
    const outside = (c, count) => c < 0 || c >= count;
    const positive = [this.unit, this.growth, ...this.ratio, ...this.cell.map((row, q) => new Exact(row[q]))];
    refuse(this.add.n <= 0n || new Exact(2n).below(this.add), "non_additivity must be above -1 and at most 1");
    refuse(!this.stable.includes(true), "no sphere is stable");
    refuse(!contacts.length, "the file lists no contact");
    refuse(again.size !== 2 * contacts.length, "a contact is there twice, or of a sphere with itself");
    this.testWalls();
    refuse(contacts.some(({ i, j }) => outside(i, x.length) || (outside(j, x.length) && !this.walls.includes(j))),
      "a contact names a sphere that is not there");
    refuse(this.tiles.some(({ ring }) => ring.some((c) => outside(c, contacts.length) || contacts[c].j < 0)),
      "a tile or an implied contact names a contact that is not there");
    refuse(positive.some((v) => v.n <= 0n), "a diameter, a cell edge, unit or gamma is not positive");
    this.closed = again;
    x.forEach((_, i) => again.add(keyOf(i, i, Array(d).fill(0))));
  }
  /** Where the unknowns stand, without G: `place` of components of spheres, `vectors` of the cell. */
  count() {
    const d = this.dim;
    [this.size, this.per] = whole(this.ratio);
    this.cross = this.add.times(this.add);
    const first = this.stable.indexOf(true), axes = this.cell.map((_, k) => k);
    const moving = this.stable.flatMap((yes, i) =>
      yes ? axes.filter((k) => i !== first || this.walled.includes(k)).map((k) => ({ i, k })) : []);
    const free = moving.filter(({ i, k }) => !this.pins.some(([end, c]) => end === i && c === k));
    refuse(moving.length - free.length !== this.pins.length || 2 * this.pins.length !== this.round * (this.round - 1),
      "there is not one pin for each rotation, of stable spheres");
    this.place = axes.map(() => new Map()); // of each component: sphere -> unknown
    free.forEach(({ i, k }, at) => this.place[k].set(i, at));
    this.sphereOf = free.map(({ i }) => i);
    this.vectors = this.strict ? this.cell.map((_, q) => free.length + (q * (q + 1)) / 2) : [];
    this.unknowns = free.length + (this.strict ? (d * (d + 1)) / 2 : 0);
    this.gradient = new Map(this.vectors.map((k, q) => [k + q, Exact.ratio(this.one, this.cell[q][q])])); // b
  }
  /** r = x_i - x_j + n H. */
  vector({ i, j, n }) {
    if (j === this.rim) return this.x[i].map((a, c) => (c < this.round ? 2n * a - this.width : 0n));
    if (j < 0) {
      const axis = (-1 - j) >> 1, far = (-1 - j) & 1 ? this.cell[axis][axis] : 0n;
      return this.x[i].map((a, c) => (c === axis ? 2n * (a - far) : 0n));
    }
    return this.x[i].map((a, c) => n.reduce((sum, m, q) => sum + BigInt(m) * this.cell[q][c], a - this.x[j][c]));
  }
  /** sigma^2, with sigma the mean of two diameters, times 1 + Delta where they differ. */
  sigma2(i, other) {
    const j = other < 0 ? i : other;
    const square = Exact.ratio((this.size[i] + this.size[j]) ** 2n, (2n * this.per) ** 2n);
    return this.size[i] === this.size[j] ? square : square.times(this.cross);
  }
  square(r) {
    return Exact.ratio(r.reduce((sum, v) => sum + v * v, 0n), this.one * this.one);
  }
  /** Of the contacts kept: F, -dF / dG or dg, and the columns of R as [row, whole number over one]. */
  equations(kept) {
    const f = [], sigma2 = [], columns = Array.from({ length: this.unknowns }, () => []);
    kept.map((k) => this.contacts[k]).forEach((contact, c) => {
      const { i, j, n } = contact;
      const loose = spheresOf(contact).some((k) => !this.stable[k]), r = this.vector(contact);
      refuse(i === j || loose, `images: contact ${c} is not of two stable ones`);
      const square = this.sigma2(i, j), room = Exact.ratio(this.width, this.one).minus(this.growth.times(this.ratio[i]));
      if (j === this.rim) {
        f.push(room.times(room).minus(this.square(r)));
        sigma2.push(TWO.times(this.ratio[i]).times(room));
      } else {
        f.push(this.square(r).minus(this.gamma.times(square)));
        sigma2.push(this.round ? TWO.times(this.growth).times(square) : square);
      }
      for (const [end, times] of j < 0 ? [[i, j === this.rim ? -4n : 4n]] : [[i, 2n], [j, -2n]])
        this.place.forEach((places, k) => {
          if (places.has(end)) columns[places.get(end)].push([c, times * r[k]]);
        });
      this.vectors.forEach((at, q) => {
        for (let k = 0; k <= q; ++k) columns[at + k].push([c, BigInt(2 * n[q]) * r[k]]);
      });
    });
    return { f, sigma2, columns };
  }
  /** Entries in units of 2^-BITS, off by half a unit. */
  rounded(columns) {
    const one = new Exact(this.one);
    return columns.map((column) => column.map(([c, v]) => [c, Number(new Exact(v, -BITS).over(one).round())]));
  }
  /** R^T f - b. */
  unbalanced(columns, forces) {
    const [list, per] = whole(forces), over = new Exact(this.one * per);
    return columns.map((column, k) => {
      const net = new Exact(column.reduce((sum, [c, v]) => sum + v * list[c], 0n)).over(over);
      return this.gradient.has(k) ? net.minus(this.gradient.get(k)) : net;
    });
  }
  /** Spheres are open where a component of r is larger, and farther apart than SEEN. There is room for 4 radii, and
   * strict for one more of each cell vector between them. */
  reach(radius, gamma) {
    const { cell, one, x } = this, way = radius.times(new Exact(one)).ceil(), images = Array(this.dim).fill(0n);
    const ratio = most(this.ratio), seen = SEEN.times(new Exact(one));
    const largest = ratio.times(ratio).times(most([ONE, this.cross]));
    const reach = root(gamma.times(largest).times(seen).times(seen).ceil()) + 1n + 4n * way;
    for (let c = this.vectors.length - 1; c >= 0; --c) { // images: |n| of spheres this near, in any cell in the radius
      refuse(cell[c][c] <= 2n * way, "gap: the cell is not larger than the radius");
      const at = x.map((v) => v[c]).reduce(([a, b], v) => [v < a ? v : a, v > b ? v : b], [x[0][c], x[0][c]]);
      const apart = cell.reduce((sum, row, q) => sum + images[q] * ((row[c] < 0n ? -row[c] : row[c]) + way), at[1] - at[0]);
      images[c] = (reach + apart) / (cell[c][c] - way) + 1n;
    }
    return reach + images.reduce((a, b) => a + b) * way;
  }
  /** Refuses if (3) fails for this part of gamma; the least left side over gamma sigma^2 below SEEN^2, or null. */
  leastOpening(radius, gamma, part = ONE) {
    const reach = this.reach(radius, gamma), seen = SEEN.times(SEEN), { x, stable, cell } = this;
    let found = null;
    const images = (times, row, c) => (this.walled.includes(c) ? times : times * (floorOver(2n * reach, row[c]) + 1n));
    const many = cell.reduce(images, 1n);
    refuse(many > MOST_IMAGES, `gap: the cell is so thin that a sphere meets more than ${MOST_IMAGES} images`);
    for (let i = 0; i < x.length; ++i)
      for (const j of [...this.walls, ...x.keys()].filter((k) => k <= i))
        for (const { n, r } of this.near(i, j, reach)) {
          if (j < 0) this.testInside(i, j, r, radius, gamma);
          if (this.closed.has(keyOf(i, j, n))) continue;
          const images = this.strict ? n.reduce((sum, m) => sum + Math.abs(m), 0) : 0;
          const moving = (i !== j ? stable[i] + stable[j < 0 ? i : j] : 0) + images;
          const have = this.left(j, r, radius.times(new Exact(BigInt(moving)))).over(gamma.times(this.sigma2(i, j)));
          const image = n.length > 1 ? n.join(", ") : `${n[0]},`;
          refuse(!part.below(have), () => `gap: spheres ${i} and ${j} are not open (image (${image}))`);
          if (have.below(seen)) found = found && found.n ? (have.below(found) ? have : found) : have;
        }
    return found;
  }
  /** What is left of |r|^2, or of (W - |r|)^2 at a round wall, after this way. */
  left(j, r, way) {
    const one = Exact.ratio(r.reduce((sum, v) => sum + (v < 0n ? -v : v), 0n), this.one), change = TWO.times(one).times(way);
    if (j !== this.rim) return this.square(r).minus(change);
    const farthest = this.square(r).plus(change).plus(way.times(way).times(new Exact(BigInt(this.dim))));
    const room = Exact.ratio(this.width, this.one).minus(rooted(farthest, 1));
    return room.times(room.abs());
  }
  testInside(i, j, r, radius, gamma) {
    const size = new Exact(this.width).over(this.ratio[i].times(new Exact(this.one)));
    const fits = j === this.rim && gamma.below(size.times(size));
    if (fits) return;
    refuse(j === this.rim, () => `gap: the centre of sphere ${i} may be outside the walls`);
    const way = r.reduce((a, b) => a + b) * (j % 2 ? 1n : -1n), reach = radius.times(new Exact(4n * this.one));
    refuse(!reach.below(new Exact(way)), `gap: the centre of sphere ${i} may be outside the walls`);
  }
  /** Images n of sphere i, and their vectors r from sphere j with components within reach. */
  near(i, j, reach) {
    const none = Array(this.dim).fill(0);
    if (j < 0) return [{ n: none, r: this.vector({ i, j, n: none }) }];
    let list = [{ n: [], r: this.x[i].map((v, c) => v - this.x[j][c]) }];
    for (let c = this.dim - 1; c >= 0; --c) {
      const row = this.cell[c], next = [];
      for (const { n, r } of list) {
        const walled = this.walled.includes(c), inside = r[c] <= reach && -r[c] <= reach ? 0n : -1n;
        const end = walled ? inside : floorOver(reach - r[c], row[c]);
        for (let m = walled ? 0n : -floorOver(reach + r[c], row[c]); m <= end; ++m)
          next.push({ n: [Number(m), ...n], r: m ? r.map((v, k) => v + m * row[k]) : r });
      }
      list = next;
    }
    return list;
  }
}
