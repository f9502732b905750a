// SPDX-License-Identifier: GPL-3.0-or-later
// The modules of the page, as its sources import each other.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

const folder = process.env.DEMO_PAGE;
assert.ok(folder, "DEMO_PAGE is the folder in which the page was built");

const modules = new Map(readdirSync(folder).filter((name) => name.endsWith(".ts")).map((name) => {
  const text = readFileSync(path.join(folder, name), "utf8");
  return [name.slice(0, -3), [...text.matchAll(/ from "\.\/(\w+)";/g)].map(([, other]) => other)];
}));

test("no module of the page leads back to itself, not even by a type", () => {
  assert.ok(modules.size > 30 && [...modules.values()].flat().length > 100);
  const done = new Set();
  const walk = (name, way) => {
    assert.ok(!way.includes(name), [...way, name].join(" → "));
    if (done.has(name)) return;
    for (const other of modules.get(name) ?? assert.fail(`no module ${name}`)) walk(other, [...way, name]);
    done.add(name);
  };
  for (const name of modules.keys()) walk(name, []);
});

test("no module of the page has more than 400 lines", () => {
  for (const name of modules.keys()) {
    const lines = readFileSync(path.join(folder, `${name}.ts`), "utf8").split("\n").length - 1;
    assert.ok(lines <= 400, `${name}.ts has ${lines}`);
  }
});
