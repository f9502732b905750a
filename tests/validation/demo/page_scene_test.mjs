// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files on the page of `clatter demo`: opened, dropped, pasted and given back, all as the program has them.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { SHOWN, close, column, onOnePage, onPage, printed, program, waitForCell } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-page-"));
after(() => rmSync(scratch, { recursive: true }));

const BOX = '[body]\nshape = "box"\nmass = 0.2\nsize = [0.15, 0.07, 0.01]\n';
/** With impact.* keys, so that the discrete model's impacts are those of `clatter sequence`. */
const SCENES = {
  rod: '[drop]\nangle_deg = 17.25\nspeed = 2\nspin = 0.5\ntangential_velocity = -0.25\n[world]\ngravity = 3.5\n[impact]\nrestitution = 0.875\n'
    + 'friction = 0.125\n[body]\nmass = 0.5\nlength = 0.75\nradius = 0.03\n[ground]\nstiffness = 2e9\ndamping = 1e7\nsliding_friction = 0.125\n'
    + '[run]\nimpacts = 3\n',
  attitude: `[drop]\nattitude = [0.8, 0.36, -0.48, 0]\nvelocity = [0.25, 0.125, -1.5]\nangular_velocity = [1, -2, 0.5]\n[world]\ngravity = 9.81\n[impact]\nrestitution = 0.7\n`
    + `law = "stronge"\nfriction = 0.4\n${BOX}centre = [0.01, 0.002, 0]\ninertia = [1e-4, 4e-4, 4.5e-4]\n[ground]\nstiffness = 1e9\n`
    + 'static_friction = 0.5\nsliding_friction = 0.3\narea = "projected"\n[run]\nimpacts = 2\n',
  corner: `[drop]\norientation = 20\nheight = 0.4\n[impact]\nrestitution = 0.5\n${BOX}[ground]\nstiffness = 1e9\n[run]\nimpacts = 2\n`,
  planar: `[drop]\nangle_deg = 40\ntilt_deg = 5\n[impact]\nrestitution = 1\n${BOX}[ground]\nstiffness = 1e8\n[run]\nimpacts = 2\nplanar = true\n`,
  flags: '[drop]\nangle_deg = 12\n[world]\ngravity = 0\n[body]\nradius = 0\n[impact]\nimpulse_ratio = 0.2\n',
};

function written(name, text) {
  const file = path.join(scratch, name);
  writeFileSync(file, text);
  return file;
}

/** Hands a scene to the page in one of the ways there are. */
const HANDED = {
  open: (page, name, text) => page.setInputFiles("#scene-file", { name, mimeType: "application/toml", buffer: Buffer.from(text) }),
  drop: (page, name, text) => page.evaluate(([called, content]) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([content], called));
    document.getElementById("stage").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  }, [name, text]),
  paste: (page, _name, text) => page.evaluate((content) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", content);
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  }, text),
};

const said = (page, pattern) => page.waitForFunction((words) => new RegExp(words).test(document.getElementById("file-said").textContent), pattern);

/** All files are opened; dropping and pasting hand over the same text. */
const GIVEN = { open: Object.keys(SCENES), drop: ["corner", "flags"], paste: ["rod", "planar"] };

onOnePage("what is handed over", "#predict=0&hide=map,explain", Object.fromEntries(Object.entries(HANDED).map(([way, hand]) => [
  `a scene that comes by ${way} gives the program's numbers`, async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    for (const name of GIVEN[way]) {
      const text = SCENES[name];
      const file = written(`${name}.toml`, text);
      await hand(page, `${name}.toml`, text);
      await said(page, way === "paste" ? "^Opened pasted text" : `^Opened ${name}\\.toml`);
      const { impacts } = printed("sequence", file);
      await waitForCell(page, "Impulse", 0, impacts[0].impulse_normal);
      close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
      close((await column(page, "Velocity after")), impacts.map((i) => i.velocity_after[2]), 2 * SHOWN);
      if (!text.includes("stiffness")) continue;
      const run = printed("simulate", file);
      await waitForCell(page, "Peak force", 0, Number(run.impacts[0].peak_force.toPrecision(4)), "continuous");
    }
  },
])));

