// SPDX-License-Identifier: GPL-3.0-or-later
// Where prediction ends, on the page of `clatter demo`: what a hand's tremor makes of a drop, and the digits that it leaves.
import assert from "node:assert/strict";
import { test } from "node:test";
import { number, onPage } from "./page_browser.mjs";

const PANEL = "#predict=0&hide=map,explain,story,race,measured";
/** Tilts in the plane, each in the middle of its part of the tremor. */
const COUNT = 41;
const tiltsAround = (angle, tremor) => Array.from({ length: COUNT }, (_, i) => angle + tremor * ((2 * i + 1) / COUNT - 1));
/** Of the first blow on an elastic thin rod of 1 kg at 1 m/s: P = 2 / (1 + 3 cos²θ). */
const firstBlow = (degrees) => 2 / (1 + 3 * Math.cos((degrees * Math.PI) / 180) ** 2);
/** Beyond this angle the elastic thin rod has no second blow, times 90 (see "How many drops" in the reference). */
const FOLD = 0.64987158098 * 90;

const ready = (page) => page.waitForFunction(() => document.getElementById("panel-fan").getAttribute("aria-busy") === "false" && document.querySelector("#fan-rows tr"));
const shares = async (page) => (await page.locator("#fan-shares button").allTextContents()).map((text) => /^([\d.]+) %(.*)/.exec(text).slice(1));

test("near the fold some tilts have a second blow and some have none, in the shares that the fold gives", () => onPage(`${PANEL}&angle=58.5&tremor=0.5`, async (page) => {
  await ready(page);
  const striking = tiltsAround(58.5, 0.5).filter((angle) => angle < FOLD).length;
  const found = await shares(page);
  assert.deepEqual(found.map(([, words]) => words), ["none: nothing reaches the ground any more.", "end b"]);
  for (const [i, count] of [COUNT - striking, striking].entries()) assert.ok(Math.abs(Number(found[i][0]) - (100 * count) / COUNT) <= 0.5, found[i][0]);
  assert.match(await page.textContent("#fan-said"), /^Of 41 drops .* alike up to blow 1\. Blow 2 is struck by:$/);
  assert.equal(await page.getAttribute("#fan-shares button >> nth=0", "aria-pressed"), "true");
  await page.click("#fan-shares button >> nth=1");
  assert.deepEqual(await page.locator("#fan-shares button").evaluateAll((all) => all.map((one) => one.getAttribute("aria-pressed"))), ["false", "true"]);
}));

test("far from the fold all are alike, and the digits that stand out are those that the law of the first blow leaves to every tilt", () => onPage(`${PANEL}&angle=10`, async (page) => {
  for (const tremor of [0.5, 0.1, 2]) {
    await page.selectOption("#tremor", String(tremor));
    await ready(page);
    assert.match(await page.textContent("#fan-said"), /all strike the same places/);
    assert.deepEqual(await shares(page), []);
    const cell = page.locator("#fan-rows tr >> nth=0 >> .digits");
    const texts = [10, ...tiltsAround(10, tremor)].map((angle) => firstBlow(angle).toFixed(15));
    const shared = [...texts[0]].findIndex((letter, i) => texts.some((text) => text[i] !== letter));
    const [dark] = await cell.evaluate((element) => [...element.childNodes].map(({ textContent }) => textContent));
    assert.equal(dark, texts[0].slice(0, shared));
    const [shown] = /^[\d.]+/.exec(await cell.textContent());
    assert.ok(Math.abs(number(shown) - firstBlow(10)) < 1e-14, shown);
  }
}));

test("in space tilts lie around the wanted one on all sides: a box that lies flat strikes first with each of its four corners, a quarter each", () => onPage(
  `${PANEL}&body=plate&turn=tilted&angle=0&tilt=0.000001&gravity=9.81&e=0.5&impacts=2`, async (page) => {
    await ready(page);
    const found = await shares(page);
    assert.deepEqual(found.map(([, words]) => words).sort(), ["back", "front"].flatMap((y) => ["left", "right"].map((x) => `corner ${x} ${y} lower`)).sort());
    for (const [share] of found) assert.ok(Math.abs(Number(share) - 25) < 4, share);
  }));

test("the link has the tremor and whether the picture shows its fan", () => onPage(PANEL, async (page) => {
  await ready(page);
  await page.selectOption("#tremor", "2");
  await page.check("#fan-shown");
  await page.waitForFunction(() => /tremor=2/.test(location.hash) && /fan=1/.test(location.hash));
  await page.reload();
  await ready(page);
  assert.equal(await page.inputValue("#tremor"), "2");
  assert.ok(await page.isChecked("#fan-shown"));
}));

test("the fan changes the picture, and only while it is shown", () => onPage(`${PANEL}&angle=58.5&tremor=2&t=0.3`, async (page) => {
  await ready(page);
  const picture = async () => (await page.locator("#stage").screenshot()).toString("base64");
  const before = await picture();
  await page.check("#fan-shown");
  assert.notEqual(await picture(), before);
  await page.uncheck("#fan-shown");
  assert.equal(await picture(), before);
}));
