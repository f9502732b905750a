#include "analytic/error_factor.hpp"

#include <cmath>
#include <limits>

namespace clatter::analytic {
namespace {

double norm(double a, double b) {
  const double size = std::fmax(std::fabs(a), std::fabs(b));
  if (!(size > 0)) return size;
  const double x = a / size, y = b / size;
  return size * std::sqrt(x * x + y * y);
}

}  // namespace

/// Each rotation of the columns i of F and the new one makes entry i of the new one vanish.
void ErrorFactor::add(const StateVector& column) {
  for (const double value : column) known_ = known_ && std::isfinite(value);
  StateVector left = column;
  for (std::size_t i = 0; i < state_size; ++i) {
    const double length = norm(rows_[i][i], left[i]);
    if (!(length > 0) || left[i] == 0) continue;
    const double c = rows_[i][i] / length, s = left[i] / length;
    for (std::size_t k = i; k < state_size; ++k) {
      const double old = rows_[k][i];
      rows_[k][i] = c * old + s * left[k];
      left[k] = c * left[k] - s * old;
    }
  }
}

void ErrorFactor::advance(const StateMatrix& jacobian) {
  const StateMatrix old = rows_;
  rows_ = {};
  for (std::size_t k = 0; k < state_size; ++k) {
    StateVector column{};
    for (std::size_t i = 0; i < state_size; ++i) column[i] = old[i][k];
    add(product(jacobian, column));
  }
}

double ErrorFactor::deviation(const StateVector& gradient) const {
  if (!known_) return std::numeric_limits<double>::infinity();
  double size = 0;
  for (std::size_t k = 0; k < state_size; ++k) {
    double sum = 0;
    for (std::size_t i = k; i < state_size; ++i) sum += gradient[i] * rows_[i][k];
    size = norm(size, sum);
  }
  return size;
}

StateVector product(const StateMatrix& jacobian, const StateVector& vector) {
  StateVector result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = 0; j < state_size; ++j) result[i] += jacobian[i][j] * vector[j];
  }
  return result;
}

}  // namespace clatter::analytic
