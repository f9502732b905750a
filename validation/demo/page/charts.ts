// SPDX-License-Identifier: GPL-3.0-or-later
// The force of the ground over time, where the energy is, and how fast each point of the body moves up and down just before and just
// after a blow: why the end that did not strike comes down twice as fast.
import uPlot from "uplot";
import type { SimulateAnswer } from "./api";
import { isDisc, longHalf, lowestPlace } from "./body";
import { COLOURS } from "./colours";
import { byId, make, svg } from "./dom";
import { significant } from "./format";
import { pointMotion, touchRotation, type Motion } from "./motion";
import { plus, rotateBack, type Rotation, type Vector } from "./rotation";

export const FONT = "12px system-ui, sans-serif";

/** Width that a chart has in its panel; its height is the same on all screens. */
export function chartSize(box: HTMLElement, height: number): { width: number; height: number } {
  return { width: Math.max(200, box.clientWidth), height };
}

export function axis(label: string, size: number): uPlot.Axis {
  return {
    label, labelSize: 22, size, font: FONT, labelFont: FONT, labelGap: 2, stroke: COLOURS.quiet,
    grid: { stroke: COLOURS.grid, width: 1 }, ticks: { stroke: COLOURS.grid, width: 1, size: 5 },
    values: (_plot, values) => values.map((value) => String(Number(value.toPrecision(6))).replace("-", "−")),
  };
}

/** Draws over a chart, in one colour; lengths are those of a screen whose pixels are CSS's. */
export function paint({ ctx }: uPlot, colour: string, width: number, draw: (ctx: CanvasRenderingContext2D) => void): void {
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour;
  ctx.lineWidth = width * devicePixelRatio;
  ctx.setLineDash([]);
  ctx.beginPath();
  draw(ctx);
  ctx.stroke();
  ctx.restore();
}

export function upright(plot: uPlot, x: number, colour: string, dash: number[], width = 1.5): void {
  const { left, top, width: wide, height } = plot.bbox;
  const px = plot.valToPos(x, "x", true);
  if (px < left || px > left + wide) return;
  paint(plot, colour, width, (ctx) => {
    ctx.setLineDash(dash.map((d) => d * devicePixelRatio));
    ctx.moveTo(px, top);
    ctx.lineTo(px, top + height);
  });
}

/** The samples of a contact are few: a monotone curve through them, as the force is one. */
function smooth(): uPlot.Series.PathBuilder {
  const { spline } = uPlot.paths;
  if (!spline) throw new Error("uPlot has no splines");
  return spline();
}

const CHART_HEIGHT = 300;

export class ForceChart {
  private readonly box = byId("force-chart");
  private readonly whole = byId<HTMLInputElement>("force-whole");
  private plot: uPlot | null = null;
  private answer: SimulateAnswer | null = null;
  private discreteStarts: number[] = [];
  private chosen = 1;
  private readonly now = make("div", { class: "now-line" });

  constructor() {
    new ResizeObserver(() => this.plot?.setSize(chartSize(this.box, CHART_HEIGHT))).observe(this.box);
    this.whole.addEventListener("change", () => this.zoom());
  }

  show(answer: SimulateAnswer | null, discrete: Motion | null, chosen: number): void {
    this.discreteStarts = discrete?.impacts.map(({ start }) => start * 1e3) ?? [];
    this.chosen = chosen;
    if (answer !== this.answer || !this.plot) this.rebuild(answer);
    this.zoom();
  }

  setTime(time: number, end: number): void {
    if (!this.plot) return;
    const x = this.plot.valToPos(Math.min(time, end) * 1e3, "x");
    this.now.textContent = time > end ? "ends here" : "";
    const inside = x >= 0 && x <= this.plot.bbox.width / devicePixelRatio;
    this.now.hidden = !inside;
    this.now.style.transform = `translateX(${x.toFixed(1)}px)`;
  }

