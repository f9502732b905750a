// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `clatter demo` as it tells its story: untouched, without JavaScript, and to the ear.
import assert from "node:assert/strict";
import { test } from "node:test";
import { LARGE, NARROW, onOnePage, onPage, printed, sequence } from "./page_browser.mjs";

const numbersIn = (text) => (text.match(/\d+(?:\.\d+)?/g) ?? []).map(Number);
const has = (text, value, digits) => {
  const place = Number(value.toPrecision(digits));
  assert.ok(numbersIn(text).some((shown) => Math.abs(shown - place) <= 1e-12 * place), `${place} is not in: ${text}`);
};

async function storyOf(page) {
  await page.waitForSelector("#story", { state: "attached" });
  return page.locator("#story .reveal p").allTextContents();
}

onOnePage("the page as one finds it", "", {
  "untouched, the page shows the second blow, the doubling and the fold in five steps, with the program's numbers": async (page) => {
    const [first, second, doubling, fold, phone] = await storyOf(page);
    const rod = sequence("--angle", "10").impacts;
    has(first, rod[0].impulse_normal, 4);
    has(first, rod[0].angular_velocity_after[1], 4);
    has(second, rod[1].approach_speed, 4);
    has(second, rod[1].start, 3);
    has(second, rod[1].impulse_normal, 4);
    has(second, rod[1].impulse_normal / rod[0].impulse_normal, 3);
    for (const [angle, digits] of [["10", 4], ["1", 5], ["0.1", 6]]) {
      const [one, two] = sequence("--angle", angle).impacts;
      has(doubling, two.impulse_normal / one.impulse_normal, digits);
    }
    const flat = sequence("--angle", "0.1").impacts.map((i) => i.contact_angle_deg);
    has(doubling, (2 * flat[1]) / flat[0], 5);
    const { rows: [regimes] } = printed("angles", "--regimes");
    has(fold, regimes.second.theta_deg, 6);
    has(fold, regimes.second.beta_deg, 4);
    has(fold, regimes.third.theta_deg, 6);
    // What the picture's caption says, by the discrete model, and beside it the other one.
    const drop = sequence("--body", "box", "--mass", "0.08814", "--size", "0.10566x0.04394x0.01905", "--angle", "10", "--height", "1", "--gravity", "9.81").impacts;
    for (const { impulse_normal: impulse } of drop.slice(0, 2)) has(phone, impulse, 3);
    has(phone, drop[1].impulse_normal / drop[0].impulse_normal, 2);
    const { impacts } = printed("simulate", "phone-elastic", "--impacts", "2");
    has(phone, impacts[1].impulse_normal / impacts[0].impulse_normal, 3);
    assert.equal(await page.locator("#story svg").count(), 5);
  },
  "a step of the story is shown in the picture, and opens as a link by itself": async (page, context) => {
    await page.waitForSelector("#prediction:not([hidden])");
    await page.click("#prediction-skip");
    await page.click("#story-start");
    await page.click("#story-4 a");
    assert.equal(await page.inputValue("#angle"), "58.48");
    await page.waitForFunction(() => /^Impact 2: end b/.test(document.getElementById("caption").textContent));
    await page.click("#story-5 a");
    await page.waitForFunction(() => /^Impact 2/.test(document.getElementById("caption").textContent) && document.getElementById("body").value === "phone");
    const other = await context.newPage();
    const link = await page.locator("#story-2 a").evaluate((one) => one.href);
    await other.goto(link);
    await other.waitForFunction(() => /^Impact 2: end b, 0\.087 s/.test(document.getElementById("caption").textContent));
  },
});

test("what the answers say of friction is the program's and a formula's", () => onPage("#predict=0&hide=explain,map", async (page) => {
  const answer = (await page.locator("#answers li").allTextContents()).at(-1);
  const [sine, cosine] = [Math.sin(Math.PI / 18), Math.cos(Math.PI / 18)];
  const least = (3 * sine * cosine) / (1 + 3 * sine ** 2);
  has(answer, least, 2);
  const first = (friction) => sequence("--angle", "10", "--friction", String(friction)).impacts[0].impulse_normal;
  assert.ok(first(0.99 * least) < first(1.01 * least));
  assert.equal(first(1.01 * least), first(1));
  for (const friction of [0, 1]) has(answer, first(friction), 3);
}));

