// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/explain/formula.hpp"

#include <fmt/format.h>
#include <gsl/gsl_sf_lambert.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"

namespace clatter::validation {
namespace {

using Eigen::MatrixXd;

constexpr double degree = std::numbers::pi / 180;

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }

/// The only component.
double number_of(const MatrixXd& value) {
  if (value.size() != 1) throw std::logic_error("a formula has a vector where it needs a number");
  return value(0, 0);
}

Eigen::Vector3d vector_of(const MatrixXd& value) {
  if (value.rows() != 3 || value.cols() != 1) throw std::logic_error("a formula needs a vector of three components");
  return value;
}

/// The cosine of a right angle is 0, not the rounding of π.
double cosine(const Expression& angle) {
  const Quantity& quantity = angle->quantity;
  const bool is_right = quantity.unit == "°" && std::fabs(std::remainder(quantity.value(0, 0), 180)) == 90;
  return is_right ? 0 : std::cos(number_of(evaluated(angle)));
}

MatrixXd of_function(const std::string& name, const Expression& argument) {
  if (name == "cos") return scalar(cosine(argument));
  const MatrixXd x = evaluated(argument);
  if (name == "angle") return scalar(std::atan2(x(1), x(0)));
  const double number = number_of(x);
  if (name == "sin") return scalar(std::sin(number));
  if (name == "ln") return scalar(std::log(number));
  if (name == "exp") return scalar(std::exp(number));
  if (name == "√") return scalar(std::sqrt(number));
  if (name == "sgn") return scalar(number < 0 ? -1 : number > 0 ? 1 : 0);
  if (name == "W_0") return scalar(gsl_sf_lambert_W0(std::max(number, -1 / std::numbers::e)));  // rounding
  if (name == "K") return scalar(std::comp_ellint_1(std::sqrt(number)));
  throw std::logic_error("a formula has the unknown function " + name);
}

MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  if (a.size() == 1) return a(0, 0) * b;
  if (b.size() == 1) return a * b(0, 0);
  if (a.cols() != b.rows()) throw std::logic_error("a formula multiplies matrices that do not fit");
  return a * b;
}

MatrixXd raised(const MatrixXd& base, int exponent) {
  if (base.size() == 1) return scalar(std::pow(base(0, 0), exponent));
  if (exponent != -1) throw std::logic_error("a formula raises a matrix to a power other than −1");
  return base.inverse();
}

/// A number beside a matrix stands for that times the unit matrix, as 1/m in W = 1/m − [r]× I⁻¹ [r]×.
MatrixXd sum(const MatrixXd& a, const MatrixXd& b) {
  if (a.size() == 1 && b.size() > 1) return a(0, 0) * MatrixXd::Identity(b.rows(), b.cols()) + b;
  if (a.size() != b.size()) throw std::logic_error("a formula adds a vector to a number");
  return a + b;
}

/// How tightly an operation binds.
enum Binding { sums = 1, quotients, products, powers, atoms };

struct Sign {
  std::string_view text, tex;
};
constexpr Sign signs[]{{"Ω", "\\Omega "}, {"ω", "\\omega "},  {"α", "\\alpha "}, {"β", "\\beta "}, {"γ", "\\gamma "},
                       {"θ", "\\theta "}, {"φ", "\\varphi "}, {"Γ", "\\Gamma "}, {"μ", "\\mu "},   {"σ", "\\sigma "},
                       {"Δ", "\\Delta "}, {"λ", "\\lambda "}, {"τ", "\\tau "},   {"ζ", "\\zeta "}, {"ψ", "\\psi "},
                       {"ρ", "\\rho "},   {"²", "^2"},        {"³", "^3"},       {"⁴", "^4"},      {"·", "\\cdot "},
                       {"°", "^\\circ "}};

