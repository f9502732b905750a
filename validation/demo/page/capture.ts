// SPDX-License-Identifier: GPL-3.0-or-later
// The picture as a file, with the names and numbers that stand in it and the line below: one moment as PNG, the whole drop as a film
// or as a GIF, which slides and mails play that take no film, with fewer pictures a second and fewer colours.
import { GIFEncoder, applyPalette, quantize } from "gifenc";
import { byId } from "./dom";
import { download } from "./sharing";

const LINE = 40; // below the picture, for the caption [px]
/** The first that the browser writes. */
const FILMS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
/** The last picture stays so long [ms]: of a film, and of a GIF, which begins anew then. */
const STAYS = 700;
const STAYS_IN_GIF = 2000;

export class Capture {
  private readonly stage = byId("stage");
  private readonly paper = document.createElement("canvas");
  /** What takes the pictures, while one of the buttons has been pressed. */
  private taking: { button: HTMLButtonElement; add(): void; end(): void } | null = null;

  /** @param redraw draws the picture now, which a canvas keeps only until the browser has shown it */
  constructor(private readonly redraw: () => void, private readonly playFromStart: () => void) {
    // What is drawn in space is gone before it is printed; on paper this picture stands in its place.
    this.stage.after(this.paper);
    this.paper.className = "paper";
    addEventListener("beforeprint", () => this.keep());
    byId("picture").addEventListener("click", () => {
      this.keep();
      this.paper.toBlob((blob) => { if (blob) download("clatter.png", blob, "image/png"); });
    });
    byId("film").hidden = typeof MediaRecorder === "undefined";
    byId<HTMLButtonElement>("film").addEventListener("click", () => this.toggle("film"));
    byId<HTMLButtonElement>("gif").addEventListener("click", () => this.toggle("gif"));
  }

  /** After each picture that the playback has drawn. */
  drawn(ended: boolean): void {
    if (!this.taking) return;
    this.paint();
    this.taking.add();
    // A film lasts until its last picture.
    if (ended) setTimeout(() => { this.keep(); requestAnimationFrame(() => this.stop()); }, STAYS);
  }

  /** The picture as it is now. */
  keep(): void {
    if (!this.stage.clientWidth) return;
    this.redraw();
    this.paint();
  }

  private toggle(kind: "film" | "gif"): void {
    if (this.taking) return this.stop();
    this.keep();
    this.taking = { button: byId<HTMLButtonElement>(kind), ...(kind === "gif" ? this.gif() : this.film()) };
    this.label(this.taking.button, true);
    this.playFromStart();
  }

  private gif(): { add(): void; end(): void } {
    const gif = new Gif(this.paper);
    return { add: () => gif.add(), end: () => download("clatter.gif", new Blob([gif.end(STAYS_IN_GIF)], { type: "image/gif" }), "image/gif") };
  }

  private film(): { add(): void; end(): void } {
    const type = FILMS.find((one) => MediaRecorder.isTypeSupported(one)) ?? "";
    const recorder = new MediaRecorder(this.paper.captureStream(), { mimeType: type, videoBitsPerSecond: 6e6 });
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    recorder.addEventListener("stop", () => {
      const kind = type.split(";")[0] ?? "";
      download(`clatter.${kind.slice(kind.indexOf("/") + 1)}`, new Blob(parts, { type: kind }), kind);
    });
    recorder.start();
    return { add: () => undefined, end: () => recorder.stop() };
  }

  private stop(): void {
    const { taking } = this;
    this.taking = null;
    if (!taking) return;
    taking.end();
    this.label(taking.button, false);
  }

  private label(button: HTMLButtonElement, takes: boolean): void {
    button.textContent = takes ? "Stop" : button.dataset["name"] ?? "";
    button.setAttribute("aria-pressed", String(takes));
  }

