// The package that is tested: the folder js of a build, or the one that JAM_JS names.
import { pathToFileURL } from 'node:url';

const folder = pathToFileURL(`${process.env.JAM_JS}/`);
export const { load, spawn, JamError } = await import(new URL('node.mjs', folder));
export const at = (name) => new URL(name, folder);
