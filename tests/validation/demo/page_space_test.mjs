// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies in space on the page of `clatter demo`: any attitude, velocity and spin, drawn blow by blow; which impacts correspond
// and which cannot be predicted.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { SHOWN, close, column, number, onPage, printed, sequence, waitForCell } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-page-"));
after(() => rmSync(scratch, { recursive: true }));

const PHONE = ["--body", "box", "--mass", "0.08814", "--size", "0.10566x0.04394x0.01905"];
const CORNER = "#predict=0&body=phone&angle=30&tilt=40&height=1&gravity=9.81&e=0.75&friction=0.075&stiffness=1e8&damping=1e7&impacts=4";
const CORNER_FLAGS = ["--angle", "30", "--tilt", "40", "--height", "1", "--gravity", "9.81", "--restitution", "0.75", "--friction", "0.075",
  ...PHONE, "--impacts", "4"];
/** Two corners of an edge strike at once, and then nothing can be predicted. */
const EDGE = "#predict=0&body=own-box&mass=1&length=0.1&width=0.05&thickness=0.02&orientation=7&speed=1&gravity=9.81&e=0.5&friction=0.2&stiffness=1e9";
const EDGE_FLAGS = ["--body", "box", "--size", "0.1x0.05x0.02", "--orientation", "7", "--gravity", "9.81", "--restitution", "0.5", "--friction", "0.2"];

async function fill(page, values) {
  for (const [id, value] of Object.entries(values)) await page.fill(`#${id}`, String(value));
}

test("a body in any attitude, with any velocity and spin, is the program's", () => onPage("#predict=0&body=phone&impacts=3", async (page) => {
  const check = async (...flags) => {
    const { impacts } = sequence(...flags, ...PHONE, "--impacts", "3");
    await waitForCell(page, "Impulse", 0, impacts[0].impulse_normal);
    await waitForCell(page, "Impulse", impacts.length - 1, impacts[impacts.length - 1].impulse_normal);
    close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
    close(await column(page, "Velocity after"), impacts.map((i) => i.velocity_after[2]), 4 * SHOWN);
  };
  await page.waitForSelector("#impact-table tbody tr");
  await page.selectOption("#turn", "tilted");
  await fill(page, { angle: 25, tilt: -70 });
  await check("--angle", "25", "--tilt", "-70");
  await page.selectOption("#turn", "orientation");
  for (const [number, part] of [[3, "face −y"], [9, "edge −x+z"], [20, "corner −x−y+z"], [26, "corner +x+y+z"]]) {
    await fill(page, { orientation: number });
    assert.equal(await page.locator("fieldset .hint:visible").textContent(), part);
    await check("--orientation", String(number));
  }
  await page.selectOption("#drop", "velocity");
  await fill(page, { vx: 0.25, vy: -0.5, vz: -1.5 });
  await page.check("#spinning");
  await fill(page, { wx: 2, wy: -3, wz: 1 });
  await page.selectOption("#turn", "attitude");
  await fill(page, { q0: 0.8, q1: 0.36, q2: -0.48, q3: 0 });
  await check("--attitude", "0.8,0.36,-0.48,0", "--velocity", "0.25,-0.5,-1.5", "--angular-velocity", "2,-3,1");
  // A quarter turn about the upright, in six steps, turns the sequence with it and leaves its impulses alone.
  const upright = sequence("--attitude", "0.8,0.36,-0.48,0", "--velocity", "0,0,-1.5", ...PHONE, "--impacts", "3");
  await fill(page, { vx: 0, vy: 0 });
  await page.uncheck("#spinning");
  for (let i = 0; i < 6; i++) await page.click('button[aria-label="Turn about z +15°"]');
  const q = await Promise.all(["q0", "q1", "q2", "q3"].map(async (id) => Number(await page.inputValue(`#${id}`))));
  const half = Math.SQRT1_2;
  close(q, [0.8 * half, (0.36 + 0.48) * half, (0.36 - 0.48) * half, 0.8 * half], 1e-12);
  const last = upright.impacts.length - 1;
  await waitForCell(page, "Impulse", last, upright.impacts[last].impulse_normal);
  // While four numbers are typed one by one they have no length of 1, and the program says so.
}));

