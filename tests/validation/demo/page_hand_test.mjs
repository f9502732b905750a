// SPDX-License-Identifier: GPL-3.0-or-later
// The body in the hand, honest time and the guess: taken, tilted, lifted and let go with mouse, finger and keys; how much slower than
// life is said; no number of before a blow stands beside one of after it; and nothing gives the guess away.
import assert from "node:assert/strict";
import { test } from "node:test";
import { LARGE, column, number, onOnePage, onPage, sequence, waitForCell } from "./page_browser.mjs";

const NARROW = { width: 390, height: 800 };
/** What a browser on a laptop or a projector leaves of 1280 × 720. */
const LAPTOP = { width: 1280, height: 657 };
/** Half the breadth of the thin rod as it is drawn, with its outline. */
const ROD = 4;

/** Where a label of the picture stands in the window. */
const placeOf = (page, text) => page.locator(".stage-label.end", { hasText: new RegExp(`^${text}$`) }).first().evaluate((label) => {
  const { x, y, width, height } = label.getBoundingClientRect();
  return { x: x + width / 2, y: y + height / 2 };
});

/** The drop is the program's for what the controls now say. */
async function isDropped(page, changed) {
  await page.waitForFunction(() => document.getElementById("gravity").value === "9.81");
  const [angle, height] = await Promise.all(["angle", "height"].map((id) => page.inputValue(`#${id}`)));
  assert.ok(changed({ angle: Number(angle), height: Number(height) }), `${angle}°, ${height} m`);
  const { impacts } = sequence("--angle", angle, "--height", height, "--gravity", "9.81");
  await waitForCell(page, "Impulse", 1, impacts[1].impulse_normal);
}

for (const browser of ["chromium", "firefox"]) {
  onOnePage(`in ${browser}`, "#predict=0&hide=map,explain", {
    "the keys tilt the body, lift it and let it go, turn the view and set it back": async (page) => {
      await page.waitForSelector("#impact-table tbody tr");
      assert.equal(await page.isVisible("#grab-hint"), true);
      await page.focus("#stage");
      for (let i = 0; i < 5; i++) await page.keyboard.press("]");
      for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowUp");
      assert.match(await page.textContent("#caption"), /^In your hand: 15\.0°/);
      await page.keyboard.press("Enter");
      await isDropped(page, ({ angle, height }) => angle === 15 && Math.abs(height - (0.5 * Math.sin(Math.PI / 12) + 0.12)) < 0.02);
      // Who has found out needs no hint.
      assert.equal(await page.isVisible("#grab-hint"), false);
      assert.equal(await page.isVisible("#view-reset"), false);
      await page.keyboard.press("Shift+ArrowLeft");
      await page.keyboard.press("+");
      assert.equal(await page.isVisible("#view-reset"), true);
      await page.keyboard.press("0");
      assert.equal(await page.isVisible("#view-reset"), false);
    },
    "an end is pulled up with the mouse, the middle lifted, and the body falls from there": async (page) => {
      const pull = async (from, to) => {
        await page.mouse.move(from.x, from.y);
        await page.mouse.down();
        await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
        await page.mouse.move(to.x, to.y);
        assert.match(await page.textContent("#caption"), /^In your hand: \d+/);
        await page.mouse.up();
      };
      const [a, b] = [await placeOf(page, "a"), await placeOf(page, "b")];
      // By as much as makes some 10° more of it.
      await pull(b, { x: b.x - 20, y: b.y - (b.x - a.x) * 0.17 });
      await isDropped(page, ({ angle }) => angle > 20 && angle < 45);
      const [c, d] = [await placeOf(page, "a"), await placeOf(page, "b")];
      const before = Number(await page.inputValue("#height"));
      const middle = { x: (c.x + d.x) / 2, y: (c.y + d.y) / 2 };
      await pull(middle, { x: middle.x, y: middle.y - 60 });
      await isDropped(page, ({ height }) => height > before);
    },
  }, { browser });
}

