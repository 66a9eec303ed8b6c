// The picture as a file, with a caption of its numbers: PNG as it is on the screen, SVG of circles and lines.
const CAPTIONED = ["contacts above isostatic", "rattlers", "force imbalance over mean force"];
function caption() {
  const r = data.report, { q, low, high } = scene.tint, lines = [];
  lines.push(document.title);
  lines.push(`N = ${n}, d = ${dim}, packing fraction ${shownNumber(data.packing_fraction, 12)}, seed ${data.seed}`);
  const known = r ? CAPTIONED.filter((name) => r.numbers[name] !== null) : [];
  const verdict = r && r.jammed ? "collectively jammed" : "not jammed";
  if (r) lines.push(`${verdict}, ${network ? contactCount : "unknown"} contacts`);
  if (!r && network) lines.push(data.network);
  if (known.length) lines.push(known.map((name) => `${name} ${shownNumber(r.numbers[name], 3)}`).join(", "));
  const classes = [0, 1, 2].map((k) => scene.tint.values.filter((x) => x === k).length);
  lines.push(q.classes ? CLASSES.map((c, k) => `${classes[k]} ${c.name} (${["blue", "orange", "grey"][k]})`).join(", ")
    : `colour: ${q.name} from ${shownNumber(low, 4)} (dark) to ${shownNumber(high, 4)} (light)`);
  if (network && !balanced && state.forces) lines.push("lines: contacts");
  if (balanced && state.forces && atEnd()) lines.push("lines: contacts, as wide as their forces" +
    (state.forceColours ? `, from light to dark at ${STRONG} mean forces` : "") +
    (state.threshold > 0 ? `, those above ${shownNumber(state.threshold, 3)} mean forces` : ""));
  if (state.gap > 0) lines.push(`thin black lines: pairs with gaps below ${shownNumber(state.gap, 3)}`);
  return lines;
}

function save(name, href) {
  const link = document.createElement("a");
  link.href = href;
  link.download = name;
  link.click();
}

const CAPTION = { size: 14, line: 20, margin: 12 };
function picturePng() {
  thin.moving = false;
  fitCanvas();
  renderer.draw(viewNow(), 1, oscillation.phase);
  const ratio = window.devicePixelRatio || 1, lines = caption(), paper = document.createElement("canvas");
  const more = ratio * (lines.length * CAPTION.line + CAPTION.margin);
  [paper.width, paper.height] = [canvas.width, canvas.height + more];
  const pen = paper.getContext("2d");
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, paper.width, paper.height);
  pen.drawImage(canvas, 0, 0);
  pen.drawImage(labels, 0, 0);
  pen.fillStyle = "#1c2430";
  lines.forEach((text, k) => {
    pen.font = `${k ? "" : "600 "}${CAPTION.size * ratio}px system-ui, sans-serif`;
    const left = CAPTION.margin * ratio, down = canvas.height + ratio * CAPTION.line * (k + 1);
    pen.fillText(text, left, down, paper.width - 2 * left);
  });
  return paper.toDataURL("image/png");
}

// From far to near, so that what is in front covers what is behind.
function pictureSvg() {
  const view = viewNow(), parts = [], rgb = (list, k, light) =>
    `rgb(${[0, 1, 2].map((c) => Math.round(list[4 * k + c] * light))})`;
  const near = (z) => (dim === 2 ? 1 : 0.82 + 0.18 * Math.min(Math.max((2 * z) / view.depth + 0.5, 0), 1));
  for (let k = 0; k < scene.count; ++k) {
    const { u, v, z, pixels } = onCanvas(k, view);
    if (u < -pixels || v < -pixels || u > canvas.width + pixels || v > canvas.height + pixels) continue;
    const edge = dim === 2 ? "" : ` stroke="${rgb(scene.colours, k, 0.5)}" stroke-width="0.6"`;
    parts.push([z, `<circle cx="${u.toFixed(2)}" cy="${v.toFixed(2)}" r="${pixels.toFixed(2)}" ` +
      `fill="${rgb(scene.colours, k, near(z))}"${edge}/>`]);
  }
  const flat = (list, k) => {
    const x = turned([list[4 * k], list[4 * k + 1], list[4 * k + 2]]);
    return { u: (0.5 * canvas.width + (x[0] + view.shift[0]) * view.scale).toFixed(2),
      v: (0.5 * canvas.height - (x[1] + view.shift[1]) * view.scale).toFixed(2), z: x[2] };
  };
  for (let k = 0; k < scene.sticks; ++k) {
    const [a, b] = [flat(scene.stick.start, k), flat(scene.stick.stop, k)], z = 0.5 * (a.z + b.z);
    const width = (2 * scene.stick.start[4 * k + 3] * view.scale).toFixed(2);
    parts.push([z + (dim === 2 ? view.depth : 0), `<path d="M${a.u} ${a.v}L${b.u} ${b.v}" ` +
      `stroke="${rgb(scene.stick.tint, k, near(z))}" stroke-width="${width}"/>`]);
  }
  parts.sort((a, b) => a[0] - b[0]);
  const lines = caption(), high = canvas.height + lines.length * CAPTION.line + CAPTION.margin;
  const written = lines.map((text, k) =>
    `<text x="${CAPTION.margin}" y="${canvas.height + CAPTION.line * (k + 1)}" font-family="sans-serif" ` +
    `font-size="${CAPTION.size}"${k ? "" : ' font-weight="600"'}>${escaped(text)}</text>`);
  const parsed = document.createElement("template"); // knows the name space, so that the page holds no address
  parsed.innerHTML = "<svg></svg>";
  return `<svg xmlns="${parsed.content.firstChild.namespaceURI}" viewBox="0 0 ${canvas.width} ${high}" role="img">\n` +
    `<title>${escaped(lines[0])}</title>\n<desc>${escaped(lines.slice(1).join("; "))}</desc>\n` +
    `<rect width="100%" height="100%" fill="#fff"/>\n` +
    `<g stroke-linecap="round">\n${parts.map((p) => p[1]).join("\n")}\n</g>\n` +
    `<rect y="${canvas.height}" width="100%" height="${high - canvas.height}" fill="#fff"/>\n` +
    written.join("\n") + "\n</svg>\n";
}
const savePng = () => save("packing.png", picturePng());
const saveSvg = () => save("packing.svg", URL.createObjectURL(new Blob([pictureSvg()], { type: "image/svg+xml" })));
