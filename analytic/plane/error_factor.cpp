// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/error_factor.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "analytic/base/limits.hpp"

namespace clatter::analytic {

namespace {

/// Numbers that a processor computes side by side.
constexpr std::size_t lanes = 4;
using Lanes = std::array<double, lanes>;

double sum(const Lanes& parts) { return (parts[0] + parts[1]) + (parts[2] + parts[3]); }

/// Σ aᵢ bᵢ of as many numbers as fill lanes.
double product(std::span<const double> a, std::span<const double> b) {
  Lanes parts{};
  for (std::size_t k = 0; k < a.size(); k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) parts[lane] += a[k + lane] * b[k + lane];
  }
  return sum(parts);
}

/// √Σ values², also where squares would leave the doubles; infinite for NaN.
/// @param values as many as fill lanes
double norm(std::span<const double> values) {
  constexpr double least = 1e-280, most = 1e280;  // of a sum whose small terms may underflow
  const double squares = product(values, values);
  if (squares >= least && squares <= most) return std::sqrt(squares);
  if (std::isnan(squares)) return detail::infinite;
  Lanes sizes{};
  for (std::size_t k = 0; k < values.size(); k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) sizes[lane] = std::max(sizes[lane], std::fabs(values[k + lane]));
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  if (largest == 0 || largest == detail::infinite) return largest;
  double scaled = 0;
  for (const double value : values) scaled += (value / largest) * (value / largest);
  return largest * std::sqrt(scaled);
}

/// Four columns of the rows.
using Block = std::array<Lanes, state_size>;

/// factorsᵀ block.
Lanes combined(const StateVector& factors, const Block& block) {
  Lanes result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t lane = 0; lane < lanes; ++lane) result[lane] += factors[i] * block[i][lane];
  }
  return result;
}

/// From column k on.
Block block_of(const auto& rows, std::size_t k) {
  Block block;
  for (std::size_t i = 0; i < state_size; ++i) std::copy_n(&rows[i][k], lanes, block[i].begin());
  return block;
}

}  // namespace

/// At most `state_size` columns with the same F Fᵀ, unless there is room: Householder's reflection
/// of the columns from `first` on leaves the norm of row i in column `first` alone; rows above have
/// nothing in these columns.  Rounding of a row is relative to the row's own norm.
void ErrorFactor::make_room(std::size_t columns) {
  if (columns_ + columns <= capacity) return;
  std::size_t first = 0;
  for (std::size_t i = 0; i < state_size; ++i) {
    Row mirror = rows_[i];
    std::fill_n(mirror.begin(), first, 0.0);
    const double length = norm(mirror);
    if (!(length > 0)) continue;
    for (double& entry : mirror) entry *= 1 / length;
    const double sign = std::copysign(1.0, mirror[first]);
    const double scale = 1 + std::fabs(mirror[first]);
    mirror[first] += sign;
    std::fill(rows_[i].begin() + static_cast<std::ptrdiff_t>(first), rows_[i].end(), 0.0);
    rows_[i][first] = -sign * length;
    for (std::size_t below = i + 1; below < state_size; ++below) {
      const double along = product(mirror, rows_[below]) / scale;
      for (std::size_t k = 0; k < capacity; ++k) rows_[below][k] -= along * mirror[k];
    }
    ++first;
  }
  columns_ = first;
}

void ErrorFactor::add(const StateVector& column) {
  if (column == StateVector{}) return;
  for (const double entry : column) known_ = known_ && std::isfinite(entry);
  make_room(1);
  for (std::size_t i = 0; i < state_size; ++i) rows_[i][columns_] = column[i];
  ++columns_;
}

void ErrorFactor::add(std::size_t number, double size) {
  alone_[number] = alone_[number] == 0 ? std::fabs(size) : norm(std::array{alone_[number], size, 0.0, 0.0});
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
  Lanes zero{};
  for (std::size_t k = 0; k < columns_; k += lanes) {
    const Block old = block_of(rows_, k);
    for (std::size_t i = 0; i < state_size; ++i) {
      const Lanes sums = combined(jacobian[i], old);
      for (std::size_t lane = 0; lane < lanes; ++lane) zero[lane] += 0 * sums[lane];
      std::copy(sums.begin(), sums.end(), &rows_[i][k]);
    }
  }
  known_ = known_ && sum(zero) == 0;
}

double ErrorFactor::deviation_of(std::size_t number) const {
  std::array<double, capacity + lanes> parts{};
  parts[capacity] = alone_[number];
  std::copy(rows_[number].begin(), rows_[number].end(), parts.begin());
  return known_ ? norm(parts) : detail::infinite;
}

double ErrorFactor::deviation(const StateVector& gradient) const {
  if (!known_) return detail::infinite;
  std::array<double, capacity + 2 * lanes> parts;  // not filled first, which took longer than the products
  std::size_t size = 2 * lanes;
  for (std::size_t i = 0; i < size; ++i) parts[i] = i < state_size ? gradient[i] * alone_[i] : 0;
  for (std::size_t k = 0; k < columns_; k += lanes, size += lanes) {
    const Lanes sums = combined(gradient, block_of(rows_, k));
    std::copy(sums.begin(), sums.end(), &parts[size]);
  }
  return norm(std::span(parts).first(size));
}

StateVector product(const StateMatrix& jacobian, const StateVector& vector) {
  StateVector result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = 0; j < state_size; ++j) result[i] += jacobian[i][j] * vector[j];
  }
  return result;
}

}  // namespace clatter::analytic