test("Euler parameters begin as the attitude that was chosen before", () => onPage("#predict=0&body=phone&angle=30&tilt=40", async (page) => {
  const { impacts } = sequence("--angle", "30", "--tilt", "40", ...PHONE);
  await waitForCell(page, "Impulse", 1, impacts[1].impulse_normal);
  await page.selectOption("#turn", "attitude");
  const attitude = [];
  for (const id of ["q0", "q1", "q2", "q3"]) attitude.push(Number(await page.inputValue(`#${id}`)));
  impacts[0].attitude.forEach((part, i) => assert.ok(Math.abs(part - attitude[i]) < 1e-14));
}));

test("a flight in space ends in the attitude and at the height in which the next impact starts", async () => {
  const { impacts } = sequence(...CORNER_FLAGS);
  for (const impact of impacts.slice(1)) {
    await onPage(`${CORNER}&hide=map,explain,strip,force&t=${impact.start * (1 - 1e-9)}`, async (page) => {
      await page.waitForSelector("#impact-table tbody tr");
      const [height, inclination] = (await page.locator("#numbers-table tbody td:nth-of-type(1)").allTextContents()).map(number);
      // By its own steps, which a picture does not show, and to the last place shown.
      assert.ok(Math.abs(inclination - impact.inclination_deg) < 0.01, `${inclination} is not ${impact.inclination_deg}`);
      const [w, x, y, z] = impact.attitude;
      const up = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
      const place = impact.place.reduce((sum, part, i) => sum + part * up[i], 0);
      assert.ok(Math.abs(height + 1e3 * place) < 0.02, `${height} mm is not ${-1e3 * place}`);
    });
  }
});

/** Of a box whose three visible faces are drawn: the corner behind, by the edges that leave the one in front. */
function hiddenCorner(drawn) {
  const times = new Map();
  for (const corner of drawn) times.set(String(corner), (times.get(String(corner)) ?? 0) + 1);
  const seen = (count) => [...times].filter(([, n]) => n === count).map(([text]) => text.split(",").map(Number));
  const [[front], neighbours] = [seen(3), seen(2)];
  assert.equal(neighbours.length, 3);
  return [0, 1].map((axis) => neighbours.reduce((sum, corner) => sum + corner[axis], 0) - 2 * front[axis]);
}

test("the sequence in space is drawn blow by blow, each body on the corner that strikes, the continuous one below, and told in equations", () => onPage(CORNER, async (page) => {
  await page.waitForSelector('[data-strip="continuous-1"]');
  const count = { discrete: sequence(...CORNER_FLAGS).impacts.length, continuous: await page.locator('#impact-table tr[data-model="continuous"]').count() };
  for (const model of ["discrete", "continuous"]) {
    const pictures = await page.locator(`.sketch.${model}`).evaluateAll((all) => all.map((one) => ({
      corners: [...one.querySelectorAll("polygon")].flatMap(({ points }) => [...points].map(({ x, y }) => [x, y])),
      foot: (({ x, y }) => ({ x, y }))(one.querySelector(".blow").getPointAtLength(0)),
    })));
    assert.equal(pictures.length, count[model]);
    for (const { corners: drawn, foot } of pictures) {
      const corners = [...drawn, hiddenCorner(drawn)];
      // Upwards is less: a box that hung below its corner would have one there, too.
      assert.ok(corners.reduce((sum, [, y]) => sum + y, 0) / corners.length < foot.y - 5);
      assert.ok(corners.some(([x, y]) => Math.hypot(x - foot.x, y - foot.y) < 0.3), JSON.stringify([corners, foot.x, foot.y]));
    }
    assert.equal(new Set(pictures.map(({ corners }) => String(corners))).size, pictures.length);
  }
  assert.equal(await page.getAttribute("#stage", "data-layout"), "side");
  await page.click('[data-strip="discrete-3"]');
  assert.match(await page.textContent("#caption"), /^Impact 3: corner/);
  await page.click('[data-strip="continuous-2"]');
  assert.equal(await page.getAttribute('[data-strip="discrete-2"]', "aria-pressed"), "true");
  // The equations of the impact that was chosen there are set in type.
  await page.waitForFunction(() => /Rotation without torque/.test(document.getElementById("explain-steps").textContent));
  assert.equal(await page.locator("#explain-steps .katex-error").count(), 0);
}));

