// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `clatter demo` in a browser: what it shows is what the program computes, a link carries the whole state, and
// keyboard, screen reader and narrow screens are served.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  LARGE, SHOWN, address, chromium, close, column, number, onOnePage, onPage, printed, program, sequence, slide, waitForCell,
} from "./page_browser.mjs";

onOnePage("the rod of the first visit", "#predict=0", {
  "steps go forward and back, and are told in words": async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.textContent("#caption"), "Impact 2: end b, 0.087 s after the first, twice as hard");
    await page.click("#next");
    assert.match(await page.textContent("#caption"), /^Impact 3: end a/);
    await page.click("#previous");
    await page.click("#previous");
    assert.match(await page.textContent("#caption"), /^Impact 1: end a, at 10\.0°/);
    assert.equal(await page.textContent("#time"), "0.00 ms");
  },
  "the equations of the chosen impact are set in type": async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await page.click('button[data-choose="2"]');
    await page.waitForFunction(() => /The flight to impact 2/.test(document.getElementById("explain-steps").textContent));
    assert.equal(await page.locator("#explain-steps .katex-error").count(), 0);
    assert.match(await page.textContent("#explain-steps"), /1\.00284/);
    const sources = await page.locator("#explain-steps annotation").allTextContents();
    assert.ok(sources.some((tex) => tex.includes("-\\frac{(1 + e) m u}{A}")), sources.join("\n"));
  },
  "what is wrong is said next to its control; the last good picture stays": async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await page.fill("#angle", "95");
    await page.waitForFunction(() => /must be from 0 to 90 degrees/.test(document.getElementById("angle-error").textContent));
    assert.equal(await page.getAttribute("#angle", "aria-invalid"), "true");
    assert.equal(await page.locator('tr[data-model="discrete"]').count(), 3);
    await page.fill("#angle", "40");
    await page.waitForFunction(() => document.getElementById("angle-error").textContent === "");
  },
  "the map finds both folds, and a click on it sets the angle": async (page) => {
    await page.waitForFunction(() => /58\.4884°.*27\.5778°/.test(document.getElementById("map-folds").textContent));
    const area = await page.locator("#map-chart .u-over").boundingBox();
    await page.locator("#map-chart .u-over").click({ position: { x: area.width / 3, y: area.height / 2 } });
    assert.ok(Math.abs(Number(await page.inputValue("#angle")) - 30) < 0.5);
  },
  "a slider's answer is the program's": async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    await slide(page, "angle", 23.5);
    const { impacts } = sequence("--angle", "23.5");
    await waitForCell(page, "Impulse", 1, impacts[1].impulse_normal);
    close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
    close(await column(page, "Angle"), impacts.map((i) => i.contact_angle_deg), SHOWN);
    close(await column(page, "Velocity after"), impacts.map((i) => i.velocity_after[2]), SHOWN);
  },
  "playing changes no number of the table": async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const numbers = () => page.locator("#impact-table td").allTextContents();
    const atFirst = await numbers();
    await page.selectOption("#rate", "2");
    await page.evaluate(() => document.activeElement.blur());
    const begin = await page.textContent("#time");
    await page.keyboard.press("Space");
    await page.waitForFunction((before) => document.getElementById("time").textContent !== before, begin);
    assert.deepEqual(await numbers(), atFirst);
  },
  "predict=0 switches the question off": async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    assert.equal(await page.isVisible("#prediction"), false);
    await page.check("#ask-first");
    assert.equal(await page.isVisible("#prediction"), true);
  },
});

test("gravity, restitution, friction and body enter the discrete model", () => onPage(
  "#predict=0&body=phone&angle=20&height=1&gravity=9.81&e=0.7&friction=0.2&stiffness=1e8&impacts=3", async (page) => {
    const { impacts } = sequence("--angle", "20", "--height", "1", "--gravity", "9.81", "--restitution", "0.7", "--friction", "0.2",
      "--body", "box", "--mass", "0.08814", "--size", "0.10566x0.04394x0.01905", "--impacts", "3");
    await waitForCell(page, "Impulse", 0, impacts[0].impulse_normal);
    close(await column(page, "Impulse"), impacts.map((i) => i.impulse_normal), SHOWN);
    close((await column(page, "Time")).slice(1), impacts.map((i) => i.start).slice(1), SHOWN);
    const heads = () => page.locator("#impact-table thead th").evaluateAll((all) => all.map(({ firstChild }) => firstChild.textContent));
    const rubbing = ["Pₙ", "Pₜ", "mode"];
    assert.deepEqual((await heads()).filter((head) => ["Impulse", ...rubbing].includes(head)), rubbing);
    close(await column(page, "Pₜ"), impacts.map((i) => i.impulse_tangential), SHOWN);
    const modes = page.locator('#impact-table tr[data-model="discrete"] td[data-column="mode"]');
    assert.deepEqual(await modes.allTextContents(), impacts.map(({ mode }) => mode));
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#csv")]);
    const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\n").map((line) => line.split(","));
    const inFile = (name) => lines.filter(([model]) => model === "discrete").map((line) => line[head.indexOf(name)]);
    assert.deepEqual(inFile("mode"), impacts.map(({ mode }) => mode));
    close(inFile("impulse_tangential_N_s").map(Number), impacts.map((i) => i.impulse_tangential), 1e-12);
    await page.fill("#friction", "0");
    await page.waitForFunction(() => !document.querySelector('[data-column="mode"]'));
    assert.deepEqual((await heads()).filter((name) => ["Impulse", ...rubbing].includes(name)), ["Impulse"]);
  }));

