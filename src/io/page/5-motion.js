// A motion of the spheres, such as a mode, as an oscillation about the packing.
const oscillation = { phase: 0, amplitude: 0.3, running: false, began: 0 };
const PERIOD = 1600; // ms

// The largest displacement in mean diameters, so that the amplitude is one too.
const largest = motions.map(({ rows }) => {
  let most = 0;
  for (let i = 0; i < n; ++i) most = Math.max(most, Math.hypot(...cell.map((_, c) => rows[c * n + i])));
  return most / meanDiameter || 1;
});

function swing(now) {
  if (!oscillation.running) return;
  const angle = (2 * Math.PI * (now - oscillation.began)) / PERIOD;
  setPhase(Math.sin(angle));
  requestAnimationFrame(swing);
}
function setPhase(s) {
  const on = state.motion >= 0 && atEnd();
  oscillation.phase = on ? (s * oscillation.amplitude) / largest[state.motion] : 0;
  redraw(true);
}
function play(on) {
  oscillation.running = on && state.motion >= 0;
  oscillation.began = performance.now();
  if (parts.play) {
    parts.play.textContent = oscillation.running ? "Stop" : "Animate";
    parts.play.setAttribute("aria-pressed", String(oscillation.running));
  }
  if (oscillation.running) requestAnimationFrame(swing);
  else setPhase(0);
}
// Shows a motion, from the page around this one.
function startMotion(k) {
  if (!parts.motion) return;
  parts.motion.value = k + 1;
  parts.motion.dispatchEvent(new Event("change"));
}
function makeMotionControls() {
  if (!motions.length) return;
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  parts.motion = choice("Motion", ["none", ...motions.map((m) => m.name)], 0, (k) => {
    state.motion = k - 1;
    play(state.motion >= 0 && !still.matches);
  }, "displacements that come with the packing, such as modes");
  slider("Amplitude", 0.02, 1, oscillation.amplitude, (x) => (oscillation.amplitude = x),
    "largest displacement in mean diameters");
  parts.play = document.createElement("button");
  parts.play.type = "button";
  parts.play.addEventListener("click", () => play(!oscillation.running));
  controls.append(parts.play);
  play(false);
}
