// SPDX-License-Identifier: GPL-3.0-or-later
// What a report finds: the worst drop, its answer in a sentence, and what that depends on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/report/attitudes.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// What a drop does at its worst.
struct Answer {
  std::optional<Blow> blow;  ///< none: nothing struck a probe
  std::string words;
  Value fields = Value(Value::Fields{});
};

/// What a page is about.
struct Findings {
  std::optional<AllAttitudes> all;  ///< none: of the drop as given alone
  Scene scene;                      ///< of the worst drop of all, or as given
  ShockRun run;
  Ranking ranking;
  Answer answer;
  std::string lead;                ///< the answer in a sentence
  std::vector<std::string> notes;  ///< what it depends on
  Report impacts;                  ///< of the model, as its own command prints them
  std::vector<std::string> commands;
  Report report;  ///< for other programs
};

/// Keys of which a report on a drop of many says nothing: its attitude has a name there.
inline const KeyNames attitude_keys{"drop.attitude", "drop.angle_deg", "drop.orientation", "drop.tilt_deg"};

/// Refuses options of the worst attitudes where the page has none.
void require_worst_attitudes(const ReportInput& input, const Scene& scene);

/// Whether file or flags say how the body is turned.
[[nodiscard]] bool gives_attitude(const ReportInput& input);

/// Whether the drops are those of all attitudes.
[[nodiscard]] bool looks_at_all(const ReportInput& input);

/// Nothing where it was interrupted.
/// @param given  the scene
/// @param is_turned  whether the input says how the body is turned
/// @param swept  its drops in all attitudes; null: the drop as given alone
[[nodiscard]] std::optional<Findings> findings_of(const ReportInput& input, const Scene& given, bool is_turned,
                                                  const AttitudeSweep* swept, const ShockView& view,
                                                  const CooperativeInterrupt& interrupt);

}  // namespace clatter::validation
