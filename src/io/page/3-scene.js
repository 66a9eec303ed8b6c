// What is drawn: the state that controls set, and the instances that follow from it.
const state = {
  axes: [0, 1, 2].slice(0, Math.min(dim, 3)), // coordinates on the screen
  hidden: cell.map((row, c) => 0.5 * row[c]), // d > 3: where the slice lies along the others
  whole: false, // d > 3: project all spheres instead of a slice
  colour: 0, size: 1, forces: network && dim === 2 ? 1 : 0, width: 1, threshold: 0, images: false, box: true,
  forceColours: true, gap: 0, motion: -1, names: false, step: data.steps ? data.steps.length - 1 : 0,
  slab: -1, slabAt: 0.5, slabThick: 0.3, hide: new Set(), chosen: -1,
};
const THICK = dim === 2 ? 0.055 : 0.03; // radius of a mean force over the mean diameter
const THIN_FROM = 2000; // instances: fewer are never thinned out
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
    if (!closed[c]) d -= Math.round(d / cell[c][c]) * cell[c][c];
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
  const of = q.classes ? (i) => CLASSES[values[i]].colour : (i) => viridis(high > low ? (values[i] - low) / (high - low) : 0.4);
  return { q, values, low, high, of };
}

// Lattice shifts whose images may reach into the margin, the cell itself first.
function shifts() {
  const a = shownCell(), list = [[0, 0, 0]];
  if (!state.images) return list;
  const span = (c) => (c < state.axes.length && !closed[state.axes[c]] ? [-1, 0, 1] : [0]);
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

const scene = { sphere: null, colours: null, owner: null, count: 0, sticks: 0, stick: null, tint: null };

// Shown components of the displacement of sphere i in the chosen motion, in the unit of the cell.
function movement(i) {
  if (state.motion < 0 || i < 0) return [0, 0, 0];
  const { rows } = motions[state.motion];
  return [0, 1, 2].map((c) => (c < state.axes.length ? rows[state.axes[c] * n + i] : 0));
}

// Places of the instances in the order in which a thinned picture takes them: from the outside in, where they hide the
// others; disks in a scattered order.
function drawingOrder(all, count) {
  const order = Array.from({ length: count }, (_, k) => k);
  if (count < THIN_FROM) return order;
  const key = new Float64Array(count), low = [0, 1, 2].map(() => Infinity), high = low.map(() => -Infinity);
  for (let k = 0; k < count; ++k)
    for (let c = 0; c < 3; ++c) {
      const x = all[4 * k + c];
      [low[c], high[c]] = [Math.min(low[c], x), Math.max(high[c], x)];
    }
  for (let k = 0; k < count; ++k) {
    if (dim === 2) key[k] = (k * 2654435761) % 4294967296;
    else key[k] = Math.min(...[0, 1, 2].map((c) => Math.min(all[4 * k + c] - low[c], high[c] - all[4 * k + c])));
  }
  return order.sort((a, b) => key[a] - key[b]);
}

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
  scene.count = owner.length;
  const order = drawingOrder(all, scene.count), four = (list, Type) => {
    const made = new Type(4 * scene.count);
    order.forEach((k, at) => { for (let c = 0; c < 4; ++c) made[4 * at + c] = list[4 * k + c]; });
    return made;
  };
  scene.owner = order.map((k) => owner[k]);
  scene.sphere = four(all, Float32Array);
  scene.colours = four(colours, Uint8Array);
  scene.tint = tint;
  const arrays = { start: scene.sphere, tint: scene.colours };
  if (state.motion >= 0) arrays.move = new Float32Array(scene.owner.flatMap((i) => [...movement(i), 0]));
  renderer.spheres(arrays, scene.count);
  buildSticks(renderer, where, visible, moved);
}

