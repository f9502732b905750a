// SPDX-License-Identifier: GPL-3.0-or-later
// Measured drops on the page of `clatter demo`: the tracks as they were published, the state at the first touch, the prediction.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { folder, onPage, printed, program } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-measured-"));
after(() => rmSync(scratch, { recursive: true }));
const root = process.env.CLATTER_ROOT;
const shipped = JSON.parse(readFileSync(path.join(folder, "measured.json"), "utf8"));
const cubes = JSON.parse(readFileSync(path.join(folder, "cubes.json"), "utf8"));
const tosses = printed("measured", "predict", "cube-tosses").drops.filter(({ point }) => point);
const predictions = printed("measured", "predict", "square-drops").drops.filter(({ point }) => point);

test("the page ships what its script makes: the first drops that the law was not fitted on and that strike with a corner", () => {
  const outputs = ["measured.json", "cubes.json"].map((name) => path.join(scratch, name));
  execFileSync("/usr/bin/python3", ["-B", path.join(root, "validation/demo/measured.py"), program, ...outputs]);
  const [made, cubesMade] = outputs.map((output) => JSON.parse(readFileSync(output, "utf8")));
  assert.deepEqual(made.drops.map(({ name }) => name), predictions.slice(0, made.drops.length).map(({ drop }) => drop));
  assert.deepEqual(cubesMade.drops.map(({ name }) => name), tosses.slice(0, cubesMade.drops.length).map(({ drop }) => drop));
  // Rounded: whole units of the tracks, five digits of the fits.
  const isNear = (a, b) => (typeof a === "number" ? Math.abs(a - b) <= (Number.isInteger(a) ? 1 : 3e-5 * Math.max(1, Math.abs(b)))
    : typeof a === "string" ? a === b : Object.keys(a).length === Object.keys(b).length && Object.keys(a).every((key) => isNear(a[key], b[key])));
  assert.ok(isNear(made, shipped));
  assert.ok(isNear(cubesMade, cubes));
});

test("the tracks are the published ones, turned and moved as a whole", () => {
  const rows = readFileSync(path.join(root, "validation/measured/square-drops.csv"), "utf8").split("\n").filter((line) => /^\d/.test(line)).map((line) => line.split(",").map(Number));
  for (const drop of shipped.drops) {
    const own = rows.filter(([name, sample]) => name === Number(drop.name) && sample < drop.x.length);
    for (const [column, name, unit] of [[2, "x", 1e4], [3, "z", 1e4], [4, "angle", 1e3]]) {
      const shifts = own.map((row, i) => row[column] * unit - drop[name][i]);
      // Rounded to whole units.
      assert.ok(Math.max(...shifts) - Math.min(...shifts) <= 1.001, `${drop.name} ${name}`);
    }
  }
});

/** What the program says of the first blow; its own way from frames to velocities, with another filter than the script's. */
test("the velocities after the first blow, from the shipped state, are those that the program predicts", () => {
  const { side, gravity, e, friction, inertia, drops } = shipped;
  const moment = (inertia * side ** 2) / 6;
  for (const [i, { name, place, speed }] of drops.entries()) {
    const { impacts: [first] } = printed("sequence", "--body", "box", "--mass", "1", "--size", `${side}x${side}x${side}`, "--inertia", `${moment},${moment},${moment}`,
      "--attitude", `${Math.cos(place[2] / 2)},0,${-Math.sin(place[2] / 2)},0`, "--velocity", `${speed[0]},0,${speed[1]}`, "--angular-velocity", `0,${-speed[2]},0`,
      "--gravity", String(gravity), "--restitution", String(e), "--friction", String(friction), "--impacts", "1");
    const wanted = predictions[i];
    assert.equal(wanted.drop, name);
    // Half of what the law leaves open, 0.22 m/s.
    for (const [value, expected] of [[first.velocity_after[0], wanted.v_x], [first.velocity_after[2], wanted.v_z]]) {
      assert.ok(Math.abs(value - expected) < 0.11, `${name}: ${value} is not ${expected}`);
    }
  }
});

