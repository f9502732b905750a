// SPDX-License-Identifier: GPL-3.0-or-later
// The values of the swept keys: a grid, a list, or random ones that depend on their place instead of on their turn.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace clatter::validation {

/// Most scenes of a sweep.
inline constexpr long long most_scenes = 1'000'000'000;

/// Euler parameters, body to world, scalar first.
using SweptAttitude = std::array<double, 4>;
/// Uniform over all rotations if the three parts are independent and uniform in [0, 1); of the two signs that mean one
/// rotation the one with q₀ >= 0.  Source: Shoemake, Uniform random rotations, Graphics Gems III, 1992.
[[nodiscard]] SweptAttitude uniform_attitude(const std::array<double, 3>& parts);

/// Number `column` of scene `scene` in the family `seed`, and where a column needs several its number `draw`: uniform
/// in [0, 1), a multiple of 2^-53, the same on every machine, by its place instead of by its turn.  From Philox 4×32
/// with ten rounds (Salmon et al., Parallel random numbers: as easy as 1, 2, 3, 2011).
[[nodiscard]] double uniform_at(std::uint64_t seed, std::uint64_t scene, std::uint32_t column, std::uint32_t draw = 0);

/// An attitude turned by a vector [rad] in the world frame: (cos ½|v|, sin ½|v| v/|v|) q.
[[nodiscard]] SweptAttitude turned(const SweptAttitude& attitude, const std::array<double, 3>& vector);

/// The unit of a number of a scene; empty: none.
[[nodiscard]] std::string unit_of(const std::string& key);
/// A swept key as an axis of a picture is called: its last word, and its unit, as in "angle [°]" for drop.angle_deg.
[[nodiscard]] std::string axis_words(const std::string& key);

/// Scenes first, first + 1, …, first + count − 1.
struct SceneRange {
  long long first = 0, count = 0;
};
/// Scenes first, first + step, ..., `count` of them.
struct PickedScenes {
  long long first = 0, count = 0, step = 1;

  /// The number of the scene at a place, from 0.
  [[nodiscard]] long long at(long long place) const { return first + place * step; }
  [[nodiscard]] long long last() const { return at(count - 1); }
};
/// FROM:TO, both taken, or FROM:TO:STEP, from FROM by STEP as far as TO, of `count` scenes.
/// @throws BadInput naming what was given and what is allowed
[[nodiscard]] PickedScenes read_scenes(const std::string& text, long long count);

/// The values that one key takes: numbers or attitudes.
struct SweepAxis {
  std::string key;
  double first = 0, last = 0;    ///< of the grid, both taken; or the ends of the range
  double step = 0;               ///< of a grid with equal steps
  long long count = 1;           ///< of the grid's values
  bool logarithmic = false;      ///< a grid with equal ratios, or a range whose logarithm is uniform
  bool whole = false;            ///< only whole numbers
  std::vector<double> listed{};  ///< the values themselves, where they were listed

  std::vector<SweptAttitude> attitudes{};  ///< likewise, of a key whose values are attitudes
  bool any_attitude = false;               ///< attitudes drawn uniformly over all rotations
  /// Scatter of drawn attitudes about the listed ones, each in its turn: standard deviation of the turn about each of
  /// the three axes, normally distributed [rad].
  double scatter = 0;

  [[nodiscard]] bool is_attitude() const { return any_attitude || !attitudes.empty(); }
  /// Columns that a value takes, and so their numbers.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::size_t width() const { return is_attitude() ? 4 : 1; }

  /// Value i of the grid, i from 0; rounded to 15 digits, so that steps that are decimal fractions give clean decimals.
  [[nodiscard]] double at(long long i) const;
  /// The value at `part` of the range, part in [0, 1).
  [[nodiscard]] double drawn(double part) const;
};

/// FROM:TO:STEP, the values from FROM by STEP as far as TO, STEP with the sign of TO − FROM; FROM:TO:lin:COUNT, values
/// with equal steps, or FROM:TO:log:COUNT, with equal ratios, both ends taken; or A,B,...: these.
/// @throws BadInput naming the key, what was given and what is allowed.
[[nodiscard]] SweepAxis read_grid_axis(const std::string& key, const std::string& text, bool whole);
/// LOW:HIGH or LOW:HIGH:log.  @throws BadInput likewise.
[[nodiscard]] SweepAxis read_random_axis(const std::string& key, const std::string& text, bool whole);

/// "[q0,q1,q2,q3],[...]": these attitudes.  "@FILE": those of a CSV file with columns q0, q1, q2 and q3.
/// @throws BadInput naming the attitude, or the file and its line, where that is not of length 1 to within 0.01.
[[nodiscard]] SweepAxis read_attitude_axis(const std::string& key, const std::string& text);

/// The points of a sweep, counted from 0.
class SweepPoints {
 public:
  SweepPoints() = default;
  /// The product of the axes, the last one varying fastest; one point without axes.
  /// @throws BadInput if there are more than most_scenes.
  explicit SweepPoints(std::vector<SweepAxis> grid);
  /// Points drawn from the ranges: each depends on the seed and its own number alone.
  SweepPoints(std::vector<SweepAxis> ranges, long long count, std::uint64_t seed);

  [[nodiscard]] long long count() const { return count_; }
  [[nodiscard]] const std::vector<SweepAxis>& axes() const { return axes_; }
  /// How many attitudes are listed, and which of them, from 0, a point has; 0 without a list.
  [[nodiscard]] long long attitudes() const;
  [[nodiscard]] long long attitude_of(long long point) const;
  /// Puts the numbers of a point into `values`, axis by axis.
  void at(long long point, std::vector<double>& values) const;

 private:
  void draw(long long point, std::size_t axis, double* values) const;

  std::vector<SweepAxis> axes_;
  long long count_ = 1;
  bool random_ = false;
  std::uint64_t seed_ = 0;
};

}  // namespace clatter::validation
