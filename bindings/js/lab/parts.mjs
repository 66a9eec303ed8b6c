// Elements of the page, and files that it gives to the reader.
export const byId = (id) => document.getElementById(id);

/** An element by name, properties and children; what begins with aria or data is an attribute. */
export function make(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(properties))
    if (/^(aria|data|role|for)/.test(key)) made.setAttribute(key, value);
    else made[key] = value;
  made.append(...children.filter((child) => child !== null));
  return made;
}
export const button = (text, use, id = '', main = false) =>
  make('button', { type: 'button', textContent: text, onclick: use, id, className: main ? 'main' : '' });
export function field(label, element, hint = '') {
  const row = make('label', { className: 'field' }, make('span', { textContent: label }), element);
  if (hint) row.append(make('small', { textContent: hint }));
  return row;
}
export function choice(id, words, value) {
  const box = make('select', { id });
  for (const [key, text] of Object.entries(words)) box.add(new Option(text, key, key === value, key === value));
  return box;
}
export function table(head, rows) {
  const line = (cells, tag) => make('tr', {}, ...cells.map((text) => make(tag, { textContent: text })));
  return make('table', {}, line(head, 'th'), ...rows.map((row) => line(row, 'td')));
}
export function saveFile(name, data, type = 'application/octet-stream') {
  const link = make('a', { href: URL.createObjectURL(new Blob([data], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
export const shown = (x, digits = 6) => (Number.isInteger(x) ? String(x) : Math.abs(x) >= 1e-3 && Math.abs(x) < 1e6 ? String(+x.toPrecision(digits)) : x.toExponential(2));