test("a tossed cube's first blow, from the shipped state, leaves the velocity that the program predicts with its own fit", () => {
  const { side, gravity, e, friction, inertia, drops } = cubes;
  const moment = (inertia * side ** 2) / 6;
  for (const [i, { name, attitude, speed, spin }] of drops.entries()) {
    const { impacts: [first] } = printed("sequence", "--body", "box", "--mass", "1", "--size", `${side}x${side}x${side}`, "--inertia", `${moment},${moment},${moment}`,
      "--attitude", attitude.join(","), "--velocity", speed.join(","), "--angular-velocity", spin.join(","),
      "--gravity", String(gravity), "--restitution", String(e), "--friction", String(friction), "--impacts", "1");
    const { drop, v_x, v_y, v_z } = tosses[i];
    assert.equal(drop, name);
    for (const [axis, expected] of [v_x, v_y, v_z].entries()) {
      assert.ok(Math.abs(first.velocity_after[axis] - expected) < 0.11, `${name}: ${first.velocity_after[axis]} is not ${expected}`);
    }
  }
});

test("a tossed cube lies on the predicted one until it strikes", () => onPage("#predict=0&hide=explain,map", async (page) => {
  await page.waitForFunction((count) => document.querySelectorAll("#cubes-cells .exact[d]").length === count, cubes.drops.length);
  const said = (time) => page.locator("#cubes-time").evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    return [...document.querySelectorAll("#cubes-cells li > span")].map((words) => words.textContent.match(/^off by ([\d.]+) mm, ([\d.]+)°$/).slice(1).map(Number));
  }, Math.round(1e4 * time));
  for (const [apart, turned] of await said(Math.min(...cubes.drops.map(({ touch }) => touch)) - 0.004)) {
    assert.ok(apart < 2 && turned < 1, `${apart} mm, ${turned}°`);
  }
  assert.ok((await said(0.29)).some(([apart]) => apart > 5));
}));

for (const browser of ["chromium", "firefox"]) {
  test(`in ${browser} the tracked square lies on the predicted one until it strikes, and it is said how far they are apart`, () => onPage("#predict=0&hide=explain,map", async (page) => {
    await page.waitForFunction((count) => document.querySelectorAll("#measured-cells .exact[d]").length === count, shipped.drops.length);
    const at = (time) => page.locator("#measured-time").evaluate((slider, value) => {
      slider.value = String(value);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      const corners = (square) => square.getAttribute("d").match(/[\d.]+,[\d.]+/g).map((corner) => corner.split(",").map(Number));
      const middle = (square) => corners(square).reduce(([x, y], corner) => [x + corner[0] / 4, y + corner[1] / 4], [0, 0]);
      return [...document.querySelectorAll("#measured-cells li")].map((cell) => {
        const [a, b] = [".own", ".exact"].map((name) => cell.querySelector(name));
        const [[x, y], [u, v]] = [middle(a), middle(b)];
        const [p, q] = corners(a);
        const edge = Math.hypot(p[0] - q[0], p[1] - q[1]);
        return { apart: Math.hypot(x - u, y - v) / edge, said: Number(cell.querySelector("span").textContent.match(/off by ([\d.]+) mm/)[1]) };
      });
    }, Math.round(1e4 * time));
    const first = Math.min(...shipped.drops.map(({ touch }) => touch));
    // Before the blow by what the camera and the fit leave; the edge is 60 mm.
    for (const { apart, said } of await at(first - 0.004)) {
      assert.ok(60 * apart < 1.5, String(60 * apart));
      assert.ok(Math.abs(said - 60 * apart) < 0.1, `${said} is not ${60 * apart}`);
    }
    const later = await at(0.2);
    for (const { apart, said } of later) assert.ok(Math.abs(said - 60 * apart) <= 0.06 * said, `${said} is not ${60 * apart}`);
    // A law with two numbers does not hit a blow to better than a tenth.
    assert.ok(later.some(({ said }) => said > 10));
  }, { browser }));
}
