// SPDX-License-Identifier: GPL-3.0-or-later
// A browser on the page of `clatter demo`, for its tests.
// DEMO_URL: where the page is served. DEMO_PAGE: the folder in which it was built. CLATTER_PROGRAM: the program to compare
// with. CHROMIUM: the browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { after, before } from "node:test";

export const folder = process.env.DEMO_PAGE;
assert.ok(folder, "DEMO_PAGE is the folder in which the page was built");
const require = createRequire(path.join(folder, "package.json"));
export const { chromium } = require("playwright-core");
export const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export const address = process.env.DEMO_URL;
export const program = process.env.CLATTER_PROGRAM;
assert.ok(address, "DEMO_URL says where the page is served");
assert.ok(program, "CLATTER_PROGRAM is the program to compare with");

export const LARGE = { width: 1280, height: 900 };
export const NARROW = { width: 360, height: 740 };
/** Answers come from a program that may share two cores with everything else. */
const PATIENCE = 600_000;
/** Of what the table shows: half a unit of the sixth digit. */
export const SHOWN = 5e-6;

let browser;

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-background-networking", "--no-first-run"],
  });
});

after(() => browser?.close());

/**
 * Opens the page, with a script before its own if `before` is one. Afterwards nothing may have gone wrong in its console, and
 * nothing been asked of another host.
 */
export async function onPage(query, use, { viewport = LARGE, reducedMotion = "reduce", mayFail = false, script = true, before: prepare } = {}) {
  const context = await browser.newContext({ viewport, reducedMotion, javaScriptEnabled: script });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  const wrong = [];
  const foreign = [];
  page.on("console", (message) => {
    // The browser itself reports an answer 400 as an error; drivers report how fast they are as warnings.
    const expected = mayFail && /status of 4\d\d/.test(message.text());
    if (message.type() === "error" && !expected) wrong.push(message.text());
  });
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("request", (request) => {
    const { protocol, origin } = new URL(request.url());
    if (protocol !== "data:" && protocol !== "file:" && protocol !== "blob:" && origin !== new URL(address).origin) foreign.push(request.url());
  });
  try {
    if (prepare) await page.addInitScript(prepare);
    await page.goto(new URL(query, address).href);
    await use(page, context);
    assert.deepEqual(wrong, []);
    assert.deepEqual(foreign, []);
  } finally {
    await context.close();
  }
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

