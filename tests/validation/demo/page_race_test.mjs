// SPDX-License-Identifier: GPL-3.0-or-later
// The race on the page of `clatter demo`: recorded runs of the league beside the exact drop, and the script that makes them small.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { folder, onPage, printed, sequence } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-race-"));
after(() => rmSync(scratch, { recursive: true }));
const recorded = JSON.parse(readFileSync(path.join(folder, "race.json"), "utf8"));
const { impacts } = sequence("--angle", "10", "--speed", "1.5");
const RADIANS = Math.PI / 180;

test("a recorded run becomes whole tenths of a millimetre and milliradians, with the part of the energy that is left", () => {
  const write = (name, text) => writeFileSync(path.join(scratch, name), text);
  const head = "# engine: x\n# version: 7\n# problem: rod-10-brisk\n# step: 0.0166\n# settings: default\nt,x,z,phi,vx,vz,omega\n";
  // At the end 1 m/s upwards and 3 rad/s: 1 + 9/12 of 1.5².
  write("planck-rod-10-brisk-default-1_60-2.csv", `${head}0,0,0.0903,0.1745,0,-1.5,0\n0.0166,0,0.0705049,-0.0305,0,1,-3\n`);
  for (const other of ["planck-rod-10-brisk-tuned-1_60-2.csv", "planck-rod-10-brisk-default-1_240-2.csv", "planck-rod-10-brisk-default-1_60-1.csv", "clatter-sequence-rod-10-brisk-default-1_60-2.csv"]) {
    write(other, `${head}0,0,1,1,0,1,1\n`);
  }
  const output = path.join(scratch, "race.json");
  execFileSync("/usr/bin/python3", ["-B", path.join(process.env.CLATTER_ROOT, "validation/demo/race.py"), scratch, output]);
  const { drop, step, runs } = JSON.parse(readFileSync(output, "utf8"));
  assert.deepEqual(drop, recorded.drop);
  assert.equal(step, 1 / 60);
  assert.deepEqual(runs.map(({ name, version, z, phi, energy }) => ({ name, version, z, phi, energy })),
    [{ name: "planck", version: "7", z: [903, 705], phi: [174, -30], energy: 0.7778 }]);
});

test("the recorded runs are those of the league's problem: each begins where its drop does and falls as nothing touches it yet", () => {
  const shown = printed("benchmark", "show", "rod-10-brisk");
  assert.ok(JSON.stringify(shown).includes(String(recorded.drop.gap)));
  assert.ok(recorded.runs.length >= 8);
  const start = recorded.drop.gap + 0.5 * Math.sin(10 * RADIANS);
  for (const { name, z, phi, energy } of recorded.runs) {
    assert.ok(Math.abs(z[0] - 1e4 * start) <= 0.51, `${name} begins at ${z[0]}`);
    assert.ok(Math.abs(phi[0] - 1e3 * 10 * RADIANS) <= 0.51, name);
    assert.equal(z.length, phi.length);
    assert.ok(energy >= 0 && energy <= 1.01, `${name}: ${energy}`);
  }
});

/** Height and inclination of the exact rod, by its impacts, so long after the first. */
function exactAt(time) {
  if (time < 0) return [0.5 * Math.sin(10 * RADIANS) - 1.5 * time, 10 * RADIANS];
  const last = impacts.filter(({ start }) => start <= time).at(-1);
  const inclination = last.inclination_deg * RADIANS;
  const passed = time - last.start;
  return [0.5 * Math.abs(Math.sin(inclination)) + last.velocity_after[2] * passed, inclination - last.angular_velocity_after[1] * passed];
}

for (const browser of ["chromium", "firefox"]) {
  test(`in ${browser} each engine's rod moves beside the exact one, by hand and by itself`, () => onPage("#predict=0&hide=explain,map", async (page) => {
    await page.waitForSelector("#race-cells .exact[d]", { state: "attached" });
    assert.equal(await page.locator("#race-cells li").count(), recorded.runs.length);
    assert.deepEqual(await page.locator("#race-cells b").allTextContents(), recorded.runs.map(({ name }) => name));
    for (const ms of [0, 50, 100, 200]) {
      const drawn = await page.locator("#race-time").evaluate((slider, value) => {
        slider.value = String(value);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        return [...document.querySelectorAll("#race-cells li")].map((cell) => ["exact", "own"].map((name) => {
          const places = (path) => cell.querySelector(path).getAttribute("d").match(/[\d.]+/g).map(Number);
          const [[x1, y1, x2, y2], [, floor]] = [places(`.${name}`), places(".ground")];
          // In lengths of the rod, which is 1 m.
          return [(floor - (y1 + y2) / 2) / Math.hypot(x2 - x1, y2 - y1), Math.atan2(y1 - y2, x2 - x1)];
        }).concat([cell.querySelector("span").textContent.match(/[\d.]+/g).map(Number)]));
      }, 10 * ms);
      const [height, angle] = exactAt(ms / 1e3 - recorded.drop.gap / 1.5);
      drawn.forEach(([exact, own, apart], i) => {
        // What is said is how far they are apart, in mm and degrees of two digits; drawn are hundredths of a pixel.
        const said = [1e3 * Math.abs(own[0] - exact[0]), Math.abs(own[1] - exact[1]) / RADIANS];
        apart.forEach((value, k) => assert.ok(Math.abs(value - said[k]) <= 0.05 * said[k] + [0.3, 0.05][k], `${ms} ms: ${apart} is not ${said}`));
        assert.ok(Math.abs(exact[0] - height) < 1e-3 && Math.abs(exact[1] - angle) < 1e-3, `${ms} ms: ${exact} is not ${[height, angle]}`);
        // At a step of the engines.
        const { z, phi } = recorded.runs[i];
        const row = (ms / 1e3) * 60;
        if (Number.isInteger(row)) assert.ok(Math.abs(own[0] - z[row] / 1e4) < 1e-3 && Math.abs(own[1] - phi[row] / 1e3) < 1e-3, `${ms} ms: ${own}`);
      });
    }
    await page.click("#race-play");
    assert.equal(await page.textContent("#race-play"), "Stop");
    await page.waitForFunction(() => document.getElementById("race-play").textContent === "Play");
    assert.equal(await page.inputValue("#race-time"), await page.getAttribute("#race-time", "max"));
  }, { browser }));
}
