// SPDX-License-Identifier: GPL-3.0-or-later
// The low-pass filter against the response of a Butterworth filter, its phase, and what it leaves of noise.
#include "validation/shock/low_pass.hpp"

#include "tests/support.hpp"

using namespace clatter::validation;

namespace {

using std::numbers::pi;
constexpr double step = 1e-5;       // [s]
constexpr double exact = 1e-9;      // of (1), with its frequencies bent by the steps
constexpr double of_analog = 3e-3;  // of the analog filter: (π f_d T)² at CFC 1000 and this step, 4e-3, times 2/3

/// Amplitudes of the filtered cosine along cosine and sine, over whole periods in the middle of a long record.
std::pair<double, double> gain_at(const LowPass& filter, double frequency) {
  const auto count = static_cast<std::size_t>(200 / (frequency * step));
  std::vector<Vector3> values;
  for (std::size_t i = 0; i < count; ++i)
    values.emplace_back(std::cos(2 * pi * frequency * step * static_cast<double>(i)), 1, 0);
  const std::vector<Vector3> filtered = filter.filtered(values, step);
  double in_phase = 0, across = 0, all = 0;
  for (std::size_t i = count / 4; i < 3 * count / 4; ++i) {
    const double angle = 2 * pi * frequency * step * static_cast<double>(i);
    in_phase += filtered[i].x() * std::cos(angle);
    across += filtered[i].x() * std::sin(angle);
    all += std::cos(angle) * std::cos(angle);
    BOOST_TEST(std::fabs(filtered[i].y() - 1) < exact);  // what stays is left as it is
  }
  return {in_phase / all, across / all};
}

}  // namespace

BOOST_AUTO_TEST_CASE(both_passes_have_the_square_of_a_butterworth_filter_and_no_phase) {
  const LowPass filter = LowPass::of_class(1000);
  BOOST_TEST(filter.design == 2077.5);  // SAE J211-1
  for (const double frequency : {100., 500., 1000., 2000., 4000., 10'000.}) {
    const auto [gain, across] = gain_at(filter, frequency);
    const double bent = std::tan(pi * frequency * step) / std::tan(pi * filter.design * step);
    BOOST_TEST(std::fabs(gain - 1 / (1 + std::pow(bent, 4))) < exact);
    BOOST_TEST(std::fabs(across) < exact);
    BOOST_TEST(std::fabs(gain - 1 / (1 + std::pow(frequency / filter.design, 4))) < of_analog);
  }
}

BOOST_AUTO_TEST_CASE(a_cut_off_is_where_both_passes_together_halve_the_power) {
  const LowPass filter = LowPass::of_cut_off(500);
  BOOST_TEST(std::fabs(filter.cut_off() - 500) < 1e-10);
  BOOST_TEST(std::fabs(gain_at(filter, 500).first - std::sqrt(0.5)) < of_analog);
  // The class is 0.6 of the cut-off, to the digits of 2.0775.
  BOOST_TEST(std::fabs(LowPass::of_class(600).cut_off() / 1000 - 1) < 1e-3);
}

BOOST_AUTO_TEST_CASE(noise_is_left_as_the_squared_response_says) {
  // ∫ (1 + x⁴)⁻² dx from 0 on is 3π/(8√2), of the band up to half the rate.
  const LowPass filter = LowPass::of_cut_off(200);
  const double squares = 2 * step * filter.design * 3 * pi / (8 * std::numbers::sqrt2);
  BOOST_TEST(std::fabs(filter.noise_gain(step) / std::sqrt(squares) - 1) < 1e-3);
}

BOOST_AUTO_TEST_CASE(too_few_samples_for_a_filter_are_refused) {
  BOOST_CHECK_THROW((void)LowPass::of_class(1000).filtered({Vector3::Zero()}, 1. / 4000), std::domain_error);
}
