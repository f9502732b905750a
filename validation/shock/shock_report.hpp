// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter shock` says and draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/required_spectrum.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// A row for each impact and probe.
[[nodiscard]] std::vector<Column> shock_columns();
/// A row for each frequency of each spectrum.
[[nodiscard]] std::vector<Column> spectrum_columns();

/// A spectrum with what its rows and curves are called.
struct NamedSpectrum {
  std::string probe, model;
  std::string axis;  ///< "x", or a column of a record
  const Spectrum* spectrum = nullptr;
};
[[nodiscard]] Value spectrum_values(const std::vector<NamedSpectrum>& spectra, double quality);
/// "Q = 10", or "undamped".
[[nodiscard]] std::string quality_words(double quality);

enum class ShockRows { impacts, spectra, pulses };

/// What is shown of a run.
struct ShockView {
  ShockRows rows = ShockRows::impacts;         ///< of the table; JSON has all
  std::optional<double> severity{};            ///< pseudo-velocity with which those of the spectra are compared [m/s]
  std::vector<FragilePart> parts{};            ///< of which the damage boundaries are shown
  std::optional<double> rate{};                ///< the table is the history at this rate instead [Hz]
  std::optional<RequiredSpectrum> required{};  ///< beside which those of most impacts are set
};
[[nodiscard]] Grid spectrum_grid(const std::vector<NamedSpectrum>& spectra, int digits, const ShockView& view);
/// One table of the pseudo-velocities and accelerations of all probes, those of the first naming the columns.
[[nodiscard]] Grid spectrum_digest(const std::vector<std::vector<NamedSpectrum>>& shown, int digits,
                                   const ShockView& view);
/// Pseudo-velocity and acceleration over natural frequency; models other than the first one's are dashed.
[[nodiscard]] std::vector<PicturePanel> spectrum_panels(const std::vector<NamedSpectrum>& shown, const ShockView& view);
/// For each model the spectrum of most impacts, without flat drops.
[[nodiscard]] std::vector<NamedSpectrum> wholes_of(const std::vector<NamedSpectrum>& spectra);
/// How each spectrum stands to the required one, a sentence each; none: nothing is required.
[[nodiscard]] std::vector<std::string> required_words(const std::vector<NamedSpectrum>& spectra, const ShockView& view,
                                                      double quality);
/// The filter, and how spectra stand to the required one, for other programs.
void add_spectrum_fields(const std::vector<NamedSpectrum>& compared, const ShockRequest& request, const ShockView& view,
                         Report& report);
[[nodiscard]] Report shock_report(const ShockRun& run, const ShockView& view);
/// The spectra of each probe, or of one alone, and the damage boundaries; at a rate the history of each probe.
[[nodiscard]] Picture shock_picture(const ShockRun& run, const ShockView& view,
                                    std::optional<std::size_t> of_probe = std::nullopt);

}  // namespace clatter::validation