  /** The picture and all words over it, as they stand on the screen, with the caption below. */
  private paint(): void {
    const canvas = this.stage.querySelector("canvas") as HTMLCanvasElement;
    const { width, height, left, top } = this.stage.getBoundingClientRect();
    const sharp = canvas.width / width;
    // Even, as films ask for.
    const size = [width, height + LINE].map((side) => 2 * Math.round((side * sharp) / 2));
    // A canvas that is given its size again is emptied.
    if (this.paper.width !== size[0] || this.paper.height !== size[1]) Object.assign(this.paper, { width: size[0], height: size[1] });
    const context = this.paper.getContext("2d") as CanvasRenderingContext2D;
    const colour = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name);
    context.setTransform(sharp, 0, 0, sharp, 0, 0);
    const sky = context.createLinearGradient(0, 0, 0, 0.62 * height);
    sky.addColorStop(0, colour("--hover"));
    sky.addColorStop(1, colour("--paper"));
    context.fillStyle = sky;
    context.fillRect(0, 0, width, height + LINE);
    context.drawImage(canvas, 0, 0, width, height);
    context.textBaseline = "middle";
    for (const words of this.stage.querySelectorAll<HTMLElement>(".stage-label, #pace, .names span")) write(context, words, left, top);
    context.font = fontOf(byId("caption"));
    context.fillStyle = colour("--ink");
    context.fillText(byId("caption").textContent ?? "", 12, height + LINE / 2, width - 24);
  }
}

/** The shorthand is empty where its digits are all of one width. */
function fontOf(element: HTMLElement): string {
  const { fontWeight, fontSize, fontFamily } = getComputedStyle(element);
  return `${fontWeight} ${fontSize} ${fontFamily}`;
}

function write(context: CanvasRenderingContext2D, element: HTMLElement, left: number, top: number): void {
  const { x, y, width, height } = element.getBoundingClientRect();
  if (width === 0) return;
  const { color, backgroundColor } = getComputedStyle(element);
  context.fillStyle = backgroundColor;
  context.fillRect(x - left, y - top, width, height);
  context.font = fontOf(element);
  const text = element.textContent ?? "";
  const place = [x - left + (width - context.measureText(text).width) / 2, y - top + height / 2] as const;
  // Around it paper, as on the screen: it may stand on a body.
  Object.assign(context, { strokeStyle: getComputedStyle(document.documentElement).getPropertyValue("--paper"), lineWidth: 4, lineJoin: "round" });
  context.strokeText(text, ...place);
  context.fillStyle = color;
  context.fillText(text, ...place);
}

const WIDTH = 640; // at most [px]
const STEP = 80; // between two pictures, at least [ms]
const COLOURS = 64;

interface Picture {
  pixels: Uint8ClampedArray;
  at: number;
}

class Gif {
  private readonly encoder = GIFEncoder();
  private readonly small = document.createElement("canvas");
  private last: Picture | null = null;

  constructor(private readonly paper: HTMLCanvasElement) {
    const scale = Math.min(1, WIDTH / paper.width);
    Object.assign(this.small, { width: Math.round(paper.width * scale), height: Math.round(paper.height * scale) });
  }

  /** The paper as it is now, unless that comes too soon after the picture before. */
  add(): void {
    const at = performance.now();
    if (this.last && at - this.last.at < STEP) return;
    const { width, height } = this.small;
    const context = this.small.getContext("2d", { willReadFrequently: true }) as CanvasRenderingContext2D;
    context.drawImage(this.paper, 0, 0, width, height);
    // How long a picture stays is known when the next one comes.
    this.write(at);
    this.last = { pixels: context.getImageData(0, 0, width, height).data, at };
  }

  /** @param stays how long the last picture is shown [ms] */
  end(stays: number): Uint8Array<ArrayBuffer> {
    this.write((this.last?.at ?? 0) + stays);
    this.encoder.finish();
    return this.encoder.bytes();
  }

  private write(until: number): void {
    if (!this.last) return;
    const { pixels, at } = this.last;
    const palette = quantize(pixels, COLOURS, { format: "rgb444" });
    const { width, height } = this.small;
    this.encoder.writeFrame(applyPalette(pixels, palette, "rgb444"), width, height, { palette, delay: until - at });
  }
}
