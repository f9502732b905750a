// A scene of the discrete model as the user gives it: flags, defaults, checks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/sequence.hpp"
#include "validation/output/json.hpp"

namespace clatter::validation {

/// The texts of the scene options, empty where not given.  Names are those of the flags.
struct SceneTexts {
  std::optional<std::string> angle, speed, height, tangential_velocity, spin, gravity, restitution,
      restitution_law, impulse_ratio, friction, body, mass, length, radius, size, impacts, digits;
  bool require_digits = false;
};

/// A checked scene.
struct Scene {
  double angle_deg = 0;              ///< [°]
  double speed = 1;                  ///< of the centre of mass at the first touch, downward [m/s]
  std::optional<double> height;      ///< of the centre of mass at release, if given [m]
  double tangential_velocity = 0;    ///< [m/s]
  double spin = 0;                   ///< [rad/s]
  double gravity = 0;                ///< [m/s²]
  analytic::ImpactLaw law;
  bool is_box = false;
  analytic::RodSize rod;
  analytic::BoxSize box;
  int impacts = 6;
  int digits = 6;
  bool require_digits = false;       ///< fewer known digits are exit status 3

  [[nodiscard]] analytic::PlanarBody body() const;
  [[nodiscard]] analytic::Drop drop() const;
  /// Everything, defaults included, under the names of scene files.
  [[nodiscard]] Json json() const;
  /// The same for a reader: a few lines.
  [[nodiscard]] std::vector<std::string> summary() const;
};

/// @throws BadInput with one line that names the option, what was given and what is allowed.
[[nodiscard]] Scene read_scene(const SceneTexts& texts);

/// What a number may be.
struct Range {
  double low, high;
  bool low_open = false;  ///< low itself is not allowed
  const char* words;      ///< what is allowed, in words
};

/// @throws BadInput unless `text` is a finite number in `range`; `option` is as typed ("--angle").
[[nodiscard]] double read_number_option(const std::string& option, const std::string& text,
                                        const Range& range);
[[nodiscard]] int read_integer_option(const std::string& option, const std::string& text, int low,
                                      int high);
/// Index of `text` among `names`.  @throws BadInput naming the nearest.
[[nodiscard]] std::size_t read_name_option(const std::string& option, const std::string& text,
                                           const std::vector<std::string>& names);

[[nodiscard]] const char* law_name(analytic::RestitutionLaw law);

}  // namespace clatter::validation
