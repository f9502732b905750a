// SPDX-License-Identifier: GPL-3.0-or-later
// What a worker runs after the module's own code.

interface Models {
  ccall(name: string, result: "string", types: readonly "string"[], values: readonly string[]): string;
}

type Instantiate = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => object;

declare const clatterModule: (given: { instantiateWasm: Instantiate }) => Promise<Models>;

/**
 * Takes once the compiled models, and [path, body] each time; gives back answers in the order in which they are asked
 * for.  Stands by itself: only its text is taken.
 */
export function answerRequests(): void {
  let start: (code: WebAssembly.Module) => void = () => undefined;
  const models = new Promise<WebAssembly.Module>((resolve) => { start = resolve; }).then((code) => clatterModule({
    instantiateWasm: (imports, done) => {
      void WebAssembly.instantiate(code, imports).then(done);
      return {};
    },
  }));
  self.onmessage = ({ data }: MessageEvent<WebAssembly.Module | readonly [string, string]>) => {
    if (data instanceof WebAssembly.Module) return start(data);
    void models.then(({ ccall }) => self.postMessage(ccall("clatter_answer", "string", ["string", "string"], data)))
      // A module that broke off is of no more use: as an error of the worker it is told to the page.
      .catch((error: unknown) => setTimeout(() => { throw error; }));
  };
}
