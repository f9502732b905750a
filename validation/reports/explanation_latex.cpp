#include "validation/reports/explanation_latex.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "validation/output/estimated.hpp"

namespace clatter::validation {
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

/// LaTeX mathematics for the notation of the equations.
std::string latex_math(std::string text) {
  for (const Replacement& sign : signs) replace_all(text, sign, "", "");
  for (const Replacement& letter : letters) replace_all(text, letter, "", "");
  return text;
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

std::string latex_line(const Equation& e, int digits) {
  const auto& [formula, words] = parts_of(e.formula);
  std::string line = "  " + latex_name(e.name) + (formula.empty() ? " &" : " &= " + latex_math(formula));
  if (!e.numbers.empty()) line += " = " + latex_math(e.numbers);
  line += " = " + known_text({e.value, e.error}, {.digits = digits, .size = e.size});
  if (!e.unit.empty()) line += "\\ \\mathrm{" + latex_math(e.unit) + "}";
  return words.empty() ? line : line + " &&" + latex_words(words);
}

}  // namespace

std::string explanation_latex(const std::vector<std::string>& head, const std::vector<Step>& steps, int digits) {
  std::string out;
  for (const std::string& line : head) out += "% " + line + "\n";
  for (const Step& step : steps) {
    out += "\n\\paragraph{" + step.title + "}\n\\begin{align*}\n";
    std::string separator;
    for (const Equation& e : step.equations) {
      out += separator + latex_line(e, digits);
      separator = " \\\\\n";
    }
    out += "\n\\end{align*}\n";
  }
  return out;
}

}  // namespace clatter::validation