test("with a finger, too, while the picture stays above the controls of a phone", () => onPage("#predict=0&hide=map,explain", async (page, context) => {
  await page.waitForSelector("#impact-table tbody tr");
  const session = await context.newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  const b = await placeOf(page, "b");
  await touch("touchStart", b);
  await touch("touchMove", { x: b.x - 10, y: b.y - 30 });
  await touch("touchMove", { x: b.x - 20, y: b.y - 60 });
  await touch("touchEnd");
  await isDropped(page, ({ angle }) => angle > 15 && angle < 60);
  await page.locator("#gravity").scrollIntoViewIfNeeded();
  const { top, bottom } = await page.locator("#stage").evaluate((stage) => stage.getBoundingClientRect());
  assert.ok(top >= 0 && bottom < 500, `${top} to ${bottom}`);
}, { viewport: NARROW, hasTouch: true, isMobile: true }));

test("no number of before a blow stands beside one of after it, at any time", () => onPage("#predict=0&stiffness=1e8&hide=map,explain", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  const shown = await page.locator("#scrubber").evaluate((scrubber) => Array.from({ length: 41 }, (_none, step) => {
    scrubber.value = String(25 * step);
    scrubber.dispatchEvent(new Event("input", { bubbles: true }));
    const spin = [...document.querySelectorAll("#numbers-table tbody tr")].find((row) => row.textContent.startsWith("Spin"));
    return [document.getElementById("numbers-title").textContent, spin.querySelectorAll("td")[2].textContent];
  }));
  // A blow changes the spin by 3 rad/s and more.
  for (const [title, difference] of shown) if (difference !== "–") assert.ok(Math.abs(number(difference)) < 0.5, `${title}: ${difference}`);
  const seen = new Set(shown.map(([title]) => title.replace(/\d+\.\d+/, "")));
  assert.ok([...seen].some((title) => /after blow 2, each/.test(title)), [...seen].join("; "));
}));

for (const viewport of [LAPTOP, LARGE]) {
  test(`at ${viewport.width} × ${viewport.height} the question stands below the picture, over which nothing tells of time or blows, in a lecture, too`, () => onPage(
    "#body=phone&height=1&gravity=9.81&angle=20&e=0.5&stiffness=1e8&hide=map,explain", async (page) => {
      await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
      const nothingTells = async () => {
        for (const part of ["#panel-strip", "#panel-table", "#caption", "#pace", "#busy"]) assert.equal(await page.isVisible(part), false, part);
        assert.equal(await page.locator(".stage-label.blow").count(), 0);
        const [stage, card] = await Promise.all(["#stage", "#prediction"].map((part) => page.locator(part).boundingBox()));
        assert.ok(stage.height > 150 && card.y >= stage.y + stage.height && card.y + card.height <= viewport.height, JSON.stringify([stage, card]));
      };
      await nothingTells();
      await page.click("#lecture");
      await nothingTells();
      assert.equal(await page.textContent("#lecture"), "End the lecture");
      for (const guess of ["harder", "harder", "softer"]) await page.click(`button[data-guess="${guess}"]`);
      await page.evaluate(() => document.body.classList.add("watching"));
      assert.equal(await page.isVisible("#panel-strip"), false);
      await page.click("#prediction-skip");
      // Without motion the second blow is shown at once.
      await page.waitForFunction(() => /The class: Yes · 2, About the same, No · 1\.$/.test(document.getElementById("prediction-reveal").textContent));
      assert.equal(await page.isVisible("#panel-strip"), true);
    }, { viewport, more: false }));
}

