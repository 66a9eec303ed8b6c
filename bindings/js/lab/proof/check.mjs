// Checks a proof file of a jammed packing, apart from libjam: the rules, words and answers of jamproof.py.
import { Scene } from './scene.mjs';
import { conclusion } from './theorem.mjs';

/** { status, text, summary }: 0 proved, 1 not proved, 2 cannot be read, 3 trapped but not proved. */
export async function checkProof(bytes) {
  let scene;
  try {
    scene = await Scene.read(bytes);
  } catch (error) {
    return { status: 2, text: `cannot be read: ${error.message}`, summary: "" };
  }
  return conclusion(scene);
}
