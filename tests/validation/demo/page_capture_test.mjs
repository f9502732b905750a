// SPDX-License-Identifier: GPL-3.0-or-later
// What one takes along from the page of `clatter demo`: the picture, a film of the drop, and one page for a class.
import assert from "node:assert/strict";
import { test } from "node:test";
import { onPage, sequence } from "./page_browser.mjs";

const DROP = "#predict=0&hide=map,explain&angle=20&rate=2&impacts=2";
/** Of the discrete model's body, and of the words in the picture. */
const BODY = [0, 114, 178];
const WORDS = [10, 61, 98];

/** As a browser does before it prints. */
const HANDOUT = { before: () => { window.print = () => dispatchEvent(new Event("beforeprint")); } };

/** Keeps what the page hands to the browser as a file: not every browser tells of a download. */
function keepFiles() {
  globalThis.files = [];
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => {
    if (/^(image|video)/.test(blob.type)) globalThis.files.push(blob);
    return make(blob);
  };
}

async function fileOf(page, button, type) {
  await page.click(button);
  await page.waitForFunction((kind) => globalThis.files.some((file) => file.type.startsWith(kind)), type);
  const [kind, text] = await page.evaluate((wanted) => new Promise((done) => {
    const file = globalThis.files.find((one) => one.type.startsWith(wanted));
    const reader = new FileReader();
    reader.onload = () => done([file.type, reader.result.split(",")[1]]);
    reader.readAsDataURL(file);
  }), type);
  return { type: kind, bytes: Buffer.from(text, "base64") };
}

/** How many points of a picture or of a film's last one have about these colours, and how large it is. */
async function looked(context, { bytes, type }, colours) {
  const page = await context.newPage();
  const answer = await page.evaluate(async ([text, kind, wanted]) => {
    const isFilm = kind.startsWith("video");
    const source = isFilm ? Object.assign(document.createElement("video"), { muted: true }) : new Image();
    source.src = `data:${kind};base64,${text}`;
    await (isFilm ? new Promise((done) => { source.onloadeddata = done; }) : source.decode());
    const [width, height] = isFilm ? [source.videoWidth, source.videoHeight] : [source.naturalWidth, source.naturalHeight];
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const drawing = canvas.getContext("2d");
    const look = () => {
      drawing.drawImage(source, 0, 0);
      return drawing.getImageData(0, 0, width, height).data;
    };
    let data = look();
    // Not every browser has a picture until the very end: the last one that it has.
    for (let at = source.duration; isFilm && at > 0; at -= 0.1) {
      source.currentTime = at;
      await new Promise((done) => { source.onseeked = done; });
      drawing.clearRect(0, 0, width, height);
      data = look();
      if (data[3] > 0) break;
    }
    // Light and the film's compression change a colour a little.
    const counts = wanted.map((colour) => {
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (colour.every((part, k) => Math.abs(data[i + k] - part) < 40)) count += 1;
      return count;
    });
    return { width, height, counts };
  }, [bytes.toString("base64"), type, colours]);
  await page.close();
  return answer;
}

/** Pictures of a GIF, each with how long it stays [ms], as the format's blocks tell. */
function picturesOf(gif) {
  const colours = (flags) => (flags & 0x80 ? 3 * 2 ** ((flags & 7) + 1) : 0);
  const pictures = [];
  let stays = 0;
  for (let at = 13 + colours(gif[10]); gif[at] !== 0x3b;) {
    if (gif[at] === 0x21) {
      if (gif[at + 1] === 0xf9) stays = 10 * gif.readUInt16LE(at + 4);
      at += 2;
    } else {
      assert.equal(gif[at], 0x2c);
      pictures.push({ stays, width: gif.readUInt16LE(at + 5), height: gif.readUInt16LE(at + 7) });
      at += 11 + colours(gif[at + 9]);
    }
    while (gif[at] !== 0) at += gif[at] + 1;
    at += 1;
  }
  return pictures;
}

test("the drop is a GIF that lasts as long as its playback and rests on its last picture", () => onPage(DROP, async (page, context) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  const gif = await fileOf(page, "#gif", "image");
  assert.equal(gif.bytes.subarray(0, 6).toString(), "GIF89a");
  const pictures = picturesOf(gif.bytes);
  const { width, height, counts } = await looked(context, gif, [BODY]);
  assert.ok(width <= 640 && pictures.every((one) => one.width === width && one.height === height));
  for (const count of counts) assert.ok(count > 100, String(counts));
  // At twice the rate a playback takes at least 2.25 s, longer on a slow machine; then 2.7 s of rest.
  assert.ok(pictures.length > 2 && pictures.reduce((sum, { stays }) => sum + stays, 0) > 4500, JSON.stringify(pictures));
  assert.equal(pictures.at(-1).stays, 2000);
  assert.equal(await page.textContent("#gif"), "GIF");
}, { before: keepFiles }));

