// The camera, the mouse and the keys, labels on spheres, and the sphere under the pointer.
const canvas = document.getElementById("gl"), labels = document.getElementById("labels");
const tip = document.getElementById("tip");
const renderer = makeRenderer(canvas);
const camera = { turn: null, zoom: 1, shift: [0, 0] };

const product = (a, b) => [0, 1, 2].flatMap((r) => [0, 1, 2].map((c) =>
  a[3 * r] * b[c] + a[3 * r + 1] * b[3 + c] + a[3 * r + 2] * b[6 + c]));
function turning(axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return axis === 0 ? [1, 0, 0, 0, c, -s, 0, s, c] : [c, 0, s, 0, 1, 0, -s, 0, c];
}
function home() {
  camera.turn = dim === 2 ? [1, 0, 0, 0, 1, 0, 0, 0, 1] : product(turning(0, 0.38), turning(1, -0.5));
  camera.zoom = 1;
  camera.shift = [0, 0];
}

const turned = (x) => [0, 1, 2].map((r) => camera.turn[3 * r] * x[0] + camera.turn[3 * r + 1] * x[1] +
  camera.turn[3 * r + 2] * x[2]);
const middle = () => shownCell().reduce((sum, row) => sum.map((x, c) => x + 0.5 * row[c]), [0, 0, 0]);
// The whole cell fits on the canvas, however it is turned; with room for images when they are shown.
function viewNow() {
  const a = shownCell(), m = turned(middle()), room = state.images ? 1 + 2 * MARGIN : 1;
  const across = dim === 2 ? a[0][0] + Math.abs(a[1][0]) + meanDiameter : reachOf(a) + meanDiameter;
  const up = dim === 2 ? a[1][1] + meanDiameter : across;
  const fit = Math.min(canvas.width / across, canvas.height / up) / room;
  return { turn: new Float32Array(camera.turn), scale: camera.zoom * fit,
    shift: [camera.shift[0] - m[0], camera.shift[1] - m[1]],
    depth: room * reachOf(a) + Math.abs(m[2]) + meanDiameter, flat: dim === 2 };
}
// The longest diagonal of the cell.
function reachOf(a) {
  let longest = 0;
  for (let signs = 0; signs < 4; ++signs) {
    const sum = [0, 1, 2].map((c) => a[0][c] + (signs & 1 ? -1 : 1) * a[1][c] + (signs & 2 ? -1 : 1) * a[2][c]);
    longest = Math.max(longest, Math.hypot(...sum));
  }
  return longest;
}

// While the view moves, no more is drawn than the frame time allows; at rest all is. Where all take longer than that,
// the picture is coarse while it moves, since most of the time goes into pixels, and then a share of the instances is
// drawn. `whole`: ms of a picture at rest.
const FRAME = 24; // ms, which leaves a part of 1/30 s to the browser
const COARSE = 0.5, FEWEST = 1000; // pixels of a coarse picture along an edge; instances
const thin = { share: 1, moving: false, coarse: false, rest: 0, whole: 0 };
const bounded = (share) => Math.min(1, Math.max(share, FEWEST / Math.max(scene.count, FEWEST)));
function adapt(elapsed) {
  thin.share = bounded(thin.share * Math.min(Math.max(FRAME / Math.max(elapsed, 1), 0.25), 1.5));
}
function beginMoving() {
  thin.moving = true;
  thin.coarse = thin.whole > FRAME;
  thin.share = bounded(thin.coarse ? FRAME / (0.5 * thin.whole) : 1);
}
function showThinning() {
  const place = document.getElementById("thinned"), drawn = Math.ceil(scene.count * thin.share);
  place.hidden = !thin.moving || (drawn >= scene.count && !thin.coarse);
  place.textContent = `while it moves: ${drawn} of ${scene.count} spheres${dim === 2 ? "" : ", the outer ones"}` +
    (thin.coarse ? `, at ${COARSE} of the resolution` : "");
}

// Whether the size had to change, which clears the picture.
function fitCanvas() {
  const ratio = window.devicePixelRatio || 1;
  let changed = false;
  for (const one of [canvas, labels]) {
    const fine = ratio * (thin.moving && thin.coarse && one === canvas ? COARSE : 1);
    const width = Math.round(one.clientWidth * fine), height = Math.round(one.clientHeight * fine);
    if (one.width === width && one.height === height) continue;
    [one.width, one.height] = [width, height];
    changed = true;
  }
  return changed;
}
function draw() {
  fitCanvas();
  const view = viewNow(), began = performance.now();
  renderer.draw(view, thin.moving ? thin.share : 1, oscillation.phase);
  if (isLarge()) renderer.finish();
  if (thin.moving) adapt(performance.now() - began);
  else {
    thin.whole = performance.now() - began;
    drawLabels(view);
  }
  showThinning();
}
const isLarge = () => scene.count + scene.sticks >= THIN_FROM;
let waiting = false;
function redraw(moves = false) {
  if (!renderer) return;
  if (moves !== true || !isLarge()) thin.moving = false;
  else if (!thin.moving) beginMoving();
  if (thin.moving) {
    clearTimeout(thin.rest);
    thin.rest = setTimeout(redraw, 250);
  }
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    draw();
  });
}
function rebuild() {
  if (!renderer) return;
  build(renderer);
  showLegend();
  redraw();
}

