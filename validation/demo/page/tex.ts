// From the program's formulas, plain text such as "−(1+e) m u/(A − μᵢ B)", to TeX.

const GREEK: Readonly<Record<string, string>> = {
  α: "\\alpha", β: "\\beta", γ: "\\gamma", θ: "\\theta", φ: "\\varphi", μ: "\\mu", ω: "\\omega", Ω: "\\Omega", Γ: "\\Gamma",
  σ: "\\sigma", λ: "\\lambda", Δ: "\\Delta",
};
const SUBSCRIPT: Readonly<Record<string, string>> = { "₀": "0", "₁": "1", "₂": "2", "₃": "3", "₄": "4", "ᵢ": "i", "ₙ": "n", "ₜ": "t" };
const POWER: Readonly<Record<string, string>> = { "²": "2", "³": "3", "⁴": "4", "⁻¹": "-1" };
const FUNCTIONS = new Set(["sin", "cos", "tan", "arccos", "arctan", "ln", "exp"]);
const TOKEN = /\s+|\d+(?:\.\d+)?(?:e[-+]?\d+)?|\p{L}(?:_\p{L})?(?:[₀₁₂₃₄ᵢₙₜ]*)[′]?|⁻¹|[-+−·×/()|=,±<>≤≥²³⁴]/uy;

/** Text with words that are not names of quantities is prose, not a formula. */
function isProse(text: string): boolean {
  const words = text.match(/\p{L}{2,}/gu) ?? [];
  return words.some((word) => !FUNCTIONS.has(word) && !/^(?:ωt|[A-Z]?\p{L}[₀-₄ᵢₙₜ])$/u.test(word));
}

/** "P_t/P_n, mode slip" is a formula and a remark; other prose is a remark alone. */
export function splitRemark(text: string): { formula: string; remark: string } {
  if (!isProse(text)) return { formula: text, remark: "" };
  const comma = text.indexOf(", ");
  const formula = comma < 0 ? "" : text.slice(0, comma);
  if (formula === "" || isProse(formula)) return { formula: "", remark: text };
  return { formula, remark: text.slice(comma + 2) };
}

function prose(text: string): string {
  const plain = text.replace(/[\\{}$&#^_~%]/g, " ").replace(/−/g, "-");
  return `\\text{${plain.replace(/[αβγθφμωΩΓ]/g, (letter) => `$${GREEK[letter]}$`)}}`;
}

/** TeX of a formula; of a text that is none, that text upright. */
export function toTex(text: string): string {
  if (isProse(text)) return prose(text);
  try {
    return new Formula(tokens(text)).parse();
  } catch {
    return prose(text);
  }
}

/** Unit in upright letters: "N·s" and "rad/s". */
export function unitTex(unit: string): string {
  if (unit === "") return "";
  if (unit === "°") return "^\\circ";
  const letters = unit.replace(/·/g, "\\,").replace(/²/g, "^2").replace(/³/g, "^3");
  return `\\;\\mathrm{${letters}}`;
}

/** A number as the program rounds it, with a power of ten set as one. */
export function numberTex(text: string): string {
  const [mantissa = "", exponent] = text.replace("−", "-").split("e");
  return exponent === undefined ? mantissa : `${mantissa}\\cdot10^{${Number(exponent)}}`;
}

function tokens(text: string): string[] {
  // A function's name would else be taken for the product of its letters.
  const parts: string[] = [];
  let position = 0;
  while (position < text.length) {
    const name = [...FUNCTIONS].find((f) => text.startsWith(f, position) && !/\p{L}/u.test(text[position + f.length] ?? ""));
    TOKEN.lastIndex = position;
    const token = name ?? TOKEN.exec(text)?.[0];
    if (token === undefined) throw new SyntaxError(text.slice(position));
    position += token.length;
    if (token.trim()) parts.push(token);
  }
  return parts;
}

const SUMS = new Set(["+", "-", "−", "±", "=", ",", "<", ">", "≤", "≥"]);
const RELATIONS: Readonly<Record<string, string>> = { "−": "-", "±": "\\pm ", "≤": "\\le ", "≥": "\\ge ", ",": ",\\;" };

/** Sum of products of powers; a quotient's denominator is one factor, its numerator the product before it. */
class Formula {
  private position = 0;
  private insideBars = false;

  constructor(private readonly tokens: string[]) {}

  parse(): string {
    const tex = this.sum();
    if (this.peek() !== undefined) throw new SyntaxError(this.peek());
    return tex;
  }

  private peek(): string | undefined {
    return this.tokens[this.position];
  }

  private sum(): string {
    let tex = "";
    for (;;) {
      let next = this.peek();
      while (next !== undefined && SUMS.has(next)) {
        tex += RELATIONS[next] ?? next;
        this.position++;
        next = this.peek();
      }
      if (this.ends(next)) return tex;
      tex += this.product();
    }
  }

  private product(): string {
    let tex = this.factor();
    for (;;) {
      const next = this.peek();
      if (next === undefined || this.ends(next) || SUMS.has(next)) return tex;
      if (next === "·" || next === "×") {
        this.position++;
        tex += `${next === "·" ? "\\cdot" : "\\times"} ${this.factor()}`;
      } else if (next === "/") {
        this.position++;
        tex = `\\frac{${tex}}{${bare(this.factor())}}`;
      } else tex += `\\,${this.factor()}`;
    }
  }

  private factor(): string {
    let tex = this.atom();
    for (let next = this.peek(); next !== undefined && POWER[next] !== undefined; next = this.peek()) {
      tex = `${tex}^{${POWER[next]}}`;
      this.position++;
    }
    return tex;
  }

  private atom(): string {
    const token = this.peek();
    if (token === undefined) throw new SyntaxError("end of the formula");
    this.position++;
    if (token === "(") return `\\left(${this.until(")")}\\right)`;
    if (token === "|") return this.absolute();
    if (FUNCTIONS.has(token)) return `\\${token} ${this.factor()}`;
    if (/^\d/.test(token)) return numberTex(token);
    return nameTex(token);
  }

  /** The bar that opens an absolute value looks like the one that closes it. */
  private ends(next: string | undefined): boolean {
    return next === undefined || next === ")" || (next === "|" && this.insideBars);
  }

  private absolute(): string {
    this.insideBars = true;
    const tex = this.until("|");
    return `\\left|${tex}\\right|`;
  }

  private until(end: string): string {
    const tex = this.sum();
    if (this.peek() !== end) throw new SyntaxError(`${end} is missing`);
    if (end === "|") this.insideBars = false;
    this.position++;
    return tex;
  }
}

/** A fraction's bar makes the brackets around its denominator superfluous. */
function bare(tex: string): string {
  if (!tex.startsWith("\\left(") || !tex.endsWith("\\right)")) return tex;
  let depth = 0;
  for (const { 0: bracket, index } of tex.matchAll(/\\left\(|\\right\)/g)) {
    depth += bracket === "\\left(" ? 1 : -1;
    if (depth === 0 && index + bracket.length < tex.length) return tex;
  }
  return tex.slice("\\left(".length, -"\\right)".length);
}

function nameTex(token: string): string {
  const match = /^(\p{L})(?:_(\p{L}))?([₀₁₂₃₄ᵢₙₜ]*)(′?)$/u.exec(token);
  if (!match) throw new SyntaxError(token);
  const [, letter = "", under = "", digits = "", prime = ""] = match;
  const below = under + [...digits].map((digit) => SUBSCRIPT[digit] ?? "").join("");
  return `${GREEK[letter] ?? letter}${below && `_{${below}}`}${prime && "'"}`;
}