test("a bad scene file is told in the program's own line, and changes nothing", () => onPage("#predict=0&hide=map,explain", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  const rows = await page.locator('#impact-table tr[data-model="discrete"]').allTextContents();
  const bad = {
    "steep.toml": "[drop]\nangle_deg = 95\n", "typing.toml": "[drop]\nangel_deg = 10\n", "torn.toml": "[drop\n", "empty.toml": "# nothing\n",
    "twice.toml": "[drop]\nangle_deg = 1\nangle_deg = 2\n", "round.toml": '[drop]\nangle_deg = 10\n[body]\nshape = "ball"\n',
  };
  for (const [name, text] of Object.entries(bad)) {
    written(name, text);
    const { stderr } = spawnSync(program, ["sequence", name], { cwd: scratch, encoding: "utf8" });
    await page.evaluate(() => { document.getElementById("file-error").textContent = ""; });
    await HANDED.open(page, name, text);
    await page.waitForFunction(() => document.getElementById("file-error").textContent !== "");
    assert.equal(`clatter: ${await page.textContent("#file-error")}\n`, stderr);
  }
  await HANDED.open(page, "mesh.toml", '[drop]\nangle_deg = 10\n[body]\nshape = "mesh"\nmesh = { file = "/etc/passwd", density = 1 }\n');
  await page.waitForFunction(() => /a page can name no file/.test(document.getElementById("file-error").textContent));
  assert.deepEqual(await page.locator('#impact-table tr[data-model="discrete"]').allTextContents(), rows);
  assert.match(page.url(), /angle=10&/);
}));

test("the scene that is given back is the one that was opened", () => onPage("#predict=0&hide=map,explain", async (page, context) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.waitForSelector("#impact-table tbody tr");
  for (const [name, text] of Object.entries(SCENES)) {
    const file = written(`${name}.toml`, text);
    await HANDED.open(page, `${name}.toml`, text);
    await said(page, `^Opened ${name}`);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#download-scene")]);
    const given = readFileSync(await download.path(), "utf8");
    const back = written("back.toml", given);
    assert.deepEqual(printed("sequence", back).impacts, printed("sequence", file).impacts, name);
    if (text.includes("stiffness")) assert.deepEqual(printed("simulate", back).impacts, printed("simulate", file).impacts, name);
    await page.click("#copy-scene");
    await said(page, "^Scene copied");
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), given);
  }
}));

test("what the page shows of its own can be downloaded, and both models read it", () => onPage(
  "#predict=0&body=own-box&angle=15.5&tilt=20&speed=2&gravity=1.62&e=0.9&friction=0.25&mass=0.3&length=0.2&width=0.1&thickness=0.02&impacts=2",
  async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#download-scene")]);
    const file = await download.path();
    close(await column(page, "Impulse"), printed("sequence", file).impacts.map((i) => i.impulse_normal), SHOWN);
    const forces = printed("simulate", file).impacts.map((i) => i.peak_force);
    close(await column(page, "Peak force", "continuous"), forces, 1e-3);
  }));

/** Every way in which a drop's motion is given: what the page draws, and what it does not. */
const SHOWN_MOTIONS = ["--angle 10 --speed 2", "--angle 10 --height 1", "--angle 20 --clearance 1", "phone-damped --clearance 1", "--angle 10 --velocity 0.2,0,-2",
  "--angle 10 --speed 2 --tangential-velocity -0.5", "--angle 10 --clearance 0.5 --tangential-velocity -0.5", "--angle 10 --speed 1 --spin 2",
  "--angle 10 --speed 1 --angular-velocity 0,2,0"];
const REFUSED_MOTIONS = ["--angle 10 --release-height 1 --release-spin 2", "--release-angle 10 --release-clearance 1", "--topple 0.1",
  "--angle 10 --incline 5", "phone-damped --start rest"];
