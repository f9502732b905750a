// SPDX-License-Identifier: GPL-3.0-or-later
// Measures, judges nothing: how long the page's models take in a worker of the browser, how much memory they hold after many
// computations, how long the page takes to its first picture, from slider to answer, frames a second and the page's own part of
// each; then, for MINUTES of a visitor who changes and plays the drop all the time, the memory of the page and of its process.
//   DEMO_PAGE=build/page CLATTER_PROGRAM=build/dev/validation/clatter node tests/validation/demo/page_benchmark.mjs [COMPUTATIONS [MINUTES]]
import { readFileSync } from "node:fs";
import { chromium, address, slide, waitForCell } from "./page_browser.mjs";

const COMPUTATIONS = Number(process.argv[2] ?? 2000);
const MINUTES = Number(process.argv[3] ?? 0);
const PHONE = { body: "box", mass: "0.08814", size: "0.10566x0.04394x0.01905", gravity: "9.81" };
const WORKS = {
  "planar sequence": ["sequence", { angle: "10" }, 1000],
  "two impacts in space, friction, errors": ["sequence", { ...PHONE, angle: "30", tilt: "40", height: "1", restitution: "0.75", friction: "0.1", impacts: "2" }, 200],
  "damped phone, two impacts": ["simulate", { ...PHONE, angle: "10", height: "1", stiffness: "1e8", damping: "1e7", impacts: "2" }, 20],
};

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-precise-memory-info"] });

/** In the page: a worker like its own, of which each answer is timed within the worker. */
async function measure([works, computations]) {
  const textOf = (id) => document.getElementById(id).textContent;
  const bytes = Uint8Array.from(atob(textOf("module-code")), (letter) => letter.charCodeAt(0));
  const code = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const timed = `let models; onmessage = async ({ data: [what, path, body, count] }) => {
    if (what instanceof ArrayBuffer) { models = await clatterModule({ wasmBinary: what }); return postMessage(0); }
    const times = [];
    for (let i = 0; i < count; i++) {
      const start = performance.now();
      models.ccall("clatter_answer", "string", ["string", "string"], [path, body]);
      times.push(performance.now() - start);
    }
    postMessage([times, models.HEAPU8 ? models.HEAPU8.length : -1]);
  };`;
  const worker = new Worker(URL.createObjectURL(new Blob([textOf("module"), timed], { type: "text/javascript" })));
  const ask = (message) => new Promise((resolve) => { worker.onmessage = ({ data }) => resolve(data); worker.postMessage(message); });
  await ask([code]);
  const lines = [];
  const middle = (times) => [...times].sort((a, b) => a - b)[Math.floor(times.length / 2)];
  for (const [name, [path, body, count]] of Object.entries(works)) {
    const [times] = await ask(["", path, JSON.stringify(body), count]);
    // The compiler is at work during the first half.
    const later = times.slice(times.length / 2);
    const block = later.reduce((sum, one) => sum + one, 0) / later.length;
    lines.push(`${name}: mean ${block.toFixed(3)} ms, median ${middle(later).toFixed(3)} ms, least ${Math.min(...times).toFixed(3)} ms, first ${times[0].toFixed(1)} ms`);
  }
  const [path, body] = Object.values(works)[1];
  const sizes = [];
  for (let part = 0; part < 4; part++) sizes.push((await ask(["", path, JSON.stringify(body), computations / 4]))[1]);
  lines.push(`memory of the module after each quarter of ${computations} computations in space: ${sizes.join(", ")} bytes`);
  worker.terminate();
  return lines;
}

/** A drop of another angle each time, of each body in turn, played. */
async function visit(minutes) {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const all = await (await browser.newBrowserCDPSession()).send("SystemInfo.getProcessInfo");
  const resident = () => Math.max(...all.processInfo.filter(({ type }) => type === "renderer")
    .map(({ id }) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"))[1])));
  await page.evaluate(() => { document.getElementById("more").open = true; });
  const bodies = ["rod", "phone", "die", "plate"];
  const start = Date.now();
  let drops = 0;
  for (let minute = 0; minute <= minutes; minute++) {
    for (; Date.now() - start < minute * 60_000; drops++) {
      await page.selectOption("#body", bodies[drops % bodies.length]);
      await slide(page, "angle", 10 + (drops % 50));
      await page.waitForTimeout(500);
      await page.evaluate(() => { document.getElementById("play").click(); });
      await page.waitForTimeout(2000);
    }
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    const value = (wanted) => metrics.find(({ name }) => name === wanted).value;
    console.log(`after ${minute} min and ${drops} drops: heap of the page ${(value("JSHeapUsedSize") / 1e6).toFixed(2)} MB, ${value("Nodes")} nodes; its process with the workers ${(resident() / 1e3).toFixed(0)} MB`);
  }
}

const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce" });
await page.addInitScript(() => {
  globalThis.measured = { first: 0, frames: [] };
  const { drawElements } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.drawElements = function draw(...given) {
    measured.first ||= performance.now();
    return drawElements.apply(this, given);
  };
  const request = requestAnimationFrame;
  globalThis.requestAnimationFrame = (draw) => request((now) => {
    const start = performance.now();
    draw(now);
    measured.frames.push(performance.now() - start);
  });
});
await page.goto(`${address}#predict=0&fan=1&tab=all`);
await page.waitForSelector("#impact-table tbody tr");
console.log(await page.evaluate(() => [...performance.getEntriesByType("paint").map(({ name, startTime }) => `${name} ${startTime.toFixed(0)} ms`), `first picture ${measured.first.toFixed(0)} ms`].join(", ")));
await page.waitForSelector('tr[data-model="continuous"]');
for (const line of await page.evaluate(measure, [WORKS, COMPUTATIONS])) console.log(line);
const times = [];
for (let angle = 12; angle < 22; angle++) {
  await slide(page, "angle", angle);
  await waitForCell(page, "Angle", 0, angle);
  times.push(Number(await page.evaluate(() => document.documentElement.dataset.latency)));
}
times.sort((a, b) => a - b);
await page.waitForSelector('tr[data-model="continuous"]');
const frames = await page.evaluate(async () => {
  document.getElementById("play").click();
  measured.frames = [];
  let count = 0;
  const start = performance.now();
  for (; performance.now() - start < 2000; count++) await new Promise(requestAnimationFrame);
  const own = measured.frames.filter((time) => time > 0.2).sort((a, b) => a - b);
  return `${count / 2} frames a second, each of which keeps the page itself busy for ${own[Math.floor(own.length / 2)]?.toFixed(1)} ms (median), ${own[Math.floor(0.95 * own.length)]?.toFixed(1)} ms (of 95 %)`;
});
console.log(`slider to answer: median ${times[5]} ms, longest ${times[9]} ms; ${frames}`);
if (MINUTES > 0) await visit(MINUTES);
await browser.close();
