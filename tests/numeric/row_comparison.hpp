// SPDX-License-Identifier: GPL-3.0-or-later
// Two runs of a drop, number by number, in units of their error bars.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "numeric/simulate.hpp"

namespace clatter::numeric::test {

struct NamedNumber {
  const char* name;
  double ImpactNumbers::*number;
};

inline constexpr NamedNumber named_numbers[] = {{"start", &ImpactNumbers::start},
                                                {"duration", &ImpactNumbers::duration},
                                                {"inclination", &ImpactNumbers::inclination},
                                                {"contact_angle", &ImpactNumbers::contact_angle},
                                                {"approach_speed", &ImpactNumbers::approach_speed},
                                                {"restitution", &ImpactNumbers::restitution},
                                                {"peak_force", &ImpactNumbers::peak_force},
                                                {"peak_time", &ImpactNumbers::peak_time},
                                                {"indentation", &ImpactNumbers::indentation},
                                                {"energy_before", &ImpactNumbers::energy_before},
                                                {"energy_after", &ImpactNumbers::energy_after},
                                                {"energy_loss", &ImpactNumbers::energy_loss},
                                                {"work_damping", &ImpactNumbers::work_damping},
                                                {"work_friction", &ImpactNumbers::work_friction},
                                                {"work_released", &ImpactNumbers::work_released}};

struct NamedVector {
  const char* name;
  Vector3 ImpactNumbers::*vector;
};

inline constexpr NamedVector named_vectors[] = {{"impulse_", &ImpactNumbers::impulse},
                                                {"velocity_after_", &ImpactNumbers::velocity_after},
                                                {"angular_velocity_after_", &ImpactNumbers::angular_velocity_after}};

struct Comparison {
  int numbers = 0, within = 0;
  int unknown = 0;           ///< numbers without a bar
  bool alike = true;         ///< as many rows, with the same labels
  double worst = 0;          ///< |difference| over the bar
  std::string worst_number;  ///< in words
  std::string note;          ///< on what is no number: rows, outcomes, how they are labelled

  void add(double one, double other, double bar, const std::string& name) {
    if (std::isnan(one) && std::isnan(other)) return;
    if (std::isnan(bar)) {
      ++unknown;
      return;
    }
    ++numbers;
    const double distance = std::fabs(one - other);
    if (distance <= bar) ++within;
    double ratio = distance > 0 ? distance / bar : 0;
    if (std::isnan(distance)) ratio = std::numeric_limits<double>::infinity();
    if (!(ratio > worst)) return;
    worst = ratio;
    std::ostringstream words;
    words << name << ' ' << one << " off by " << distance;
    worst_number = words.str();
  }
};

/// How a row is labelled: end, touches and friction mode, as numbers.
inline std::string kind_of(const ImpactRecord& row) {
  std::ostringstream words;
  words << static_cast<int>(row.end) << '/' << row.touches << '/' << static_cast<int>(row.mode);
  return words.str();
}

/// @param with_other  whether the other run's bar counts too.
inline Comparison compare_rows(const Simulation& run, const Simulation& other, bool with_other) {
  Comparison c;
  if (run.outcome != other.outcome) c.note += " (" + run.message + "; " + other.message + ")";
  c.alike = run.impacts.size() == other.impacts.size();
  if (!c.alike) c.note += " OTHER NUMBER OF ROWS";
  for (std::size_t i = 0; i < std::min(run.impacts.size(), other.impacts.size()); ++i) {
    const ImpactRecord &a = run.impacts[i], &b = other.impacts[i];
    const std::string row = "row " + std::to_string(i + 1) + ' ';
    if (!a.predictable) c.note += ' ' + row + "not predictable";
    if (kind_of(a) != kind_of(b)) {
      c.alike = false;
      c.note += ' ' + row + "OTHER KIND: " + kind_of(a) + ", " + kind_of(b);
    }
    for (const auto& [name, n] : named_numbers) {
      c.add(a.value.*n, b.value.*n, a.error.*n + (with_other ? b.error.*n : 0), row + name);
    }
    for (const auto& [name, n] : named_vectors) {
      for (int k = 0; k < 3; ++k) {
        const double bar = (a.error.*n)[k] + (with_other ? (b.error.*n)[k] : 0);
        c.add((a.value.*n)[k], (b.value.*n)[k], bar, row + name + "xyz"[k]);
      }
    }
  }
  return c;
}

}  // namespace clatter::numeric::test