onOnePage("a rod that loses energy", "#predict=0&gravity=9.81&e=0.8", {
  "energy after each impact, and what is lost until then, are the program's": async (page) => {
    const { impacts } = sequence("--angle", "10", "--gravity", "9.81", "--restitution", "0.8");
    await page.waitForSelector('tr[data-model="continuous"]');
    const energies = () => page.locator("#energy-table tbody tr").evaluateAll((rows) => Object.fromEntries(rows.map((row) =>
      [row.querySelector("th").textContent, [...row.querySelectorAll("td")].map((cell) => Number(cell.textContent))])));
    // Parts are shown to a thousandth of a joule.
    const near = (shown, expected) => assert.ok(Math.abs(shown - expected) <= 1.6e-3, `${shown} is not ${expected}`);
    let lost = 0;
    for (const { n, energy_after: left, energy_loss: loss } of impacts) {
      lost += loss;
      if (n > 1) await page.click("#next");
      const shown = await energies();
      near(shown.Translation[0] + shown.Rotation[0] + shown.Height[0], left);
      near(shown.Lost[0], lost);
      near(shown.Total[0], impacts[0].energy_before);
    }
    await page.locator("#scrubber").evaluate((scrubber) => {
      scrubber.value = scrubber.max;
      scrubber.dispatchEvent(new Event("input", { bubbles: true }));
    });
    const losses = await column(page, "Energy lost", "continuous");
    const atEnd = await energies();
    near(atEnd.Lost[1], losses.reduce((sum, loss) => sum + loss, 0));
    near(atEnd.Ground[1], 0);
  },
  "the table's CSV has all digits of the models": async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#csv")]);
    const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\n").map((line) => line.split(","));
    const rows = lines.map((line) => Object.fromEntries(line.map((value, i) => [head[i], value])));
    const { impacts } = sequence("--angle", "10", "--gravity", "9.81", "--restitution", "0.8");
    const discrete = rows.filter(({ model }) => model === "discrete");
    close(discrete.map((row) => Number(row.impulse_normal_N_s)), impacts.map((i) => i.impulse_normal), 1e-12);
    close(discrete.map((row) => Number(row.start_s)), impacts.map((i) => i.start), 1e-12);
    assert.deepEqual(discrete.map((row) => row.peak_force_N), impacts.map(() => ""));
    assert.ok(rows.filter(({ model }) => model === "continuous").every((row) => Number(row.peak_force_N) > 0));
  },
});

test("where the law of restitution creates energy the page says so with the program's number, and names the law that does not", () => onPage(
  "#predict=0&friction=0.3&models=discrete&hide=map", async (page) => {
    await page.waitForSelector(".warnings:visible");
    const given = sequence("--angle", "10", "--friction", "0.3").impacts.reduce((sum, { energy_loss: loss }) => sum - Math.min(0, loss), 0);
    for (const said of await page.locator(".warnings").allTextContents()) {
      assert.match(said, /creates energy: .* from impact 3 on; .*with\.restitution_law=stronge/);
      assert.ok(Math.abs(Number(/([\d.]+) J/.exec(said)[1]) - given) < SHOWN * given, said);
    }
    await page.evaluate(() => { location.hash += "&with.restitution_law=stronge"; });
    await page.waitForFunction(() => document.querySelectorAll("#impact-table tbody tr").length && !document.querySelector(".warnings:not([hidden])"));
  }));

test("the table of a drop with friction is whole in a window of 1280, and impulses stand in one of 390", async () => {
  const visible = (page, title) => page.locator(`td[data-column="${title}"]`).evaluateAll((cells) => cells.every((cell) =>
    cell.getBoundingClientRect().right <= cell.closest(".scroll").getBoundingClientRect().right + 1));
  for (const [width, titles] of [[1280, ["Energy lost", "mode", "Lasts", "Peak force"]], [390, ["Impulse"]]]) {
    await onPage("#predict=0&friction=0.3&hide=map,explain", async (page) => {
      await page.waitForSelector('tr[data-model="continuous"]');
      for (const title of titles) assert.ok(await visible(page, title), `${title} at ${width}`);
    }, { viewport: { width, height: 900 } });
  }
});

