// Builds the page into the package, always the same bytes: `npm ci && npm run build`.
import { build } from "esbuild";
import { gzipSync } from "fflate";
import crypto from "node:crypto";
import fs from "node:fs";

const SITE = new URL("../physexp/analysis/play/site/", import.meta.url);
const read = (path) => fs.readFileSync(new URL(path, import.meta.url));
const write = (name, bytes) => fs.writeFileSync(new URL(name, SITE), bytes);

fs.rmSync(SITE, { recursive: true, force: true });
fs.mkdirSync(SITE);
await build({
  entryPoints: [new URL("src/main.js", import.meta.url).pathname],
  outfile: new URL("main.js", SITE).pathname,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "none", // They are in `licenses.txt`.
  external: ["module"], // MuJoCo asks for it outside browsers.
});
for (const name of ["index.html", "style.css"]) write(name, read(`src/${name}`));
// The compressor is the same JavaScript everywhere; that of node differs between versions and processors.
write("mujoco.wasm.gz", gzipSync(read("node_modules/@mujoco/mujoco/mujoco.wasm"), { level: 9, mtime: 0 }));
const licenses = [
  ["MuJoCo 3.14.0, Copyright DeepMind Technologies Limited (main.js, mujoco.wasm.gz)", "../LICENSE"],
  ["three.js 0.187.0 (main.js)", "node_modules/three/LICENSE"],
];
write("licenses.txt", licenses.map(([title, path]) => `${title}\n\n${read(path)}`).join(`\n${"-".repeat(80)}\n\n`));
// A test compares it with the sources, so that the built page is never an old one.
const sources = ["build.js", "package-lock.json", "package.json", ...fs.readdirSync("src").sort().map((name) => `src/${name}`)];
const hash = crypto.createHash("sha256");
for (const path of sources) hash.update(read(path));
write("sources.sha256", `${hash.digest("hex")}\n`);
