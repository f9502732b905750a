// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of the page of `clatter demo`, and how they press into the ground.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { SHOWN, close, column, number, onOnePage, onPage, program, sequence, waitForCell } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-page-"));
after(() => rmSync(scratch, { recursive: true }));

const box = (mass, size) => ["--body", "box", "--mass", mass, "--size", size];
const rod = (mass, length, radius) => ["--body", "rod", "--mass", mass, "--length", length, "--radius", radius];
/** A tube's thin wall: m r² about its axis, m (r²/2 + L²/12) across. */
const across = 0.1934 * (0.02 ** 2 / 2 + 0.3 ** 2 / 12);
const PHONE = box("0.08814", "0.10566x0.04394x0.01905");
const COIN = rod("0.0075", "0.00233", "0.011625");
const BODIES = {
  phone: PHONE, coin: COIN, tube: [...rod("0.1934", "0.3", "0.02"), "--inertia", `${0.1934 * 0.02 ** 2},${across},${across}`],
  die: box("0.00483", "0.016x0.016x0.016"), plate: box("0.942", "0.2x0.2x0.003"),
};

onOnePage("each body that one chooses", "#predict=0&hide=map,explain&height=0.5&gravity=9.81&e=0.6&angle=12&impacts=3", Object.fromEntries(
  Object.entries(BODIES).map(([name, flags]) => [`a ${name} falls as the program's does`, async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await page.selectOption("#body", name);
    const { impacts } = sequence("--angle", "12", "--height", "0.5", "--gravity", "9.81", "--restitution", "0.6", "--impacts", "3", ...flags);
    await waitForCell(page, "Impulse", 0, impacts[0].impulse_normal);
    await waitForCell(page, "Impulse", 2, impacts[2].impulse_normal);
    close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
    await page.waitForSelector('tr[data-model="continuous"]');
  }])));

test("a coin is taken by its side, not by its faces: the side that is pulled up makes it lean", () => onPage(
  "#predict=0&hide=map,explain&body=coin&angle=80&height=0.02&gravity=9.81&e=0.6&stiffness=1e12", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    // What one sees is how far it is from flat, everywhere.
    assert.match(await page.textContent("#caption"), /^Impact 1: .*, at 10\.0°/);
    assert.equal((await column(page, "Angle"))[0], 10);
    assert.equal(await page.inputValue("#angle"), "10");
    await page.focus("#stage");
    for (let i = 0; i < 5; i++) await page.keyboard.press("[");
    assert.match(await page.textContent("#caption"), /^In your hand: 15\.0°/);
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.getElementById("angle").value === "15");
    await page.waitForFunction(() => /[#&]angle=75&/.test(location.hash));
    assert.match(await page.textContent("#body-note"), /At 0° the coin lies flat/);
  }));

/** At a time between two rows of the program's history. */
function stateAt(flags, time) {
  const history = path.join(scratch, "history.csv");
  execFileSync(program, ["simulate", ...flags, "--planar", "--digits", "4", "--history", history]);
  const [head, ...rows] = readFileSync(history, "utf8").split("\n").filter((line) => line && !line.startsWith("#")).map((line) => line.split(","));
  const value = (row, name) => Number(row[head.indexOf(name)]);
  const next = rows.findIndex((row) => value(row, "t") > time);
  const [a, b] = [rows[next - 1], rows[next]];
  const part = (time - value(a, "t")) / (value(b, "t") - value(a, "t"));
  const at = (name) => value(a, name) + part * (value(b, name) - value(a, name));
  return { height: at("z"), angle: -2 * Math.atan2(at("beta2"), at("beta0")) };
}

/** Lengths of the patch along x and y and its depth, in mm, as the page says. */
async function patchOf(page) {
  await page.waitForFunction(() => / deep/.test(document.getElementById("patch-words").textContent));
  return (await page.textContent("#patch-words")).match(/[\d.]+/g).map(Number);
}
const near = (value, expected, relative) => assert.ok(Math.abs(value - expected) <= relative * expected, `${value} is not ${expected}`);
const THREE_DIGITS = 6e-3;  // of the page, and of a history that is interpolated

test("the patch of a phone's edge is the wedge that it cuts: depth over sin θ cos θ, as broad as the phone", () => onPage(
  "#predict=0&hide=map,explain&body=phone&angle=20&height=1&gravity=9.81&stiffness=1e8&impacts=2&t=0.0012", async (page) => {
    const { height, angle } = stateAt(["--angle", "20", "--height", "1", "--gravity", "9.81", "--stiffness", "1e8", "--impacts", "2", ...PHONE], 0.0012);
    const depth = (0.10566 / 2) * Math.sin(angle) + (0.01905 / 2) * Math.cos(angle) - height;
    const [x, y, deep] = await patchOf(page);
    near(deep, 1e3 * depth, THREE_DIGITS);
    near(x, (1e3 * depth) / (Math.sin(angle) * Math.cos(angle)), THREE_DIGITS);
    near(y, 43.94, THREE_DIGITS);
    await page.fill("#gravity", "9.8");
    await page.evaluate(() => { const time = document.getElementById("scrubber"); time.value = "0"; time.dispatchEvent(new Event("input", { bubbles: true })); });
    assert.equal(await page.textContent("#patch-words"), "nothing touches now");
  }));

test("the patch of a coin's rim is as broad as the chord of what its face sinks in", () => onPage(
  "#predict=0&hide=map,explain&body=coin&angle=70&height=0.1&gravity=9.81&e=1&stiffness=1e9&impacts=1&t=0.0006", async (page) => {
    const { height, angle } = stateAt(["--angle", "70", "--height", "0.1", "--gravity", "9.81", "--stiffness", "1e9", "--impacts", "1", ...COIN], 0.0006);
    const radius = 0.011625;
    const depth = (0.00233 / 2) * Math.sin(angle) + radius * Math.cos(angle) - height;
    const sunk = depth / Math.cos(angle);
    const [, y, deep] = await patchOf(page);
    near(deep, 1e3 * depth, THREE_DIGITS);
    // A polygon of 64 sides is up to r (1 - cos(pi/64)) within the circle.
    near(y, 2e3 * Math.sqrt(sunk * (2 * radius - sunk)), 0.03);
  }));