test("the continuous model follows, and tends to the discrete one on a stiff ground", () => onPage(
  "#predict=0&stiffness=1e12&hide=map,explain", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    // The rod of the continuous model is 1 cm thick, so that its contact point is not quite the end of the thin rod.
    close(await column(page, "Impulse", "continuous"), await column(page, "Impulse", "discrete"), 0.02);
    assert.match(await page.getAttribute("#force-chart", "aria-label"), /impact 2: \d+/);
  }));

/** Drops in the plane, as `clatter demo` hands them to the page, and as flags. */
const IN_PLANE = {
  rod: ["angle=10&gravity=0&restitution=1&body=rod&mass=1&length=1&radius=0&stiffness=1e10&impacts=3",
    ["--angle", "10", "--radius", "0.01", "--stiffness", "1e10", "--impacts", "3"]],
  // It turns over, and the sixth blow of the continuous model is on the upper edge of an end.
  phone: ["angle=10&height=1&gravity=9.81&restitution_law=viscoelastic&body=box&mass=0.08814&size=0.10566,0.04394,0.01905"
    + "&stiffness=1e8&damping=1e7&static_friction=0.075&sliding_friction=0.075", ["phone-damped", "--planar"]],
};
/** The page asks four digits of the continuous model, of which the sixth blow, whose errors have grown, keeps three. */
const CONTINUOUS_SHOWN = 2e-3;

/** On the upper side of a box the program tells an end by its corners alone. */
const placeOf = ({ end, corners = "" }) => (/\+z/.test(corners) && !/-z/.test(corners) ? `${end}-top` : end);
const AFTER = {
  "Velocity after": ({ velocity_after: [, , up] }) => up, "Spin after": ({ angular_velocity_after: [, spin] }) => spin,
};

test("rows of a drop in the plane are simulate's: which end strikes, velocity and spin with their signs", async () => {
  for (const [fragment, flags] of Object.values(IN_PLANE)) {
    const { impacts } = printed("simulate", ...flags);
    await onPage(`#predict=0&hide=map,explain&given=1&${fragment}`, async (page) => {
      await page.waitForSelector('#impact-table tr[data-model="continuous"]');
      const places = page.locator('#impact-table tr[data-model="continuous"] td:nth-of-type(2)');
      assert.deepEqual(await places.allTextContents(), impacts.map(placeOf));
      for (const [title, of] of Object.entries(AFTER)) {
        close(await column(page, title, "continuous"), impacts.map(of), CONTINUOUS_SHOWN);
      }
    });
  }
});

test("beside the continuous model's numbers stands its ground, and whether the page chose it", () => onPage(
  "#predict=0&hide=map,explain&given=1&angle=10&gravity=9.81&restitution=0.8&body=rod&radius=0", async (page) => {
    const notes = () => page.locator(".ground-note:visible").allTextContents();
    // simulate refuses a scene without a ground.
    await page.waitForSelector('tr[data-model="discrete"]');
    assert.deepEqual([await page.isChecked("#with-continuous"), await notes()], [false, []]);
    assert.match(await page.textContent("#file-said"), /names no ground/);
    await page.check("#with-continuous");
    await page.waitForSelector('tr[data-model="continuous"]');
    const all = await notes();
    assert.equal(all.length, 3);
    for (const note of all) assert.match(note, /k = 1·10¹⁰ N\/m³, c = .*, chosen by the page/);
    // The numbers are those of the simulator on that very ground.
    const [, mantissa, exponent] = /c = ([\d.]+)·10([⁰¹²³⁴⁵⁶⁷⁸⁹]+) N·s/.exec(all[0]);
    const power = [...exponent].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(digit)).join("");
    const { impacts } = printed("simulate", "--angle", "10", "--gravity", "9.81", "--radius", "0.01", "--impacts", "2",
      "--stiffness", "1e10", "--damping", `${mantissa}e${power}`);
    const shown = await column(page, "Impulse", "continuous");
    close(shown.slice(0, 2), impacts.map((i) => i.impulse_normal), CONTINUOUS_SHOWN);
    await page.fill("#stiffness", "1e9");
    await page.waitForFunction(() => /k = 1·10⁹ /.test(document.querySelector(".ground-note").textContent));
    for (const note of await notes()) assert.doesNotMatch(note, /chosen/);
  }));

test("a flight ends where the next impact starts", async () => {
  const { impacts } = sequence("--angle", "20", "--gravity", "9.81", "--restitution", "0.9");
  const [, second] = impacts;
  await onPage(`#predict=0&angle=20&gravity=9.81&e=0.9&hide=map,explain&t=${second.start * (1 - 1e-9)}`, async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    const [height, inclination] = (await page.locator("#numbers-table tbody td:nth-of-type(1)").allTextContents()).map(number);
    assert.equal(inclination, Number(second.inclination_deg.toFixed(3)));
    // The end that strikes is on the ground.
    assert.equal(height, Number((500 * Math.abs(Math.sin((second.inclination_deg * Math.PI) / 180))).toFixed(2)));
  });
});

