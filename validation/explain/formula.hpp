// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas as structure: expressions of quantities, from which the formula, the same with its numbers put in, and its
// value follow.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace clatter::validation {

/// How a quantity is called: made from "V_n1" or "ω_x′", name, index and mark.
struct Symbol {
  std::string name, index{}, mark{};

  Symbol(const char* text) : Symbol(std::string(text)) {}  // NOLINT: a text is a symbol
  Symbol(const std::string& text);                         // NOLINT
  [[nodiscard]] bool operator==(const Symbol&) const = default;
};

/// A number, vector or matrix with its name, unit and what is known of it.
struct Quantity {
  Symbol symbol;
  Eigen::MatrixXd value;
  std::string unit{};
  double error = 0;  ///< bound on the error of each component; 0: exact as given; infinite: not known
  double size = 0;   ///< of such numbers: a component that is small beside it counts as zero
};

enum class Operation {
  number,    ///< written as such
  quantity,  ///< by its symbol, or by its number
  sum,
  negative,
  product,
  quotient,
  power,  ///< with a whole exponent
  function,
  absolute,  ///< length, of a vector
  dot,
  cross,
  cross_matrix,  ///< [r]×, which makes r × a of a vector a
  column,        ///< a vector of its components
};

/// An expression, a tree of operations.
class Expression {
 public:
  struct Node;
  Expression(int number);                // NOLINT: a number is an expression
  Expression(const Quantity& quantity);  // NOLINT: so is a quantity
  Expression(Operation operation, std::vector<Expression> parts, int exponent = 0, std::string function = "");

  [[nodiscard]] const Node* operator->() const { return node_.get(); }

 private:
  std::shared_ptr<const Node> node_;
};

struct Expression::Node {
  Operation operation;
  std::vector<Expression> parts{};
  int exponent = 0;        ///< of a power, or the number itself
  std::string function{};  ///< "sin", "cos", "ln", "exp", "√", "sgn", "angle", "W_0" (Lambert), "K" (elliptic, of k²)
  Quantity quantity{"", {}};
};

[[nodiscard]] Expression operator+(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator-(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator-(const Expression& a);
[[nodiscard]] Expression operator*(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator/(const Expression& a, const Expression& b);
[[nodiscard]] Expression power(const Expression& base, int exponent);
[[nodiscard]] Expression square(const Expression& base);
[[nodiscard]] Expression function(const char* name, const Expression& argument);
[[nodiscard]] Expression absolute(const Expression& a);
[[nodiscard]] Expression dot(const Expression& a, const Expression& b);
[[nodiscard]] Expression cross(const Expression& a, const Expression& b);
[[nodiscard]] Expression cross_matrix(const Expression& a);
[[nodiscard]] Expression column(const Expression& a, const Expression& b);

/// The value of an expression; a quantity in degrees counts in radians.
/// Accuracy: rounding of doubles × the condition number.  @throws std::logic_error for sizes that do not go together
[[nodiscard]] Eigen::MatrixXd evaluated(const Expression& expression);
/// All quantities in an expression, from left to right.
[[nodiscard]] std::vector<Quantity> quantities_in(const Expression& expression);

/// Prose with formulas in it.
using Words = std::vector<std::variant<std::string, Expression>>;

/// One line: symbol = formula = numbers = value; without a formula words say where the value comes from.
struct Equation {
  Quantity quantity;
  std::vector<Expression> formula{};  ///< none or one
  Words words{};
};

/// A law as it stands, left = right, whose symbols need no number yet.
struct Law {
  Expression left, right;
};

/// A titled group of words, laws and equations.
struct Step {
  std::string title;
  Words words;
  std::vector<Law> laws{};
  std::vector<Equation> equations{};
};

// Formulas written as text or as TeX.

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
