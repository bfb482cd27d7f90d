// Browser or Node: modules of Node are asked for by a name that bundlers for the web do not follow.

export const isNode = typeof process !== "undefined" && Boolean(process.versions?.node);

export const nodeModule = (name) => import(/* @vite-ignore */ /* webpackIgnore: true */ `node:${name}`);