test("how much slower than life it is stands beside the picture, and a button plays life itself", () => onPage("#predict=0&hide=map,explain", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  assert.match(await page.textContent("#pace"), /^\d+ times slower than life$/);
  // By frames that the test gives, 10 ms apart.
  const [said, moved] = await page.evaluate(() => {
    const waiting = [];
    window.requestAnimationFrame = (frame) => waiting.push(frame);
    const frameAt = (now) => { for (const frame of waiting.splice(0)) frame(now); };
    const time = () => Number(document.getElementById("time").textContent.replace("−", "-").replace(" ms", ""));
    document.getElementById("real").click();
    frameAt(1000);
    const before = time();
    for (let now = 1010; now <= 1050; now += 10) frameAt(now);
    return [document.getElementById("pace").textContent, time() - before];
  });
  assert.equal(said, "as fast as it happens");
  assert.ok(Math.abs(moved - 50) <= 0.2, `${moved} ms of 50`);
}));

test("before the second blow has been seen nothing on the page tells how hard it is", () => onPage("", async (page) => {
  await page.waitForSelector("#prediction:not([hidden])");
  assert.ok(!/hard|second/i.test(await page.title()));
  const telling = ["#impact-table", "#story", "#strip-rows", "#energy-table", "#caption", "#panel-profile"];
  for (const part of telling) assert.equal(await page.isVisible(part), false, part);
  await page.click('button[data-guess="softer"]');
  for (const part of telling.filter((one) => one !== "#caption")) assert.equal(await page.isVisible(part), false, part);
  assert.equal(await page.textContent("#prediction-reveal"), "Watch the second blow …");
  await page.waitForFunction(() => document.getElementById("impact-marks").textContent.includes("2"), null, { polling: 50 });
  // The picture comes to the first blow, which is no answer yet.
  for (let i = 0; i < 2 && !/^Impact 1:/.test(await page.textContent("#caption")); i++) await page.click("#next");
  assert.match(await page.textContent("#caption"), /^Impact 1:/);
  assert.equal(await page.textContent("#prediction-reveal"), "Watch the second blow …");
  for (let i = 0; i < 2 && !/^Impact 2:/.test(await page.textContent("#caption")); i++) await page.click("#next");
  assert.match(await page.textContent("#prediction-reveal"), /^A surprise: .*twice as hard as the first: 1\.003 N·s after 0\.5116 N·s/);
  for (const part of telling) assert.equal(await page.isVisible(part), true, part);
  // Nothing moves by itself here.
}, { reducedMotion: "no-preference", before: () => { window.requestAnimationFrame = () => 0; } }));

test("who wants no motion is shown the second blow, and told, as soon as the guess is made", () => onPage("", async (page) => {
  await page.waitForFunction(() => document.getElementById("impact-marks").textContent.includes("2"));
  await page.click('button[data-guess="harder"]');
  assert.match(await page.textContent("#caption"), /^Impact 2:/);
  assert.match(await page.textContent("#prediction-reveal"), /^You guessed it/);
}));

/** How long the drawn body is, and where its middle stands [px]. */
async function drawn(page) {
  const [a, b] = [await placeOf(page, "a"), await placeOf(page, "b")];
  return { length: Math.hypot(b.x - a.x, b.y - a.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

for (const fragment of ["#predict=0&hide=map,explain&impact=3", "#predict=0&hide=map,explain&body=phone&height=1&gravity=9.81&e=0.7&impact=2"]) {
  test(`the body stays as large and where it is under the pointer when it is taken at ${fragment}`, () => onPage(fragment, async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const before = await drawn(page);
    await page.mouse.move(before.x, before.y);
    await page.mouse.down();
    await page.mouse.move(before.x, before.y - 1);
    const taken = await drawn(page);
    for (const part of ["length", "x", "y"]) assert.ok(Math.abs(taken[part] - before[part]) < 6, `${part}: ${taken[part]} px after ${before[part]}`);
    await page.mouse.move(before.x, before.y - 30);
    const lifted = await drawn(page);
    assert.ok(Math.abs(lifted.length - before.length) < 0.03 * before.length && Math.abs(before.y - 30 - lifted.y) < 8, JSON.stringify([before, lifted]));
    await page.mouse.up();
  }));
}

test("where nothing falls by itself the hand says that letting go switches gravity on", () => onPage("#predict=0&hide=map,explain", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  await page.focus("#stage");
  await page.keyboard.press("ArrowUp");
  assert.match(await page.textContent("#caption"), /Let go to drop it, with gravity switched on\.$/);
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.getElementById("gravity").value === "9.81");
  await page.keyboard.press("ArrowUp");
  assert.match(await page.textContent("#caption"), /Let go to drop it\.$/);
}));

