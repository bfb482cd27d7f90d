import base from "./vite.config.ts";
const fake = { name: "fake", enforce: "pre", resolveId(id) { if (/sinew\/index\.js$/.test(id)) return "/work/wt-play29/web/.fake.js"; } };
export default { ...base, plugins: [...base.plugins, fake], worker: { ...base.worker, plugins: () => [fake] }, server: { ...base.server, fs: { strict: false } } };
