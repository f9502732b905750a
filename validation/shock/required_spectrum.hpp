// SPDX-License-Identifier: GPL-3.0-or-later
// A response spectrum that a test standard or a customer asks for, beside one that was computed or measured.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/output/text_rows.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// Units of acceleration as files write them, in m/s².
inline constexpr UnitName acceleration_units[]{{"g", standard_gravity},
                                               {"gn", standard_gravity},
                                               {"g_n", standard_gravity},
                                               {"mg", 1e-3 * standard_gravity},
                                               {"m/s^2", 1},
                                               {"m/s2", 1},
                                               {"m/s²", 1},
                                               {"m/s/s", 1},
                                               {"m s^-2", 1},
                                               {"m s-2", 1},
                                               {"ms-2", 1},
                                               {"ms^-2", 1},
                                               {"m.s-2", 1},
                                               {"m·s⁻²", 1},
                                               {"meters/s^2", 1},
                                               {"mm/s^2", 1e-3},
                                               {"m/sec^2", 1},
                                               {"m/s**2", 1}};

/// Maximax accelerations over natural frequency, straight lines between breakpoints in logarithmic scales.
struct RequiredSpectrum {
  std::string path;
  std::vector<std::pair<double, double>> points;  ///< rising frequencies [Hz] and accelerations [m/s²], > 0

  /// Nothing below the first and above the last breakpoint.
  [[nodiscard]] std::optional<double> at(double frequency) const;
};

/// Reads a text with a row for each breakpoint, a frequency and an acceleration, whose unit stands above the rows.
/// @throws BadInput for anything else
[[nodiscard]] RequiredSpectrum read_required_spectrum(const std::string& path);

/// 20 lg of a spectrum over the required one, over the frequencies that both have.
struct SpectrumMargin {
  struct End {
    Estimated decibels;
    double frequency = 0;  ///< [Hz]
  };
  End least, most;

  /// Nothing falls short of the requirement, as a test must have it; nothing goes beyond, as what was qualified by it
  /// must have it.  Unknown where an error leaves it open.
  [[nodiscard]] std::optional<bool> is_reached() const;
  [[nodiscard]] std::optional<bool> is_kept() const;
  /// "up to 3.2 dB below it at 1200 Hz, ...".
  [[nodiscard]] std::string words() const;
};
/// 20 lg of a point over it.
[[nodiscard]] Estimated decibels_over(double required, const ResponsePoint& point);
/// None where they have no frequency in common.
[[nodiscard]] std::optional<SpectrumMargin> margin_over(const RequiredSpectrum& required, const Spectrum& spectrum);

}  // namespace clatter::validation
