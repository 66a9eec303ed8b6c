// States of the crunch: the slider goes from its start to the packing itself, which comes last.
const lastStep = data.steps ? data.steps.length - 1 : 0;
const atEnd = () => state.step === lastStep;
const distance = new Float64Array(n); // of each sphere to where it ends, mean diameters, without the drift of all
let farthest = 0; // of the first state: the scale of its colours

function takeState(k) {
  const s = data.steps[k], end = k === lastStep;
  state.step = k;
  position = end ? endPosition : numbers(s.position, Float32Array);
  growth = end ? 1 : s.growth;
  cell = end ? data.cell : s.cell;
  cube = isCube(cell);
  const way = new Float64Array(n * dim), drift = new Float64Array(dim);
  for (let i = 0; i < n; ++i)
    for (let c = dim - 1; c >= 0; --c) {
      way[i * dim + c] += endPosition[i * dim + c] - position[i * dim + c];
      const m = Math.round(way[i * dim + c] / cell[c][c]);
      for (let q = 0; q <= c; ++q) way[i * dim + q] -= m * cell[c][q];
      drift[c] += way[i * dim + c] / n;
    }
  for (let i = 0; i < n; ++i) {
    let sum = 0;
    for (let c = 0; c < dim; ++c) sum += (way[i * dim + c] - drift[c]) ** 2;
    distance[i] = Math.sqrt(sum) / meanDiameter;
    if (k === 0) farthest = Math.max(farthest, distance[i]);
  }
}

function takeStep(k) {
  if (!data.steps || k < 0 || k > lastStep) return;
  takeState(k);
  showStep();
  if (state.chosen >= 0) choose(state.chosen);
  tip.hidden = true;
  rebuild();
}

// A moment of a packing that grows, from the page around this one: all diameters have one factor.
function showMoment(positions, diameters, rows) {
  position = positions;
  growth = diameters[0] / diameter[0];
  cell = Array.from({ length: dim }, (_, r) => Array.from(rows.slice(r * dim, (r + 1) * dim)));
  cube = isCube(cell);
  rebuild();
}

function makeStepSlider() {
  takeState(0); // for the scale of distances
  takeState(lastStep);
  const box = document.createElement("input"), out = document.createElement("output");
  Object.assign(box, { type: "range", min: 0, max: lastStep, step: 1, value: lastStep, className: "steps" });
  box.addEventListener("input", () => takeStep(+box.value));
  control("Step of the crunch", box, "comma and full stop: one back, one on").after(out);
  [parts.step, parts.stepShown] = [box, out];
  showStep();
}

// The numbers of the step, in words for those who do not see the slider, and its place in the chart.
function showStep() {
  const s = data.steps[state.step], of = data.steps[lastStep].number, place = document.getElementById("step");
  const rows = Object.entries(s.numbers).filter(([, x]) => x !== null);
  place.parentElement.hidden = false;
  place.innerHTML = `<p class="verdict">${s.number} of ${of}: ${s.kind}</p><table>` +
    [["packing fraction", s.packing_fraction], ...rows].map(([name, x], k) =>
      `<tr><td>${name}</td><td>${shownNumber(x, k ? 4 : 9)}</td></tr>`).join("") + "</table>" +
    (network && !atEnd() ? "<p>Forces are shown at the end alone, and classes are those of the end.</p>" : "");
  if (parts.step) {
    parts.step.value = state.step;
    parts.step.setAttribute("aria-valuetext",
      `step ${s.number} of ${of}, ${s.kind}, packing fraction ${shownNumber(s.packing_fraction, 4)}`);
    parts.stepShown.value = `${s.number} of ${of}, packing fraction ${shownNumber(s.packing_fraction, 6)}`;
  }
  const now = document.getElementById("now");
  if (!now) return;
  const [from, each] = now.dataset.scale.split(" ").map(Number), x = from + each * s.number;
  now.setAttribute("d", x < SVG.left ? "" : `M${x} ${SVG.top}V${SVG.height - SVG.bottom}`);
}
