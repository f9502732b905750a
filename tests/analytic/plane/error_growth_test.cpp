// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/error_growth.hpp"

#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;
using Real = long double;
using Column = std::array<Real, state_size>;

constexpr double rounding = 1e-13;  // relative to the row norms: 40 steps of a few eps each

/// All errors ever added, each followed by itself.
struct AllColumns {
  std::vector<Column> columns;

  void add(const StateVector& column) {
    Column copy;
    for (std::size_t i = 0; i < state_size; ++i) copy[i] = column[i];
    columns.push_back(copy);
  }
  void advance(const StateMatrix& jacobian) {
    for (Column& column : columns) {
      Column moved;
      for (std::size_t i = 0; i < state_size; ++i) {
        moved[i] = 0;
        for (std::size_t j = 0; j < state_size; ++j) moved[i] += Real(jacobian[i][j]) * column[j];
      }
      column = moved;
    }
  }
  [[nodiscard]] Real deviation(const StateVector& gradient) const {
    Real sum = 0;
    for (const Column& column : columns) {
      Real part = 0;
      for (std::size_t i = 0; i < state_size; ++i) part += Real(gradient[i]) * column[i];
      sum += part * part;
    }
    return std::sqrt(sum);
  }
};

StateVector unit(std::size_t i) {
  StateVector v{};
  v[i] = 1;
  return v;
}

/// Numbers of sizes 1, scale, scale², … that errors mix.
class Campaign {
 public:
  Campaign(unsigned seed, double scale) : random_(seed) {
    double size = 1;
    for (double& s : sizes_) s = size, size *= scale;
  }
  void step() {
    StateMatrix jacobian{};
    for (std::size_t i = 0; i < state_size; ++i) {
      for (std::size_t j = 0; j < state_size; ++j) {
        const double mixed = random_.one_in(3) ? random_(-1, 1) : 0;
        jacobian[i][j] = (mixed + (i == j ? 1 : 0)) * sizes_[i] / sizes_[j];
      }
    }
    factor_.advance(jacobian);
    all_.advance(jacobian);
    for (int k = 0; k < 2; ++k) {
      StateVector column;
      for (std::size_t i = 0; i < state_size; ++i) column[i] = random_(-1, 1) * sizes_[i];
      factor_.add(column);
      all_.add(column);
      const std::size_t number = random_.below(state_size);
      factor_.add(number, column[number]);
      all_.add(scaled(unit(number), column[number]));
    }
  }
  /// Largest error of a deviation, relative to the sum of those of its parts.
  [[nodiscard]] double worst() {
    double worst = 0;
    for (int k = 0; k < 20; ++k) {
      StateVector gradient;
      Real parts = 0;
      for (std::size_t i = 0; i < state_size; ++i) {
        gradient[i] = k < 6 ? (static_cast<std::size_t>(k) == i ? 1 : 0) : random_(-1, 1) / sizes_[i];
        parts += std::fabs(Real(gradient[i])) * all_.deviation(unit(i));
      }
      const auto number = static_cast<std::size_t>(k);
      const double of_number = k < 6 ? factor_.deviation_of(number) : factor_.deviation(gradient);
      for (const double found : {of_number, factor_.deviation(gradient)})
        worst = std::fmax(worst, static_cast<double>(std::fabs(Real(found) - all_.deviation(gradient)) / parts));
    }
    return worst;
  }

 private:
  static StateVector scaled(StateVector v, double by) {
    for (double& entry : v) entry *= by;
    return v;
  }

  clatter::test::Random random_;
  StateVector sizes_{};
  ErrorFactor factor_;
  AllColumns all_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(errors_put_together_keep_the_deviations_that_each_error_followed_by_itself_has) {
  for (const double scale : {1.0, 1e-3, 1e-25, 1e25}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      Campaign campaign(seed, scale);
      for (int step = 0; step < 40; ++step) {
        campaign.step();
        BOOST_TEST_CONTEXT("seed " << seed << " scale " << scale << " step " << step)
        BOOST_TEST(campaign.worst() <= rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(errors_whose_squares_are_no_doubles_keep_their_size) {
  for (const double size : {1e-300, 1e-160, 1e160, 1e300}) {
    ErrorFactor factor;
    factor.add({0, 3 * size});
    factor.add(std::size_t{1}, 4 * size);
    BOOST_TEST(std::fabs(factor.deviation({0, 1}) / (5 * size) - 1) <= 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(an_error_that_is_no_number_makes_every_deviation_infinite) {
  for (const double bad : {double(INFINITY), double(NAN)}) {
    ErrorFactor factor;
    factor.add({0, bad});
    BOOST_TEST(std::isinf(factor.deviation(unit(0))));
    BOOST_TEST(std::isinf(factor.deviation(unit(1))));
  }
  ErrorFactor sound;
  sound.add({1});
  BOOST_TEST(std::isinf(sound.deviation({NAN})));
}
