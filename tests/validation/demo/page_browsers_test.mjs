// SPDX-License-Identifier: GPL-3.0-or-later
// The page as a file that somebody was given: copied to an empty folder, opened from there in Chromium and in Firefox, without any
// network, with a scene in its address or in itself.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";
import { SHOWN, close, column, file, onPage, program, printed, waitForCell } from "./page_browser.mjs";

const scratch = mkdtempSync(path.join(tmpdir(), "clatter-page-"));
after(() => rmSync(scratch, { recursive: true }));
const copy = path.join(scratch, "a page #1.html");
copyFileSync(file, copy);
const exported = path.join(scratch, "exported.html");
execFileSync(program, ["demo", "phone-corner", "--export", exported]);

const FLAGS = ["--angle", "30", "--tilt", "40", "--height", "1", "--gravity", "9.81", "--body", "box", "--mass", "0.08814", "--size", "0.10566x0.04394x0.01905",
  "--stiffness", "1e8", "--damping", "1e7", "--impacts", "2"];
const CORNER = "#predict=0&hide=map,explain&body=phone&angle=30&tilt=40&height=1&gravity=9.81&stiffness=1e8&damping=1e7&law=ground&impacts=2";

for (const browser of ["chromium", "firefox"]) {
  test(`in ${browser} a copy of the file drops a phone on its corner in both models, and its link shows the same drop elsewhere`, async () => {
    let link = "";
    await onPage(CORNER, async (page) => {
      const { impacts } = printed("sequence", ...FLAGS);
      await waitForCell(page, "Impulse", 1, impacts[1].impulse_normal);
      close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
      const run = printed("simulate", ...FLAGS, "--digits", "4");
      // Four digits are asked for.
      await page.waitForSelector('tr[data-model="continuous"]');
      close(await column(page, "Peak force", "continuous"), run.impacts.map((i) => i.peak_force), 1e-3);
      await page.click("#next");
      await page.waitForFunction(() => location.hash.includes("impact=2"));
      link = page.url();
    }, { browser, at: pathToFileURL(copy).href });
    // Elsewhere: in a page that had another scene written into it.
    await onPage(link.slice(link.indexOf("#")), async (page) => {
      await page.waitForFunction(() => /^Impact 2/.test(document.getElementById("caption").textContent));
      assert.deepEqual(await column(page, "Impulse"), (printed("sequence", ...FLAGS).impacts.map((i) => Number(i.impulse_normal.toPrecision(6)))));
    }, { browser, at: pathToFileURL(exported).href });
  });

  // An address without a body changes the rest alone.
  for (const fragment of ["", "#hide=map"]) {
    test(`in ${browser} an exported page shows the scene that was written into it ${fragment}`, () => onPage(fragment, async (page) => {
      const { impacts } = printed("sequence", "phone-corner");
      await page.click("#prediction-skip");
      await waitForCell(page, "Impulse", 0, impacts[0].impulse_normal);
    }, { browser, at: pathToFileURL(exported).href }));
  }
}

test("the page saves itself with the scene that it shows", async () => {
  const saved = path.join(scratch, "saved.html");
  await onPage(CORNER, async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-page")]);
    await download.saveAs(saved);
  });
  await onPage("", async (page) => {
    await waitForCell(page, "Impulse", 1, printed("sequence", ...FLAGS).impacts[1].impulse_normal);
    const names = await page.locator("[id]").evaluateAll((all) => all.map(({ id }) => id));
    assert.deepEqual(names.filter((name, i) => names.indexOf(name) !== i), []);
    assert.equal(await page.locator("#basics label").count(), 3);
    // Who gets it is asked first.
    assert.equal(await page.isVisible("#prediction"), true);
  }, { at: pathToFileURL(saved).href });
});

test("a drop that takes for ever is left for another one", () => onPage(
  // Steps so short that the contact would take many minutes.
  "#predict=0&stiffness=1e8&with.method=tvd-rk3&with.step=1e-12&with.evaluation_limit=2000000000", async (page) => {
    await page.waitForSelector('tr[data-model="discrete"]');
    assert.match(await page.textContent("#spinner"), /computing/);
    await page.evaluate(() => { location.hash = "#predict=0&stiffness=1e8&angle=20&tab=all"; });
    await page.waitForSelector('tr[data-model="continuous"]');
    assert.equal(await page.textContent("#spinner"), "");
  }));

/** What the page has put off, for a test that brings it about. */
const rememberWhatIsDue = () => {
  const { setTimeout, clearTimeout } = window;
  window.due = new Map();
  window.setTimeout = (act, ...rest) => {
    const id = setTimeout(() => { window.due.delete(id); act(); }, ...rest);
    window.due.set(id, act);
    return id;
  };
  window.clearTimeout = (id) => { window.due.delete(id); clearTimeout(id); };
};

test("a link is opened although the page was about to write its own address", () => onPage("#predict=0&stiffness=1e8", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  await Promise.all([page.waitForEvent("load"), page.evaluate(() => {
    document.getElementById("next").click();  // writes the address soon
    location.hash = "#predict=0&stiffness=1e8&angle=20";
    for (const act of window.due.values()) act();  // before the browser tells of the link
  })]);
  assert.match(page.url(), /[#&]angle=20(&|$)/);
  await waitForCell(page, "Impulse", 0, printed("sequence", "--angle", "20", "--stiffness", "1e8").impacts[0].impulse_normal);
}, { before: rememberWhatIsDue }));
