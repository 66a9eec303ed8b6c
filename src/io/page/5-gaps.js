// Pairs of spheres with small gaps that do not touch, found when they are asked for.
const GAPS_TO = 0.2; // of the contact distance
const touching = (i, j) => (radius(i) + radius(j)) * (radius(i) === radius(j) ? 1 : 1 + data.non_additivity);
// Cells of more than three dimensions have too many neighbours to look through; shifted pairs have no place in space.
const canFindGaps = !data.shifted && dim <= 3 && n > 1;

let foundPairs = null;
function nearPairs() {
  if (foundPairs) return foundPairs;
  let widest = 0;
  for (let i = 0; i < n; ++i) widest = Math.max(widest, 2 * radius(i));
  const reach = widest * (1 + Math.max(0, data.non_additivity)) * (1 + GAPS_TO), rows = [], key = new Set();
  for (let k = 0; k < contactCount; ++k) {
    const [i, j] = [network.pair[2 * k], network.pair[2 * k + 1]];
    if (j >= 0) key.add(Math.min(i, j) * n + Math.max(i, j)); // j < 0: a wall
  }
  // Places in a grid of cells no narrower than the reach, so that neighbours lie in adjacent ones.
  const side = cell.map((row, c) => Math.max(1, Math.min(64, Math.floor(row[c] / reach)))), grid = new Map();
  const inside = (i) => {
    const s = new Array(dim);
    for (let c = dim - 1; c >= 0; --c) {
      let rest = position[i * dim + c];
      for (let q = c + 1; q < dim; ++q) rest -= s[q] * cell[q][c];
      s[c] = rest / cell[c][c];
    }
    return s.map((x) => x - Math.floor(x));
  };
  const place = (s) => s.map((x, c) => Math.min(Math.floor(x * side[c]), side[c] - 1));
  const code = (at) => at.reduce((sum, a, c) => sum * side[c] + a, 0);
  const fractions = Array.from({ length: n }, (_, i) => inside(i));
  fractions.forEach((s, i) => {
    const at = code(place(s));
    if (!grid.has(at)) grid.set(at, []);
    grid.get(at).push(i);
  });
  const steps = [[]];
  for (let c = 0; c < dim; ++c) // a sheared cell may need cells one farther along the axes before
    steps.splice(0, steps.length,
      ...steps.flatMap((s) => (isSheared(c) ? [-2, -1, 0, 1, 2] : [-1, 0, 1]).map((d) => [...s, d])));
  for (let i = 0; i < n; ++i) {
    const own = place(fractions[i]);
    const around = new Set(steps.map((d) => code(own.map((a, c) => (a + d[c] + 2 * side[c]) % side[c]))));
    for (const at of around)
      for (const j of grid.get(at) || []) {
        if (j <= i || key.has(i * n + j)) continue;
        const v = nearest(i, j), r = Math.hypot(...v), gap = r / touching(i, j) - 1;
        if (gap <= GAPS_TO) rows.push({ i, j, gap, v });
      }
  }
  rows.sort((a, b) => a.gap - b.gap);
  foundPairs = { pair: rows.flatMap((w) => [w.i, w.j]), gap: rows.map((w) => w.gap), vector: rows.flatMap((w) => w.v) };
  return foundPairs;
}
const isSheared = (c) => cell.some((row, r) => r > c && row[c] !== 0);

// The vector from j to the nearest image of i.
function nearest(i, j) {
  const v = Array.from({ length: dim }, (_, c) => position[i * dim + c] - position[j * dim + c]);
  for (let c = dim - 1; c >= 0; --c) {
    if (closed[c]) continue;
    const m = Math.round(v[c] / cell[c][c]);
    for (let q = 0; q <= c; ++q) v[q] -= m * cell[c][q];
  }
  return v;
}
