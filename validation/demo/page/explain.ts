// How the chosen impact came about: the program's equations, set in type.
import katex from "katex";
import type { Equation, ExplainAnswer } from "./answers";
import { byId, make } from "./dom";
import { numberTex, splitRemark, toTex, unitTex } from "./tex";

export class Explanation {
  private readonly box = byId("explain-steps");

  show(answer: ExplainAnswer): void {
    this.box.replaceChildren(...answer.steps.map(({ title, text, equations }) => make("section", { class: "step" },
      make("h3", {}, title), make("p", {}, ...withSubscripts(text)), ...equations.map(equationElement))));
  }

  say(text: string): void {
    this.box.replaceChildren(make("p", { class: "quiet" }, text));
  }
}

/** "V_n" in running text as V with an index. */
function withSubscripts(text: string): (Node | string)[] {
  return text.split(/_(\p{L})/u).map((part, i) => (i % 2 ? make("sub", {}, part) : part));
}

function equationElement(equation: Equation): HTMLElement {
  const element = make("div", { class: "equation" });
  const { remark } = splitRemark(equation.symbolic);
  const formula = make("div", { class: "formula", tabindex: 0, role: "group", "aria-label": equation.name });
  katex.render(texOf(equation), formula, { displayMode: true, throwOnError: false });
  element.append(formula);
  if (remark) element.append(make("p", { class: "remark" }, remark));
  return element;
}

/** name = formula = the numbers put in = value; prose stands beside it instead. */
function texOf({ name, symbolic, numeric, value, unit }: Equation): string {
  const terms: string[] = [];
  const { formula } = splitRemark(symbolic);
  if (formula) terms.push(toTex(formula));
  if (numeric) terms.push(toTex(numeric.replace(/(\d\.\d*?)0+(?=\D|$)/g, (_all, kept: string) => kept.replace(/\.$/, ""))));
  if (value !== null) terms.push(numberTex(rounded(value)) + unitTex(unit));
  const [first = "", ...others] = terms;
  const left = toTex(name);
  return `\\begin{aligned}${left} &= ${first}${others.map((term) => `\\\\ &= ${term}`).join("")}\\end{aligned}`;
}

function rounded(value: number): string {
  const text = String(Number(value.toPrecision(6)));
  return Math.abs(value) < 1e-12 && value !== 0 ? value.toExponential(1) : text;
}
