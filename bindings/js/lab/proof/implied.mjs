// Implied contacts in d = 2, by the rules in the head of jamproof_implied.py. An angle is a Map {name: whole number}.
import { refuse } from './exact.mjs';

const CONVEX = 2000n; // sines of the corners of a tile exceed 1 / CONVEX
const SIXTHS = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]]; // exp(i k pi / 3) = a + b exp(i pi / 3)
const TURN = ""; // the name of 60 degrees
const turns = (k) => new Map([[TURN, k]]);

/** The angle a + times b; six times 60 degrees are none. */
function plus(a, b, times = 1) {
  const sum = new Map(a);
  for (const [name, v] of b) sum.set(name, (sum.get(name) || 0) + times * v);
  sum.set(TURN, ((((sum.get(TURN) || 0) % 6) + 6) % 6));
  return new Map([...sum].filter(([, v]) => v));
}

/** The contacts of a walk with half turn or none, and vector; where it leads, with the sum of images. */
function walk(s, ring) {
  const ends = ring.map((c) => s.contacts[c]), [p, q] = ends;
  let at = p.j === q.i || p.j === q.j ? p.i : p.j;
  const from = at;
  let image = Array(s.dim).fill(0);
  const sides = ring.map((c, k) => {
    const { i, j, n } = ends[k], sign = at === j ? 1 : -1;
    refuse(at !== i && at !== j, `excess: contact ${c} does not go on from sphere ${at}`);
    at = sign > 0 ? i : j;
    image = image.map((v, m) => v + sign * n[m]);
    return { c, angle: turns(((1 - sign) / 2) * 3), vector: s.vector(ends[k]).map((v) => BigInt(sign) * v) };
  });
  return { sides, from, at, image };
}

/** The direction of side q is that of p and an angle: {contact: [root, angle to it]}. */
function relate(turned, p, q, angle) {
  for (const { c } of [p, q]) if (!turned.has(c)) turned.set(c, [c, new Map()]);
  const [[a, x], [b, y]] = [turned.get(p.c), turned.get(q.c)];
  const whole = plus(plus(plus(angle, p.angle), x), plus(q.angle, y), -1);
  if (a !== b) for (const [c, [root, z]] of turned) if (root === b) turned.set(c, [a, plus(z, whole)]);
}

/** The angles of a tile: a parallelogram, or a triangle with two equal sides. `length`: names of equal lengths. */
function lay(s, turned, ring, length) {
  const { sides, from, at, image } = walk(s, ring), size = sides.length;
  const corners = sides.map(({ vector: u }, k) => {
    const v = sides[(k + 1) % size].vector, cross = u[0] * v[1] - u[1] * v[0];
    const squares = u.reduce((a, x) => a + x * x, 0n) * v.reduce((a, x) => a + x * x, 0n);
    return (CONVEX * cross) ** 2n > squares ? (cross > 0n ? 1 : -1) : 0;
  });
  refuse(from !== at || image.some((v) => v) || !corners[0] || corners.some((v) => v !== corners[0]),
    "excess: a tile is not closed and convex");
  const sigma = ring.map((c) => length[c]);
  if (size === 4) {
    refuse(sigma[0] !== sigma[2] || sigma[1] !== sigma[3], "excess: a tile is no triangle and no parallelogram");
    for (const k of [0, 1]) relate(turned, sides[k], sides[k + 2], turns(3));
    return;
  }
  for (const k of [0, 1]) {
    const [p, q, opposite] = [0, 1, 2].map((m) => sigma[(k + m) % 3]);
    refuse(new Set([p, q, opposite]).size === 3, "excess: three unequal sides");
    let outer; // 180 degrees less the angle between them
    if (p === q) outer = opposite === p ? turns(2) : new Map([[`${p} ${opposite}`, 2]]);
    else outer = new Map([[TURN, 3], [`${opposite} ${p === opposite ? q : p}`, -1]]);
    relate(turned, sides[k], sides[k + 1], plus(new Map(), outer, corners[0]));
  }
}

/** Does the walk over these sides add up to one vector of the length of contact c? */
function follows(turned, sides, c, length) {
  const sums = new Map();
  for (const side of sides) {
    const [root, given] = turned.get(side.c) || [side.c, new Map()], angle = plus(given, side.angle);
    const names = [...angle].filter(([name]) => name !== TURN).map((pair) => pair.join(":")).sort().join(";");
    const key = `${root}|${length[side.c]}|${names}`, [a, b] = SIXTHS[angle.get(TURN) || 0];
    const sum = sums.get(key) || { a: 0, b: 0, size: length[side.c] };
    sums.set(key, { a: sum.a + a, b: sum.b + b, size: sum.size });
  }
  const left = [...sums.values()].filter(({ a, b }) => a || b);
  return left.length === 1 && left[0].size === length[c] && left[0].a ** 2 + left[0].a * left[0].b + left[0].b ** 2 === 1;
}

/** The contacts but those that the others imply. */
export function keptContacts(s) {
  const implied = new Set(s.tiles.filter(({ word, ring }) => word === "implied" && ring.length).map(({ ring }) => ring[0]));
  const every = s.contacts.map((_, c) => c), known = new Set(every.filter((c) => !implied.has(c))), turned = new Map();
  const named = [], length = s.contacts.map(({ i, j }) => {
    const own = s.sigma2(i, j), at = named.findIndex((v) => v.compare(own) === 0);
    return at < 0 ? named.push(own) - 1 : at;
  });
  for (const { word, ring } of s.tiles) {
    const rests = (word === "tile" ? ring : ring.slice(1)).every((c) => known.has(c));
    refuse(s.dim !== 2 || ring.length < 3 || ring.length > 4 || !rests,
      `excess: ${word} [${ring.join(", ")}] does not rest on known contacts`);
    if (word === "tile") {
      lay(s, turned, ring, length);
      continue;
    }
    const { i, j, n } = s.contacts[ring[0]], { sides, from, at, image } = walk(s, ring.slice(1));
    const leads = (a, b, sign) => from === a && at === b && image.every((v, k) => v === sign * n[k]);
    refuse(!leads(j, i, 1) && !leads(i, j, -1), `excess: the walk of contact ${ring[0]} leads elsewhere`);
    refuse(!follows(turned, sides, ring[0], length), `excess: contact ${ring[0]} does not follow`);
    known.add(ring[0]);
  }
  return every.filter((c) => known.has(c) && !implied.has(c));
}
