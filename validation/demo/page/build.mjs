// SPDX-License-Identifier: GPL-3.0-or-later
// Builds dist/index.html, the whole page in one file, and dist/requests.json, what an offline copy has to hold.
import { build } from "esbuild";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const dist = path.join(here, "dist");
const require = createRequire(import.meta.url);

/** The faces of KaTeX that the equations of `explain` use; the others would only make the page heavier. */
const KATEX_FACES = ["KaTeX_Main-Regular", "KaTeX_Math-Italic", "KaTeX_Size1-Regular", "KaTeX_Size2-Regular",
  "KaTeX_Size3-Regular", "KaTeX_Size4-Regular"];
/** Whose code or fonts the page holds: their notices go with it. */
const BUNDLED = ["three", "uplot", "katex"];

async function script() {
  const result = await build({
    entryPoints: [path.join(here, "main.ts")],
    bundle: true, minify: true, write: false, format: "iife", target: "es2022", legalComments: "none",
  });
  return result.outputFiles[0].text;
}

async function katexStyle() {
  const folder = path.dirname(require.resolve("katex/dist/katex.min.css"));
  const css = await readFile(path.join(folder, "katex.min.css"), "utf8");
  const faces = await Promise.all((css.match(/@font-face\{[^}]*\}/g) ?? []).map(async (face) => {
    const file = /fonts\/([\w-]+)\.woff2/.exec(face)?.[1];
    if (!file || !KATEX_FACES.includes(file)) return "";
    const font = await readFile(path.join(folder, "fonts", `${file}.woff2`));
    return face.replace(/src:[^;}]*/, `src:url(data:font/woff2;base64,${font.toString("base64")}) format("woff2")`);
  }));
  return faces.join("") + css.replace(/@font-face\{[^}]*\}/g, "");
}

async function style() {
  const uplot = await readFile(require.resolve("uplot/dist/uPlot.min.css"), "utf8");
  const page = await build({
    entryPoints: [path.join(here, "page.css")], bundle: true, minify: true, write: false, target: "es2022",
  });
  return [await katexStyle(), uplot, page.outputFiles[0].text].join("\n");
}

async function notices() {
  const texts = await Promise.all(BUNDLED.map(async (name) => {
    const folder = path.join(here, "node_modules", name);
    const file = (await readdir(folder)).find((entry) => /^licen[cs]e/i.test(entry));
    return `${name}\n\n${(await readFile(path.join(folder, file), "utf8")).trim()}`;
  }));
  return texts.join("\n\n----\n\n").replace(/&/g, "&amp;").replace(/</g, "&lt;");
}

/** Runs the page's own code, so that the keys of the answers are those that the page will look up. */
async function requests() {
  const result = await build({
    entryPoints: [path.join(here, "offline_scenes.ts")], bundle: true, write: false, format: "esm", target: "es2022",
  });
  const file = path.join(dist, "offline_scenes.mjs");
  await writeFile(file, result.outputFiles[0].text);
  const { offlineScenes } = await import(pathToFileURL(file).href);
  return JSON.stringify({ scenes: offlineScenes() }, null, 1) + "\n";
}

await mkdir(dist, { recursive: true });
const template = await readFile(path.join(here, "index.html"), "utf8");
const parts = { "/*STYLE*/": await style(), "/*SCRIPT*/": await script(), "<!--NOTICES-->": await notices() };
let page = template;
for (const [mark, text] of Object.entries(parts)) page = page.replace(mark, () => text);
await writeFile(path.join(dist, "index.html"), page);
await writeFile(path.join(dist, "requests.json"), await requests());
console.log(`dist/index.html ${(Buffer.byteLength(page) / 1e3).toFixed(0)} kB`);
