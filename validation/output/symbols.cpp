// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/symbols.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace clatter::validation {
namespace {

/// Characters, and after each what stands for it: separated by blanks, or a text for each.
constexpr const char* latex_words =
    R"(ω_x $\omega_x$ ω_z $\omega_z$ V_y $V_y$ P_y $P_y$
\ \textbackslash{} % \% # \# _ \_ & \& ° $^\circ$ Ω $\Omega$ β $\beta$ γ $\gamma$ θ $\theta$ μ $\mu$ Σ
$\Sigma$ · $\cdot$ … \dots{} ∞ $\infty$ ± $\pm$ − $-$ ₁ $_1$ ₂ $_2$ ₃ $_3$ ² $^2$ ₙ $_n$ ₜ $_t$ ≤ $\le$ ₖ
$_k$ ₛ $_s$ ³ $^3$ ⁴ $^4$ → $\to$ ≈ $\approx$ – -- π $\pi$ ω $\omega$ α $\alpha$ √ $\surd$ × $\times$ ✓
$\surd$ ✗ $\times$)";
constexpr std::string_view ascii[]{
    "°",      "deg",   "Ω",      "Omega", "ω", "omega",  "β", "beta",  "γ",  "gamma", "θ", "theta", "μ",      "mu",
    "Σ",      "sum ",  "·",      "*",     "…", "...",    "∞", "inf",   "±",  "+-",    "−", "-",     "₁",      "1",
    "₂",      "2",     "₃",      "3",     "²", "^2",     "³", "^3",    "⁴",  "^4",    "ₛ", "_s",    "≈",      "~",
    "✓",      "+",     "✗",      "X",     "δ", "delta",  "ₖ", "_k",    "ₙ",  "_n",    "ₜ", "_t",    "ᵢ",      "_i",
    "≤",      "<=",    "≥",      ">=",    "─", "-",      "–", "-",     "é",  "e",     "×", "x",     "φ",      "phi",
    "α",      "alpha", "σ",      "sigma", "′", "'",      "″", "''",    "½",  "1/2",   "→", "->",    "√",      "sqrt ",
    "Δ",      "d",     "⇒",      "=>",    "π", "pi",     "Γ", "Gamma", "₀",  "0",     "₄", "4",     "₅",      "5",
    "₆",      "6",     "₇",      "7",     "₈", "8",      "₉", "9",     "⁻¹", "^-1",   "τ", "tau",   "ζ",      "zeta",
    "ψ",      "psi",   "ρ",      "rho",   "λ", "lambda", "∂", "d",     "ν",  "nu",    "∫", "int ",  "\u0307", "_dot",
    "\u0308", "_ddot", "\u0303", "~",     "ũ", "u~",     "Ġ", "G_dot", "ᵀ",  "^T"};

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// Each character by that of the table, in one pass, so that nothing is replaced twice.
std::string replaced(std::string_view text, std::span<const std::string_view> table) {
  std::string out;
  while (!text.empty()) {
    std::size_t i = 0;
    while (i < table.size() && !text.starts_with(table[i])) i += 2;
    const bool found = i < table.size();
    out += found ? table[i + 1] : text.substr(0, 1);
    text.remove_prefix(found ? table[i].size() : 1);
  }
  return out;
}

/// Bytes of the character at the text's beginning; 0 where they are no UTF-8.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80 ? 1 : lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : 4;
  if ((lead >= 0x80 && lead < 0xC2) || lead >= 0xF5 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((text[i] & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// C0, DEL and, in UTF-8, C1.
bool is_control(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  return lead < 0x20 || lead == 0x7F || (lead == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

}  // namespace

std::string to_latex(const std::string& text) {
  static const std::vector<std::string_view> table = words_of(latex_words);
  return replaced(text, table);
}
std::string to_ascii(const std::string& text) { return replaced(text, ascii); }

std::string printable(std::string_view text, Lines lines) {
  std::string out;
  while (!text.empty()) {
    const std::size_t known = character_length(text), length = std::max<std::size_t>(known, 1);
    const std::string_view character = text.substr(0, length);
    text.remove_prefix(length);
    const bool stays = known > 0 && (!is_control(character) || (lines == Lines::kept && character == "\n"));
    if (stays) out += character;
    else
      for (const char byte : character) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  }
  return out;
}

}  // namespace clatter::validation
