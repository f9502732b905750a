// SPDX-License-Identifier: GPL-3.0-or-later
// The drops of a report in all attitudes: a sweep, ranked, and the worst blow of each face, edge and corner.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "validation/output/interrupt.hpp"
#include "validation/output/report.hpp"
#include "validation/report/report_input.hpp"
#include "validation/report/verdict.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

/// Whether the key turns the body, in place of or beside its Euler parameters.
[[nodiscard]] bool turns_body(const std::string& key);

/// What was typed, with which every command begins: the scene and its flags.
/// @param attitude  Euler parameters in place of the scene's own; empty: those
[[nodiscard]] std::string scene_words(const ReportInput& input, const std::vector<double>& attitude);

[[nodiscard]] std::string probe_words(const ReportInput& input);

/// One of the drops in all attitudes.
struct SweptDrop {
  long long point = 0;
  int attitude = 0;                    ///< of a box, by number, from 0
  std::array<double, 4> parameters{};  ///< Euler's
  Vector3 down = Vector3::Zero();
  double value = 0;         ///< that it is ranked by
  int impact = 0;           ///< whose blow has it; 0: not told
  double beyond_value = 0;  ///< the same with the impacts that the ranking leaves out, or NaN
  int beyond_impact = 0;
  double curve_depth = 0;  ///< depth over that of the pad's last point, or NaN
  double peak_g = 0;       ///< the largest specific force at the ranking's probe in any of its blows, or NaN
};

/// What the name of a ranking by a part's response begins with; sweeps have its margin for that, of a limit of 1 g.
inline constexpr std::string_view response_column = "response_";

/// What the drops in all attitudes give.
struct AllAttitudes {
  std::vector<SweptDrop> drops;
  bool is_sample = true;  ///< else each attitude is exactly that
  double scatter = 0;     ///< standard deviation of the turns about each axis [°]
  std::size_t worst = 0;
  Column column;                           ///< by which they are ranked
  std::vector<std::size_t> worst_of;       ///< of each attitude that has a drop: its worst one
  std::vector<std::optional<Blow>> blows;  ///< of those: the worst of each, with errors
  bool is_of_blow = true;                  ///< whether the blows have what is ranked by
  Scene scene;                             ///< of the worst
  std::string name;                        ///< of its attitude: "corner -x-y+z down, 3.2° off"
  Report report;                           ///< percentiles, and in its fields the largest of each attitude
  std::string command;                     ///< empty: no file that a command could name

  [[nodiscard]] bool is_least_worst() const { return is_worst_least(column.name); }
  [[nodiscard]] bool is_ranked_by_peak() const { return column.name.starts_with(peak_column); }
  [[nodiscard]] bool is_worse(double one, double other) const { return is_least_worst() ? one < other : one > other; }
  /// How far the worst of a sample is from that of all is told by two samples of half the size, of all attitudes each:
  /// the worst value of the half without the worst drop; NaN where that half is empty.
  [[nodiscard]] double worst_of_other_half() const;
  /// |ln| of the ratio of the halves' worst values; 0: not known.
  [[nodiscard]] double spread() const;
  /// "260 drops on its faces, edges and corners, each ±3°".
  [[nodiscard]] std::string drops_words() const;
  [[nodiscard]] std::ptrdiff_t count(auto&& wanted) const { return std::ranges::count_if(drops, wanted); }
};

/// "corner -x-y+z down, 3.2° off", of a box's attitude by number, from 0.
[[nodiscard]] std::string name_of_drop(const Scene& scene, int number, const Vector3& down);

/// What the ranking of a sweep's column says of blows: of the probe that the column names, else of the first.
[[nodiscard]] Ranking ranking_of(std::string_view column, const std::vector<Probe>& probes, const ReportInput& input);

/// The drops of a scene in all attitudes, computed once for all parts.
struct AttitudeSweep {
  SweepRequest request;
  SweepPlan plan;
  SweepBody body;
  std::string rows;  ///< packed
  int threads = 1;
};
/// Nothing where it was interrupted.
/// @param parts  at most one at each probe
/// @param before  drops of other scenes that `progress` counted
/// @throws BadInput as read_sweep_plan
[[nodiscard]] std::optional<AttitudeSweep> sweep_attitudes(const ReportInput& input, const Attitudes& attitudes,
                                                           const std::vector<FragilePart>& parts, RunProgress& progress,
                                                           long long before, const CooperativeInterrupt& interrupt);

/// What the drops give for one part; nothing where none has a number to rank it by.
/// @param given  the drop whose attitude they change
/// @param rank_by  column; empty: as the sweep has it
[[nodiscard]] std::optional<AllAttitudes> all_attitudes(const ReportInput& input, const Scene& given,
                                                        const AttitudeSweep& sweep, const std::string& rank_by);

/// "margin of camera, first landing [g]": what drops are ranked by, for a reader.
[[nodiscard]] std::string ranked_words(const Column& ranking);

/// The columns of the table of faces, edges and corners, whatever a report has of them.
[[nodiscard]] std::vector<Column> attitude_columns();

/// Each face, edge and corner by the worst blow of its worst drop, the worst first.
[[nodiscard]] Grid attitudes_grid(const AllAttitudes& all);

}  // namespace clatter::validation