test("a link opens the same state", () => onPage(
  "#predict=0&body=own-box&angle=15.5&speed=2&gravity=1.62&e=0.9&mass=0.3&length=0.2&width=0.1&thickness=0.02",
  async (page, context) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    await page.click('button[data-layout="side"]');
    await page.selectOption("#rate", "0.5");
    await page.uncheck("#slow");
    await page.uncheck("#planar");
    await page.waitForFunction(() => document.getElementById("spinner").textContent === "");
    const hasFan = () => document.getElementById("panel-fan").getAttribute("aria-busy") === "false";
    await page.waitForFunction(hasFan);
    await page.click("#next");
    await page.locator("#scrubber").evaluate((scrubber) => {
      scrubber.value = "520";
      scrubber.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await page.waitForFunction((before) => location.hash !== before, await page.evaluate(() => location.hash));
    const link = page.url();
    const shown = () => [...document.querySelectorAll("#numbers-table td, #time, #caption, #impact-table td, #explain-title")]
      .map((element) => element.textContent).concat([...document.querySelectorAll("input, select")]
        .map((input) => (input.type === "checkbox" ? input.checked : input.value)))
      .concat([...document.querySelectorAll("[aria-pressed]")].map((button) => button.getAttribute("aria-pressed")));
    const here = await page.evaluate(shown);
    assert.equal(await page.getAttribute('button[data-layout="side"]', "aria-pressed"), "true");
    const other = await context.newPage();
    await other.goto(link);
    await other.waitForSelector('tr[data-model="continuous"]');
    await other.waitForFunction(hasFan);
    assert.deepEqual(await other.evaluate(shown), here);
  }));

test("a link that is copied has the scene alone: who opens it is asked before the drop", () => onPage("#predict=0&angle=15.5&impact=2&hide=map,explain", async (page, context) => {
  await page.waitForSelector("#impact-table tbody tr");
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.click("#copy-link");
  await page.waitForFunction(() => /^Link copied: it opens this file on this computer/.test(document.getElementById("copied").textContent));
  const said = new URLSearchParams(new URL(await page.evaluate(() => navigator.clipboard.readText())).hash.slice(1));
  assert.deepEqual(["angle", "hide", "impact", "t", "predict"].map((name) => said.get(name)), ["15.5", "map,explain", null, null, null]);
}));

/** The program's line, without the dashes of its options. */
const refusal = (...flags) => spawnSync(program, ["sequence", ...flags], { encoding: "utf8" }).stderr.trim().replace(/^clatter: /, "").replace(/--/g, "");

test("a name or value of a link that means nothing is said, and a height without gravity has that of the program", async () => {
  for (const [fragment, words] of [["clearance=0,5&angel=10", /^clearance=0,5: a decimal comma is refused, write 0.5; angel=10: unknown, did you mean angle\?; allowed are body, .*angle/],
    ["e=half&tab=forces", /^e=half: must be a number; tab=forces: must be one of story, /], ["hide=map,situation", /^hide=situation: must be one of story, .*, continuous; until it is, /], ["lock=angel,scene", /^lock=angel, did you mean angle\?: must be a quantity/],
    ["angle=10&clearance=0.5&speed=2", new RegExp(`^${refusal("--angle", "10", "--clearance", "0.5", "--speed", "2")}$`)]]) {
    await onPage(`#predict=0&${fragment}`, async (page) => {
      await page.waitForSelector("#error:visible");
      assert.match(await page.textContent("#error"), words);
    });
  }
  for (const [slip, meant] of [["answer", "answers"], ["continous", "continuous"], ["tabel", "table"]]) await onPage(`#predict=0&hide=${slip}`, async (page) => {
    await page.waitForSelector("#error:visible");
    assert.match(await page.textContent("#error"), new RegExp(`^hide=${slip}, did you mean ${meant}\\?`));
    for (const id of ["answers-print", "lesson-print", "lecture", "print", "of-continuous", "panel-table", "panel-strip", "story"]) assert.equal(await page.isVisible(`#${id}`), false, `${slip}: ${id}`);
    await page.waitForFunction(() => document.documentElement.dataset.latency !== undefined);
    assert.match(page.url(), new RegExp(`hide=${slip}(&|$)`));
  });
  await onPage("#predict=0&hide=story,strip,numbers,profile,table,fan,force,energy,map,race,measured,explain,controls,continuous&lock=angle,turn,scene,file,story,sound,layout,rate,slow,predict", async (page) => {
    await page.waitForFunction(() => document.documentElement.dataset.latency !== undefined);
    assert.equal(await page.isVisible("#error"), false);
  });
});

test("gravity is 9.81 where a height is given, and a drop that is refused is not asked about", async () => {
  const { impacts: [first] } = sequence("--angle", "10", "--clearance", "0.5");
  await onPage("#clearance=0.5", async (page) => {
    await waitForCell(page, "Impulse", 0, first.impulse_normal);
    assert.deepEqual([await page.inputValue("#gravity"), await page.isVisible("#prediction")], ["9.81", true]);
    await page.fill("#gravity", "0");
    await page.waitForFunction(() => document.body.classList.contains("refused"));
    assert.equal(await page.isVisible("#prediction"), false);
  });
});

test("the equations stay with the impact that was chosen while another one is played", () => onPage("#predict=0&impact=2&rate=2&hide=map", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  await page.click("#play");
  await page.waitForFunction(() => /^Impact 3/.test(document.getElementById("caption").textContent));
  assert.equal(await page.textContent("#explain-title"), "How impact 2 came about");
  await page.click('#impact-table tr[data-model="discrete"] td');
  await page.waitForFunction(() => document.getElementById("explain-title").textContent === "How impact 1 came about");
}));