test("only impacts that compare calls comparable stand together, and a line says why the next one does not", async () => {
  const scene = path.join(scratch, "scene.toml");
  const cases = {
    // Restitution and friction as the ground gives them: those that compare takes.
    corner: "[drop]\nangle_deg = 30\ntilt_deg = 40\nheight = 1\n[body]\nshape = 'box'\nmass = 0.08814\nsize = [0.10566, 0.04394, 0.01905]\n"
      + "[ground]\nstiffness = 1e8\ndamping = 1e7\nsliding_friction = 0.075\n[run]\nimpacts = 3\n",
    rod: "[drop]\nangle_deg = 10\n[world]\ngravity = 0\n[ground]\nstiffness = 1e11\n[run]\nimpacts = 3\n",
    merged: "[drop]\nangle_deg = 1\n[world]\ngravity = 0\n[ground]\nstiffness = 1e7\n[run]\nimpacts = 3\n",
  };
  const counts = {};
  for (const [name, text] of Object.entries(cases)) {
    writeFileSync(scene, text);
    const { impacts } = printed("compare", scene);
    const first = impacts.findIndex(({ comparable }) => !comparable);
    counts[name] = first < 0 ? impacts.length : first;
    await onPage("#predict=0&hide=map,explain", async (page) => {
      await page.waitForSelector("#impact-table tbody tr");
      await page.setInputFiles("#scene-file", { name: "scene.toml", mimeType: "application/toml", buffer: Buffer.from(text) });
      await page.waitForFunction(() => /^Opened/.test(document.getElementById("file-said").textContent));
      const run = printed("simulate", scene);
      await waitForCell(page, "Peak force", 0, Number(run.impacts[0].peak_force.toPrecision(4)), "continuous");
      assert.equal(await page.locator('#impact-table th[rowspan="2"]').count(), counts[name], name);
      const lines = await page.textContent("#pairing");
      if (first < 0) assert.equal(lines, "");
      else assert.match(lines, new RegExp(`^Impact ${first + 1} is not the same in both models: .{20}`));
      if (first >= 0) assert.ok(lines.includes(impacts[first].reason.replace(/-(?=[xyz])/g, "−").slice(0, 30)), `${lines} | ${impacts[first].reason}`);
      assert.equal(await page.locator(".cards .alone").count(),
        await page.locator("#impact-table tbody tr").count() - 2 * counts[name]);
    });
  }
  assert.deepEqual(counts, { corner: 2, rod: 3, merged: 0 });
});

test("a row that cannot be predicted is marked in the table, in the strip and on the time line", () => onPage(EDGE, async (page) => {
  const { impacts } = sequence(...EDGE_FLAGS);
  const unknown = impacts.filter(({ predictable }) => !predictable).map(({ n }) => n);
  assert.ok(unknown.length > 0 && unknown.length < impacts.length);
  await page.waitForSelector('tr[data-model="discrete"]');
  const marked = (selector, name) => page.locator(selector).evaluateAll((all, key) => all.map((one) => Number.parseInt(one.dataset[key], 10)), name);
  assert.deepEqual(await marked('#impact-table tr.unpredictable[data-model="discrete"]', "impact"), unknown);
  const cards = await page.locator('.cards .unpredictable[data-strip^="discrete"] b').allTextContents();
  assert.deepEqual(cards, unknown.map((n) => `${n}?`));
  const marks = (await page.locator("#impact-marks span").allTextContents()).filter((text) => text.endsWith("?"));
  assert.ok(marks.length > 0 && marks.every((text) => unknown.includes(Number.parseInt(text, 10))));
  for (const title of ["Time", "Impulse"]) {
    const texts = await page.locator(`#impact-table tr[data-model="discrete"] td[data-column="${title}"]`).allTextContents();
    assert.deepEqual(texts.map((text) => text === "?"), impacts.map(({ n }) => unknown.includes(n)));
  }
  assert.match(await page.textContent("#pairing"), new RegExp(`in the discrete model impact ${unknown[0]} cannot be predicted, nor what follows`));
}));
