// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/explain/formula.hpp"

#include <gsl/gsl_sf_lambert.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

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

}  // namespace clatter::validation