for (const browser of ["chromium", "firefox"]) {
  test(`in ${browser} the picture is a file with its numbers, and the drop is a film of its size that ends with the last blow`, () => onPage(DROP, async (page, context) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    await page.click("#next");
    const { width, height } = await page.locator("#stage").boundingBox();
    const picture = await fileOf(page, "#picture", "image");
    assert.deepEqual([...picture.bytes.subarray(1, 4)], [...Buffer.from("PNG")]);
    const shown = await looked(context, picture, [BODY, WORDS]);
    assert.ok(Math.abs(shown.width - width) <= 2 && shown.height > height, `${shown.width} × ${shown.height}`);
    for (const count of shown.counts) assert.ok(count > 200, String(shown.counts));

    const film = await fileOf(page, "#film", "video");
    if (film.type === "video/webm") assert.equal(film.bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
    const last = await looked(context, film, [BODY, WORDS]);
    assert.deepEqual([last.width, last.height], [shown.width, shown.height]);
    for (const count of last.counts) assert.ok(count > 200, String(last.counts));
    assert.equal(await page.textContent("#film"), "Film");
    assert.equal(await page.getAttribute("#play", "aria-label"), "Play");
  }, { browser, before: keepFiles }));
}

test("the handout is one page: the drop in words, its picture, its blows, and questions that tell no answer", () => onPage("#predict=0&body=phone&height=1&gravity=9.81&e=0.8&stiffness=1e8", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await page.waitForSelector("#explain-steps .katex");
  await page.click("#handout-print");
  assert.equal(await page.evaluate(() => globalThis.printing), true);
  await page.emulateMedia({ media: "print" });
  for (const part of ["#handout", ".paper", "#panel-strip", "#panel-profile"]) assert.equal(await page.isVisible(part), true, part);
  for (const part of ["#panel-explain", "#panel-table", "#story", "#panel-map", "#panel-controls"]) assert.equal(await page.isVisible(part), false, part);
  assert.match(await page.textContent("#handout-drop"), /^Phone, 106 mm \(0\.08814 kg\), inclined by 10\.00°, let go 1\.000 m above the floor\. Gravity 9\.810 m\/s², restitution e = 0\.8000\.$/);
  const paper = (await page.pdf({ format: "A4" })).toString("latin1");
  assert.equal(paper.match(/\/Type\s*\/Page\b/g).length, 1);
  // The body is there, near to the ground: in the page's blue, over more than a speck.
  const blue = await page.locator(".paper").evaluate((paper, [r, g, b]) => {
    const { data } = paper.getContext("2d").getImageData(0, 0, paper.width, paper.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (Math.abs(data[i] - r) < 40 && Math.abs(data[i + 1] - g) < 40 && Math.abs(data[i + 2] - b) < 40) count += 1;
    return count / (paper.width * paper.height);
  }, BODY);
  assert.ok(blue > 0.01, String(blue));
}, { before: () => { window.print = () => { dispatchEvent(new Event("beforeprint")); globalThis.printing = document.body.classList.contains("handout"); }; } }));

/** How many bytes draw each page. */
function pagesOf(paper) {
  const text = paper.toString("latin1");
  const parts = new Map([...text.matchAll(/(\d+) 0 obj(.*?)endobj/gs)].map(([, n, part]) => [n, part]));
  return [...parts.values()].filter((part) => /\/Type\s*\/Page\b/.test(part)).map((part) => parts.get(/\/Contents (\d+) 0 R/.exec(part)[1]).length);
}

test("on paper no page is empty, or has only the page's last line", () => onPage("#predict=0", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await page.waitForSelector("#explain-steps .katex");
  await page.emulateMedia({ media: "print" });
  const pages = pagesOf(await page.pdf({ format: "A4" }));
  assert.ok(pages.length > 5 && pages.every((bytes) => bytes > 600), pages.join(" "));
}));

for (const sheet of ["lesson", "exercises", "answers"]) {
  test(`the sheet of ${sheet} is one page of words alone, from a dark screen, too`, () => onPage("#predict=0", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await page.click(`#${sheet}-print`);
    await page.emulateMedia({ media: "print" });
    for (const part of ["#motion", "#story", "#panel-strip", "header", "#handout"]) assert.equal(await page.isVisible(part), false, part);
    assert.equal(await page.isVisible(`#${sheet}`), true);
    assert.ok((await page.textContent(`#${sheet}`)).includes("second blow"));
    assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue("--paper").trim()), "#ffffff");
    const paper = (await page.pdf({ format: "A4" })).toString("latin1");
    assert.equal(paper.match(/\/Type\s*\/Page\b/g).length, 1);
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    await page.emulateMedia({ media: "screen" });
    assert.deepEqual([await page.isVisible("#motion"), await page.isVisible(`#${sheet}`)], [true, false]);
  }, { ...HANDOUT, colorScheme: "dark" }));
}

