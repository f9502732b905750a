// SPDX-License-Identifier: GPL-3.0-or-later
// The story that the page tells by itself, also to a browser without JavaScript: five steps as HTML, each a heading, a picture
// and a text, with numbers that both models give while the page is built.

const WIDTH = 300;
const HEIGHT = 160;

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
const significant = (value, digits) => String(Number(value.toPrecision(digits)));
const placed = (value) => value.toFixed(1);

const picture = (words, ...content) =>
  `<svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label="${escaped(words)}">${content.flat(9).join("")}</svg>`;
const text = (x, y, anchor, words) => `<text x="${placed(x)}" y="${placed(y)}" text-anchor="${anchor}">${escaped(words)}</text>`;
const stroke = (x1, y1, x2, y2, kind) =>
  `<line x1="${placed(x1)}" y1="${placed(y1)}" x2="${placed(x2)}" y2="${placed(y2)}" class="${kind}"/>`;
/** Upward from a point. */
const arrow = (x, y, length) => [stroke(x, y, x, y - length + 10, "impulse"), `<path d="M${placed(x)},${placed(y - length)}l-6,10h12z" class="tip"/>`];

/** A blow on an end of the rod; `strongest` of the story, for the length of the arrow. */
function rodPicture({ degrees, isLeft, impulse, strongest, words }) {
  const floor = 138;
  const rod = 210;
  const foot = isLeft ? 45 : 45 + rod;
  const side = isLeft ? 1 : -1;
  const angle = (degrees * Math.PI) / 180;
  const length = (78 * impulse) / strongest;
  return picture(words, stroke(8, floor, WIDTH - 8, floor, "line"),
    stroke(foot, floor, foot + side * rod * Math.cos(angle), floor - rod * Math.sin(angle), "rod"), arrow(foot, floor - 4, length),
    text(foot, floor - length - 12, "middle", `${impulse.toFixed(3)} N·s`), text(foot + side * 64, floor + 17, "middle", `${degrees.toFixed(2)}°`));
}

/** Curves over axes that begin at 0; each has its name at its last point, and a ring there if it is a fold. */
function curvePicture({ curves, xEnd = 90, yEnd = 90, axes, words }) {
  const [x0, x1, y0, y1] = [36, 278, 126, 28];
  const x = (value) => x0 + ((x1 - x0) * value) / xEnd;
  const y = (value) => y0 + ((y1 - y0) * value) / yEnd;
  const ticks = [0, 0.5, 1].map((part) => [text(x(part * xEnd), y0 + 16, "middle", String(part * xEnd)), text(x0 - 6, y(part * yEnd) + 4, "end", String(part * yEnd))]);
  const drawn = curves.map(({ points, kind, name, isFold }) => {
    const [u, v] = points[points.length - 1];
    return [`<polyline points="${points.map(([a, b]) => `${placed(x(a))},${placed(y(b))}`).join(" ")}" class="curve ${kind}"/>`,
      isFold ? `<circle cx="${placed(x(u))}" cy="${placed(y(v))}" r="4.5" class="curve ${kind} ring"/>` : "", text(x(u) + 9, y(v) + 4, "start", name)];
  });
  return picture(words, stroke(x0, y0, x1, y0, "line"), stroke(x0, y0, x0, y1, "line"), ticks,
    text(x1 + 10, y0 + 31, "end", axes[0]), text(4, 13, "start", axes[1]), drawn);
}

function barPicture(bars, unit, words) {
  const floor = 132;
  const step = WIDTH / bars.length;
  const most = Math.max(...bars.map(({ value }) => value));
  return picture(words, stroke(8, floor, WIDTH - 8, floor, "line"), bars.map(({ value, name }, i) => {
    const x = (i + 0.5) * step;
    const tall = (100 * value) / most;
    return [`<rect x="${placed(x - 28)}" y="${placed(floor - tall)}" width="56" height="${placed(tall)}" class="bar"/>`,
      text(x, floor - tall - 7, "middle", `${significant(value, 3)} ${unit}`), text(x, floor + 17, "middle", name)];
  }));
}

/** The place of the number that is nearest by ratio. */
function nearest(value, numbers) {
  const distance = (number) => Math.abs(Math.log(value / number));
  return numbers.reduce((best, number, i) => (distance(number) < distance(numbers[best]) ? i : best), 0);
}

