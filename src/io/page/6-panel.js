// Controls, legend, certificate and keys.
const controls = document.getElementById("controls");
const NAMED = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const escaped = (text) => text.replace(/[&<>"]/g, (c) => NAMED[c]);

function control(label, element, title) {
  const row = document.createElement("label");
  row.title = title || "";
  row.append(label, element);
  controls.append(row);
  return element;
}
function choice(label, names, value, use, title) {
  const box = document.createElement("select");
  names.forEach((name, k) => box.add(new Option(name, k, k === value, k === value)));
  box.addEventListener("change", () => (use(+box.value), rebuild()));
  return control(label, box, title);
}
function tick(label, key, title) {
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = !!state[key];
  box.name = key;
  box.addEventListener("change", () => ((state[key] = box.checked), rebuild()));
  return control(label, box, title);
}
function slider(label, low, high, value, use, title) {
  const box = document.createElement("input"), out = document.createElement("output");
  Object.assign(box, { type: "range", min: low, max: high, step: (high - low) / 200, value });
  box.addEventListener("input", () => ((out.value = shownNumber(+box.value, 2)), use(+box.value), rebuild()));
  out.value = shownNumber(value, 2);
  control(label, box, title).after(out);
  return box;
}

const parts = {};
function makeControls() {
  if (data.steps) makeStepSlider();
  parts.colour = choice("Colour", quantities.map((q) => q.name), 0, (k) => (state.colour = k), "C: the next one");
  parts.size = slider("Spheres", 0, 1, state.size, (x) => (state.size = x), "size of the spheres; 0 hides them");
  if (network) {
    const shown = balanced ? "contact forces" : "contacts";
    parts.forces = tick(balanced ? "Forces" : "Contacts", "forces",
      `F: ${shown} as cylinders; spheres in space shrink to show them`);
    parts.forces.addEventListener("change", () => {
      if (dim === 2 || (state.forces && state.size < 1)) return;
      parts.size.value = state.forces ? 0.35 : 1;
      parts.size.dispatchEvent(new Event("input"));
    });
    slider("Width", 0.2, 3, 1, (x) => (state.width = x), "width of the cylinders");
  }
  if (balanced) {
    parts.forceColours = tick("coloured", "forceColours",
      "contacts from light (weak) to dark (three mean forces and more)");
    slider("Forces above", 0, 4, 0, (x) => (state.threshold = x), "in units of the mean force");
    for (const [k, one] of CLASSES.entries()) {
      const box = document.createElement("input");
      Object.assign(box, { type: "checkbox", checked: true });
      box.addEventListener("change", () => (state.hide[box.checked ? "delete" : "add"](k), rebuild()));
      control(`${one.name}s`.replace("stables", "stable"), box, `show spheres of this class (${one.letter})`);
    }
  }
  if (canFindGaps)
    parts.gap = slider("Gaps below", 0, GAPS_TO, 0, (x) => (state.gap = x),
      "thin lines: pairs of spheres that do not touch, by their gap");
  makeMotionControls();
  if (dim === 3) {
    choice("Slice", ["none", "x", "y", "z"], 0, (k) => (state.slab = k - 1), "only spheres with centres in a slab");
    slider("at", 0, 1, state.slabAt, (x) => (state.slabAt = x), "middle of the slab, in edges of the cell");
    slider("thick", 0.02, 1, state.slabThick, (x) => (state.slabThick = x), "in edges of the cell");
  }
  if (dim > 3) makeSlices();
  parts.images = tick("Periodic images", "images", "I: copies beyond the cell, paler");
  tick("Cell", "box", "edges of the cell, or the round wall");
  parts.names = tick("Labels", "names", "L: letters or numbers on the spheres (up to 3000)");
  for (const [name, use] of [["Reset", () => (home(), redraw())], ["Save PNG", savePng], ["Save SVG", saveSvg]]) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = name;
    button.addEventListener("click", use);
    controls.append(button);
  }
}

// d > 3: which coordinates are on the screen, and where the slice lies along the others.
function makeSlices() {
  const places = document.createElement("span");
  const hidden = () => {
    places.replaceChildren();
    for (let c = 0; c < dim; ++c) {
      if (state.axes.includes(c)) continue;
      slider(`x${c + 1} =`, 0, cell[c][c], state.hidden[c], (x) => (state.hidden[c] = x), "where the slice lies");
      places.append(...[...controls.children].slice(-1));
    }
  };
  for (let k = 0; k < 3; ++k) {
    const box = choice(["across", "up", "towards you"][k], cell.map((_, c) => `x${c + 1}`), k, (c) => {
      const other = state.axes.indexOf(c);
      if (other >= 0) state.axes[other] = state.axes[k];
      state.axes[k] = c;
      parts.axes.forEach((b, m) => (b.value = state.axes[m]));
      hidden();
    }, "the coordinate on this axis of the screen");
    (parts.axes = parts.axes || []).push(box);
  }
  tick("Project all", "whole", "draw every sphere at its full radius instead of the slice");
  controls.append(places);
  hidden();
}

function showLegend() {
  const { q, low, high, values } = scene.tint, place = document.getElementById("legend");
  if (q.classes) {
    const counts = [0, 0, 0];
    for (const k of values) ++counts[k];
    place.innerHTML = CLASSES.map((c, k) => `<span><i style="background:rgb(${c.colour})"></i>${counts[k]} ${c.name}` +
      `${k && counts[k] !== 1 ? "s" : ""} (${c.letter})</span>`).join("");
  } else {
    const steps = Array.from({ length: 9 }, (_, k) => `rgb(${viridis(k / 8)})`).join(",");
    place.innerHTML = `<span>${escaped(q.name)} ${shownNumber(low, 4)}` +
      `<b style="background:linear-gradient(90deg,${steps})"></b>${shownNumber(high, 4)}</span>`;
  }
  if (balanced && state.forces && state.forceColours && atEnd()) {
    const steps = Array.from({ length: 9 }, (_, k) => `rgb(${tone(FORCES, k / 8)})`).join(",");
    place.innerHTML +=
      `<span>force 0<b style="background:linear-gradient(90deg,${steps})"></b>${STRONG} and more</span>`;
  }
  if (dim > 3 && !state.whole) place.innerHTML += `<span>${scene.count} of ${n} spheres cut the slice</span>`;
}

function choose(i) {
  state.chosen = i;
  const place = document.getElementById("chosen");
  let out = "<p>None. Click a sphere, or press N.</p>";
  if (i >= 0) out = describe(i, 12).map((s) => `<p>${escaped(s)}</p>`).join("");
  if (i >= 0 && network && atEnd() && coordination[i])
    out += `<table><tr><th>touches</th>${balanced ? "<th>force</th>" : ""}<th>gap</th></tr>` + contacts(i).map((c) =>
      `<tr><td>${c.other < 0 ? `wall ${-1 - c.other}` : c.other}</td>` +
      (balanced ? `<td>${shownNumber(c.force)}</td>` : "") +
      `<td>${shownNumber(c.gap, 3)}</td></tr>`).join("") + "</table>";
  place.innerHTML = out;
  redraw();
}

function showReport() {
  const place = document.getElementById("certificate"), r = data.report;
  document.getElementById("title").textContent = document.title = data.title || `${n} spheres in d = ${dim}`;
  document.getElementById("about").textContent =
    `N = ${n}, d = ${dim}, packing fraction ${shownNumber(data.packing_fraction, 12)}, seed ${data.seed}`;
  if (!r) return void (place.innerHTML = `<p>${escaped(data.network)}</p>`);
  const rows = Object.entries(r.numbers).map(([name, x]) => `<tr><td>${name}</td><td>${shownNumber(x, 12)}</td></tr>`);
  const verdict = `${r.jammed ? "Collectively jammed" : "Not jammed"} (${r.stop_reason})` +
    (r.proof ? `; ${r.proof}` : "");
  place.innerHTML = `<p class="verdict">${verdict}</p><table>${rows.join("")}</table>`;
}

const KEYS = { ArrowLeft: () => rotate(-0.1, 0), ArrowRight: () => rotate(0.1, 0), ArrowUp: () => rotate(0, -0.1),
  ArrowDown: () => rotate(0, 0.1), "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15),
  n: () => choose((state.chosen + 1) % n), p: () => choose((Math.max(state.chosen, 0) + n - 1) % n),
  f: () => parts.forces && parts.forces.click(), l: () => parts.names.click(), i: () => parts.images.click(),
  c: () => {
    parts.colour.value = state.colour = (state.colour + 1) % quantities.length;
    rebuild();
  },
  g: () => {
    if (!parts.gap) return;
    parts.gap.value = +parts.gap.value > 0 ? 0 : 0.05;
    parts.gap.dispatchEvent(new Event("input"));
  },
  m: () => parts.motion && ((parts.motion.value = (+parts.motion.value + 1) % (motions.length + 1)),
    parts.motion.dispatchEvent(new Event("change"))),
  " ": () => parts.play && parts.play.click(),
  ",": () => takeStep(state.step - 1), ".": () => takeStep(state.step + 1),
  Escape: () => choose(-1), r: () => (home(), redraw()) };
const PANS = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] };
canvas.addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const pans = PANS[e.key] && (dim === 2 || e.shiftKey), use = pans ? () => pan(...PANS[e.key]) : KEYS[e.key];
  if (!use) return;
  e.preventDefault();
  use();
});

function startPage() {
  document.body.classList.toggle("small", data.small);
  document.getElementById("keys").textContent =
    "With the picture in focus: arrows turn (with Shift: move), + and - zoom, " +
    "N and P choose the next and the previous sphere, C colour, F forces" + (canFindGaps ? ", G small gaps" : "") +
    ", I images, L labels, R reset, Esc none" +
    (motions.length ? ", M the next motion, space starts and stops it" : "") +
    (data.steps ? ", comma and full stop go one step of the crunch back and on." : ".");
  showReport();
  showCharts();
  if (data.steps) showStep();
  choose(-1);
  if (!renderer) {
    const problem = document.getElementById("problem");
    problem.hidden = false;
    problem.textContent = "This browser has no WebGL2, so the picture cannot be drawn. The numbers are beside it.";
    return;
  }
  canvas.setAttribute("aria-label", `${n} spheres in d = ${dim}` + (network ? `, ${contactCount} ${balanced ? "contact forces" : "contacts"}` : "") +
    ". Keys: arrows turn, N chooses the next sphere, L shows labels.");
  home();
  makeControls();
  rebuild();
}
startPage();