const exported = path.join(scratch, "motion.html");
const demo = (flags) => spawnSync(program, ["demo", ...flags, "--export", exported], { encoding: "utf8" });

test("a motion that the page does not draw is refused before a page is written", () => {
  for (const words of REFUSED_MOTIONS) {
    const { status, stderr } = demo(words.split(" "));
    assert.deepEqual([status, existsSync(exported)], [2, false], words);
    assert.match(stderr, /^clatter: (drop|world)\.[a-z._]+: must be left out; [^\n]*\n$/, words);
  }
});

test("of every other motion the page shows the impacts of `clatter sequence`", async () => {
  for (const words of SHOWN_MOTIONS) {
    const flags = words.split(" ");
    assert.equal(demo(flags).stderr, "", words);
    const [, written] = /name="clatter-scene" content="([^"]*)"/.exec(readFileSync(exported, "utf8"));
    await onPage(`#${written.replaceAll("&amp;", "&")}&predict=0&hide=map,explain`, async (page) => {
      const { impacts } = printed("sequence", ...flags);
      await waitForCell(page, "Impulse", 1, impacts[1].impulse_normal);
      close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
      assert.equal(await page.isVisible("#error"), false, words);
    });
  }
});

test("what no control is to blame for is said where one looks", () => onPage("#given=1&angle=10&clearance=1&topple=0.1&body=rod", async (page) => {
  await page.waitForSelector("#error:visible");
  const { y, height } = await page.locator("#error").boundingBox();
  assert.ok(y >= 0 && y + height < (await page.locator("#stage").boundingBox()).y, String(y));
}, { more: false }));

test("keys of a file without a control are named, go along in a link, and can be left out", () => onPage("#predict=0&hide=map,explain", async (page, context) => {
  await page.waitForSelector("#impact-table tbody tr");
  await HANDED.open(page, "attitude.toml", SCENES.attitude);
  await said(page, "^Opened");
  assert.match(await page.textContent("#extra-keys"), /inertia = 0\.0001,0\.0004,0\.00045; centre = 0\.01,0\.002,0/);
  const { impacts } = printed("sequence", written("attitude.toml", SCENES.attitude));
  await page.waitForFunction(() => location.hash.includes("with.centre"));
  const other = await context.newPage();
  await other.goto(page.url());
  await waitForCell(other, "Impulse", 1, impacts[1].impulse_normal);
  await other.click("#extra-forget");
  await other.waitForFunction((impulse) => {
    const cell = document.querySelector('#impact-table tr[data-model="discrete"] td[data-column="Impulse"]');
    return Math.abs(Number(cell?.textContent) - impulse) > 1e-3 * impulse;
  }, impacts[0].impulse_normal);
}));

test("what a class has locked stays, whatever scene, file or step of the story is chosen", async () => {
  const angle = (page) => page.inputValue("#angle");
  await onPage("#predict=0&lock=angle,e&angle=33", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await HANDED.open(page, "corner.toml", SCENES.corner);
    await said(page, "locked, and kept: .*turn");
    assert.equal(await angle(page), "33");
    assert.equal(await page.isVisible("#orientation"), false);
    assert.equal(await page.inputValue("#e"), "1");
    await page.selectOption("#scene", "phone-damped");
    assert.equal(await angle(page), "33");
    await page.click("#story-start");
    await page.click("#story-4 a");
    assert.equal(await angle(page), "33");
  });
  await onPage("#predict=0&lock=scene,story,sound,turn", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    for (const id of ["scene", "scene-file", "sound", "turn"]) assert.equal(await page.isDisabled(`#${id}`), true, id);
    for (const way of ["drop", "paste"]) await HANDED[way](page, "rod.toml", SCENES.rod);
    await page.click("#story-start");
    await page.click("#story-5 a");
    // The program still answers, and what it answers is the page's own situation.
    await page.fill("#gravity", "2");
    await waitForCell(page, "Impulse", 1, printed("sequence", "--angle", "10", "--gravity", "2").impacts[1].impulse_normal);
    assert.equal(await page.textContent("#file-said"), "");
  });
});
