// Distributions as SVG, each with its axes and a sentence for readers of the screen.
const SVG = { width: 368, height: 190, left: 52, right: 10, top: 20, bottom: 34 };

// points: [x, y]; log: which axes are logarithmic; bars: y from 0.
function chart(name, xName, yName, points, { logX = false, logY = false, bars = false, mark: pointer = null } = {}) {
  const fx = logX ? Math.log10 : (x) => x, fy = logY ? Math.log10 : (y) => y;
  const shown = points.map(([x, y]) => [fx(x), fy(y)]).filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y));
  if (shown.length < 2) return "";
  let [x0, x1] = [Math.min(...shown.map((p) => p[0])), Math.max(...shown.map((p) => p[0]))];
  let [y0, y1] = [bars ? 0 : Math.min(...shown.map((p) => p[1])), Math.max(...shown.map((p) => p[1]))];
  if (bars) [x0, x1] = [x0 - 0.6, x1 + 0.6];
  if (x0 === x1) x1 = x0 + 1;
  if (y0 === y1) y1 = y0 + 1;
  const X = (x) => SVG.left + ((x - x0) / (x1 - x0)) * (SVG.width - SVG.left - SVG.right);
  const Y = (y) => SVG.height - SVG.bottom - ((y - y0) / (y1 - y0)) * (SVG.height - SVG.top - SVG.bottom);
  const floor = SVG.height - SVG.bottom;
  let out = `<svg viewBox="0 0 ${SVG.width} ${SVG.height}" role="img" aria-label="${name}: ${yName} against ${xName}">`;
  out += `<text class="name" x="${SVG.left}" y="12">${name}</text>`;
  for (const t of ticks(x0, x1, logX))
    out += `<path d="M${X(t)} ${SVG.top}V${floor + 4}" stroke="var(--grid)"/>` +
      `<text x="${X(t)}" y="${floor + 15}" text-anchor="middle">${mark(t, logX)}</text>`;
  for (const t of ticks(y0, y1, logY))
    out += `<path d="M${SVG.left - 4} ${Y(t)}H${SVG.width - SVG.right}" stroke="var(--grid)"/>` +
      `<text x="${SVG.left - 7}" y="${Y(t) + 4}" text-anchor="end">${mark(t, logY)}</text>`;
  if (bars) {
    const wide = Math.min(28, 0.8 * (X(1) - X(0)));
    for (const [x, y] of shown)
      out += `<rect x="${X(x) - wide / 2}" y="${Y(y)}" width="${wide}" height="${floor - Y(y)}" fill="#0072b2"/>`;
  } else {
    const line = shown.map(([x, y], k) => `${k ? "L" : "M"}${X(x).toFixed(1)} ${Y(y).toFixed(1)}`).join("");
    out += `<path d="${line}" fill="none" stroke="#0072b2" stroke-width="1.8"/>`;
  }
  if (pointer)
    out += `<path id="${pointer}" data-scale="${X(0)} ${X(1) - X(0)}" d="" stroke="#d0006f" stroke-width="1.5"/>`;
  out += `<path d="M${SVG.left} ${SVG.top}V${floor}H${SVG.width - SVG.right}" fill="none" stroke="var(--soft)"/>`;
  const middle = [0.5 * (SVG.left + SVG.width - SVG.right), 0.5 * (SVG.top + floor)];
  out += `<text x="${middle[0]}" y="${SVG.height - 4}" text-anchor="middle">${xName}</text>`;
  out += `<text transform="translate(11 ${middle[1]}) rotate(-90)" text-anchor="middle">${yName}</text>`;
  return out + "</svg>";
}
const mark = (t, log) => (log ? (t === 0 ? "1" : `1e${t}`) : String(+t.toPrecision(4)));
function ticks(low, high, log) {
  if (log && high - low >= 1) {
    const step = Math.max(1, Math.ceil((high - low) / 5)), list = [];
    for (let t = Math.ceil(low / step) * step; t <= high; t += step) list.push(t);
    return list;
  }
  const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= raw), list = [];
  for (let t = Math.ceil(low / step) * step; t <= high + 1e-9 * step; t += step) list.push(log ? +t.toFixed(2) : t);
  return list;
}

// The share of values up to each of them, thinned to the points that a chart can show.
function cumulative(values, total = values.length) {
  const sorted = Float64Array.from(values).filter((x) => x > 0).sort(), points = [];
  let last = -Infinity;
  for (let k = 0; k < sorted.length; ++k) {
    const at = Math.log(sorted[k]);
    if (at - last < 0.03 && k < sorted.length - 1) continue;
    last = at;
    points.push([sorted[k], (k + 1) / total]);
  }
  return points;
}

function showCharts() {
  const place = document.getElementById("charts"), counts = new Map();
  let out = "";
  if (network && contactCount) {
    for (const z of coordination) counts.set(z, (counts.get(z) || 0) + 1);
    if (balanced)
      out += chart("Contact forces", "force over the mean", "share up to it", cumulative(network.force),
        { logX: true, logY: true });
    const near = closed.some((c) => c) ? "pairs and walls" : "pairs";
    out += chart(`Gaps of ${near} that do not touch`, "gap in diameters", "pairs up to it, a sphere",
      data.gaps.map(([gap, count]) => [gap, count / n]), { logX: true, logY: true });
    out += chart("Coordination", "contacts of a sphere", "spheres", [...counts].sort((a, b) => a[0] - b[0]),
      { bars: true });
  }
  if (data.history.length > 1)
    out += chart("Way to the jamming point", "step", "growth of the diameters", data.history.map((g, k) => [k + 1, g]),
      { logY: true, mark: data.steps ? "now" : null });
  if (new Set(diameter).size > 2)
    out += chart("Diameters", "diameter", "share up to it", cumulative(diameter));
  place.innerHTML = out || "<p>They appear after a crunch.</p>";
}
