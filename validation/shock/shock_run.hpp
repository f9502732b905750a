// SPDX-License-Identifier: GPL-3.0-or-later
// All that `clatter shock` computes of a scene: rows of both models, response spectra, and the flat drop beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/compare/discrete_side.hpp"
#include "validation/scene/probes.hpp"
#include "validation/shock/low_pass.hpp"
#include "validation/shock/response_spectrum.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {

/// What of a shock is asked for.
struct ShockRequest {
  bool continuous = true;            ///< the continuous model, too
  bool sensitivity = true;           ///< of peaks, four more runs
  std::vector<FragilePart> parts{};  ///< whose margins are asked for, each at every probe
  double low = 10, high = 1e4;       ///< natural frequencies [Hz]
  int count = 61;
  double quality = 10;        ///< Q; infinite: undamped
  int first = 2;              ///< so many impacts are the "first" ones
  std::optional<int> axis{};  ///< of the body: 0, 1, 2; none: that with the largest change of velocity of each probe
  std::optional<LowPass> filter{};    ///< of what the continuous model or a record reads, before peaks and spectra
  std::vector<double> breakpoints{};  ///< further natural frequencies, those of a required spectrum [Hz]

  /// Natural frequencies of spectra, rising [Hz].
  [[nodiscard]] std::vector<double> natural_frequencies() const;
};

/// Which part of the drop a spectrum is of: `first` and `all` where they have more impacts than the part before.
enum class Blows { impact_1, first, all, flat };

struct Spectrum {
  std::size_t probe = 0;
  int axis = 2;  ///< of the body
  bool continuous = true;
  Blows blows = Blows::all;
  int impacts = 1;  ///< so many are in it
  std::vector<ResponsePoint> points{};
};

struct ShockRun {
  Scene scene;
  std::vector<Probe> probes;
  ShockRequest request;
  std::optional<ContinuousShock> continuous;
  std::optional<Run> discrete_run;
  std::vector<ShockRow> discrete;
  std::string discrete_reason;  ///< why there is no discrete run; empty: there is one
  PartedBlows parted;           ///< from where on rows of the two models are not beside each other
  std::vector<Spectrum> spectra;
  std::vector<FilteredHistory> filtered;           ///< of each probe, where a filter is asked for
  std::vector<std::optional<Envelope>> envelopes;  ///< of each probe, after its first two impacts; the discrete model's

  [[nodiscard]] const Spectrum* spectrum(std::size_t probe, bool of_continuous, Blows blows) const;
  /// The spectrum of most impacts.
  [[nodiscard]] const Spectrum* whole(std::size_t probe, bool of_continuous) const;
  /// The run of the model that comes first: of the continuous one where it ran.
  [[nodiscard]] Run leading_run() const { return continuous ? run_of(continuous->planned.run) : *discrete_run; }
  /// How that ended, and in words.
  struct Ending {
    std::string outcome, message;
  };
  [[nodiscard]] Ending ending() const;
  /// Whether it ended after as many impacts as were asked for, so that harder ones may follow.
  [[nodiscard]] bool ends_at_limit() const;
  [[nodiscard]] const std::vector<ShockRow>& rows() const { return continuous ? continuous->rows : discrete; }
  /// The row of that impact and probe to show by the discrete model: none beside another blow of the continuous one.
  [[nodiscard]] const ShockRow* discrete_row(int impact, std::size_t probe) const;
};

/// Runs the scene's probes through one model or both.  Spectra take the impacts that can be predicted alone.  A
/// discrete model that cannot take the scene beside the continuous one leaves its reason.
/// @throws as continuous_shock and run_discrete.
[[nodiscard]] ShockRun run_shock(const Scene& scene, const std::vector<Probe>& probes, const ShockRequest& request,
                                 const numeric::Observer& observer = {});

}  // namespace clatter::validation
