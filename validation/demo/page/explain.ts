// SPDX-License-Identifier: GPL-3.0-or-later
// How the chosen impact came about: the program's equations, in its own TeX.
import katex from "katex";
import { Latest } from "./api";
import { byId, make } from "./dom";

/** After a change, until the equations are asked for [ms]. */
const DELAY = 80;

interface ExplainAnswer {
  /** Formulas in TeX are lines of an aligned environment. */
  steps: {
    title: string; text: string; laws: { symbolic: string; tex: string }[]; equations: { name: string; tex: string; words: string }[];
  }[];
}

export const explaining = new Latest<ExplainAnswer, null>(
  DELAY, showExplanation, ({ message }) => byId("explain-steps").replaceChildren(make("p", { class: "quiet" }, message)));

function showExplanation({ steps }: ExplainAnswer): void {
  byId("explain-steps").replaceChildren(...steps.map(({ title, text, laws, equations }) => make("section", { class: "step" },
    make("h3", {}, title), make("p", {}, ...withSubscripts(text)),
    ...laws.map(({ symbolic, tex }) => formulaElement(symbolic, tex)),
    ...equations.map(({ name, tex, words }) => make("div", { class: "equation" }, formulaElement(name, tex),
      ...(words ? [make("p", { class: "remark" }, words)] : []))))));
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
