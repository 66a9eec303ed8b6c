// The checker in a worker: bytes of a proof file come in, the answer goes out.
import { checkProof } from './check.mjs';

onmessage = async ({ data }) => postMessage(await checkProof(data));
