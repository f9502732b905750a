// SPDX-License-Identifier: GPL-3.0-or-later
// The options of commands that look at points of the body: `shock` and `report`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/scene/probes.hpp"
#include "validation/shock/shock_report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// What is asked of a shock.
struct ShockInput {
  SceneFlags scene;
  std::vector<std::string> probes;
  std::optional<Model> model;  ///< else the continuous one where the scene has a ground
  std::optional<ShockRows> rows;
  std::vector<FragilePart> parts;
  ShockRequest request;  ///< what of it does not follow from the model
  ShockView view;        ///< severity and rate
  bool no_sensitivity = false;
};

/// Adds the flags of a scene and those of probes, spectra and parts.
void add_shock_options(Command& command, ShockInput& input);
/// The continuous model where the scene has a ground and nothing else is asked.
[[nodiscard]] Model model_of(const ShockInput& input);
/// @throws BadInput for a scene that sweeps something or keeps a history, too.
[[nodiscard]] Scene shock_scene(const ShockInput& input);
/// The probes of the flags, of which one may be a name of the scene file's, or else all of these.
[[nodiscard]] std::vector<Probe> probes_of(const ShockInput& input);
/// The parts that were given, or else those of the scene file's probes.
/// @throws BadInput for one at a probe that is not there
[[nodiscard]] std::vector<FragilePart> parts_of(const std::vector<FragilePart>& given,
                                                const std::vector<Probe>& probes);
[[nodiscard]] ShockRequest request_of(const ShockInput& input);
/// What is shown, a record or a drop.
[[nodiscard]] ShockView shown_of(const ShockInput& input);
/// The same of a drop.  @throws BadInput for rows that its model does not have
[[nodiscard]] ShockView view_of(const ShockInput& input);
/// "HZ:G", "G" or "G:MS", the last with its units, the others with them or not, each behind "PROBE:" or not.
/// @throws BadInput for anything else
[[nodiscard]] FragilePart read_part(const std::string& option, const std::string& text);
/// "CFC1000", a channel frequency class, or the cut-off of both passes together: "1650", "1650Hz", "1.65kHz".
/// @throws BadInput for anything else
[[nodiscard]] LowPass read_low_pass(const std::string& option, const std::string& text);
/// --part.  @param read  takes name and text, as read_part()
/// @param help  what it is for
[[nodiscard]] Argument part_argument(Argument::Reader read, const std::string& help, const std::string& group);
/// Exit status of a run, as that of simulate or of sequence; says why it is not 0.
[[nodiscard]] int status_of(const Scene& scene, const ShockRun& run);

/// Watches runs of the simulator: says on a terminal how far a long one is, until the watch goes, and ends it once
/// interrupted.
/// @param drop  what runs, in words
[[nodiscard]] std::function<bool(int, long)> watched(const CooperativeInterrupt& interrupt, const std::string& drop,
                                                     const Scene& scene);

}  // namespace clatter::validation
