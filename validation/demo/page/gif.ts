// SPDX-License-Identifier: GPL-3.0-or-later
// A drop as a GIF, which slides and mails play that take no film: fewer pictures a second and fewer colours.
import { GIFEncoder, applyPalette, quantize } from "gifenc";

const WIDTH = 640; // at most [px]
const STEP = 80; // between two pictures, at least [ms]
const COLOURS = 64;

interface Picture {
  pixels: Uint8ClampedArray;
  at: number;
}

export class Gif {
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
