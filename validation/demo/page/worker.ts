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
  /** Of a time history as many rows as a picture can show, with the largest force of each stretch that is left out. */
  const thinned = (answer: { history?: Record<string, number[]> }): object => {
    const { t = [], fz = [], in_contact: touches = [] } = answer.history ?? {};
    const stride = Math.ceil(t.length / 6000);
    if (!answer.history || stride < 2) return answer;
    const kept: number[] = [];
    let largest = 0;
    t.forEach((_time, i) => {
      if ((fz[i] ?? 0) > (fz[largest] ?? 0)) largest = i;
      const isKept = i % stride === 0 || i === t.length - 1 || touches[i] !== touches[i - 1] || touches[i] !== touches[i + 1];
      if (!isKept) return;
      if (largest < i && largest > (kept[kept.length - 1] ?? -1)) kept.push(largest);
      kept.push(i);
      largest = i + 1;
    });
    const columns = Object.entries(answer.history).map(([name, column]) => [name, kept.map((row) => column[row] ?? 0)] as const);
    return { ...answer, history: Object.fromEntries(columns) };
  };
  let start: (code: WebAssembly.Module) => void = () => undefined;
  const models = new Promise<WebAssembly.Module>((resolve) => { start = resolve; }).then((code) => clatterModule({
    instantiateWasm: (imports, done) => {
      void WebAssembly.instantiate(code, imports).then(done);
      return {};
    },
  }));
  self.onmessage = ({ data }: MessageEvent<WebAssembly.Module | readonly [string, string]>) => {
    if (data instanceof WebAssembly.Module) return start(data);
    void models.then(({ ccall }) => self.postMessage(thinned(JSON.parse(ccall("clatter_answer", "string", ["string", "string"], data)) as object)))
      // A module that broke off is of no more use: as an error of the worker it is told to the page.
      .catch((error: unknown) => setTimeout(() => { throw error; }));
  };
}
