// What is drawn: the state that controls set, and the instances that follow from it.
const state = {
  axes: [0, 1, 2].slice(0, Math.min(dim, 3)), // coordinates on the screen
  hidden: cell.map((row, c) => 0.5 * row[c]), // d > 3: where the slice lies along the others
  whole: false, // d > 3: project all spheres instead of a slice
  colour: 0, size: 1, forces: network && dim === 2 ? 1 : 0, width: 1, threshold: 0, images: false, box: true,
  names: false, step: data.steps ? data.steps.length - 1 : 0, slab: -1, slabAt: 0.5, slabThick: 0.3, hide: new Set(), chosen: -1,
};
const THICK = dim === 2 ? 0.055 : 0.03; // radius of a mean force over the mean diameter
const MARGIN = 0.15; // of the cell: how far periodic images are drawn beyond it

// Cell vectors on the shown axes, (3, 3); d = 2 gets a third axis without extent.
const shownCell = () => [0, 1, 2].map((r) => [0, 1, 2].map((c) =>
  r < state.axes.length && c < state.axes.length ? cell[state.axes[r]][state.axes[c]] : 0));

// Spheres are stored in a brick; a sheared cell is filled by moving them by lattice vectors.
function placed(i) {
  const x = [0, 1, 2].map((c) => (c < state.axes.length ? position[i * dim + state.axes[c]] : 0));
  if (cube) return x;
  const a = shownCell();
  for (let r = state.axes.length - 1; r >= 0; --r) {
    let rest = x[r];
    for (let k = r + 1; k < state.axes.length; ++k) rest -= fraction(x, a, k) * a[k][r];
    const m = Math.floor(rest / a[r][r]);
    for (let c = 0; c <= r; ++c) x[c] -= m * a[r][c];
  }
  return x;
}
function fraction(x, a, k) {
  let rest = x[k];
  for (let q = k + 1; q < state.axes.length; ++q) rest -= fraction(x, a, q) * a[q][k];
  return rest / a[k][k];
}

// The radius of a sphere's cut with the chosen slice; 0: it misses the slice.
function cutRadius(i) {
  const r = radius(i);
  if (dim <= 3 || state.whole) return r;
  let left = r * r;
  for (let c = 0; c < dim; ++c) {
    if (state.axes.includes(c)) continue;
    let d = position[i * dim + c] - state.hidden[c];
    d -= Math.round(d / cell[c][c]) * cell[c][c];
    left -= d * d;
  }
  return left > 0 ? Math.sqrt(left) : 0;
}

const inSlab = (x) => {
  if (dim === 2 || state.slab < 0) return true;
  const edge = cell[state.axes[state.slab]][state.axes[state.slab]];
  return Math.abs(x[state.slab] / edge - state.slabAt) <= 0.5 * state.slabThick;
};

function tints() {
  const q = quantities[state.colour], values = new Float64Array(n);
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < n; ++i) {
    values[i] = q.of(i);
    low = Math.min(low, values[i]);
    high = Math.max(high, values[i]);
  }
  if (q.range) [low, high] = q.range();
  const of = q.classes ? (i) => CLASSES[values[i]].colour : (i) => viridis((values[i] - low) / (high - low || 1));
  return { q, values, low, high, of };
}

// Lattice shifts whose images may reach into the margin, the cell itself first.
function shifts() {
  const a = shownCell(), list = [[0, 0, 0]];
  if (!state.images) return list;
  const span = (c) => (c < state.axes.length ? [-1, 0, 1] : [0]);
  for (const i of span(0)) for (const j of span(1)) for (const k of span(2))
    if (i || j || k) list.push([0, 1, 2].map((c) => i * a[0][c] + j * a[1][c] + k * a[2][c]));
  return list;
}
function inMargin(x) {
  const a = shownCell();
  return state.axes.every((_, k) => {
    const s = fraction(x, a, k);
    return s >= -MARGIN && s <= 1 + MARGIN;
  });
}

const scene = { sphere: null, owner: null, count: 0, sticks: 0, tint: null };

function build(renderer) {
  const tint = tints(), all = [], owner = [], colours = [], visible = new Uint8Array(n), where = new Array(n);
  for (let i = 0; i < n; ++i) {
    const r = cutRadius(i);
    where[i] = placed(i);
    visible[i] = r > 0 && !state.hide.has(classOf(i)) && inSlab(where[i]);
    if (visible[i]) where[i].push(r);
  }
  const moved = shifts();
  for (const s of moved)
    for (let i = 0; i < n; ++i) {
      if (!visible[i] || state.size <= 0) continue;
      const x = [where[i][0] + s[0], where[i][1] + s[1], where[i][2] + s[2]];
      if (s !== moved[0] && !inMargin(x)) continue;
      const c = tint.of(i), pale = s === moved[0] ? 0 : 0.45;
      all.push(x[0], x[1], x[2], where[i][3] * state.size);
      colours.push(...c.map((v) => Math.round(v + pale * (255 - v))), 255);
      owner.push(i);
    }
  scene.sphere = new Float32Array(all);
  scene.owner = owner;
  scene.count = owner.length;
  scene.tint = tint;
  renderer.spheres(scene.sphere, new Uint8Array(colours), scene.count);
  buildSticks(renderer, where, visible, moved);
}

// Each contact as two half lines from the centres, so that none crosses the cell; and the edges of the cell.
function buildSticks(renderer, where, visible, moved) {
  const start = [], stop = [], colours = [];
  const stick = (a, b, r, c) => {
    start.push(a[0], a[1], a[2], r);
    stop.push(b[0], b[1], b[2], 0);
    colours.push(...c, 255);
  };
  for (let k = 0; state.forces && atEnd() && k < contactCount; ++k) {
    const f = network.force[k];
    if (f < state.threshold) continue;
    const [i, j] = [network.pair[2 * k], network.pair[2 * k + 1]];
    const stretch = radius(i) === radius(j) ? 1 : 1 + data.non_additivity;
    const half = 0.5 * (radius(i) + radius(j)) * stretch * (1 + network.gap[k]);
    const r = THICK * state.width * meanDiameter * f;
    for (const [end, sign] of [[i, -1], [j, 1]]) {
      if (!visible[end] || (dim > 3 && !state.whole && !(visible[i] && visible[j]))) continue;
      const v = [0, 1, 2].map((c) => (c < state.axes.length ? network.vector[k * dim + state.axes[c]] : 0));
      for (const s of moved) {
        const a = [0, 1, 2].map((c) => where[end][c] + s[c]), b = a.map((x, c) => x + sign * half * v[c]);
        if (s === moved[0] || inMargin(a)) stick(a, b, r, [150, 20, 40]);
      }
    }
  }
  if (state.box) {
    const a = shownCell(), thin = 0.012 * meanDiameter, m = state.axes.length;
    for (let corner = 0; corner < 1 << m; ++corner)
      for (let axis = 0; axis < m; ++axis) {
        if (corner & (1 << axis)) continue;
        const from = [0, 1, 2].map((c) => a.reduce((sum, row, r) => sum + ((corner >> r) & 1) * row[c], 0));
        stick(from, from.map((x, c) => x + a[axis][c]), thin, [60, 66, 78]);
      }
  }
  scene.sticks = start.length / 4;
  renderer.sticks(new Float32Array(start), new Float32Array(stop), new Uint8Array(colours), scene.sticks);
}