  private rebuild(answer: SimulateAnswer | null): void {
    this.answer = answer;
    this.plot?.destroy();
    this.plot = null;
    if (!answer) return;
    const { t, fx, fy, fz } = answer.history;
    const tangential = fx.map((f, i) => Math.hypot(f, fy[i] ?? 0));
    const rubs = tangential.some((f) => f > 1e-9);
    const series: uPlot.Series[] = [
      { label: "Time [ms]" }, { label: "Normal force", stroke: COLOURS.continuous, width: 2, points: { show: false }, paths: smooth() },
    ];
    const data: number[][] = [t.map((time) => time * 1e3), fz];
    if (rubs) {
      series.push({ label: "Friction", stroke: COLOURS.tangential, width: 2, dash: [6, 3], points: { show: false } });
      data.push(tangential);
    }
    byId("force-friction").hidden = !rubs;
    this.plot = new uPlot({
      ...chartSize(this.box, CHART_HEIGHT), pxAlign: 0, series, legend: { show: false }, cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { range: (_plot, _low, high) => [0, Math.max(high, 1e-9) * 1.08] } },
      axes: [axis("Time after the first touch [ms]", 34), axis("Force of the ground [N]", 58)],
      hooks: { draw: [(plot) => this.discreteStarts.forEach((x) => upright(plot, x, COLOURS.discrete, [4, 4]))] },
    }, data as uPlot.AlignedData, this.box);
    this.plot.over.append(this.now);
    const peaks = answer.impacts.map(({ n, peak_force }) => `impact ${n}: ${significant(peak_force, 3)} N`);
    this.box.setAttribute("aria-label", `Force of the ground over time. Peaks, ${peaks.join("; ")}`);
  }

  private zoom(): void {
    if (!this.plot || !this.answer) return;
    const { impacts, history } = this.answer;
    const impact = impacts[Math.min(this.chosen, impacts.length) - 1];
    const all = this.whole.checked || !impact || impact.duration === 0;
    const min = all ? 0 : (impact.start - 0.35 * impact.duration) * 1e3;
    const max = all ? (history.t[history.t.length - 1] ?? 1) * 1e3 : (impact.start + 1.35 * impact.duration) * 1e3;
    this.plot.setScale("x", { min, max });
  }
}

const WIDTH = 420;
const HEIGHT = 220;
const LEFT = 72;  // beside a number such as −0.00123
const RIGHT = WIDTH - LEFT;

/** Upward velocity at the two ends, or at two opposite sides of a disc, in line with the place that touches in this attitude [m/s]. */
function velocities(motion: Motion, time: number, touch: Rotation): [number, number] {
  const { body } = motion;
  const half = longHalf(body);
  const struck = plus(rotateBack(touch, lowestPlace(body, touch)), body.centre);
  const at = (side: number): number =>
    pointMotion(body, motion.pose(time), struck.map((part, i) => side * (half[i] ?? 0) || part) as Vector).velocity[2];
  return [at(-1), at(1)];
}

export function showProfile(motion: Motion | null, n: number): void {
  byId("profile-title").textContent = `Along the body, at blow ${n}`;
  const box = byId("profile-picture");
  const impact = motion?.impacts[n - 1];
  byId("panel-profile").classList.toggle("empty", !impact);
  if (!motion || !impact) return;
  const gap = 1e-9 * Math.max(1e-6, motion.end - motion.begin);
  const touch = touchRotation(impact);
  const lines = { before: velocities(motion, impact.start - gap, touch), after: velocities(motion, impact.start, touch) };
  const most = Math.max(1e-12, ...Object.values(lines).flat().map(Math.abs));
  const names = isDisc(motion.body) ? ["one side", "other side"] as const : ["end a", "end b"] as const;
  const y = (speed: number): string => (HEIGHT / 2 - (speed / most) * (HEIGHT / 2 - 30)).toFixed(1);
  const words = (name: "before" | "after"): string => `${name} the blow ${significant(lines[name][0], 3)} m/s at ${names[0]} and ${significant(lines[name][1], 3)} m/s at ${names[1]}`;
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `Upward velocity along the body: ${words("before")}, ${words("after")}` });
  const write = (x: number, top: number, anchor: string, kind: string, text: string): void => {
    picture.append(svg("text", { x, y: top, "text-anchor": anchor, class: kind }));
    picture.lastElementChild?.append(text);
  };
  picture.append(svg("line", { x1: LEFT - 12, x2: RIGHT + 12, y1: y(0), y2: y(0), class: "axis" }));
  for (const name of ["before", "after"] as const) {
    const [a, b] = lines[name];
    picture.append(svg("line", { x1: LEFT, x2: RIGHT, y1: y(a), y2: y(b), class: name }));
    for (let i = 0; i <= 6; i++) {
      const x = LEFT + ((RIGHT - LEFT) * i) / 6;
      picture.append(svg("line", { x1: x, x2: x, y1: y(0), y2: y(a + ((b - a) * i) / 6), class: `${name} thin` }));
    }
    // Numbers that would lie on each other stand above and below.
    const shift = (own: number, other: number): number => (Math.abs(own - other) / most < 0.15 && name === "after" ? 16 : -6);
    const other = lines[name === "after" ? "before" : "after"];
    write(LEFT - 8, Number(y(a)) + shift(a, other[0]), "end", name, significant(a, 3));
    write(RIGHT + 8, Number(y(b)) + shift(b, other[1]), "start", name, significant(b, 3));
  }
  write(LEFT, HEIGHT - 6, "middle", "end", names[0]);
  write(RIGHT, HEIGHT - 6, "middle", "end", names[1]);
  write(WIDTH / 2, 14, "middle", "end", "velocity upwards in m/s");
  box.replaceChildren(picture);
}
