// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/explanation_latex.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <string_view>

#include "validation/output/estimated.hpp"

namespace clatter::validation::inline reports {
namespace {

struct Replacement {
  std::string_view from, to;
};

void replace_all(std::string& text, const Replacement& one, const std::string& before, const std::string& after) {
  const std::string to = before + std::string(one.to) + after;
  for (std::size_t at = 0; (at = text.find(one.from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, one.from.size(), to);
  }
}

constexpr Replacement letters[]{{"Ω", "\\Omega "}, {"ω", "\\omega "}, {"θ", "\\theta "}, {"φ", "\\varphi "},
                                {"α", "\\alpha "}, {"Γ", "\\Gamma "}, {"μᵢ", "\\mu_i "}, {"μ", "\\mu "},
                                {"σ", "\\sigma "}, {"Δ", "\\Delta "}, {"λ", "\\lambda "}};
constexpr Replacement signs[]{{"₁₁", "_{11}"},    {"₁₂", "_{12}"},    {"₂₂", "_{22}"},   {"−", "-"},
                              {"·", "\\cdot "},   {"×", "\\times "},  {"⁻¹", "^{-1}"},   {"²", "^2"},
                              {"₀", "_0"},        {"₁", "_1"},        {"₂", "_2"},       {"₃", "_3"},
                              {"₄", "_4"},        {"′", "'"},         {"±", "\\pm "},    {"°", "^\\circ "},
                              {"sin ", "\\sin "}, {"cos ", "\\cos "}, {"sin(", "\\sin("}};

/// Where the product ends with which a numerator does.
std::size_t product_begin(std::string_view text, std::size_t at) {
  int depth = 0;
  bool in_bars = false;
  for (; at > 0; --at) {
    const char c = text[at - 1];
    if (depth == 0 && !in_bars) {
      const std::string_view before = text.substr(0, at);
      const bool ends = std::ranges::any_of(std::array{" + ", " − ", " = ", ", ", "(", "{"},
                                            [&](const char* sign) { return before.ends_with(sign); });
      if (ends) break;
    }
    depth += (c == ')' || c == '}') - (c == '(' || c == '{');
    if (c == '|') in_bars = !in_bars;
  }
  return at;
}

/// Where the factor ends that begins at `at`.
std::size_t factor_end(std::string_view text, std::size_t at) {
  int depth = 0;
  bool in_bars = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    const bool ends = std::string_view(" ,/)}").find(c) != std::string_view::npos || text.substr(at).starts_with("·");
    if (ends && depth == 0 && !in_bars) break;
    depth += (c == '(' || c == '{') - (c == ')' || c == '}');
    if (c == '|') in_bars = !in_bars;
  }
  return at;
}

/// Whether the bracket at the beginning closes at the end.
bool is_group(std::string_view text) {
  int depth = 0;
  std::size_t at = 0;
  do {
    depth += (text[at] == '(') - (text[at] == ')');
    ++at;
  } while (depth > 0 && at < text.size());
  return text.starts_with('(') && at == text.size();
}

/// Quotients as fractions: above the line the product before the sign, below it the factor behind it.
std::string with_fractions(std::string text) {
  for (std::size_t sign; (sign = text.find('/')) != std::string::npos;) {
    const std::size_t begin = product_begin(text, sign), end = factor_end(text, sign + 1);
    std::string below = text.substr(sign + 1, end - sign - 1);
    // The line makes brackets superfluous.
    if (is_group(below)) below = below.substr(1, below.size() - 2);
    text.replace(begin, end - begin, "\\frac{" + text.substr(begin, sign - begin) + "}{" + below + "}");
  }
  return text;
}

std::string latex_symbols(std::string text) {
  for (const Replacement& sign : signs) replace_all(text, sign, "", "");
  for (const Replacement& letter : letters) replace_all(text, letter, "", "");
  return text;
}

/// LaTeX mathematics for the notation of the equations.
std::string latex_math(std::string text) {
  static const std::regex exponent("([0-9.])e\\+?(-?)0*([0-9]+)");
  return latex_symbols(std::regex_replace(with_fractions(std::move(text)), exponent, "$1·10^{$2$3}"));
}

/// The same of words in which symbols occur.
std::string latex_words(std::string text) {
  constexpr Replacement specials[]{{"_", "\\_"}, {"%", "\\%"}, {"−", "-"}};
  for (const Replacement& special : specials) replace_all(text, special, "", "");
  for (const Replacement& letter : letters) replace_all(text, letter, "$", "$");
  for (const Replacement& sign : signs) replace_all(text, sign, "$", "$");
  return "\\text{" + text + "}";
}

/// Whether there is a word of two letters or more that is no function's name.
bool is_words(const std::string& text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (auto word = text.begin(); word != text.end();) {
    word = std::find_if(word, text.end(), is_letter);
    const auto end = std::find_if_not(word, text.end(), is_letter);
    const std::string_view found(word, end);
    if (found.size() > 1 && found != "sin" && found != "cos") return true;
    word = end;
  }
  return false;
}

/// "FORMULA, words", or one of them.
struct Parts {
  std::string formula, words;
};
Parts parts_of(const std::string& text) {
  if (!is_words(text)) return {text, ""};
  const std::size_t comma = text.find(", ");
  if (comma == std::string::npos || is_words(text.substr(0, comma))) return {"", text};
  return {text.substr(0, comma), text.substr(comma + 2)};
}

/// "φ low" as φ with an index.
std::string latex_name(const std::string& name) {
  if (!is_words(name)) return latex_math(name);
  const std::size_t blank = name.find(' ');
  const std::string first = name.substr(0, blank);
  if (blank == std::string::npos || is_words(first)) return latex_words(name);
  return latex_math(first) + "_{" + latex_words(name.substr(blank + 1)) + "}";
}

}  // namespace

std::string equation_tex(const Equation& e, int digits, const std::string& between) {
  std::string tex = latex_name(e.name) + " &= ";
  for (const std::string& part : {parts_of(e.formula).formula, e.numbers}) {
    if (!part.empty()) tex += latex_math(part) + between;
  }
  tex += latex_math(known_text({e.value, e.error}, {.digits = digits, .size = e.size}));
  return e.unit.empty() ? tex : tex + "\\ \\mathrm{" + latex_symbols(e.unit) + "}";
}

std::string equation_words(const Equation& equation) { return parts_of(equation.formula).words; }

std::string explanation_latex(const std::vector<std::string>& head, const std::vector<Step>& steps, int digits) {
  std::string out;
  for (const std::string& line : head) out += "% " + line + "\n";
  for (const Step& step : steps) {
    out += "\n\\paragraph{" + step.title + "}\n\\begin{align*}\n";
    std::string separator;
    for (const Equation& e : step.equations) {
      const std::string words = equation_words(e);
      out += separator + "  " + equation_tex(e, digits, " = ") + (words.empty() ? "" : " &&" + latex_words(words));
      separator = " \\\\\n";
    }
    out += "\n\\end{align*}\n";
  }
  return out;
}

}  // namespace clatter::validation::inline reports
