// What the page needs of a browser, the first versions that have it, and how to see it. The guide's table has these rows.
const wasm = (...code) => typeof WebAssembly === 'object' && WebAssembly.validate(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, ...code));

export const NEEDS = [
  // () -> v128: i32.const 0, i8x16.splat
  ['WebAssembly with vectors', 'Chrome 91, Firefox 89, Safari 16.4',
    () => wasm(1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11)],
  // () -> (): try, catch_all
  ['WebAssembly with exceptions', 'Chrome 95, Firefox 100, Safari 15.2',
    () => wasm(1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11)],
  ['64-bit integers of WebAssembly (BigInt)', 'Chrome 85, Firefox 78, Safari 15', () => typeof BigInt64Array === 'function'],
  ['unpacking (DecompressionStream)', 'Chrome 80, Firefox 113, Safari 16.4', () => typeof DecompressionStream === 'function'],
  ['workers made of text', 'Chrome 20, Firefox 10, Safari 6', () => typeof Worker === 'function' && typeof Blob === 'function'],
];
export const missing = () => NEEDS.filter(([, , has]) => !has());