// Where an instance stands on the canvas, in pixels from its top left, with its depth and radius.
function onCanvas(k, view) {
  const s = scene.sphere, away = oscillation.phase ? movement(scene.owner[k]) : [0, 0, 0];
  const x = turned([0, 1, 2].map((c) => s[4 * k + c] + oscillation.phase * away[c]));
  return { u: 0.5 * canvas.width + (x[0] + view.shift[0]) * view.scale,
    v: 0.5 * canvas.height - (x[1] + view.shift[1]) * view.scale, z: x[2], r: s[4 * k + 3],
    pixels: s[4 * k + 3] * view.scale };
}

// The instance in front at a point of the canvas; -1: none.
function instanceAt(u, v, view) {
  let found = -1, front = -Infinity;
  for (let k = 0; k < scene.count; ++k) {
    const at = onCanvas(k, view), q = ((at.u - u) ** 2 + (at.v - v) ** 2) / (at.pixels * at.pixels);
    if (q >= 1) continue;
    const z = at.z + at.r * Math.sqrt(1 - q);
    if (z > front) [found, front] = [k, z];
  }
  return found;
}

// Letters or numbers on the spheres in front, for those who cannot distinguish the colours; a ring on the chosen one.
function drawLabels(view) {
  const paper = labels.getContext("2d"), ratio = window.devicePixelRatio || 1;
  paper.clearRect(0, 0, labels.width, labels.height);
  paper.textAlign = "center";
  paper.textBaseline = "middle";
  const q = quantities[state.colour];
  for (let k = 0; k < scene.count; ++k) {
    const i = scene.owner[k];
    if (i !== state.chosen && (!state.names || scene.count > 3000)) continue;
    const at = onCanvas(k, view);
    if (i === state.chosen) {
      paper.lineWidth = 3 * ratio;
      paper.strokeStyle = "#d0006f";
      paper.beginPath();
      paper.arc(at.u, at.v, at.pixels + 2 * ratio, 0, 7);
      paper.stroke();
    }
    if (!state.names || at.pixels < 6 * ratio || (dim > 2 && instanceAt(at.u, at.v, view) !== k)) continue;
    paper.font = `${Math.min(at.pixels, 14 * ratio)}px system-ui, sans-serif`;
    const text = q.classes ? CLASSES[classOf(i)].letter : shownNumber(q.of(i), 3);
    paper.lineWidth = 3 * ratio;
    paper.strokeStyle = "#fff";
    paper.strokeText(text, at.u, at.v);
    paper.fillStyle = "#000";
    paper.fillText(text, at.u, at.v);
  }
}

function describe(i, digits) {
  const x = Array.from({ length: dim }, (_, c) => shownNumber(position[i * dim + c], atEnd() ? digits : 6));
  const lines = [`sphere ${i}` +
    (balanced ? `, ${atEnd() ? "" : "in the end "}${CLASSES[classOf(i)].name}` : "") +
    (network ? `, ${coordination[i]} contacts` : "")];
  lines.push(`position ${x.join("  ")}`, `diameter ${shownNumber(2 * radius(i), digits)}`);
  if (balanced && atEnd()) lines.push(`sum of forces ${shownNumber(load[i], digits)}`);
  for (const q of quantities.slice(described)) lines.push(`${q.name} ${shownNumber(q.of(i), digits)}`);
  return lines;
}
function pointed(event) {
  const ratio = canvas.width / canvas.clientWidth, frame = canvas.getBoundingClientRect();
  const k = instanceAt((event.clientX - frame.left) * ratio, (event.clientY - frame.top) * ratio, viewNow());
  return k < 0 ? -1 : scene.owner[k];
}
function hover(event) {
  const i = pointed(event), frame = canvas.getBoundingClientRect();
  tip.hidden = i < 0;
  if (i < 0) return;
  tip.textContent = describe(i, 6).join("\n");
  tip.style.left = Math.min(event.clientX - frame.left + 14, frame.width - tip.offsetWidth - 4) + "px";
  tip.style.top = Math.min(event.clientY - frame.top + 14, frame.height - tip.offsetHeight - 4) + "px";
}

let drag = null;
canvas.addEventListener("pointerdown", (e) => {
  drag = { x: e.clientX, y: e.clientY, far: 0, moves: dim === 2 || e.shiftKey || e.button === 2 };
  canvas.setPointerCapture(e.pointerId);
});
canvas.addEventListener("pointermove", (e) => {
  if (!drag) return hover(e);
  const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
  drag.far += Math.abs(dx) + Math.abs(dy);
  [drag.x, drag.y] = [e.clientX, e.clientY];
  if (drag.moves) pan(dx, dy);
  else rotate(0.008 * dx, 0.008 * dy);
});
canvas.addEventListener("pointerup", (e) => {
  if (drag && drag.far < 4) choose(pointed(e));
  drag = null;
});
canvas.addEventListener("pointerleave", () => (tip.hidden = true));
canvas.addEventListener("contextmenu", (e) => e.preventDefault());
canvas.addEventListener("wheel", (e) => {
  e.preventDefault();
  zoom(Math.exp(-0.0015 * e.deltaY));
}, { passive: false });
function rotate(across, down) {
  if (dim > 2) camera.turn = product(product(turning(0, down), turning(1, across)), camera.turn);
  redraw(true);
}
function pan(dx, dy) {
  const unit = canvas.width / canvas.clientWidth / viewNow().scale;
  camera.shift = [camera.shift[0] + dx * unit, camera.shift[1] - dy * unit];
  redraw(true);
}
function zoom(factor) {
  camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.2), 200);
  redraw(true);
}
new ResizeObserver(() => renderer && fitCanvas() && draw()).observe(canvas); // at once: the next frame is too late
