// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `clatter demo` for those who hear it, use the keyboard or have a narrow screen: nothing serious for axe, nothing
// that sticks out, in the plane, in space, with a bad file and with the sound on.
import assert from "node:assert/strict";
import { test } from "node:test";
import { LARGE, NARROW, axeSource, onPage } from "./page_browser.mjs";

const SHOWN = "#explain-steps .katex";
const CORNER = "#predict=0&body=phone&angle=30&tilt=40&height=1&gravity=9.81&e=0.75&stiffness=1e8&impacts=4&with.centre=0,0,0.001";
const EDGE = "#predict=0&body=own-box&mass=1&length=0.1&width=0.05&thickness=0.02&orientation=7&gravity=9.81&e=0.5&friction=0.2&impact=2";
const ANY = "#predict=0&body=phone&turn=attitude&q0=0.8&q1=0.36&q2=-0.48&q3=0&vx=0.1&vy=0&vz=-1&wx=1&wy=0&wz=0";
const STATES = [["", "#prediction:not([hidden])"], ["#predict=0&friction=0.2&layout=side", SHOWN], [CORNER, SHOWN], [EDGE, SHOWN], [ANY, SHOWN]];

async function nothingSerious(page, rules) {
  // The page's own policy lets no script in from a tag; through the debugger it may come.
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate((some) => globalThis.axe.run({ rules: some }), rules);
  const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  assert.deepEqual(serious.map(({ id, nodes }) => [id, nodes.map(({ target }) => target.join(" "))]), []);
}

const MIDDLE = { width: 800, height: 900 };
/** With the rules of axe for each, none where the page is as the large one is; colours are alike in all. */
const SIZES = [[LARGE, {}], [MIDDLE, undefined], [NARROW, { "color-contrast": { enabled: false } }]];
/** The states take turns; CLATTER_THEMES=all: each in both. */
const themesOf = (state) => (process.env.CLATTER_THEMES === "all" ? ["light", "dark"] : [["light", "dark"][state % 2]]);

async function nothingSeriousInAnySize(page) {
  for (const [viewport, rules] of SIZES) {
    await page.setViewportSize(viewport);
    if (rules) await nothingSerious(page, rules);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= viewport.width, `${width} px are more than ${viewport.width}`);
  }
}

for (const [state, [query, ready]] of STATES.entries()) {
  for (const colorScheme of themesOf(state)) {
    test(`axe finds nothing serious at ${query} in ${colorScheme}, and nothing sticks out`, () => onPage(query, async (page) => {
      await page.waitForSelector(ready);
      if (ready === SHOWN) await page.waitForSelector('[data-strip="continuous-1"]');
      await nothingSeriousInAnySize(page);
    }, { colorScheme }));
  }
}

for (const colorScheme of themesOf(STATES.length)) {
  test(`axe finds nothing serious with the sound on and a bad file told in ${colorScheme}`, () => onPage("#predict=0", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    await page.check("#sound");
    assert.match(await page.textContent("#sound-caption"), /^♪ Louder/);
    await page.setInputFiles("#scene-file", { name: "bad.toml", mimeType: "application/toml", buffer: Buffer.from("bad") });
    await page.waitForSelector("#file-error:not([hidden])");
    await nothingSeriousInAnySize(page);
  }, { colorScheme }));
}

for (const colorScheme of ["light", "dark"]) {
  test(`axe finds nothing serious in the story, asking and telling, in ${colorScheme}`, () => onPage("#predict=0&hide=map,explain", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    await page.click("#story-start");
    await page.waitForSelector("#story-1[data-current]");
    await nothingSeriousInAnySize(page);
    await page.focus("#story-1 button");
    await page.keyboard.press("Enter");
    await page.waitForSelector('#story-1[data-state="tells"]');
    await nothingSeriousInAnySize(page);
  }, { colorScheme }));
}

for (const [name, viewport] of [["a phone", { width: 390, height: 800 }], ["a zoom of 200 %", { width: 640, height: 450 }]]) {
  test(`what a large screen has can be reached on ${name}, and panels are chosen instead of stacked`, () => onPage("#predict=0", async (page) => {
    await page.waitForSelector('[data-strip="continuous-1"]');
    assert.equal(await page.locator("#results > section:visible").count(), 1);
    assert.ok(await page.evaluate(() => document.documentElement.scrollHeight) < 3000);
    await page.click("#take-more");
    await page.click("#options");
    for (const id of ["lecture", "picture", "film", "gif", "handout-print", "lesson-print", "exercises-print", "answers-print", "print", "save-page", "copy-link",
      "rate", "slow", "with-continuous", "traces", "speeds", "sound", "story-start"]) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box && box.x >= 0 && box.x + box.width <= viewport.width, id);
    }
    for (const words of ["discrete model", "continuous model"]) assert.equal(await page.locator("#motion .legend span", { hasText: words }).first().isVisible(), true, words);
    for (const tab of ["numbers", "table", "profile", "fan", "force", "map", "explain", "race", "measured", "strip"]) {
      await page.click(`[data-tab="${tab}"]:is(button)`);
      assert.equal(await page.isVisible(`#panel-${tab}`), true, tab);
    }
    const small = await page.locator("button:visible, select:visible").evaluateAll((all) => all.map((one) => [one.id || one.textContent, one.getBoundingClientRect()])
      .filter(([, { width, height }]) => width < 24 || height < 24).map(([one]) => one));
    assert.deepEqual(small, []);
    await page.waitForFunction(() => !location.hash.includes("tab="));
  }, { viewport, more: false }));
}

test("a wrong scene file is told where one looks, with all controls folded", () => onPage("#predict=0", async (page) => {
  await page.waitForSelector('[data-strip="discrete-1"]');
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.setData("text/plain", "[drop]\nangle = 3");
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true }));
  });
  await page.waitForSelector("#file-error:visible");
  assert.match(await page.textContent("#file-error"), /drop\.angle/);
  const { y, height } = await page.locator("#file-error").boundingBox();
  assert.ok(y >= 0 && y + height <= LARGE.height, `${y}`);
}, { more: false }));

test("a scrubber of 60 impacts is as wide as the picture", () => onPage("#predict=0&impacts=20", async (page) => {
  await page.waitForSelector('[data-strip="discrete-1"]');
  const [scrubber, stage] = [await page.locator("#scrubber").boundingBox(), await page.locator("#stage").boundingBox()];
  assert.ok(scrubber.width > 0.98 * stage.width);
}));

test("scene files, attitude, strip and story can be reached by the keyboard alone", () => onPage("#predict=0&body=phone&turn=attitude&q0=1&q1=0&q2=0&q3=0", async (page) => {
  await page.waitForSelector('[data-strip="discrete-1"]');
  const reached = new Set();
  for (let i = 0; i < 200; i++) {
    await page.keyboard.press("Tab");
    const name = await page.evaluate(() => {
      const { id, dataset, ariaLabel, parentElement } = document.activeElement;
      return id || dataset.strip || ariaLabel || parentElement?.id || "";
    });
    reached.add(name);
  }
  for (const wanted of ["scene-file", "download-scene", "copy-scene", "turn", "q0", "Turn about x −15°", "drop", "spinning", "sound", "discrete-1", "race-time", "measured-play", "story-start"]) {
    assert.ok(reached.has(wanted), `${wanted} is not among ${[...reached].join(", ")}`);
  }
  await page.focus("#story-start");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.closest("li").id), "story-1");
}));