/** Scrolls a step to where the story takes it up, and waits for its drop. */
async function scrollTo(page, step, angle) {
  await page.locator(`#story-${step}`).evaluate((one) => one.scrollIntoView({ block: "end" }));
  await page.waitForSelector(`#story-${step}[data-current]`);
  await page.waitForFunction((wanted) => document.getElementById("angle").value === wanted && document.getElementById("caption").textContent === "Falling"
    && document.getElementById("spinner").textContent === "", angle);
}

for (const [browser, viewport] of [["chromium", LARGE], ["firefox", LARGE], ["chromium", { width: 390, height: 844 }]]) {
  test(`in ${browser}, ${viewport.width} wide, the picture stays while the story scrolls: each step asks, plays and then tells`, () => onPage("#predict=0&hide=explain", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const ratio = (flags) => { const [one, two] = sequence(...flags).impacts; return two.impulse_normal / one.impulse_normal; };
    const phone = printed("simulate", "phone-elastic", "--impacts", "2").impacts;
    assert.equal(sequence("--angle", "58.49").impacts.length, 1);
    // What is nearest to the program's numbers.
    const answers = [["About a quarter of that", sequence("--angle", "10").impacts[0].impulse_normal / 2 / 0.25], ["Twice as hard", ratio(["--angle", "10"]) / 2],
      ["Twice as hard", ratio(["--angle", "0.1"]) / 2], ["It comes later and then not at all", 1], ["The second", phone[1].impulse_normal / phone[0].impulse_normal / 2]];
    const angles = ["10", "10", "1", "58.48", "10"];
    await page.click("#story-start");
    for (const [i, [answer, share]] of answers.entries()) {
      assert.ok(share > 0.8 && share < 1.2, `${answer}: ${share}`);
      const step = page.locator(`#story-${i + 1}`);
      await scrollTo(page, i + 1, angles[i]);
      const { top, bottom } = await page.locator("#stage").evaluate((stage) => stage.getBoundingClientRect());
      assert.ok(top >= 0 && bottom < 0.72 * viewport.height, `${top} to ${bottom}`);
      for (const part of [".reveal", ".show"]) assert.equal(await step.locator(part).isVisible(), part === ".show", part);
      assert.equal(await page.isVisible("#impact-table"), false);
      // The first step is guessed wrong.
      const guess = step.locator("button", { hasText: i === 0 ? /^2 N/ : answer });
      await guess.focus();
      await page.keyboard.press("Enter");
      await page.waitForSelector(`#story-${i + 1}[data-state="tells"]`);
      assert.equal(await step.locator(".verdict").textContent(), i === 0 ? `A surprise: ${answer.toLowerCase()}.` : "You guessed it.");
      assert.equal(await step.locator(".reveal").isVisible(), true);
    }
    assert.equal(await page.isVisible("#impact-table"), true);
    await page.click("#story-start");
    assert.equal(await page.isVisible("#story-1"), false);
    // The reader has his own scene again.
    assert.equal(await page.inputValue("#body"), "rod");
  }, { browser, viewport }));
}

test("a step of the story tells only when the picture has come to the blow, and stops before what the next one asks", () => onPage("#predict=0&hide=explain,map", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await page.click("#story-start");
  await scrollTo(page, 1, "10");
  // Frames come when the test gives them.
  await page.evaluate(() => {
    const waiting = [];
    window.requestAnimationFrame = (frame) => waiting.push(frame);
    let now = 1000;
    globalThis.isPlaying = () => waiting.length > 0;
    globalThis.frames = (until) => { for (let i = 0; i < 2000 && !until(); i++) { now += 50; for (const frame of waiting.splice(0)) frame(now); } };
  });
  await page.locator("#story-1 button", { hasText: "quarter" }).click();
  await page.waitForFunction(() => globalThis.isPlaying(), null, { polling: 50 });
  await page.evaluate(() => globalThis.frames(() => !globalThis.isPlaying()));
  assert.match(await page.textContent("#caption"), /^Impact 1/);
  assert.equal(await page.getAttribute("#story-1", "data-state"), "tells");
  assert.equal(await page.isVisible("#results"), false);
  await scrollTo(page, 2, "10");
  await page.locator("#story-2 button", { hasText: "Twice" }).click();
  await page.waitForFunction(() => globalThis.isPlaying(), null, { polling: 50 });
  const caption = () => page.textContent("#caption");
  await page.evaluate(() => globalThis.frames(() => /^Impact 1/.test(document.getElementById("caption").textContent)));
  assert.match(await caption(), /^Impact 1/);
  assert.equal(await page.getAttribute("#story-2", "data-state"), "waits");
  assert.equal(await page.textContent("#story-2 .verdict"), "Watch …");
  await page.evaluate(() => globalThis.frames(() => /^Impact 2/.test(document.getElementById("caption").textContent)));
  assert.equal(await page.getAttribute("#story-2", "data-state"), "tells");
}, { reducedMotion: "no-preference" }));