test("the answers are the program's", () => onPage("#predict=0&hide=map,explain", async (page) => {
  const rows = await page.locator("#answers tr").evaluateAll((all) => all.slice(1).map((row) => [...row.cells].map(({ textContent }) => Number(textContent.replace("°", "")))));
  const expected = [20, 10, 5, 1].map((angle) => {
    const [one, two] = sequence("--angle", String(angle)).impacts.map((impact) => impact.impulse_normal);
    return [angle, Number(one.toFixed(3)), Number(two.toFixed(3)), Number((two / one).toFixed(2))];
  });
  assert.deepEqual(rows, expected);
  const words = await page.textContent("#answers");
  const blows = (...flags) => sequence(...flags).impacts.map((impact) => impact.impulse_normal.toFixed(3));
  assert.ok(words.includes(`${blows("--angle", "58.4")[1]} N·s at 58.4° and ${blows("--angle", "58.48")[1]} N·s at 58.48°`));
  assert.equal(blows("--angle", "58.49").length, 1);
  // Between these two the second blow has its largest; all three are the same as the answer writes them.
  const [below, largest, beyond] = ["47.05", "47.15", "47.25"].map((angle) => sequence("--angle", angle).impacts[1].impulse_normal);
  assert.ok(largest > below && largest > beyond && words.includes(`At 47.15°, with ${largest.toFixed(4)} N·s`));
  const [first, second] = blows("--angle", "10", "--restitution", "0.5");
  assert.ok(words.includes(`${(second / first).toFixed(2)}, from ${second} N·s after ${first} N·s`));
  const phone = (angle) => blows("phone-damped", "--angle", angle);
  assert.ok(words.includes(`at 10° the second blow is the harder one, ${phone("10")[1]} N·s after ${phone("10")[0]} N·s; at 45° it is not, ${phone("45")[1]} N·s after ${phone("45")[0]} N·s`));
}));

test("words in a picture are in the fonts of the page", () => onPage(DROP, async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await fileOf(page, "#picture", "image");
  const fonts = await page.evaluate(() => globalThis.fonts);
  assert.ok(fonts.length > 3);
  const family = await page.evaluate(() => getComputedStyle(document.body).fontFamily.split(",")[0]);
  for (const font of fonts) assert.ok(font.includes(family) && !/ 10px/.test(` ${font}`), font);
}, { before: `(${keepFiles})();
  globalThis.fonts = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function write(...given) { if (this.canvas.className === "paper") globalThis.fonts.push(this.font); return fillText.apply(this, given); };` }));

test("the handout has the drop before it falls, and no answer; then the picture is as it was", () => onPage("", async (page) => {
  await page.waitForSelector("#impact-table tbody tr", { state: "attached" });
  await page.click('button[data-guess="harder"]');
  for (let i = 0; i < 3; i++) await page.click("#next");
  await page.waitForFunction(() => /^You guessed it/.test(document.getElementById("prediction-reveal").textContent));
  const shown = () => page.evaluate(() =>
    ["caption", "time", "profile-title"].map((id) => document.getElementById(id).textContent));
  const before = await shown();
  assert.match(before[0], /^Impact 3/);
  await page.click("#handout-print");
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.isVisible("#prediction-reveal"), false);
  const [caption, time, profile] = await shown();
  assert.deepEqual([caption, profile], ["Falling", "Along the body, at blow 1"]);
  assert.ok(time.startsWith("−"), time);
  await page.emulateMedia({ media: "screen" });
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.deepEqual(await shown(), before);
}, HANDOUT));

for (const [impacts, layout] of [[6, "overlay"], [20, "overlay"], [20, "side"]]) {
  test(`the handout has every one of ${impacts} blows of both models, on one page, in the layout ${layout}`, () => onPage(
    `#predict=0&hide=map,explain&angle=2&gravity=9.81&e=0.8&impacts=${impacts}&layout=${layout}`, async (page) => {
      await page.waitForSelector('tr[data-model="continuous"]');
      await page.click("#handout-print");
      await page.emulateMedia({ media: "print" });
      for (const model of ["discrete", "continuous"]) {
        const rows = await page.locator(`#impact-table tr[data-model="${model}"]`).count();
        assert.ok(model === "continuous" || rows === impacts);
        assert.equal(await page.locator(`[data-strip^="${model}"]:visible`).count(), rows);
      }
      const paper = (await page.pdf({ format: "A4" })).toString("latin1");
      assert.equal(paper.match(/\/Type\s*\/Page\b/g).length, 1);
    }, HANDOUT));
}
