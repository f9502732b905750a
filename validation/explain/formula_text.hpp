// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas written as text or as TeX.
#pragma once

#include <string>

#include "validation/explain/formula.hpp"

namespace clatter::validation {

/// How formulas are written: "−(1 + e) m u/A" or "-\frac{(1 + e) m u}{A}", which needs amsmath.
enum class Notation { text, tex };

/// Writes formulas and their numbers in one notation, with at most so many digits.
class FormulaWriter {
 public:
  FormulaWriter(Notation notation, int digits) : notation_(notation), digits_(digits) {}

  [[nodiscard]] std::string symbol(const Quantity& quantity) const;
  /// With symbols.
  [[nodiscard]] std::string formula(const Expression& expression) const { return written(expression, false, 0); }
  /// The same with numbers in place of symbols.
  [[nodiscard]] std::string numbers(const Expression& expression) const { return written(expression, true, 0); }
  /// The number with the digits that are known of it, and its unit.
  [[nodiscard]] std::string value(const Quantity& quantity) const;
  /// Prose with its formulas; in TeX for text mode.
  [[nodiscard]] std::string words(const Words& words) const;

 private:
  [[nodiscard]] bool is_tex() const { return notation_ == Notation::tex; }
  [[nodiscard]] std::string component(const Quantity& quantity, double value) const;
  [[nodiscard]] std::string number(const Quantity& quantity) const;
  [[nodiscard]] std::string matrix(const Quantity& quantity) const;
  /// How tightly the outermost operation binds, as it is written.
  [[nodiscard]] int binding(const Expression& expression, bool with_numbers) const;
  /// In brackets if it binds less than `least`.
  [[nodiscard]] std::string written(const Expression& expression, bool with_numbers, int least) const;
  [[nodiscard]] std::string bare(const Expression& expression, bool with_numbers) const;
  [[nodiscard]] std::string sum(const Expression& expression, bool with_numbers) const;
  [[nodiscard]] std::string function(const Expression& expression, bool with_numbers) const;
  [[nodiscard]] std::string bracketed(const std::string& text) const;

  Notation notation_;
  int digits_;
};

}  // namespace clatter::validation