test("without the continuous model the discrete one is alone, in a link, too: its reader's tick brings it back, one that is hidden does not", () => onPage("#predict=0&models=discrete&hide=map,explain", async (page) => {
  await page.waitForSelector('tr[data-model="discrete"]');
  const itsOwn = ["#motion .legend", '[data-layout="side"]', '#tabs [data-tab="force"]', "#panel-force", "#stiffness", ".ground-note"];
  const visible = () => Promise.all(itsOwn.map((part) => page.locator(part).first().isVisible()));
  assert.deepEqual([await page.textContent("#spinner"), await visible()], ["", itsOwn.map(() => false)]);
  await page.check("#with-continuous");
  await page.waitForSelector('tr[data-model="continuous"]');
  assert.deepEqual(await visible(), itsOwn.map(() => true));
  await page.uncheck("#with-continuous");
  await page.waitForFunction(() => !document.querySelector('tr[data-model="continuous"]') && location.hash.includes("models=discrete"));
  await Promise.all([page.waitForEvent("load"), page.evaluate(() => { location.hash = "#predict=0&tab=all&hide=map,explain,continuous"; })]);
  await page.waitForSelector('tr[data-model="discrete"]');
  assert.deepEqual([await page.isVisible("#with-continuous"), await page.textContent("#spinner"), await visible()], [false, "", itsOwn.map(() => false)]);
}));

test("along the body no number is cut, however small it is", () => onPage("#predict=0&angle=0.1&hide=map,explain", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  for (const n of [1, 2, 3]) {
    await page.click(`button[data-choose="${n}"]`);
    // Without loss the end that strikes comes back at 1 m/s.
    if (n === 1) assert.deepEqual(await page.locator("#profile-picture text.after").allTextContents(), ["1.00", "−2.00"]);
    assert.deepEqual(await page.locator("#profile-picture svg").evaluate((picture) => {
      const { left, right } = picture.getBoundingClientRect();
      return [...picture.querySelectorAll("text")].map((text) => [text.textContent, text.getBoundingClientRect()])
        .filter(([, box]) => box.left < left || box.right > right).map(([text]) => text);
    }), []);
  }
}));

test("along the body the speeds are those of the corner that strikes, which comes back with e times its speed", () => onPage(
  "#predict=0&body=phone&angle=20&height=1&gravity=9.81&e=0.5&hide=map,explain", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    const [before, after] = (await page.getAttribute("#profile-picture svg", "aria-label")).match(/[−\d.]+(?= m\/s at end a)/g).map(number);
    assert.ok(Math.abs(after + 0.5 * before) < 0.006, `${before} m/s, then ${after} m/s`);
  }));

test("a link that names an impact but no time shows that impact", () => onPage("#predict=0&impact=3&hide=map", async (page) => {
  await page.waitForFunction(() => /^Impact 3: end a/.test(document.getElementById("caption").textContent));
}));

test("a link's time stays, even if only the slower model reaches it", () => onPage(
  "#predict=0&body=phone&height=1&gravity=9.81&stiffness=1e8&impacts=2&t=0.004&hide=map,explain", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    assert.equal(await page.textContent("#time"), "4.00 ms");
  }));

test("lock= disables controls, hide= takes panels away", () => onPage(
  "#predict=0&lock=angle,e&hide=map,explain,energy", async (page) => {
    await page.waitForSelector("#impact-table tbody tr");
    for (const id of ["angle", "angle-slider", "e", "e-slider"]) assert.equal(await page.isDisabled(`#${id}`), true, id);
    assert.doesNotMatch(await page.textContent("#handout-try"), /angle/);
    assert.equal(await page.isDisabled("#gravity"), false);
    for (const panel of ["map", "explain", "energy"]) assert.equal(await page.isVisible(`#panel-${panel}`), false, panel);
    assert.equal(await page.isVisible("#panel-force"), true);
  }));

/** A number of the energy table, in thousandths of the total as shown. */
const energyOf = (page) => page.locator("#energy-table tbody tr").evaluateAll((rows) => [0, 1].map((model) =>
  rows.map((row) => row.querySelectorAll("td")[model].textContent).map((text) => (text === "–" ? null : Number(text.replace("−", "-"))))));

