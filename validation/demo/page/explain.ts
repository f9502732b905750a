// SPDX-License-Identifier: GPL-3.0-or-later
// How the chosen impact came about: the program's equations, in its own TeX.
import katex from "katex";
import type { Equation, ExplainAnswer } from "./answers";
import { byId, make } from "./dom";

export class Explanation {
  private readonly box = byId("explain-steps");

  show(answer: ExplainAnswer): void {
    this.box.replaceChildren(...answer.steps.map(({ title, text, laws, equations }) => make("section", { class: "step" },
      make("h3", {}, title), make("p", {}, ...withSubscripts(text)),
      ...laws.map(({ symbolic, tex }) => formulaElement(symbolic, tex)), ...equations.map(equationElement))));
  }

  say(text: string): void {
    this.box.replaceChildren(make("p", { class: "quiet" }, text));
  }
}

/** "V_n" in running text as V with an index, "V_n1" likewise. */
function withSubscripts(text: string): (Node | string)[] {
  return text.split(/_([\p{L}\d]+)/u).map((part, i) => (i % 2 ? make("sub", {}, part) : part));
}

function formulaElement(label: string, tex: string): HTMLElement {
  const formula = make("div", { class: "formula", tabindex: 0, role: "group", "aria-label": label });
  katex.render(`\\begin{aligned}${tex}\\end{aligned}`, formula, { displayMode: true, throwOnError: false });
  return formula;
}

function equationElement({ name, tex, words }: Equation): HTMLElement {
  const element = make("div", { class: "equation" }, formulaElement(name, tex));
  if (words) element.append(make("p", { class: "remark" }, words));
  return element;
}
