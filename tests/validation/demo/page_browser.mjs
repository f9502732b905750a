// SPDX-License-Identifier: GPL-3.0-or-later
// A browser on the page of `clatter demo`, or on another, for its tests.
// DEMO_PAGE: the folder in which it was built. CLATTER_PROGRAM: the program to compare with. CHROMIUM, FIREFOX: the browsers.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";

export const folder = process.env.DEMO_PAGE;
assert.ok(folder, "DEMO_PAGE is the folder in which the page was built");
const require = createRequire(path.join(folder, "package.json"));
export const { chromium, firefox } = require("playwright-core");
export const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export const file = path.join(folder, "page.html");
export const address = pathToFileURL(file).href;
export const program = process.env.CLATTER_PROGRAM;
assert.ok(program, "CLATTER_PROGRAM is the program to compare with");

export const LARGE = { width: 1280, height: 900 };
export const NARROW = { width: 360, height: 740 };
/** The models may share two cores with everything else. */
const PATIENCE = 600_000;
/** Of what the table shows: half a unit of the sixth digit. */
export const SHOWN = 5e-6;

const LAUNCHED = {
  chromium: () => chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-background-networking", "--no-first-run"],
  }),
  firefox: () => firefox.launch({
    channel: "moz-firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr", headless: true,
    // Firefox takes no `reducedMotion` from a context.
    firefoxUserPrefs: { "ui.prefersReducedMotion": 1 },
  }),
};

const browsers = new Map();
const browserOf = (name) => {
  if (!browsers.has(name)) browsers.set(name, LAUNCHED[name]());
  return browsers.get(name);
};

after(async () => { for (const browser of browsers.values()) await (await browser).close(); });

/** By what a context is made with: a window in which no test is at work, and what its pages say and ask for. */
const idle = new Map();

async function newWindow(browser, options) {
  const context = await (await browserOf(browser)).newContext(options);
  context.setDefaultTimeout(PATIENCE);
  const opened = { context, page: await context.newPage(), wrong: [], asked: [] };
  opened.page.on("console", (message) => {
    // Drivers report how fast they are as warnings.
    if (message.type() === "error") opened.wrong.push(message.text());
  });
  opened.page.on("pageerror", (error) => opened.wrong.push(error.message));
  opened.page.on("request", (request) => opened.asked.push(request.url().split("#")[0]));
  return opened;
}

/** As a new window is, but for what the process behind it has compiled: that is half of what opening the page takes. */
async function clear({ context, page, wrong, asked }, { viewport }) {
  for (const other of context.pages()) if (other !== page) await other.close();
  await page.goto("about:blank");
  await page.mouse.move(0, 0);
  await page.emulateMedia({ media: null });
  await page.setViewportSize(viewport);
  await context.clearPermissions();
  wrong.length = asked.length = 0;
}

/**
 * Opens the page, with all controls and panels unless `more` is false, with a script before its own if `before` is one. Afterwards nothing may have gone wrong in its console, and
 * nothing been asked of anybody.
 */
export async function onPage(fragment, use, { browser = "chromium", at = address, before: prepare, more = true, ...others } = {}) {
  const options = { viewport: LARGE, reducedMotion: "reduce", ...others };
  const kind = JSON.stringify([browser, options]);
  const opened = idle.get(kind) ?? await newWindow(browser, options);
  idle.delete(kind);
  const { context, page, wrong, asked } = opened;
  let isGood = false;
  try {
    if (prepare) await page.addInitScript(prepare);
    await page.goto(at + fragment);
    // All controls and panels, not only the first.
    if (more && others.javaScriptEnabled !== false) {
      // A page of an earlier version has no panels to choose.
      await page.waitForFunction(() => !document.getElementById("tabs") || document.querySelector("#tabs [aria-pressed]"));
      await page.evaluate(() => {
        document.getElementById("more").open = true;
        document.querySelector('[data-tab="all"]')?.click();
      });
    }
    await use(page, context);
    assert.deepEqual(wrong, []);
    assert.deepEqual(asked.filter((place) => !/^(data|blob):/.test(place) && place !== at), []);
    isGood = true;
  } finally {
    // A script of a test's own stays in its window, and nobody knows what a test that failed left there.
    if (isGood && !prepare) {
      await clear(opened, options);
      idle.set(kind, opened);
    } else await context.close();
  }
}

/** One page for several tests in a row, each of which begins where the one before it ended: opening the page is what takes long. */
export function onOnePage(title, fragment, parts, options = {}) {
  test(title, (t) => onPage(fragment, async (page, context) => {
    for (const [name, part] of Object.entries(parts)) await t.test(name, () => part(page, context));
  }, options));
}

/** What a command of the program prints as JSON. */
export const printed = (...command) => JSON.parse(execFileSync(program, [...command, "--format", "json"], { encoding: "utf8" }));
export const sequence = (...flags) => printed("sequence", ...flags);

export const number = (text) => Number(text.replace("−", "-"));

export async function column(page, title, model = "discrete") {
  const cells = page.locator(`#impact-table tr[data-model="${model}"] td[data-column="${title}"]`);
  return (await cells.allTextContents()).map(number);
}

/** Until the table shows a number: that of the new situation, not that of the last one. */
export async function waitForCell(page, title, row, expected, model = "discrete") {
  await page.waitForFunction(([name, index, value, tolerance, of]) => {
    const cells = document.querySelectorAll(`#impact-table tr[data-model="${of}"] td[data-column="${name}"]`);
    const shown = Number(cells[index]?.textContent?.replace("−", "-") ?? NaN);
    return Math.abs(shown - value) <= tolerance * Math.abs(value);
  }, [title, row, expected, SHOWN, model]);
}

export async function slide(page, id, value) {
  await page.locator(`#${id}-slider`).evaluate((slider, to) => {
    slider.value = String(to);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    slider.dispatchEvent(new Event("change", { bubbles: true }));
  }, value);
}

export function close(shown, expected, relative) {
  assert.equal(shown.length, expected.length);
  shown.forEach((value, i) =>
    assert.ok(Math.abs(value - expected[i]) <= relative * Math.abs(expected[i]), `${value} is not ${expected[i]}`));
}