test("each model stops at its end: its body stays, pale, and its numbers are those of its last moment, in every panel", () => onPage(
  "#predict=0&gravity=9.81&e=0.8&impacts=3", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const end = () => page.locator("#scrubber").evaluate((scrubber) => {
      scrubber.value = scrubber.max;
      scrubber.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await end();
    assert.match(await page.textContent("#numbers-title"), /^At .*: the continuous model ends here$/);
    assert.deepEqual(await page.locator(".stage-label.over").allTextContents(), ["continuous model ends here"]);
    assert.match(await page.textContent(".energy-bar.continuous.over"), /ends here/);
    assert.match(await page.textContent("#patch-words"), /^the model ends here/);
    const height = number(await page.locator("#numbers-table tbody tr").first().locator("td").nth(1).textContent());
    assert.ok(height > 0 && height < 1000, `${height} mm`);
    assert.equal(await page.locator("#numbers-table tbody td:nth-of-type(3)").first().textContent(), "–");
  }));

test("a body that comes to rest on a damped ground is shown soon, and the page says how far it goes and with which e", () => onPage(
  "#predict=0&angle=10&e=0&gravity=9.81&hide=map,explain", async (page) => {
    await page.waitForSelector('tr[data-model="continuous"]');
    const rows = await page.evaluate(() => document.querySelectorAll('tr[data-model="continuous"]').length);
    assert.equal(rows, 3);  // two blows, and the contact in which it comes to rest
    await page.click("#next");
    assert.match(await page.textContent("#caption"), /^Impact 1/);
    assert.match(await page.textContent(".ground-note"), /c is such that it gives e = 0\.05, the least that the page gives it/);
  }));

test("who waits long for the continuous model can leave it, and ask for it again", () => onPage(
  // Steps so short that the contact would take many minutes.
  "#predict=0&stiffness=1e8&with.method=tvd-rk3&with.step=1e-12&with.evaluation_limit=2000000000&hide=map,explain", async (page) => {
    await page.waitForSelector("#leave-continuous:visible");
    await page.waitForFunction(() => document.querySelectorAll('tr[data-model="discrete"]').length === 3);
    await page.click("#leave-continuous");
    assert.deepEqual([await page.textContent("#spinner"), await page.isChecked("#with-continuous")], ["", false]);
    await page.check("#with-continuous");
    assert.match(await page.textContent("#spinner"), /computing/);
  }));

test("what goes wrong in drawing is told, and does not stop the page", () => onPage("#predict=0&hide=map,explain", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  await page.evaluate(() => { globalThis.isBroken = true; });
  await page.click("#next");
  assert.match(await page.textContent("#error"), /this moment cannot be drawn: Error: broken/);
  await page.evaluate(() => { globalThis.isBroken = false; });
  await page.click("#next");
  assert.equal(await page.isVisible("#error"), false);
}, { before: () => {
  const { clear } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.clear = function broken(...given) {
    if (globalThis.isBroken) throw new Error("broken");
    return clear.apply(this, given);
  };
} }));

test("the panel of angles is there for thin rods without friction alone, with every end of a curve", () => onPage("#predict=0&hide=explain&gravity=4", async (page) => {
  await page.waitForFunction(() => document.getElementById("map-folds").textContent !== "");
  assert.equal(await page.isVisible("#panel-map"), true);
  for (const set of [() => page.selectOption("#body", "phone"), () => page.selectOption("#body", "rod"), () => page.fill("#friction", "0.1")]) {
    await set();
    const isRod = (await page.inputValue("#body")) === "rod" && (await page.inputValue("#friction")) === "0";
    assert.equal(await page.isVisible("#panel-map"), isRod);
    assert.equal(await page.isVisible('[data-tab="map"]:is(button)'), isRod);
  }
}));

test("restitution that follows from the ground cannot be set, and says why", () => onPage("#predict=0&stiffness=1e8&damping=1e5&law=ground", async (page) => {
  assert.equal(await page.isDisabled("#e"), true);
  assert.equal(await page.isDisabled("#e-slider"), true);
  assert.match(await page.textContent("#e-reason"), /^It follows from the ground’s damping/);
  await page.uncheck("#ofGround");
  assert.equal(await page.isVisible("#e-reason"), false);
}));

test("energies and numbers are of one moment: at a blow both models are just after theirs", () => onPage("#predict=0&gravity=9.81&e=0.8&impact=2&hide=map,explain", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  assert.match(await page.textContent("#numbers-title"), /^Just after blow 2/);
  const [discrete, continuous] = (await energyOf(page)).map((parts) => parts[4]);
  const lost = (await column(page, "Energy lost", "continuous")).slice(0, 2).reduce((sum, loss) => sum + loss, 0);
  assert.ok(Math.abs(continuous - lost) < 2e-3, `${continuous} J are not the ${lost} J that two blows lose`);
  assert.ok(discrete > 0.3);
}));

