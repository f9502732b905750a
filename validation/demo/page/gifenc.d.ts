// SPDX-License-Identifier: GPL-3.0-or-later
// What the page uses of gifenc, which comes without types.
declare module "gifenc" {
  type Palette = number[][];
  export function quantize(pixels: Uint8ClampedArray, colours: number, options: { format: "rgb444" }): Palette;
  export function applyPalette(pixels: Uint8ClampedArray, palette: Palette, format: "rgb444"): Uint8Array;
  export function GIFEncoder(): {
    /** @param options.delay in ms */
    writeFrame(indices: Uint8Array, width: number, height: number, options: { palette: Palette; delay: number }): void;
    finish(): void;
    bytes(): Uint8Array<ArrayBuffer>;
  };
}
