// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a scene's body of which the shock is asked.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// The table of which a file may have several, [[probe]]; their keys are "probe.0.name" and so on.
inline constexpr const char* probe_table = "probe";

/// A point of the body.
struct Probe {
  std::string name;
  numeric::Vector3 place = numeric::Vector3::Zero();  ///< body frame, as BodyProperties has it [m]
  std::string part{};     ///< what the part there bears, as --part takes it; empty: the file does not say
  std::string part_at{};  ///< "file:line:column: key", where it says so
};
[[nodiscard]] bool is_probe_name(const std::string& text);

/// The probes of a file, which other commands than `shock`, `report` and `sweep` leave alone:
///     [[probe]]
///     name = "camera"              letters, digits, "_", "-" and ".", at most 40; no two alike
///     place = [0.05, 0.02, 0.009]  body frame, from the geometric centre; a mesh: in its file's frame [m]
///     part = "500:300"             what the part there bears, if it is known
/// @throws BadInput naming the key, what was given and what is allowed.
[[nodiscard]] std::vector<Probe> read_probes(const SceneValues& values);

/// The probes of flags "NAME:X,Y,Z", or "NAME" alone of one of the file's.  @throws BadInput naming the flag.
/// @param of_file  texts of no flag: all of these
[[nodiscard]] std::vector<Probe> read_probes(const std::string& flag, const std::vector<std::string>& texts,
                                             const std::vector<Probe>& of_file);
/// The probe of this name.  @throws BadInput that begins with `where` and names the nearest
[[nodiscard]] const Probe& probe_named(const std::vector<Probe>& probes, const std::string& name,
                                       const std::string& where);

/// "camera at (0.05, 0.02, 0.009) m".
[[nodiscard]] std::string place_words(const Probe& probe);

/// The places of probes from the centre of mass, body frame [m].
[[nodiscard]] std::vector<numeric::Vector3> places_from(const numeric::Vector3& centre,
                                                        const std::vector<Probe>& probes);

/// A question about probes outside of the box about the body, "were mm meant?"; empty: there are none.
[[nodiscard]] std::string probe_doubts(const Scene& scene, const std::vector<Probe>& probes);

/// What is doubtful of sizes, masses, the pad and the probes of a scene, each a question; empty: nothing.
[[nodiscard]] std::vector<std::string> doubts_of(const Scene& scene, Model model,
                                                 const std::vector<Probe>& probes = {});
/// Says them on stderr, each once.
void say_doubts(const Scene& scene, Model model, const std::vector<Probe>& probes = {});

/// As the JSON echo has them.
[[nodiscard]] Value probe_fields(const std::vector<Probe>& probes);

/// By its key, what of the scene's [impact] says nothing of a ground that yields and has no such number of its own.
[[nodiscard]] std::map<std::string, std::string> discrete_law_words(const Scene& scene);

}  // namespace clatter::validation