test("in the plane the picture is straight from the side: an impulse stands upright and the floor is level", () => onPage("#predict=0&impact=2&hide=map,explain", async (page) => {
  await page.waitForSelector("#impact-table tbody tr");
  const place = (text) => page.locator(".stage-label", { hasText: text }).first().evaluate((label) => {
    const { x, width } = label.getBoundingClientRect();
    return x + width / 2;
  });
  await page.locator(".stage-label.blow").waitFor();
  const [end, tip] = [await place(/^b$/), await place(/N·s/)];
  assert.ok(Math.abs(end - tip) < 30, `${tip} px stands over ${end} px`);
  await page.uncheck("#speeds");
  assert.equal(await page.isChecked("#traces"), true);
}));

test("the arrow of an impulse fades once its contact is over, those of speeds have a switch, and speeds along the body their unit", () => onPage("#predict=0&impact=2&hide=map,explain", async (page) => {
  await page.waitForSelector('tr[data-model="continuous"]');
  const arrows = () => page.getAttribute("#stage", "data-arrows");
  const scrubTo = (part) => page.locator("#scrubber").evaluate((scrubber, to) => {
    scrubber.value = String(to * Number(scrubber.max));
    scrubber.dispatchEvent(new Event("input", { bubbles: true }));
  }, part);
  await page.click("#next");
  assert.equal(await arrows(), "blow, past, speed");  // of impact 3, and traces of those before
  await page.uncheck("#traces");
  assert.equal(await arrows(), "blow, speed");
  await scrubTo(1);
  await page.evaluate(() => document.getElementById("previous").click());
  assert.equal(await arrows(), "blow, speed");
  await scrubTo(0.9);
  assert.equal(await arrows(), "past, speed");
  await page.uncheck("#speeds");
  assert.equal(await arrows(), "past");
  await page.check("#speeds");
  await scrubTo(0);
  assert.equal(await arrows(), "speed");
  assert.match((await page.locator("#profile-picture text").allTextContents()).join("; "), /velocity upwards in m\/s/);
  assert.match(await page.getAttribute("#profile-picture svg", "aria-label"), /[\d.]+ m\/s at end a/);
}));

