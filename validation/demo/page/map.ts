// SPDX-License-Identifier: GPL-3.0-or-later
// The map of contact angles: β and γ, at which the thin rod strikes again, over the first angle θ.
import uPlot from "uplot";
import { ask } from "./api";
import { FONT, axis, chartSize, paint, upright } from "./charts";
import { COLOURS } from "./colours";
import { byId } from "./dom";
import { fixed } from "./format";
import { firstSpeed, isThinRod, restitutionOf, type Parameters } from "./parameters";
import { anglesRequest, gravityNumber, keyOf } from "./requests";

interface AngleRow {
  theta_deg: number;
  beta_deg: number | null;
  gamma_deg: number | null;
}

type Curve = "beta_deg" | "gamma_deg";
/** Where a curve ends or begins again. */
interface Fold {
  curve: Curve;
  /** The last angle before it [°], and how far the next one of the data is. */
  theta: number;
  resolution: number;
  value: number;
  ends: boolean;
}

const HEIGHT = 300;
/** Of a fold's angle in the chart [px]. */
const LABEL = [70, 16] as const;
const MAP_DELAY = 120; // ms
const REFINED = 101;
const RESOLVED = 1e-3; // degrees

export class AngleMap {
  private readonly box = byId("map-chart");
  private readonly note = byId("map-folds");
  private plot: uPlot | null = null;
  private folds: Fold[] = [];
  private shown = "";
  private theta = 0;

  constructor(private readonly onChoose: (angle: number) => void) {
    new ResizeObserver(() => this.plot?.setSize(chartSize(this.box, HEIGHT))).observe(this.box);
  }

  /** @return whether this situation has a map */
  show(parameters: Parameters): boolean {
    const speed = firstSpeed(parameters);
    const has = isThinRod(parameters) && speed > 0;
    if (has) void this.ask(gravityNumber(parameters, speed), restitutionOf(parameters));
    this.theta = parameters.angle;
    this.plot?.redraw(false);
    return has;
  }

  /** Asks for the map of another gravity number or coefficient of restitution, and then closer to its folds. */
  private async ask(gravity: number, e: number): Promise<void> {
    const request = anglesRequest(gravity, e, 0, 90, 91);
    const key = keyOf(request);
    if (key === this.shown || !Number.isFinite(gravity)) return;
    this.shown = key;
    // While a slider moves, the faster answers go first.
    await new Promise((resume) => setTimeout(resume, this.plot ? MAP_DELAY : 0));
    if (key !== this.shown) return;
    const isNewest = (): boolean => key === this.shown;
    try {
      let { rows } = await ask<{ rows: AngleRow[] }>(request);
      if (!isNewest()) return;
      this.draw(rows);
      const coarse = (): Fold | undefined => foldsOf(rows).find(({ resolution }) => resolution > RESOLVED);
      for (let fold = coarse(); fold; fold = coarse()) {
        const closer = anglesRequest(gravity, e, fold.theta, fold.theta + fold.resolution, REFINED);
        const answer = await ask<{ rows: AngleRow[] }>(closer);
        if (!isNewest()) return;
        rows = merge(rows, answer.rows);
      }
      this.draw(rows);
    } catch {
      // What is wrong with the situation is said next to the controls; the map keeps its last good state.
      if (isNewest()) this.shown = "";
    }
  }

  private draw(rows: AngleRow[]): void {
    this.folds = foldsOf(rows);
    const data = [rows.map((r) => r.theta_deg), rows.map((r) => r.beta_deg), rows.map((r) => r.gamma_deg)] as uPlot.AlignedData;
    if (this.plot) this.plot.setData(data);
    else this.plot = this.build(data);
    this.note.textContent = (["beta_deg", "gamma_deg"] as const).map((curve) => rangesInWords(curve, this.folds.filter((fold) => fold.curve === curve))).join(" ");
    this.box.setAttribute("aria-label", `Contact angles over the first angle. ${this.note.textContent}`);
  }