// Each contact, and each pair with a small gap, as two half lines from the centres, so that none crosses the cell; and
// the container or the edges of the cell.
function buildSticks(renderer, where, visible, moved) {
  const start = [], stop = [], colours = [], move = [], moveStop = [], still = [0, 0, 0];
  const stick = (a, b, r, c, from = still, to = still) => {
    start.push(a[0], a[1], a[2], r);
    stop.push(b[0], b[1], b[2], 0);
    colours.push(...c, 255);
    if (state.motion >= 0) (move.push(...from, 0), moveStop.push(...to, 0));
  };
  // The cell first: it is drawn in full while the view moves.
  if (state.box && data.rings.length) curvedWall((a, b) => stick(a, b, 0.02 * meanDiameter, [60, 66, 78]));
  else if (state.box) {
    const a = shownCell(), thin = 0.012 * meanDiameter, m = state.axes.length;
    for (let corner = 0; corner < 1 << m; ++corner)
      for (let axis = 0; axis < m; ++axis) {
        if (corner & (1 << axis)) continue;
        const from = [0, 1, 2].map((c) => a.reduce((sum, row, r) => sum + ((corner >> r) & 1) * row[c], 0));
        stick(from, from.map((x, c) => x + a[axis][c]), thin, [60, 66, 78]);
      }
  }
  scene.frame = start.length / 4;
  // Half lines of a pair whose vector from j to i is length times v; j < 0 is a wall, to which the line goes in one.
  const bond = (i, j, length, v, r, colour) => {
    const both = j >= 0, from = { [i]: movement(i), [j]: movement(j) };
    const to = [0, 1, 2].map((c) => (both ? 0.5 * (from[i][c] + from[j][c]) : 0));
    for (const [end, sign] of both ? [[i, -1], [j, 1]] : [[i, -1]]) {
      if (!visible[end] || (both && dim > 3 && !state.whole && !(visible[i] && visible[j]))) continue;
      for (const s of moved) {
        const a = [0, 1, 2].map((c) => where[end][c] + s[c]);
        const b = a.map((x, c) => x + sign * (both ? 0.5 : 1) * length * v[c]);
        if (s === moved[0] || inMargin(a)) stick(a, b, r, colour, from[end], to);
      }
    }
  };
  const shownPart = (list, k) => [0, 1, 2].map((c) => (c < state.axes.length ? list[k * dim + state.axes[c]] : 0));
  for (let k = 0; state.forces && atEnd() && k < contactCount; ++k) {
    const f = network.force[k], [i, j] = [network.pair[2 * k], network.pair[2 * k + 1]];
    if (f < state.threshold) continue;
    const length = (j < 0 ? radius(i) : touching(i, j)) * (1 + network.gap[k]);
    const colour = state.forceColours ? tone(FORCES, f / STRONG) : [150, 20, 40];
    bond(i, j, length, shownPart(network.vector, k), THICK * state.width * meanDiameter * f, colour);
  }
  if (state.gap > 0 && atEnd()) {
    const near = nearPairs(), thin = 0.25 * THICK * meanDiameter;
    for (let k = 0; k < near.gap.length && near.gap[k] <= state.gap; ++k)
      bond(near.pair[2 * k], near.pair[2 * k + 1], 1, shownPart(near.vector, k), thin, [0, 0, 0]);
  }
  scene.sticks = start.length / 4;
  scene.stick = { start: new Float32Array(start), stop: new Float32Array(stop), tint: new Uint8Array(colours) };
  const moves = state.motion >= 0 ? { move: new Float32Array(move), moveStop: new Float32Array(moveStop) } : {};
  renderer.sticks({ ...scene.stick, ...moves }, scene.sticks, scene.frame);
}

// The curved wall in pieces of lines: its circles, and four lines from one to the next in the same plane.
function curvedWall(line) {
  const pieces = 72;
  const at = (ring, t) => {
    const x = [...ring.centre];
    x[ring.axes[0]] += ring.radius * Math.cos(t);
    x[ring.axes[1]] += ring.radius * Math.sin(t);
    return [0, 1, 2].map((c) => (c < state.axes.length ? x[state.axes[c]] : 0));
  };
  data.rings.forEach((ring, r) => {
    for (let k = 0; k < pieces; ++k) line(at(ring, (2 * Math.PI * k) / pieces), at(ring, (2 * Math.PI * (k + 1)) / pieces));
    const last = data.rings[r - 1];
    for (let k = 0; k < 4 && last && String(last.axes) === String(ring.axes); ++k)
      line(at(last, (Math.PI * k) / 2), at(ring, (Math.PI * k) / 2));
  });
}