/// Each sign by its TeX.
std::string tex_of(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto* const sign = std::ranges::find_if(signs, [&](const Sign& one) { return text.starts_with(one.text); });
    const bool found = sign != std::end(signs);
    out += found ? sign->tex : text.substr(0, 1);
    text.remove_prefix(found ? sign->text.size() : 1);
  }
  return out.ends_with(' ') ? out.substr(0, out.size() - 1) : out;
}

bool is_whole(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Digits as an index.
std::string lowered(const std::string& digits) {
  constexpr std::string_view low[]{"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
  std::string out;
  for (const char digit : digits) out += low[digit - '0'];
  return out;
}

/// "1.5e-05" as 1.5 · 10^{-5}.
std::string tex_number(const std::string& text) {
  const std::size_t at = text.find('e');
  if (at == std::string::npos) return text;
  return fmt::format("{} \\cdot 10^{{{}}}", text.substr(0, at), std::stoi(text.substr(at + 1)));
}

}  // namespace

Symbol::Symbol(const std::string& text) : name(text) {
  constexpr const char* prime = "′";
  if (name.ends_with(prime)) {
    mark = prime;
    name.resize(name.size() - mark.size());
  }
  const std::size_t under = name.find('_');
  if (under == std::string::npos) return;
  index = name.substr(under + 1);
  name.resize(under);
}

Expression::Expression(int number)
    : node_(std::make_shared<Node>(Node{.operation = Operation::number, .exponent = number})) {}

Expression::Expression(const Quantity& quantity)
    : node_(std::make_shared<Node>(Node{.operation = Operation::quantity, .quantity = quantity})) {}

Expression::Expression(Operation operation, std::vector<Expression> parts, int exponent, std::string function)
    : node_(std::make_shared<Node>(Node{
          .operation = operation, .parts = std::move(parts), .exponent = exponent, .function = std::move(function)})) {}

Expression operator+(const Expression& a, const Expression& b) { return {Operation::sum, {a, b}}; }
Expression operator-(const Expression& a, const Expression& b) { return a + -b; }
Expression operator-(const Expression& a) { return {Operation::negative, {a}}; }
Expression operator*(const Expression& a, const Expression& b) { return {Operation::product, {a, b}}; }
Expression operator/(const Expression& a, const Expression& b) { return {Operation::quotient, {a, b}}; }
Expression power(const Expression& base, int exponent) { return {Operation::power, {base}, exponent}; }
Expression square(const Expression& base) { return power(base, 2); }
Expression function(const char* name, const Expression& argument) { return {Operation::function, {argument}, 0, name}; }
Expression absolute(const Expression& a) { return {Operation::absolute, {a}}; }
Expression dot(const Expression& a, const Expression& b) { return {Operation::dot, {a, b}}; }
Expression cross(const Expression& a, const Expression& b) { return {Operation::cross, {a, b}}; }
Expression cross_matrix(const Expression& a) { return {Operation::cross_matrix, {a}}; }
Expression column(const Expression& a, const Expression& b) { return {Operation::column, {a, b}}; }

MatrixXd evaluated(const Expression& e) {
  const auto part = [&](std::size_t i) { return evaluated(e->parts[i]); };
  switch (e->operation) {
    case Operation::number: return scalar(e->exponent);
    case Operation::quantity: return e->quantity.unit == "°" ? e->quantity.value * degree : e->quantity.value;
    case Operation::sum: return sum(part(0), part(1));
    case Operation::negative: return -part(0);
    case Operation::product: return product(part(0), part(1));
    case Operation::quotient: return part(0) / number_of(part(1));
    case Operation::power: return raised(part(0), e->exponent);
    case Operation::function: return of_function(e->function, e->parts[0]);
    case Operation::absolute: return scalar(part(0).norm());
    case Operation::dot: return part(0).transpose() * part(1);
    case Operation::cross: return vector_of(part(0)).cross(vector_of(part(1)));
    case Operation::cross_matrix: {
      const Eigen::Vector3d r = vector_of(part(0));
      return (Eigen::Matrix3d() << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0).finished();
    }
    case Operation::column: return Eigen::Vector2d(number_of(part(0)), number_of(part(1)));
  }
  return {};
}

std::vector<Quantity> quantities_in(const Expression& expression) {
  if (expression->operation == Operation::quantity) return {expression->quantity};
  std::vector<Quantity> all;
  for (const Expression& part : expression->parts) {
    for (const Quantity& quantity : quantities_in(part)) all.push_back(quantity);
  }
  return all;
}

std::string FormulaWriter::symbol(const Quantity& quantity) const {
  const Symbol& symbol = quantity.symbol;
  if (!is_tex()) {
    const std::string index = symbol.index.empty()                        ? ""
                              : is_whole(symbol.index)                    ? lowered(symbol.index)
                              : symbol.name == "μ" && symbol.index == "i" ? "ᵢ"
                                                                          : "_" + symbol.index;
    return symbol.name + index + symbol.mark;
  }
  std::string name = tex_of(symbol.name);
  if (quantity.value.size() > 1 && quantity.value.cols() == 1) name = "\\vec{" + name + "}";
  const bool is_word = symbol.index.size() > 2 && !is_whole(symbol.index);
  const std::string index = is_word ? "\\mathrm{" + symbol.index + "}" : symbol.index;
  const bool is_short = index.size() == 1;
  return name + (index.empty() ? "" : is_short ? "_" + index : "_{" + index + "}") + (symbol.mark.empty() ? "" : "'");
}

std::string FormulaWriter::component(const Quantity& quantity, double value) const {
  const std::string exact = shortest(value);
  const auto count = std::ranges::count_if(exact, [](unsigned char c) { return std::isdigit(c) != 0; });
  const bool is_exact = quantity.error == 0 && count <= digits_;
  const std::string text =
      is_exact ? exact : known_text({value, quantity.error}, {.digits = digits_, .size = quantity.size});
  return is_tex() ? tex_number(text) : text;
}

std::string FormulaWriter::matrix(const Quantity& quantity) const {
  const bool is_vector = quantity.value.cols() == 1;
  const std::string between = is_vector ? ", " : is_tex() ? " & " : ", ", row_end = is_tex() ? " \\\\ " : "; ";
  std::string out;
  for (Eigen::Index i = 0; i < quantity.value.rows(); ++i) {
    for (Eigen::Index k = 0; k < quantity.value.cols(); ++k) {
      if (i + k > 0) out += k > 0 || is_vector ? between : row_end;
      out += component(quantity, quantity.value(i, k));
    }
  }
  return is_tex() && !is_vector ? "\\begin{pmatrix}" + out + "\\end{pmatrix}" : "(" + out + ")";
}

std::string FormulaWriter::number(const Quantity& quantity) const {
  if (quantity.value.size() > 1) return matrix(quantity);
  const std::string text = component(quantity, quantity.value(0, 0));
  return quantity.unit == "°" ? text + (is_tex() ? "^\\circ" : "°") : text;
}

std::string FormulaWriter::value(const Quantity& quantity) const {
  if (quantity.unit.empty() || quantity.unit == "°") return number(quantity);
  return number(quantity) + (is_tex() ? "\\ \\mathrm{" + tex_of(quantity.unit) + "}" : " " + quantity.unit);
}

std::string FormulaWriter::words(const Words& words) const {
  std::string out;
  for (const auto& piece : words) {
    if (const auto* const text = std::get_if<std::string>(&piece)) out += is_tex() ? to_latex(*text) : *text;
    else out += is_tex() ? "$" + formula(std::get<Expression>(piece)) + "$" : formula(std::get<Expression>(piece));
  }
  return out;
}

int FormulaWriter::binding(const Expression& e, bool with_numbers) const {
  switch (e->operation) {
    case Operation::sum:
    case Operation::negative: return sums;
    case Operation::quotient: return is_tex() ? products : quotients;
    case Operation::product:
    case Operation::dot:
    case Operation::cross: return products;
    case Operation::power: return powers;
    case Operation::function: return e->function == "sin" || e->function == "cos" ? powers : atoms;
    case Operation::quantity: {
      if (!with_numbers || e->quantity.value.size() > 1) return atoms;
      const std::string text = number(e->quantity);
      if (text.starts_with('-')) return sums;
      return text.find_first_of("e^ ") == std::string::npos ? atoms : products;
    }
    default: return atoms;
  }
}

std::string FormulaWriter::bracketed(const std::string& text) const {
  const bool is_high = text.find("\\frac") != std::string::npos || text.find("pmatrix") != std::string::npos;
  return is_high ? "\\left(" + text + "\\right)" : "(" + text + ")";
}

std::string FormulaWriter::written(const Expression& e, bool with_numbers, int least) const {
  const std::string text = bare(e, with_numbers);
  return binding(e, with_numbers) < least ? bracketed(text) : text;
}

std::string FormulaWriter::sum(const Expression& e, bool with_numbers) const {
  const Expression &left = e->parts[0], &right = e->parts[1];
  const bool minus = right->operation == Operation::negative;
  const std::string sign = !minus ? " + " : is_tex() ? " - " : " − ";
  return written(left, with_numbers, sums) + sign + written(minus ? right->parts[0] : right, with_numbers, quotients);
}

std::string FormulaWriter::function(const Expression& e, bool with_numbers) const {
  const std::string& name = e->function;
  const Expression& argument = e->parts[0];
  if (name == "√" && is_tex()) return "\\sqrt{" + written(argument, with_numbers, 0) + "}";
  const bool is_known = name == "sin" || name == "cos" || name == "ln" || name == "exp";
  const std::string head = !is_tex()         ? (name == "W_0" ? "W₀" : name)
                           : is_known        ? "\\" + name
                           : name.size() > 3 ? "\\operatorname{" + name + "}"
                           : name == "sgn"   ? "\\operatorname{sgn}"
                                             : name;
  const bool is_plain = (name == "sin" || name == "cos") && argument->operation == Operation::quantity &&
                        (!with_numbers || !number(argument->quantity).starts_with('-'));
  const std::string inside = written(argument, with_numbers, 0);
  return is_plain ? head + " " + inside : head + bracketed(inside);
}

std::string FormulaWriter::bare(const Expression& e, bool with_numbers) const {
  const auto part = [&](std::size_t i, int least) { return written(e->parts[i], with_numbers, least); };
  const std::string times = is_tex() ? " \\cdot " : "·";
  switch (e->operation) {
    case Operation::number: return std::to_string(e->exponent);
    case Operation::quantity: return with_numbers ? number(e->quantity) : symbol(e->quantity);
    case Operation::sum: return sum(e, with_numbers);
    case Operation::negative: return (is_tex() ? "-" : "−") + part(0, quotients);
    case Operation::product: return part(0, products) + (with_numbers ? times : " ") + part(1, quotients);
    case Operation::quotient:
      return is_tex() ? "\\frac{" + part(0, 0) + "}{" + part(1, 0) + "}" : part(0, products) + "/" + part(1, powers);
    case Operation::power:
      return part(0, atoms) + (is_tex() ? fmt::format("^{{{}}}", e->exponent) : e->exponent == 2 ? "²" : "⁻¹");
    case Operation::function: return function(e, with_numbers);
    case Operation::absolute: return "|" + part(0, 0) + "|";
    case Operation::dot: return part(0, powers) + times + part(1, powers);
    case Operation::cross: return part(0, powers) + (is_tex() ? " \\times " : " × ") + part(1, powers);
    case Operation::cross_matrix: return "[" + part(0, 0) + (is_tex() ? "]_\\times" : "]×");
    case Operation::column: return "(" + part(0, 0) + ", " + part(1, 0) + ")";
  }
  return "";
}

}  // namespace clatter::validation