test("a drop that a link locks, or whose controls it hides, is in nobody's hand: not by pointer, key, file or map", async () => {
  for (const fragment of ["lock=all", "hide=controls"]) await onPage(`#predict=0&${fragment}`, async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const before = await column(page, "Impulse");
    const { x, y, width, height } = await page.locator("#stage").boundingBox();
    await page.mouse.move(x + width / 2, y + 0.8 * height);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + 0.4 * height, { steps: 4 });
    await page.mouse.up();
    await page.focus("#stage");
    for (const key of ["ArrowUp", "]", "Enter"]) await page.keyboard.press(key);
    await page.locator("#map-chart .u-over").click({ position: { x: 200, y: 100 } });
    await page.evaluate(() => {
      const clipboardData = new DataTransfer();
      clipboardData.setData("text/plain", "[drop]\nangle = 30\nspeed = 1\n");
      document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
    });
    assert.equal(await page.isVisible("#grab-hint"), false);
    assert.deepEqual(await column(page, "Impulse"), before);
    assert.match(page.url(), new RegExp(`&${fragment}(&|$)`));
    for (const field of await page.locator("#panel-controls :is(input:not(#ask-first), select):visible").all()) assert.ok(await field.isDisabled());
  });
});

test("a first visit shows angle, restitution and gravity; the rest is under More", () => onPage("", async (page) => {
  const shown = await page.locator('#panel-controls input[type="number"]:visible').evaluateAll((fields) => fields.map(({ id }) => id));
  assert.deepEqual(shown, ["angle", "e", "gravity"]);
  await page.click("#more > summary");
  assert.equal(await page.isVisible("#friction"), true);
}, { more: false }));

test("in a lecture the picture is large, a class votes by hands, and the most are judged", () => onPage("", async (page) => {
  await page.waitForSelector("#prediction:not([hidden])");
  const before = (await page.locator("#stage").boundingBox()).height;
  await page.click("#lecture");
  assert.ok((await page.locator("#stage").boundingBox()).height > before);
  assert.equal(await page.isVisible("#panel-controls"), false);
  for (const guess of ["harder", "softer", "harder"]) await page.click(`button[data-guess="${guess}"]`);
  assert.equal(await page.textContent('button[data-guess="harder"]'), "Yes · 2");
  await page.click("#prediction-skip");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => /^You guessed it/.test(document.getElementById("prediction-reveal").textContent));
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !document.body.classList.contains("lecture"));
}));

test("a pupils' page has the exercises, and no sheet, lecture or print that holds their answers: its handout ends at the fold", () => onPage("#hide=answers", async (page) => {
  await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
  const visible = (...parts) => Promise.all(parts.map((part) => page.isVisible(part)));
  assert.deepEqual(await visible("#exercises-print", "#handout-print", "#answers-print", "#lesson-print", "#lecture", "#print"), [true, true, false, false, false, false]);
  const telling = ["#story", "#panel-strip", "#panel-table", "#panel-profile", "#panel-numbers", "#panel-explain", "#handout .fold"];
  for (const way of ["a browser's own print", "the handout"]) {
    if (way === "the handout") await page.evaluate(() => { window.print = () => undefined; document.getElementById("handout-print").click(); });
    await page.emulateMedia({ media: "print" });
    assert.deepEqual([way, await visible(...telling)], [way, telling.map(() => false)]);
    assert.equal(await page.isVisible("#handout-drop"), way === "the handout");
    await page.emulateMedia({ media: "screen" });
  }
}));

