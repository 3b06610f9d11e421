// Builds the page into the package, always the same bytes: `npm ci && npm run build`.
import { build } from "esbuild";
import { gzipSync } from "fflate";
import crypto from "node:crypto";
import fs from "node:fs";

const SITE = new URL("../physexp/analysis/play/site/", import.meta.url);
const read = (path) => fs.readFileSync(new URL(path, import.meta.url));
const write = (name, bytes) => fs.writeFileSync(new URL(name, SITE), bytes);

fs.rmSync(SITE, { recursive: true, force: true });
fs.mkdirSync(new URL("study/", SITE), { recursive: true });
await build({
  entryPoints: { main: "src/main.js", "study/study": "src/study.js" },
  outdir: SITE.pathname,
  absWorkingDir: new URL(".", import.meta.url).pathname,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "none", // They are in `licenses.txt`.
  external: ["module", "./main.js"], // MuJoCo asks for the first outside browsers; the study has the player in its folder.
});
for (const name of ["index.html", "style.css"]) write(name, read(`src/${name}`));
const study = { "study.html": "index.html", "study.json": "study.json", "study_data.json": "dataset_description.json" };
for (const [name, copy] of Object.entries(study)) write(`study/${copy}`, read(`src/${name}`));
// The compressor is the same JavaScript everywhere; that of node differs between versions and processors.
write("mujoco.wasm.gz", gzipSync(read("node_modules/@mujoco/mujoco/mujoco.wasm"), { level: 9, mtime: 0 }));
const licenses = [
  ["MuJoCo 3.14.0, Copyright DeepMind Technologies Limited (main.js, mujoco.wasm.gz)", "../LICENSE"],
  ["three.js 0.187.0 (main.js)", "node_modules/three/LICENSE"],
  ["jsPsych 8.3.0 and its plugins (study.js)", "src/jspsych-license.txt"],
  ["auto-bind 4.0.0, in jsPsych", "node_modules/auto-bind/license"],
  ["random-words 1.3.0, in jsPsych", "node_modules/random-words/LICENSE"],
  ["seedrandom 3.0.5, in jsPsych", "node_modules/seedrandom/README.md"],
];
const license = (path) => String(read(path)).split(/^LICENSE.*\n-+\n/m).at(-1); // One is the end of a README.
write("licenses.txt", licenses.map(([title, path]) => `${title}\n\n${license(path)}`).join(`\n${"-".repeat(80)}\n\n`));
// A test compares it with the sources, so that the built page is never an old one.
const sources = ["build.js", "package-lock.json", "package.json", ...fs.readdirSync("src").sort().map((name) => `src/${name}`)];
const hash = crypto.createHash("sha256");
for (const path of sources) hash.update(read(path));
write("sources.sha256", `${hash.digest("hex")}\n`);
