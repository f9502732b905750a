// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of every room share: what most of them include, random numbers, errors in ulp, and what an exception says.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace clatter::test {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// For BOOST_CHECK_EXCEPTION: the message contains the text.
inline auto mentions(const std::string& text) {
  return [text](const std::exception& error) { return std::string(error.what()).find(text) != std::string::npos; };
}

/// What evaluates the expression must throw.
#define CHECK_REFUSED(expression, error) BOOST_CHECK_THROW(static_cast<void>(expression), error)
/// The same with a text that the message contains.
#define CHECK_REFUSED_SAYING(expression, error, text) \
  BOOST_CHECK_EXCEPTION(static_cast<void>(expression), error, clatter::test::mentions(text))

/// How far a double is from a number of more digits, in units of its last place.
template <class Exact>
double ulps(double value, const Exact& exact) {
  const double nearest = std::fabs(static_cast<double>(exact));
  return static_cast<double>(Exact(abs(Exact(value) - exact))) / (std::nextafter(nearest, infinite) - nearest);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double decades(double low, double high) { return std::pow(10, (*this)(low, high)); }
  /// A whole number from 0 to count − 1.
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_); }
  bool one_in(std::size_t count) { return below(count) == 0; }
  Eigen::Vector3d vector(double size = 1) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Eigen::Vector3d direction() { return normal().head<3>().normalized(); }
  Eigen::Quaterniond attitude() { return Eigen::Quaterniond(normal()).normalized(); }
  std::mt19937_64& engine() { return engine_; }

 private:
  Eigen::Vector4d normal() {
    std::normal_distribution<double> one;
    return {one(engine_), one(engine_), one(engine_), one(engine_)};
  }

  std::mt19937_64 engine_;
};

}  // namespace clatter::test