test("each other drop is asked about, until one is only shown", () => onPage("", async (page) => {
  const asks = () => page.isVisible("#prediction");
  const said = (words) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.getElementById("prediction-reveal").textContent), words);
  await page.click('button[data-guess="softer"]');
  await said("^A surprise: .*1\\.003 N·s");
  for (const [angle, impulse] of [["5", "1\\.001"], ["0.1", "1\\.000"]]) {
    await page.fill("#angle", angle);
    assert.deepEqual([await asks(), await page.isVisible("#panel-strip"), await page.textContent("#prediction-reveal")], [true, false, ""]);
    await page.click('button[data-guess="harder"]');
    await said(`^You guessed it.*: ${impulse} N·s`);
  }
  await page.fill("#stiffness", "1e9");  // the same drop
  assert.equal(await asks(), false);
  await page.fill("#gravity", "9.81");
  await page.click("#prediction-skip");
  await page.fill("#angle", "20");
  assert.deepEqual([await asks(), await page.isChecked("#ask-first")], [false, false]);
}));

test("a guess is judged, and the table begins, with the discrete model, even where the continuous one answers first", () => onPage("", async (page) => {
  await page.click('button[data-guess="softer"]');
  await page.waitForSelector('#impact-table tr[data-model="continuous"]', { state: "attached" });
  assert.equal(await page.locator('#impact-table tr[data-model="discrete"]').count(), 3);
  await page.waitForFunction(() => /^A surprise: .*1\.003 N·s/.test(document.getElementById("prediction-reveal").textContent));
}, { before: () => {
  // The discrete model is asked once the other has answered.
  const post = Worker.prototype.postMessage;
  let held = [];
  Worker.prototype.postMessage = function late(data) {
    const ask = () => post.call(this, data);
    if (data[0] === "simulate") this.addEventListener("message", () => { held?.forEach((other) => other()); held = null; });
    if (held && data[0] === "sequence") held.push(ask);
    else ask();
  };
} }));

test("who skips to the motion keeps the drop and what its link hides and locks", () => onPage("#angle=25&hide=answers&lock=all", async (page) => {
  await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
  const address = page.url();
  await page.focus(".skip");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "motion");
  assert.equal(page.url(), address);
  assert.deepEqual([await page.inputValue("#angle"), await page.isVisible("#answers-print"), await page.isDisabled("#angle")], ["25", false, true]);
}));

for (const browser of ["chromium", "firefox"]) test(`a decimal comma is a point in ${browser}`, () => onPage("#predict=0", async (page) => {
  await page.fill("#angle", "");
  await page.focus("#angle");
  await page.keyboard.type("1,5");
  assert.equal(await page.inputValue("#angle"), "1.5");
}, { browser }));

test("of a steep drop it is open whether it strikes again, and that it does not is told at once", async () => {
  for (const [angle, count, verdict] of [["70", 1, /^You guessed it\. There is no second blow/], ["50", 2, /^A surprise: The second blow is/]]) {
    assert.ok(sequence("--angle", angle).impacts.length >= count && (count > 1 || sequence("--angle", angle).impacts.length === 1));
    await onPage(`#angle=${angle}`, async (page) => {
      await page.waitForSelector('button[data-guess="none"]:visible');
      assert.match(await page.locator("#prediction-question").innerText(), /If it strikes again, is the second blow harder/);
      await page.click('button[data-guess="none"]');
      await page.waitForFunction(() => /blow/.test(document.getElementById("prediction-reveal").textContent) && !document.body.classList.contains("watching"));
      assert.match(await page.textContent("#prediction-reveal"), verdict);
    });
  }
  await onPage("", async (page) => {
    await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
    assert.equal(await page.isVisible('button[data-guess="none"]'), false);
  });
});

