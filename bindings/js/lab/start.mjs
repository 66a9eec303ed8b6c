// The one script of the page that is not packed: it says what the browser lacks, or starts the others.
import { missing } from './needs.mjs';
import { unpacked } from './unpack.mjs';

async function start() {
  const told = (id, text) => { document.getElementById(id).textContent = text; };
  const lacks = missing().map(([what, since]) => `${what} (${since})`);
  if (!lacks.length) {
    document.body.append(Object.assign(document.createElement('script'), { textContent: await unpacked('scripts').text() }));
    return;
  }
  told('status', '');
  told('error', `This browser lacks: ${lacks.join('; ')}. Use one of these versions or newer, or the program jam-pack.`);
  document.getElementById('error').hidden = false;
  document.documentElement.dataset.ready = 'yes';
}
start();
