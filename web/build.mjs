// node build.mjs WORK TARGET: bundles src/ into TARGET: index.html, viewer.css, viewer.js. WORK has
// the packages.

import { copyFileSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const work = path.resolve(process.argv[2] ?? here);
const target = path.resolve(process.argv[3] ?? path.join(here, "dist"));
const esbuild = createRequire(path.join(work, "package.json"))("esbuild");

mkdirSync(target, { recursive: true });
await esbuild.build({
  entryPoints: ["js", "css"].map((kind) => ({ in: path.join(here, kind === "js" ? "src/main.js" : "src/viewer.css"), out: "viewer" })),
  outdir: target,
  bundle: true,
  minify: true,
  pure: ["console.warn"], // advice of three.js to programmers
  legalComments: "inline",
  format: "iife",
  target: ["chrome100", "firefox100", "safari15"],
  charset: "utf8",
  nodePaths: [path.join(work, "node_modules")],
  // The script stands within an element of the report: nothing in it may end that element.
  banner: { js: "/* QuasiMC; with three.js, copyright its authors, MIT licence. */" },
  logLevel: "warning",
});
copyFileSync(path.join(here, "src/index.html"), path.join(target, "index.html"));
