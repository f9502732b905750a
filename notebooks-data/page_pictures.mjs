// SPDX-License-Identifier: GPL-3.0-or-later
// Draws notebooks-data/figures/demo.png, the page of `clatter demo` at the second impact of a phone that fell on its corner,
// and report.png, how the page of a report begins.
//   DEMO_PAGE=build/page DEMO_SCENE=demo.html REPORT_PAGE=handset.html node notebooks-data/page_pictures.mjs
// DEMO_PAGE: the folder in which validation/demo/build_page.py built it; DEMO_SCENE: what `clatter demo phone-corner --export` wrote;
// REPORT_PAGE: what README's `clatter report` wrote
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const { chromium } = createRequire(path.resolve(process.env.DEMO_PAGE, "package.json"))("playwright-core");
const here = path.dirname(fileURLToPath(import.meta.url));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-background-networking", "--no-first-run"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce" });
const [, scene] = /name="clatter-scene" content="([^"]*)"/.exec(readFileSync(process.env.DEMO_SCENE, "utf8"));
await page.goto(`${pathToFileURL(path.resolve(process.env.DEMO_PAGE, "page.html")).href}#predict=0&${scene.replace(/&amp;/g, "&")}&impact=2`);
await page.waitForSelector('#impact-table tr[data-model="continuous"]', { state: "attached" });
await page.screenshot({ path: path.join(here, "figures", "demo.png") });
await page.setViewportSize({ width: 960, height: 600 });
await page.goto(pathToFileURL(path.resolve(process.env.REPORT_PAGE)).href);
await page.screenshot({ path: path.join(here, "figures", "report.png") });
await browser.close();
