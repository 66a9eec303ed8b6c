// What the browser keeps over a reload: choices and results in the local storage, the last packing in its database.
const KEY = 'libjam-lab', STORE = 'packings';

function storage() {
  try {
    return window.localStorage;
  } catch {
    return null; // the browser refuses: canKeep() tells
  }
}
export function canKeep() {
  try {
    storage().setItem(`${KEY}-test`, '1');
    storage().removeItem(`${KEY}-test`);
    return typeof indexedDB !== 'undefined';
  } catch {
    return false;
  }
}
export function keep(name, value) {
  try {
    storage().setItem(`${KEY}-${name}`, JSON.stringify(value));
  } catch {
    return false; // full or refused
  }
  return true;
}
export function keptValue(name, otherwise) {
  try {
    return JSON.parse(storage().getItem(`${KEY}-${name}`)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

function database() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(KEY, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
async function asked(mode, work) {
  const db = await database();
  try {
    return await new Promise((resolve, reject) => {
      const request = work(db.transaction(STORE, mode).objectStore(STORE));
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    });
  } finally {
    db.close();
  }
}
export const keepPacking = (bytes, about) => asked('readwrite', (store) => store.put({ bytes, about }, 'last'));
export const keptPacking = () => asked('readonly', (store) => store.get('last'));
export async function forgetAll() {
  for (const name of Object.keys(storage() ?? {})) if (name.startsWith(KEY)) storage().removeItem(name);
  await asked('readwrite', (store) => store.clear());
}
