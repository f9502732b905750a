// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/probes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/argument.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/pad.hpp"

namespace clatter::validation {
namespace {

constexpr Range places{-1e100, 1e100, false, "from -1e100 to 1e100"};
const char* const three_places = "three coordinates in m, body frame, from -1e100 to 1e100";
const char* const names_allowed = "letters, digits, \"_\", \"-\" and \".\", from 1 to 40 of them";

bool has_name(const std::vector<Probe>& probes, const std::string& name) {
  return std::any_of(probes.begin(), probes.end(), [&](const Probe& probe) { return probe.name == name; });
}

/// "X,Y,Z"
bool read_place(const std::string& text, numeric::Vector3& place) {
  std::istringstream parts(text + ",");  // so that an empty last part counts
  int count = 0;
  for (std::string part; std::getline(parts, part, ','); ++count) {
    if (count == 3 || !read_number(part, place[count]) || !places.holds(place[count])) return false;
  }
  return count == 3;
}

}  // namespace

bool is_probe_name(const std::string& text) {
  const auto fits = [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '_' || c == '-' || c == '.'); };
  return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), fits);
}

const Probe& probe_named(const std::vector<Probe>& probes, const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Probe& probe : probes) {
    if (probe.name == name) return probe;
    names.push_back(probe.name);
  }
  throw BadInput(names.empty() ? fmt::format("{}: no probe is named {}: there is none", where, name)
                               : fmt::format("{}: no probe is named {}{}", where, name, suggestion(name, names)));
}

std::vector<Probe> read_probes(const SceneValues& values) {
  std::vector<Probe> probes;
  for (int i = 0; values.has_table(fmt::format("{}.{}", probe_table, i)); ++i) {
    const std::string name = fmt::format("{}.{}.name", probe_table, i);
    const std::string place = fmt::format("{}.{}.place", probe_table, i);
    values.require(name, "the probe's");
    values.require(place, "the probe's [x, y, z] in m");
    const std::string text = values.text(name);
    if (!is_probe_name(text)) values.refuse(name, names_allowed);
    if (has_name(probes, text)) values.refuse(name, "another name than those of the probes before it");
    probes.push_back({text, vector_of(values.numbers(place, {3}, places, three_places))});
    if (const std::string part = fmt::format("{}.{}.part", probe_table, i); values.has(part)) {
      probes.back().part = values.text(part);
      probes.back().part_at = values.where(part);
    }
  }
  return probes;
}

std::vector<Probe> read_probes(const std::string& flag, const std::vector<std::string>& texts,
                               const std::vector<Probe>& of_file) {
  if (texts.empty()) return of_file;
  std::vector<Probe> probes;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    Probe probe{text.substr(0, colon), {}};
    const bool is_named = colon == std::string::npos && is_probe_name(text) && !of_file.empty();
    if (is_named) probe = probe_named(of_file, text, flag + " " + text);
    else if (!(colon != std::string::npos && is_probe_name(probe.name) &&
               read_place(text.substr(colon + 1), probe.place))) {
      throw BadInput("{} '{}': must be NAME:X,Y,Z, the name {}, then {}", flag, text, names_allowed, three_places);
    }
    if (has_name(probes, probe.name)) throw BadInput("{} '{}': there is a probe of this name already", flag, text);
    probes.push_back(probe);
  }
  return probes;
}

std::string place_words(const Probe& probe) {
  return fmt::format("{} at ({}, {}, {}) m", probe.name, shortest(probe.place.x()), shortest(probe.place.y()),
                     shortest(probe.place.z()));
}

std::vector<numeric::Vector3> places_from(const numeric::Vector3& centre, const std::vector<Probe>& probes) {
  std::vector<numeric::Vector3> places;
  for (const Probe& probe : probes) places.push_back(probe.place - centre);
  return places;
}

std::string probe_doubts(const Scene& scene, const std::vector<Probe>& probes) {
  constexpr double rounding = 1e-9;
  if (probes.empty() || scene.body.is_polyhedron()) return "";  // the latter's are in its file's frame
  const numeric::Vector3 extents = body_properties(scene, Model::continuous).extents;
  std::string names;
  for (const Probe& probe : probes) {
    const double outside = (probe.place.cwiseAbs() - extents / 2).maxCoeff();
    if (outside > rounding * extents.maxCoeff()) names += (names.empty() ? "" : ", ") + probe.name;
  }
  return names.empty()
             ? ""
             : fmt::format("!: warning: {}: outside of the body; places are in m, from its middle; were mm meant?",
                           names);
}

std::vector<std::string> doubts_of(const Scene& scene, Model model, const std::vector<Probe>& probes) {
  const std::string mark = "!: warning: ";
  std::vector<std::string> doubts{unit_doubts(scene, body_properties(scene, model)), pad_doubts(scene),
                                  probe_doubts(scene, probes)};
  std::erase(doubts, "");
  for (std::string& doubt : doubts) {
    if (doubt.starts_with(mark)) doubt.erase(0, mark.size());
  }
  return doubts;
}

std::map<std::string, std::string> discrete_law_words(const Scene& scene) {
  std::map<std::string, std::string> words;
  const auto add = [&](const char* key, const std::optional<double>& number, bool has_own, const char* own) {
    if (!number || has_own) return;
    words[key] = fmt::format("{} {} is the discrete model's alone: the ground's own is {} {}", key_named(key).flag,
                             shortest(*number), own, shortest(*number));
  };
  add("impact.restitution", scene.impact.restitution, scene.ground_restitution.has_value(), "--floor-restitution");
  add("impact.friction", scene.impact.friction, scene.world.ground.has_friction(), "--sliding-friction");
  return words;
}

void say_doubts(const Scene& scene, Model model, const std::vector<Probe>& probes) {
  static std::set<std::string> asked;  // a scene is read more than once
  for (const std::string& doubt : doubts_of(scene, model, probes)) {
    if (asked.insert(doubt).second) say("warning: " + doubt);
  }
}

Value probe_fields(const std::vector<Probe>& probes) {
  Value::List list;
  for (const Probe& probe : probes) {
    list.emplace_back(Value::Fields{{"name", probe.name}, {"place", probe.place}});
    if (!probe.part.empty()) list.back()["part"] = probe.part;
  }
  return list;
}

}  // namespace clatter::validation
