// The start of the page: tabs, what was kept, and the library.
import { TEXT } from './texts.mjs';
import { startEngine } from './engine.mjs';
import { canKeep, forgetAll, keep, keptPacking, keptValue } from './keep.mjs';
import { adopt, failed, fault, session, tell } from './session.mjs';
import { learnPanel, makePanel, restoreForm } from './panel_make.mjs';
import { checkPanel, provePanel, watchDrops } from './panel_check.mjs';
import { lookPanel, savePanel, showClass } from './panel_look.mjs';
import { byId, make } from './parts.mjs';

const PANELS = { learn: () => learnPanel(openTab), make: makePanel, check: checkPanel, prove: provePanel, look: lookPanel, save: savePanel };

function openTab(name) {
  for (const key of Object.keys(PANELS)) {
    const on = key === name, tab = byId(`tab-${key}`);
    tab.setAttribute('aria-selected', String(on));
    tab.tabIndex = on ? 0 : -1;
    byId(`panel-${key}`).hidden = !on;
  }
  keep('tab', name);
}
function makeTabs() {
  const keys = Object.keys(PANELS);
  for (const key of keys) {
    const tab = make('button', { id: `tab-${key}`, type: 'button', role: 'tab', 'aria-controls': `panel-${key}`, textContent: TEXT.tabs[key] });
    tab.addEventListener('click', () => openTab(key));
    tab.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = keys[(keys.indexOf(key) + step + keys.length) % keys.length];
      openTab(next);
      byId(`tab-${next}`).focus();
    });
    byId('tabs').append(tab);
    byId('panels').append(Object.assign(PANELS[key](), { id: `panel-${key}` }));
    byId(`panel-${key}`).setAttribute('role', 'tabpanel');
    byId(`panel-${key}`).setAttribute('aria-labelledby', `tab-${key}`);
  }
}

async function bringBack() {
  if (!canKeep()) return false;
  const kept = await keptPacking();
  if (!kept) return false;
  const packing = await session.jam.readCheckpoint(kept.bytes);
  await adopt(packing, kept.about);
  tell(kept.about.unfinished ? TEXT.half(packing.n, packing.dim) : TEXT.back(packing.n, packing.dim));
  return true;
}

async function startLab() {
  makeTabs();
  restoreForm();
  openTab(keptValue('tab', 'learn'));
  showClass();
  byId('stop').textContent = TEXT.stop;
  byId('stop').addEventListener('click', () => session.jam.stop());
  byId('kept').textContent = canKeep() ? TEXT.kept : TEXT.notKept;
  byId('forget').textContent = TEXT.forget;
  byId('forget').addEventListener('click', async () => {
    await forgetAll();
    tell(TEXT.forgotten);
  });
  watchDrops(openTab);
  window.addEventListener('beforeunload', (event) => session.running && event.preventDefault());
  if (!document.createElement('canvas').getContext('webgl2')) fault(TEXT.noView);
  tell(TEXT.starting);
  try {
    session.jam = await startEngine();
    if (!(await bringBack())) tell(TEXT.ready(session.jam.version));
  } catch (error) {
    tell('');
    failed(error);
  }
  document.documentElement.dataset.ready = 'yes';
}
startLab();
