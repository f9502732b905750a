// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/error_factor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace clatter::analytic {

namespace {

/// √Σ values², also where squares would leave the doubles; infinite for NaN.
double norm(std::span<const double> values) {
  constexpr double least = 1e-280, most = 1e280;  // of a sum whose small terms may underflow
  double sum = 0, largest = 0;
  for (const double value : values) sum += value * value;
  if (sum >= least && sum <= most) return std::sqrt(sum);
  if (std::isnan(sum)) return std::numeric_limits<double>::infinity();
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  if (largest == 0 || !std::isfinite(largest)) return largest;
  sum = 0;
  for (const double value : values) sum += (value / largest) * (value / largest);
  return largest * std::sqrt(sum);
}

template <std::size_t size>
bool all_finite(const std::array<double, size>& values) {
  double zero = 0;
  for (const double value : values) zero += 0 * value;
  return zero == 0;
}

}  // namespace

/// At most `state_size` columns with the same F Fᵀ, unless there is room: Householder's reflection
/// of the columns from `first` on leaves the norm of row i in column `first` alone; rows above have
/// nothing in these columns.  Rounding of a row is relative to the row's own norm.
void ErrorFactor::make_room(std::size_t columns) {
  if (columns_ + columns <= capacity) return;
  std::size_t first = 0;
  for (std::size_t i = 0; i < state_size; ++i) {
    const double length = norm(std::span(rows_[i]).subspan(first));
    if (!(length > 0)) continue;
    Row mirror{};
    for (std::size_t k = first; k < capacity; ++k) mirror[k] = rows_[i][k] / length;
    const double sign = std::copysign(1.0, mirror[first]);
    const double scale = 1 + std::fabs(mirror[first]);
    mirror[first] += sign;
    std::fill(rows_[i].begin() + static_cast<std::ptrdiff_t>(first), rows_[i].end(), 0.0);
    rows_[i][first] = -sign * length;
    for (std::size_t below = i + 1; below < state_size; ++below) {
      double along = 0;
      for (std::size_t k = 0; k < capacity; ++k) along += mirror[k] * rows_[below][k];
      along /= scale;
      for (std::size_t k = 0; k < capacity; ++k) rows_[below][k] -= along * mirror[k];
    }
    ++first;
  }
  columns_ = first;
}

void ErrorFactor::add(const StateVector& column) {
  known_ = known_ && all_finite(column);
  make_room(1);
  for (std::size_t i = 0; i < state_size; ++i) rows_[i][columns_] = column[i];
  ++columns_;
}

void ErrorFactor::add(std::size_t number, double size) {
  alone_[number] = norm(std::array{alone_[number], size});
  known_ = known_ && std::isfinite(alone_[number]);
}

void ErrorFactor::append_alone() {
  make_room(
      static_cast<std::size_t>(std::count_if(alone_.begin(), alone_.end(), [](double size) { return size != 0; })));
  for (std::size_t i = 0; i < state_size; ++i) {
    if (alone_[i] != 0) rows_[i][columns_++] = alone_[i];
  }
  alone_ = {};
}

void ErrorFactor::advance(const StateMatrix& jacobian) {
  append_alone();
  const std::array<Row, state_size> old = rows_;
  for (std::size_t i = 0; i < state_size; ++i) {
    Row sum{};
    for (std::size_t j = 0; j < state_size; ++j) {
      if (jacobian[i][j] == 0) continue;
      for (std::size_t k = 0; k < capacity; ++k) sum[k] += jacobian[i][j] * old[j][k];
    }
    known_ = known_ && all_finite(sum);
    rows_[i] = sum;
  }
}

double ErrorFactor::deviation(const StateVector& gradient) const {
  if (!known_) return std::numeric_limits<double>::infinity();
  std::array<double, capacity + state_size> parts;  // not filled first, which took longer than the products
  for (std::size_t i = 0; i < state_size; ++i) parts[i] = gradient[i] * alone_[i];
  for (std::size_t k = 0; k < columns_; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < state_size; ++i) sum += gradient[i] * rows_[i][k];
    parts[state_size + k] = sum;
  }
  return norm(std::span(parts).first(state_size + columns_));
}

StateVector product(const StateMatrix& jacobian, const StateVector& vector) {
  StateVector result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = 0; j < state_size; ++j) result[i] += jacobian[i][j] * vector[j];
  }
  return result;
}

}  // namespace clatter::analytic
