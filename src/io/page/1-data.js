// The packing: numbers of the JSON block, and what follows from them.
const data = JSON.parse(document.getElementById("data").textContent);

function numbers(text, Type) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; ++k) bytes[k] = raw.charCodeAt(k);
  return new Type(bytes.buffer);
}

const dim = data.dim, n = data.n;
const endPosition = numbers(data.position, Float64Array), diameter = numbers(data.diameter, Float64Array);
const isCube = (a) => a.every((row, r) => row.every((x, c) => (r === c ? x === a[0][0] : x === 0)));
// What is shown: the packing itself, or a state of the crunch that led to it, whose diameters are smaller by one
// factor.
let cell = data.cell, cube = isCube(cell), position = endPosition, growth = 1;
const radius = (i) => 0.5 * growth * diameter[diameter.length > 1 ? i : 0];
let meanDiameter = 0;
for (const s of diameter) meanDiameter += s / diameter.length;

// Rows of contacts: spheres i and j, the unit vector from j to i, gap and force (mean 1). Contacts by distance have no
// forces: all are drawn as the mean force would be.
const network = data.contacts && {
  pair: numbers(data.contacts.pair, Int32Array),
  vector: numbers(data.contacts.vector, Float32Array),
  gap: numbers(data.contacts.gap, Float32Array),
  force: data.contacts.force ? numbers(data.contacts.force, Float32Array) : null,
};
const contactCount = network ? network.gap.length : 0, balanced = !!network && network.force !== null;
if (network && !balanced) network.force = new Float32Array(contactCount).fill(1);
const coordination = new Int32Array(n), load = new Float64Array(n), contactsOf = new Map();
for (let k = 0; k < contactCount; ++k)
  for (const end of [network.pair[2 * k], network.pair[2 * k + 1]]) {
    if (end < 0) continue; // -1 - w: the wall w
    ++coordination[end];
    load[end] += network.force[k];
  }

// 0 stable, 1 buckler, 2 rattler: colours that stay apart for every kind of colour vision, and a letter each.
const CLASSES = [
  { name: "stable", letter: "S", colour: [0, 114, 178] },
  { name: "buckler", letter: "B", colour: [230, 159, 0] },
  { name: "rattler", letter: "R", colour: [190, 190, 190] },
];
const classOf = (i) => (!balanced ? 0 : coordination[i] === 0 ? 2 : coordination[i] === dim + 1 ? 1 : 0);

// What spheres can be coloured by: a name and a number a sphere.
const quantities = [{ name: "diameter", of: (i) => 2 * radius(i) }];
if (network) quantities.unshift({ name: "coordination", of: (i) => coordination[i], whole: true });
if (balanced) {
  quantities.unshift({ name: "class", of: classOf, classes: true });
  quantities.splice(2, 0, { name: "sum of forces", of: (i) => load[i] });
}
const described = quantities.length; // by other lines of the text on a sphere
if (data.steps) quantities.push({ name: "distance to the end", of: (i) => distance[i], range: () => [0, farthest] });
for (const own of data.values) {
  const list = numbers(own.values, Float64Array);
  quantities.push({ name: own.name, of: (i) => list[i] });
}

// Displacements that are shown as an oscillation about the packing: d rows of n numbers.
const motions = data.motions.map((m) => ({ name: m.name, rows: numbers(m.rows, Float32Array) }));
const closed = data.closed; // axes on which nothing repeats

function shownNumber(x, digits = 6) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (Number.isInteger(x) && Math.abs(x) < 1e9) return String(x);
  return Math.abs(x) >= 1e-3 && Math.abs(x) < 1e6 ? x.toPrecision(digits) : x.toExponential(Math.min(3, digits - 1));
}

// The contacts of one sphere, found when they are asked for.
function contacts(i) {
  if (!contactsOf.has(i)) {
    const rows = [];
    for (let k = 0; k < contactCount; ++k) {
      const [a, b] = [network.pair[2 * k], network.pair[2 * k + 1]];
      if (a === i || b === i) rows.push({ other: a === i ? b : a, force: network.force[k], gap: network.gap[k] });
    }
    contactsOf.set(i, rows.sort((a, b) => b.force - a.force));
  }
  return contactsOf.get(i);
}

// Both scales grow darker or lighter all the way, so that they keep their order for every kind of colour vision and in
// grey.
const FORCES = [[254, 200, 140], [241, 96, 93], [158, 47, 127], [45, 17, 96]];
const VIRIDIS = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129],
  [92, 200, 99], [170, 220, 50], [253, 231, 37]];
function tone(scale, t) {
  const x = Math.min(Math.max(t, 0), 1) * (scale.length - 1), k = Math.min(Math.floor(x), scale.length - 2);
  return scale[k].map((c, m) => Math.round(c + (x - k) * (scale[k + 1][m] - c)));
}
const viridis = (t) => tone(VIRIDIS, t);
const STRONG = 3; // mean forces: from here on the darkest colour
