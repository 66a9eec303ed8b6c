// The picture: the page of the packing that the library writes, in a frame. While a packing grows its spheres move.
import { pageOf } from './engine.mjs';
import { TEXT } from './texts.mjs';

const frame = () => document.getElementById('view');
let shownText = '';

/** Resolves when the frame has loaded. */
export function showPage(text) {
  shownText = text;
  const place = frame();
  place.title = TEXT.view;
  return new Promise((resolve) => {
    place.onload = () => resolve(place.contentWindow);
    place.srcdoc = text;
  });
}
export async function showPacking(packing, { title = '', small = false, motion = null } = {}) {
  const page = await showPage(await pageOf(packing, title, small, motion));
  if (motion) page.startMotion(0);
}
/** Positions, diameters and cell of a moment, in the page that shows the start. */
export function showMoment({ positions, diameters, cell }) {
  const page = frame().contentWindow;
  if (page && page.showMoment) page.showMoment(positions, diameters, cell);
}
export const lastPage = () => shownText;
