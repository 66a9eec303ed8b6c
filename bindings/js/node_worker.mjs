import { parentPort } from 'node:worker_threads';
import { serve } from './serve.mjs';

serve({ postMessage: (message, buffers) => parentPort.postMessage(message, buffers), onMessage: (work) => parentPort.on('message', work) });
