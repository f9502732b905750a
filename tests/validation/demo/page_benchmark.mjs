// SPDX-License-Identifier: GPL-3.0-or-later
// Measures, judges nothing: how long the page's models take in a worker of the browser, how much memory they hold after many
// computations, how long the page takes to its first picture, from slider to answer, and frames a second.
//   DEMO_PAGE=build/page CLATTER_PROGRAM=build/dev/validation/clatter node tests/validation/demo/page_benchmark.mjs [COMPUTATIONS]
import { chromium, address, slide, waitForCell } from "./page_browser.mjs";

const COMPUTATIONS = Number(process.argv[2] ?? 2000);
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

const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce" });
await page.goto(`${address}#predict=0`);
await page.waitForSelector("#impact-table tbody tr");
const first = await page.evaluate(() => performance.getEntriesByType("paint").map(({ name, startTime }) => `${name} ${startTime.toFixed(0)} ms`));
console.log(first.join(", "));
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
  let count = 0;
  const start = performance.now();
  for (; performance.now() - start < 2000; count++) await new Promise(requestAnimationFrame);
  return count / 2;
});
console.log(`slider to answer: median ${times[5]} ms, longest ${times[9]} ms; ${frames} frames a second`);
await browser.close();