/** In the page: of each model that ends before the picture does, all that panels show of it where it has just ended and at the very end. */
function pastEnds() {
  const scrubber = document.getElementById("scrubber");
  const put = (value) => {
    scrubber.value = String(value);
    scrubber.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const before = Number(scrubber.value);
  const most = Number(scrubber.max);
  const texts = (selector) => [...document.querySelectorAll(selector)].map(({ textContent }) => textContent);
  put(most);
  const found = ["discrete", "continuous"].filter((model) => document.querySelector(`.energy-bar.${model}.over`)).map((model) => {
    const column = model === "discrete" ? 2 : 3;
    const numbers = () => texts(`#numbers-table tbody td:nth-child(${column}), #energy-table tbody td:nth-child(${column})`);
    let [running, over] = [0, most];
    while (over - running > 1) {
      const middle = Math.floor((running + over) / 2);
      put(middle);
      if (document.querySelector(`.energy-bar.${model}.over`)) over = middle;
      else running = middle;
    }
    put(over);
    const first = numbers();
    put(most);
    const labels = [...document.querySelectorAll(`.stage-label.${model}`)].map(({ classList }) => classList[1]);
    const now = document.querySelector(".now-line:not([hidden])");
    const said = model === "continuous" ? [...texts("#patch-words"), ...(now ? [now.textContent] : [])] : [];
    return { model, first, last: numbers(), differences: texts("#numbers-table tbody td:nth-child(4)"), labels, said: [...said, ...texts("#numbers-title")] };
  });
  put(before);
  return found;
}

/** In the page: what a reader could only see by moving the window sideways, but for what moves within a box of its own. */
function outsideWindow() {
  const scrolls = (element) => element !== document.body && (/auto|scroll|hidden|clip/.test(getComputedStyle(element).overflowX) || scrolls(element.parentElement));
  return [...document.querySelectorAll("body *")].filter((element) => {
    const { left, right, width, height } = element.getBoundingClientRect();
    return width > 1 && height > 1 && (left < -1 || right > innerWidth + 1) && !element.closest(".spoken, .skip") && !scrolls(element);
  }).map((element) => element.id || element.outerHTML.slice(0, 80));
}

/** Random states, always the same ones. CLATTER_STATES: how many; CLATTER_BROWSER: where. */
test("random states throw nothing, show no number past an end, add up their energies and stay within the window", async () => {
  let seed = 12345;
  const random = () => { seed = (seed * 1103515245 + 12345) % 2147483648; return seed / 2147483648; };
  const oneOf = (...some) => some[Math.floor(random() * some.length)];
  const states = Array.from({ length: Number(process.env.CLATTER_STATES ?? 12) }, () => ({
    body: oneOf("rod", "thick-rod", "phone", "coin", "tube", "die", "plate"), e: oneOf(0, 0.05, 0.3, 0.7, 1), gravity: oneOf(0, 1.62, 9.81),
    angle: (random() * 90).toFixed(1), turn: oneOf("", "", "&tilt=20"), layout: oneOf("overlay", "side"), at: oneOf(0, random(), 1),
    friction: oneOf(0, 0, 0.3), size: oneOf([1280, 900], [800, 600], [390, 800], [640, 450]), colorScheme: oneOf("light", "dark"),
  }));
  const wrong = [];
  for (const colorScheme of ["light", "dark"]) {
    await onPage("#predict=0&hide=fan,explain,race,measured", async (page) => {
      const check = async (state) => {
        const link = `#predict=0&hide=fan,explain,race,measured&tab=all&body=${state.body}&angle=${state.angle}${state.turn}&e=${state.e}`
          + `&gravity=${state.gravity}&friction=${state.friction}&layout=${state.layout}&stiffness=1e9&impacts=4`;
        await page.setViewportSize({ width: state.size[0], height: state.size[1] });
        await Promise.all([page.waitForEvent("load"), page.evaluate((hash) => { location.hash = hash; }, link)]);
        await page.waitForFunction(() => document.getElementById("spinner").textContent === "" && document.documentElement.dataset.latency !== undefined
          && (document.querySelector("#impact-table tbody tr") !== null || !document.getElementById("error").hidden || document.querySelector(".row .error:not([hidden])") !== null));
        await page.locator("#scrubber").evaluate((scrubber, part) => {
          scrubber.value = String(part * Number(scrubber.max));
          scrubber.dispatchEvent(new Event("input", { bubbles: true }));
        }, state.at);
        const said = `${link} at ${state.at} in ${state.size}`;
        for (const parts of await energyOf(page)) {
          if (parts[0] === null) continue;
          const total = parts.pop();
          const sum = parts.reduce((all, part) => all + part, 0);
          assert.ok(parts.every((part) => part >= 0) && Math.abs(sum - total) <= 2e-3 * Math.max(total, 1e-3) + 5e-9, `${said}: ${parts} J are not ${total} J`);
        }
        for (const { model, first, last, differences, labels, said: told } of await page.evaluate(pastEnds)) {
          assert.deepEqual(first, last, `${said}: numbers of the ${model} model go on past its end`);
          assert.ok(differences.every((text) => text === "–"), `${said}: ${differences}`);
          assert.deepEqual(labels, ["over"], `${said}: ${model}`);
          for (const words of told) assert.match(words, /ends here/, said);
        }
        const heights = await page.locator("#numbers-table tbody tr:first-child td").allTextContents();
        for (const height of heights.slice(0, 2)) assert.ok(height === "–" || number(height) > -1, `${said}: ${height} mm`);
        assert.deepEqual(await page.evaluate(() => {
          const { left, right } = document.getElementById("stage").getBoundingClientRect();
          const out = [...document.querySelectorAll(".stage-label")].filter((label) => {
            const box = label.getBoundingClientRect();
            return box.right < left || box.left > right;
          });
          return [document.documentElement.scrollWidth > innerWidth, out.length, document.getElementById("error").textContent.includes("drawn")];
        }), [false, 0, false], said);
        assert.deepEqual(await page.evaluate(outsideWindow), [], said);
      };
      // All that goes wrong is told at once.
      for (const state of states.filter((one) => one.colorScheme === colorScheme)) await check(state).catch(({ message }) => wrong.push(message));
    }, { colorScheme, browser: process.env.CLATTER_BROWSER ?? "chromium" });
  }
  assert.deepEqual(wrong, []);
});

test("a link without sense shows what the program says of it", () => onPage("#predict=0&e=2&mass=-1", async (page) => {
  await page.waitForFunction(() => /must be from 0 to 1/.test(document.getElementById("e-error").textContent));
}));

test("with reduced motion nothing moves by itself, without it the drop plays after the guess", async () => {
  const moves = (page) => page.evaluate(async () => {
    const later = [];
    window.setTimeout = (act) => later.push(act);
    document.querySelector('button[data-guess="harder"]').click();
    for (const act of later) act();
    for (let frame = 0; frame < 2; ++frame) await new Promise(requestAnimationFrame);
    return document.getElementById("play").getAttribute("aria-label") === "Pause";
  });
  const ready = (page) => page.waitForSelector("#impact-table tbody tr", { state: "attached" });
  await onPage("", async (page) => { await ready(page); assert.equal(await moves(page), false); });
  await onPage("", async (page) => { await ready(page); assert.equal(await moves(page), true); }, { reducedMotion: "no-preference" });
});

test("without a graphics card the picture is drawn from the side", async () => {
  const plain = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--disable-3d-apis", "--disable-background-networking", "--no-first-run"],
  });
  try {
    const page = await plain.newPage({ viewport: LARGE, reducedMotion: "reduce" });
    await page.goto(`${address}#predict=0&tab=table`);
    await page.waitForSelector("#impact-table tbody tr");
    assert.equal(await page.getAttribute("#stage", "data-view"), "flat");
    const painted = await page.locator("#stage canvas").evaluate((canvas) =>
      canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value !== 0));
    assert.equal(painted, true);
  } finally {
    await plain.close();
  }
});