  private build(data: uPlot.AlignedData): uPlot {
    const degrees: uPlot.Axis["splits"] = (drawn, index) => {
      const most = drawn.scales[index === 0 ? "x" : "y"]?.max ?? 90;
      const step = most > 30 ? 15 : 5;
      return Array.from({ length: Math.floor(most / step) + 1 }, (_, i) => i * step);
    };
    const series = (label: string, stroke: string, dash: number[]): uPlot.Series =>
      ({ label, stroke, width: 2.5, dash, points: { show: false }, spanGaps: false });
    const plot = new uPlot({
      ...chartSize(this.box, HEIGHT), pxAlign: 0, legend: { show: false }, cursor: { drag: { x: false, y: false } },
      series: [{ label: "θ" }, series("β", COLOURS.beta, []), series("γ", COLOURS.gamma, [8, 4])],
      // With gravity the angles get small: the scale follows, in steps of 15°.
      scales: { x: { time: false, range: [0, 90] }, y: { range: (_plot, _low, high) => [0, Math.min(90, Math.max(15, Math.ceil(high / 15) * 15))] } },
      axes: [{ ...axis("First angle θ [°]", 34), splits: degrees }, { ...axis("Angle of the next impacts [°]", 44), splits: degrees }],
      hooks: { draw: [(drawn) => this.mark(drawn)] },
    }, data, this.box);
    plot.over.addEventListener("click", (event) => {
      const x = event.clientX - plot.over.getBoundingClientRect().left;
      this.onChoose(Math.min(90, Math.max(0, Math.round(plot.posToVal(x, "x") * 10) / 10)));
    });
    return plot;
  }

  private mark(plot: uPlot): void {
    upright(plot, this.theta, COLOURS.ink, [], 1);
    // Labels that would cover one that stands there already are left to the words below.
    const written: [number, number][] = [];
    for (const fold of this.folds) {
      ring(plot, fold.theta, fold.value, CURVES[fold.curve]);
      const [x, y] = [plot.valToPos(fold.theta, "x"), plot.valToPos(fold.value, "y")];
      if (written.some(([left, top]) => Math.abs(x - left) < LABEL[0] && Math.abs(y - top) < LABEL[1])) continue;
      written.push([x, y]);
      write(plot, fold.theta, fold.value, `${fixed(fold.theta, decimalsOf(fold))}°`);
    }
  }
}

const CURVES: Readonly<Record<Curve, string>> = { beta_deg: COLOURS.beta, gamma_deg: COLOURS.gamma };

/** All of them; at 0° both ends strike at once, and nothing begins. */
function foldsOf(rows: AngleRow[]): Fold[] {
  return (["beta_deg", "gamma_deg"] as const).flatMap((curve) => rows.slice(0, -1).flatMap((row, i) => {
    const next = rows[i + 1] as AngleRow;
    const ends = row[curve] !== null;
    if (ends === (next[curve] !== null) || row.theta_deg === 0) return [];
    return [{ curve, theta: row.theta_deg, resolution: next.theta_deg - row.theta_deg, value: row[curve] ?? next[curve] ?? 0, ends }];
  }));
}

function decimalsOf({ resolution }: Fold): number {
  return Math.max(0, Math.ceil(-Math.log10(resolution)) - 1);
}

/** "Third blow: 0–27.5778°, 58.1–90°." */
function rangesInWords(curve: Curve, folds: readonly Fold[]): string {
  const at = (fold: Fold): string => fixed(fold.theta, decimalsOf(fold));
  const ranges = folds.flatMap((fold, i) => (fold.ends ? [`${i ? at(folds[i - 1] as Fold) : "0"}–${at(fold)}°`] : i === folds.length - 1 ? [`${at(fold)}–90°`] : []));
  const which = curve === "beta_deg" ? "Second blow, of the other end" : "Third blow, of the first end again";
  return `${which}: ${ranges.join(", ") || "at every angle"}.`;
}

function merge(rows: AngleRow[], more: AngleRow[]): AngleRow[] {
  const all = new Map([...rows, ...more].map((row) => [row.theta_deg, row]));
  return [...all.values()].sort((a, b) => a.theta_deg - b.theta_deg);
}

function ring(plot: uPlot, x: number, y: number, colour: string): void {
  paint(plot, colour, 2, (ctx) => {
    ctx.arc(plot.valToPos(x, "x", true), plot.valToPos(y, "y", true), 5 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.fillStyle = COLOURS.paper;
    ctx.fill();
  });
}

function write(plot: uPlot, x: number, y: number, text: string): void {
  paint(plot, COLOURS.ink, 1, (ctx) => {
    ctx.font = FONT.replace("12px", `${12 * devicePixelRatio}px`);
    ctx.textBaseline = "middle";
    const isAtEdge = plot.valToPos(x, "x") + LABEL[0] > plot.over.clientWidth;
    ctx.textAlign = isAtEdge ? "right" : "left";
    ctx.fillText(text, plot.valToPos(x, "x", true) + (isAtEdge ? -10 : 10) * devicePixelRatio, plot.valToPos(y, "y", true));
  });
}