/** Of the elastic thin rod of 1 m and 1 kg at 1 m/s. @param ask the models: (path, texts) → answer */
export async function storyHtml(ask) {
  const rows = async (from, to, count) => (await ask("angles", { from: String(from), to: String(to), count: String(count) })).rows;
  const rod = async (degrees) => (await ask("sequence", { angle: String(degrees) })).impacts;
  const ratio = ([one, two]) => two.impulse_normal / one.impulse_normal;
  /** The last row with such an angle, to the sixth digit and more. */
  const foldOf = async (name) => {
    let [low, high, last] = [0, 90, null];
    for (let i = 0; i < 6; i++) {
      const found = await rows(low, high, 101);
      const end = found.findLastIndex((row) => row[name] !== null);
      last = found[end];
      [low, high] = [last.theta_deg, found[end + 1].theta_deg];
    }
    return last;
  };
  const upTo = async (fold, name) => [...(await rows(0.5, Math.floor(fold.theta_deg), 100)), fold].map((row) => [row.theta_deg, row[name]]);

  const ten = await rod(10);
  const [one, two] = ten;
  const flat = await rod(0.1);
  const second = await foldOf("beta_deg");
  const third = await foldOf("gamma_deg");
  const doubling = (await rows(0.01, Math.floor(second.theta_deg), 100)).map((row) => [row.theta_deg, row.P2 / row.P1]);
  const size = { body: "box", mass: "0.08814", size: "0.10566x0.04394x0.01905" };
  const fall = { ...size, angle: "10", height: "1", gravity: "9.81", impacts: "2" };
  // The picture's caption tells of the discrete model, the other one stands beside it.
  const phone = (await ask("sequence", fall)).impacts;
  const onSprings = (await ask("simulate", { ...fall, stiffness: "1e8", planar: "true" })).impacts;
  const sum = (impacts) => impacts.reduce((all, { impulse_normal }) => all + impulse_normal, 0);
  const flatBlow = 2;  // N·s: 1 kg at 1 m/s thrown back
  const ofPhone = phone[1].impulse_normal / phone[0].impulse_normal;
  const steps = [{
    title: "At an angle",
    question: "A thin rod of 1 m and 1 kg comes down at 1 m/s. If it landed flat, the blow would be 2 N·s. Now it leans by 10° and strikes with one end. How hard is that blow?",
    choices: ["2 N·s, too", "About half of that", "About a quarter of that"], right: nearest(one.impulse_normal / flatBlow, [1, 1 / 2, 1 / 4]),
    picture: rodPicture({ degrees: 10, isLeft: true, impulse: one.impulse_normal, strongest: two.impulse_normal, words: "A rod that leans by 10° strikes with its left end" }),
    text: `A thin rod of 1 m and 1 kg comes down at 1 m/s and leans by 10°. The end that strikes takes ${significant(one.impulse_normal, 4)} N·s; a `
      + `rod that lands flat takes 2. A soft blow, but it sets the rod turning, at ${significant(one.angular_velocity_after[1], 4)} rad/s.`,
    link: "impact=1",
  }, {
    title: "The other end",
    question: "The first blow, on end a, was soft. Then end b comes down. How hard is the second blow, compared with the first?",
    choices: ["Half as hard", "About as hard", "Twice as hard"], right: nearest(ratio(ten), [1 / 2, 1, 2]),
    picture: rodPicture({ degrees: two.contact_angle_deg, isLeft: false, impulse: two.impulse_normal, strongest: two.impulse_normal,
      words: `The rod has turned over its end and strikes with the right one, at ${two.contact_angle_deg.toFixed(2)}°` }),
    text: `The turning throws the other end down, at ${significant(two.approach_speed, 4)} m/s instead of 1. It strikes ${significant(two.start, 3)} s `
      + `later with ${significant(two.impulse_normal, 4)} N·s, ${significant(ratio(ten), 3)} times the first blow: this is clattering.`,
    link: "impact=2",
  }, {
    title: "Flatter",
    question: "Now the rod leans less: by 1°, by 0.1°, by less and less. What becomes of the second blow, compared with the first?",
    choices: ["As hard as the first", "Twice as hard", "Harder and harder without a limit"], right: nearest(ratio(flat), [1, 2, 1e3]),
    picture: curvePicture({ curves: [{ points: doubling, kind: "beta", name: "P₂/P₁" }], yEnd: 2, axes: ["first angle θ in °", "second blow over first"],
      words: "The second blow over the first against the first angle: 2 for a flat rod, falling to 0" }),
    text: `At 10° the second blow is ${significant(ratio(ten), 4)} times the first, at 1° ${significant(ratio(await rod(1)), 5)}, at 0.1° `
      + `${significant(ratio(flat), 6)}. The three angles are then as 2 : ${significant((2 * flat[1].contact_angle_deg) / flat[0].contact_angle_deg, 5)} : `
      + `${significant((2 * flat[2].contact_angle_deg) / flat[0].contact_angle_deg, 5)}, and the three blows together make ${significant(sum(flat), 6)} N·s, those of the flat landing.`,
    link: "angle=1&amp;impact=2",
  }, {
    title: "Steeper",
    question: "And steeper? Near 58° something happens to the second blow. What?",
    choices: ["It becomes the hardest of all", "It comes later and then not at all", "It comes at the same time as the first"], right: doubling.at(-1)[1] < 1 ? 1 : 0,
    picture: curvePicture({
      curves: [{ points: await upTo(second, "beta_deg"), kind: "beta", name: "β", isFold: true },
        { points: await upTo(third, "gamma_deg"), kind: "gamma", name: "γ", isFold: true }],
      axes: ["first angle θ in °", "next angles in °"],
      words: "Angles of the second and third impact against the first angle; each curve ends at its fold, marked by a ring" }),
    text: `The steeper it lands, the later the second blow, and beyond ${significant(second.theta_deg, 6)}° there is none: at ${significant(second.beta_deg, 4)}° `
      + "the other end only grazes the ground, with no speed, and turns away. So the discrete sequence ends there after one blow. The third blow ends likewise at "
      + `${significant(third.theta_deg, 6)}°.`,
    link: `angle=${significant(Math.floor(second.theta_deg * 100) / 100, 4)}&amp;impact=2`,
  }, {
    title: "A phone",
    question: "A phone falls from 1 m, leaning by 10°. Which blow is harder?",
    choices: ["The first", "Both alike", "The second"], right: nearest(ofPhone, [1 / 2, 1, 2]),
    picture: barPicture(phone.map(({ impulse_normal: value }, i) => ({ value, name: ["first blow", "second blow"][i] })), "N·s",
      "Impulses of the first and the second blow of a phone"),
    text: `A phone falls from 1 m at 10°: ${significant(phone[0].impulse_normal, 3)} N·s, then ${significant(phone[1].impulse_normal, 3)} N·s, `
      + `${significant(ratio(phone), 2)} times the first. The other model follows it through each contact with a springy floor, as long as that lasts: there it is `
      + `${significant(ratio(onSprings), 3)} times.`,
    link: "body=phone&amp;height=1&amp;gravity=9.81&amp;stiffness=1e8&amp;damping=0&amp;angle=10&amp;impact=2",
  }];
  const items = steps.map(({ title, question, choices, right, picture: drawn, text: words, link }, i) => `<li id="story-${i + 1}"><h3>${i + 1}. ${title}</h3>\n<p class="ask">${question}</p>\n`
    + `<div class="choices" role="group" aria-label="Your guess">${choices.map((choice, k) => `<button type="button"${k === right ? " data-right" : ""}>${choice}</button>`).join("")}</div>\n`
    + `<p class="verdict" role="status"></p>\n<div class="reveal">\n${drawn}\n<p>${words}</p></div>\n`
    + `<a class="show" href="#predict=0&amp;${link}">Show step ${i + 1} in the picture</a></li>`);
  return `<section id="story" aria-labelledby="story-title">\n<div class="bar"><h2 id="story-title">The story in five steps</h2>`
    + `<p class="hint">The picture stays while you scroll; each step asks, plays, tells. It takes scenes of its own and gives yours back at its end.</p><button type="button" id="story-start" aria-expanded="false" aria-controls="story-steps">Tell it</button></div>\n`
    + `<ol id="story-steps">\n${items.join("\n")}\n</ol>\n</section>`;
}
