// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `clatter verify --html` in a browser: whole, without script errors, without a request to anywhere.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";

import { axeSource, onOnePage, program } from "../demo/page_browser.mjs";

const folder = mkdtempSync(path.join(os.tmpdir(), "clatter-"));
after(() => rmSync(folder, { recursive: true }));
const file = path.join(folder, "verification.html");
const { checks } = JSON.parse(execFileSync(program, ["verify", "--quick", "--html", file, "--format", "json"], { encoding: "utf8" }));

onOnePage("the page of the verification", "", {
  "every check has its row": async (page) => {
    for (const check of checks) {
      const row = await page.evaluate((id) => document.getElementById(id).innerText, check.id);
      for (const words of [check.answer, check.verdict]) assert.ok(row.includes(words), row);
      assert.ok(row.split(/\s+/).join(" ").includes(check.command), row);
    }
  },
  "every figure is drawn with its command": async (page) => {
    const figures = new Set(checks.map((check) => check.figure).filter(Boolean));
    assert.equal(figures.size, 16);
    const text = await page.evaluate(() => document.body.innerText);
    for (const figure of figures) assert.ok(text.includes(`clatter verify --figures --only ${figure} `), figure);
    const pictures = await page.evaluate(() => Array.from(document.querySelectorAll(".plots svg"), (svg) => {
      const { width, height } = svg.getBoundingClientRect();
      return { width, height, paths: svg.querySelectorAll("path").length };
    }));
    assert.ok(pictures.length >= 35);
    for (const { width, height, paths } of pictures) assert.ok(width > 200 && height > 100 && paths > 5);
  },
  "on paper the column of verdicts is there, and light": async (page) => {
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    await page.setViewportSize({ width: 690, height: 1000 });
    for (const box of await page.locator(".scroll").all()) assert.ok(await box.evaluate(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth + 1));
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
    await page.emulateMedia({ media: "screen" });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(20, 24, 28)");
    await page.emulateMedia({ colorScheme: "light" });
    await page.setViewportSize({ width: 1200, height: 900 });
  },
  "axe finds nothing serious, in the light and in the dark": async (page) => {
    await page.evaluate(axeSource);
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.filter(({ impact }) => /serious|critical/.test(impact)).map(({ id, nodes }) => [id, nodes[0].target]), []);
    }
  },
  "it fits its window": async (page) => {
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  },
}, { at: pathToFileURL(file).href, more: false, viewport: { width: 1200, height: 900 } });
