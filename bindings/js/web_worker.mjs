import { serve } from './serve.mjs';

serve({ postMessage: (message, buffers) => postMessage(message, buffers), onMessage: (work) => { onmessage = (event) => work(event.data); } });