test("a class that is divided is judged by neither answer, whoever began", () => onPage("", async (page) => {
  await page.waitForSelector("#prediction:not([hidden])");
  await page.click("#lecture");
  for (const guess of ["harder", "softer"]) await page.click(`button[data-guess="${guess}"]`);
  await page.click("#prediction-skip");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => /^The class is divided: The second blow is .* The class: Yes · 1, About the same, No · 1/.test(
    document.getElementById("prediction-reveal").textContent));
}));

test("a lecture fits its window: question, picture, playback and the list of blows", () => onPage("", async (page) => {
  const inside = async (part) => {
    const { x, y, width, height } = await page.locator(part).boundingBox();
    const fits = x >= 0 && y >= 0 && x + width <= LAPTOP.width && y + height <= LAPTOP.height;
    assert.ok(height > 0 && fits, `${part}: ${y} + ${height}`);
  };
  const scrolls = () => page.evaluate(() => document.documentElement.scrollHeight > innerHeight);
  await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
  await page.click("#lecture");
  for (const part of ["#stage", "#prediction"]) await inside(part);
  assert.equal(await scrolls(), false);
  await page.click('button[data-guess="harder"]');
  await page.click("#prediction-skip");
  for (let i = 0; i < 2; i++) await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => /^You guessed it/.test(document.getElementById("prediction-reveal").textContent));
  for (const part of ["#stage", "#prediction-reveal", "#caption", ".transport"]) await inside(part);
  for (const n of [1, 3]) await inside(`[data-strip="discrete-${n}"]`);
  assert.ok((await page.locator("#stage").boundingBox()).height > 0.4 * LAPTOP.height);
  assert.equal(await scrolls(), false);
  await page.click('[data-strip="discrete-2"]');
  assert.match(await page.textContent("#caption"), /^Impact 2/);
}, { viewport: LAPTOP }));

for (const [angle, n] of [[2, 1], [10, 1], [10, 2], [24, 1], [50, 1], [80, 1]]) {
  test(`the angle of blow ${n} of a rod let go at ${angle}° stands beside the rod, not on it`, () => onPage(
    `#predict=0&hide=map,explain&gravity=9.81&e=0.8&angle=${angle}&impact=${n}`, async (page) => {
      await page.waitForSelector('tr[data-model="continuous"]');
      await page.locator(".stage-label.angle").waitFor();
      const [a, b] = (await Promise.all(["a", "b"].map((end) => placeOf(page, end)))).map(({ x, y }) => [x, y]);
      const { x, y, width, height } = await page.locator(".stage-label.angle").boundingBox();
      // On which side of the line from a to b each corner of the text lies, and how far from it.
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const distances = [[x, y], [x + width, y], [x, y + height], [x + width, y + height]]
        .map(([p, q]) => ((b[0] - a[0]) * (q - a[1]) - (b[1] - a[1]) * (p - a[0])) / length);
      assert.ok(Math.min(...distances) > ROD || Math.max(...distances) < -ROD, distances.join(" "));
    }));
}

test("on paper the picture is there, no table is cut, and no control stands there", () => onPage("#predict=0", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: 700, height: 1000 });
  for (const part of ["#panel-controls", ".transport", "#copy-link", "#force-whole"]) assert.equal(await page.isVisible(part), false, part);
  const { width, height } = await page.locator("canvas.paper").boundingBox();
  assert.ok(width > 300 && height > 100);
  // Light, with the colours of marks, although the screen is dark.
  const [paper, marks, drawn] = await page.evaluate(() => [getComputedStyle(document.documentElement).getPropertyValue("--paper").trim(),
    getComputedStyle(document.querySelector(".swatch")).printColorAdjust, getComputedStyle(document.querySelector("canvas.paper")).filter]);
  assert.deepEqual([paper, marks], ["#ffffff", "exact"]);
  assert.match(drawn, /invert/);
  for (const table of await page.locator(".scroll").all()) {
    assert.ok(await table.evaluate((box) => box.scrollWidth <= box.clientWidth + 1), await table.getAttribute("aria-labelledby"));
  }
}, { colorScheme: "dark" }));