for (const [name, viewport] of [["large", LARGE], ["narrow", NARROW]]) {
  test(`without JavaScript the story stands there as text and pictures, on a ${name} screen`, async () => {
    await onPage("", async (page) => {
      assert.equal((await storyOf(page)).length, 5);
      for (const step of [1, 2, 3, 4, 5]) {
        for (const part of ["h3", ".reveal p", "svg[role=img][aria-label]"]) {
          const box = await page.locator(`#story-${step} ${part}`).boundingBox();
          assert.ok(box && box.width > 100 && box.x >= 0 && box.x + box.width <= viewport.width, `${step} ${part}`);
        }
      }
      const dead = await page.locator("main, header").locator("button:visible, input:visible, select:visible, a:visible, canvas:visible").count();
      assert.equal(dead, 0);
      assert.equal(await page.locator("noscript code").first().isVisible(), true);
    }, { viewport, javaScriptEnabled: false });
  });
}

/** An ear: every tone that starts, with its loudness and pitch. */
function listen() {
  globalThis.heard = [];
  globalThis.contexts = 0;
  const node = () => ({ connect: (other) => other });
  globalThis.AudioContext = class {
    currentTime = 0;
    destination = node();
    constructor() { globalThis.contexts += 1; }
    resume() { return Promise.resolve(); }
    suspend() { return Promise.resolve(); }
    createGain() {
      const gain = { setValueAtTime: (value) => { this.level = value; }, setTargetAtTime: () => undefined };
      return { ...node(), gain };
    }
    createOscillator() {
      const frequency = { value: 0 };
      return { ...node(), frequency, stop: () => undefined, start: () => globalThis.heard.push({ gain: this.level, pitch: frequency.value }) };
    }
  };
}

test("sound is off until it is asked for; then blows sound as their impulses and angles, 2:1:2, and are told in a line", () => onPage(
  "#predict=0&angle=0.5&rate=2&sound=1", async (page) => {
    await page.waitForSelector('tr[data-model="discrete"]');
    const { impacts } = sequence("--angle", "0.5");
    assert.equal(impacts.length, 3);
    const played = (count) => page.waitForFunction((n) => {
      const button = document.getElementById("play");
      return button.getAttribute("aria-label") === "Play" && globalThis.heard.length >= n;
    }, count);
    await page.click("#play");
    await played(0);
    assert.deepEqual(await page.evaluate(() => [globalThis.heard.length, globalThis.contexts]), [0, 0]);
    assert.equal(await page.isChecked("#sound"), false);
    await page.check("#sound");
    const captions = page.evaluate(() => new Promise((resolve) => {
      const lines = [];
      new MutationObserver(() => {
        lines.push(document.getElementById("sound-caption").textContent);
        if (lines.length === 3) resolve(lines);
      }).observe(document.getElementById("sound-caption"), { childList: true, characterData: true, subtree: true });
    }));
    await page.click("#play");
    const lines = await captions;
    await played(3);
    const heard = await page.evaluate(() => globalThis.heard);
    assert.equal(heard.length, 3);
    const near = (value, expected) => assert.ok(Math.abs(value - expected) < 1e-9 * expected, `${value} is not ${expected}`);
    heard.forEach(({ gain, pitch }, i) => {
      near(gain / heard[0].gain, impacts[i].impulse_normal / impacts[0].impulse_normal);
      near(pitch / heard[0].pitch, impacts[i].contact_angle_deg / impacts[0].contact_angle_deg);
    });
    assert.deepEqual(heard.map(({ pitch }) => (pitch / heard[1].pitch).toFixed(2)), ["2.00", "1.00", "2.00"]);
    assert.deepEqual(lines, ["♪ Impact 1", "♪ Impact 2: twice as loud as the first, an octave lower", "♪ Impact 3: about as loud as the first, about as high"]);
    assert.ok(!page.url().includes("sound"));
  }, { before: listen }));
