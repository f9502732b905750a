// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the whole page in one file: node build.mjs MODULE VERSION MODELS PAGE NOTICES OUTPUT, the module that has the models, the
// project's version, digests of the sources of models and page, and a text that names what is compiled in.
import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { readFile, readdir, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { storyHtml } from "./story_build.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const require = createRequire(import.meta.url);
const [modulePath, version, modelsDigest, pageDigest, noticesPath, output] = process.argv.slice(2);

/** The faces of KaTeX that the equations of `explain` use; the others would only make the page heavier. */
const KATEX_FACES = ["KaTeX_Main-Regular", "KaTeX_Math-Italic", "KaTeX_Size1-Regular", "KaTeX_Size2-Regular",
  "KaTeX_Size3-Regular", "KaTeX_Size4-Regular"];
/** Whose code or fonts the page holds: their notices go with it. */
const BUNDLED = ["three", "uplot", "katex", "gifenc"];

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
  return [...texts, (await readFile(noticesPath, "utf8")).trim()].join("\n\n----\n\n").replace(/&/g, "&amp;").replace(/</g, "&lt;");
}

/** The models, from the module that the page will have. */
async function models() {
  const { ccall } = await require(path.resolve(modulePath))();
  return (name, texts) => {
    const answer = JSON.parse(ccall("clatter_answer", "string", ["string", "string"], [name, JSON.stringify(texts)]));
    if (answer.error) throw new Error(`${name} ${JSON.stringify(texts)}: ${answer.error}`);
    return answer;
  };
}

/** A sheet as a page that is printed: headings, paragraphs, lists and tables of Markdown. */
async function sheet(name) {
  const text = (await readFile(path.join(here, `${name}.md`), "utf8")).replace(/\n {2,}/g, " ").replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/`([^`]+)`/g, "<code>$1</code>");
  const block = (lines) => {
    const [first] = lines;
    const items = (mark) => lines.map((line) => `<li>${line.replace(mark, "")}</li>`).join("");
    if (/^#+ /.test(first)) return `<h2>${first.replace(/^#+ /, "")}</h2>`;
    if (/^- /.test(first)) return `<ul>${items(/^- /)}</ul>`;
    if (/^\d+\. /.test(first)) return `<ol start="${Number.parseInt(first, 10)}">${items(/^\d+\. /)}</ol>`;
    if (!first.startsWith("|")) return `<p>${lines.join(" ")}</p>`;
    const row = (line, tag) => `<tr>${line.split("|").slice(1, -1).map((cell) => `<${tag}>${cell.trim()}</${tag}>`).join("")}</tr>`;
    return `<table>${lines.filter((_line, i) => i !== 1).map((line, i) => row(line, i ? "td" : "th")).join("")}</table>`;
  };
  return text.trim().split(/\n\n+/).map((one) => block(one.split("\n"))).join("\n");
}

/** As gzip packs it, a few per cent smaller. */
function packed(bytes) {
  const folder = mkdtempSync(path.join(tmpdir(), "clatter-page-"));
  try {
    writeFileSync(path.join(folder, "code"), bytes);
    return execFileSync("zopfli", ["-c", "--i5", path.join(folder, "code")], { maxBuffer: 1 << 26 });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** The module's JavaScript, and the compiled models in it, packed: half of the room that they take there. */
async function unwrapped() {
  const text = await readFile(modulePath, "utf8");
  const data = /(data:application\/octet-stream;base64,)([A-Za-z0-9+/=]+)/;
  const code = packed(Buffer.from(data.exec(text)[2], "base64")).toString("base64");
  return { loader: text.replace(data, "$1"), code };
}

const template = await readFile(path.join(here, "index.html"), "utf8");
const { loader, code } = await unwrapped();
if (loader.includes("</script")) throw new Error("the module's text would end its element");
const parts = {
  "/*STYLE*/": await style(), "/*SCRIPT*/": packed(await script()).toString("base64"), "/*MODULE*/": loader, "/*CODE*/": code,
  "<!--NOTICES-->": await notices(), "<!--STORY-->": await storyHtml(await models()), "<!--VERSION-->": version,
  "<!--LESSON-->": await sheet("lesson"), "<!--EXERCISES-->": await sheet("exercises"), "<!--ANSWERS-->": await sheet("answers"), "<!--MODELS-->": modelsDigest, "<!--PAGE-->": pageDigest,
};
let page = template;
for (const [mark, text] of Object.entries(parts)) page = page.replaceAll(mark, () => text);
await writeFile(output, page);
console.log(`${output} ${(Buffer.byteLength(page) / 1e3).toFixed(0)} kB`);
