// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a sweep: CSV with numbers in their shortest round-trip form, or packed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/output/cells.hpp"
#include "validation/output/report.hpp"
#include "validation/run/impact_rows.hpp"
#include "validation/run/rest_face.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/probes.hpp"
#include "validation/scene/scene.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_rows.hpp"
#include "validation/sweep/scenes_told.hpp"

namespace clatter::validation {

enum class RowKind { scene, impact };

/// A column in rows of scenes that is a quantity of one impact.
struct ImpactColumn {
  Column column;
  const ImpactQuantity* quantity = nullptr;
  std::size_t part = 0;  ///< of a vector or of Euler parameters
  int impact = 0;        ///< its number, from 1; 0: the hardest, which has the largest normal impulse
};

/// What the rows of a sweep hold.
struct RowLayout {
  Model model = Model::discrete;
  RowKind rows = RowKind::scene;
  bool in_space = false;  ///< whether a scene may leave its plane
  bool warns = false;     ///< whether rows say what the law does that no contact does: those of the discrete model
  std::vector<std::string> swept{};
  std::vector<ImpactColumn> asked{};  ///< with rows of scenes
  std::vector<std::string> named{};   ///< columns asked for that these rows have anyway
  std::vector<Probe> probes{};        ///< with rows of scenes
  bool rests = false;                 ///< with rows of scenes: whether they tell the face that the body comes to lie on
  std::vector<std::optional<FragilePart>> part_at{};  ///< of each probe, or none at all: with columns of its margins
  bool has_curve = false;  ///< whether the ground is a pad, with a column of how far its curve is used
  std::string rank_by{};   ///< column by which a summary ranks attitudes; empty: as ranking_column() has it

  /// The part at the probe of this number; null: none.
  [[nodiscard]] const FragilePart* part(std::size_t probe) const {
    return probe < part_at.size() && part_at[probe] ? &*part_at[probe] : nullptr;
  }
  [[nodiscard]] std::vector<FragilePart> parts() const;
  /// The number of the probe by which a summary ranks: the first that has a part, else the first.
  [[nodiscard]] std::size_t first_ranked() const;
  /// Whether rows have this number of impacts.
  [[nodiscard]] bool has(std::string_view quantity) const;
};

/// Puts into the layout, whose probes are known, the columns that a list of names asks for, separated by commas:
/// QUANTITY_N of impact N, QUANTITY of each impact up to `impacts`, hardest (its number) and hardest_QUANTITY of the
/// impact with the largest normal impulse, QUANTITY a column of rows of impacts, a row with fewer impacts leaves its
/// cells empty; or a column that rows of scenes have anyway, which is there once.
/// @throws BadInput naming what was given and the nearest name
void read_impact_columns(const std::string& names, int impacts, RowLayout& layout);

/// Index and swept keys, then per scene
///     impacts, outcome, total_normal_impulse [N·s], first_peak_force, largest_peak_force [N] and
///     largest_indentation [m] (continuous model),
///     energy_loss [J] and last_start [s] over the impacts listed, predictable, with layout.rests rest_face, rest_time
///     and rest_known, the columns asked for, of each probe
///     in the continuous model the largest specific force [g], which impact that is and how long it stays above a tenth
///     [s], in both the largest change of its velocity over an impact [m/s] and which impact that is, both once more of
///     the first landing, and with a part its least margin and that of the first landing with their impacts, the error
///     of each of these numbers, in the discrete model warning, reason;
/// or per impact what `clatter sequence` and `clatter simulate` write as CSV, the scene's outcome, how many rows it
/// has, and reason; where scenes may leave their plane, what `clatter sequence` writes in space. The reason says why a
/// scene has no numbers, fewer impacts than asked for or fewer digits than required; else it is empty.  Errors and
/// predictable are empty where no errors were asked for, an error alone where it is not known.
[[nodiscard]] std::vector<Column> sweep_columns(const RowLayout& layout);
/// Names of columns that say true or false, where rows have them.
[[nodiscard]] std::vector<std::string> truth_columns(const RowLayout& layout);

/// The column of rows of impacts that tells how many rows their scene has.
inline constexpr const char* scene_rows_column = "scene_rows";
/// @throws std::invalid_argument if rows have no such column
[[nodiscard]] std::size_t column_place(const RowLayout& layout, std::string_view column);
/// A cell of a row of CSV, quotes and all; empty: there are not so many.
[[nodiscard]] std::string_view csv_cell(std::string_view row, std::size_t place);

/// What all rows of a scene begin with.
[[nodiscard]] std::string row_prefix(long long index, const std::vector<double>& values, bool packed);

/// What the columns of a probe's largest specific force, of its largest |ΔV| and of its part's least margin begin with,
/// before the probe's name; and what stands before those of the first landing alone.
inline constexpr std::string_view peak_column = "peak_g_", shock_column = "delta_v_", margin_column = "margin_",
                                  of_landing = "landing_";
/// Place of the probe whose number a column is; none: it is no probe's.
[[nodiscard]] std::optional<std::size_t> probe_of(std::string_view column, const std::vector<Probe>& probes);
/// The column by which rows are ranked for a probe: its part's margin, else its largest specific force or, without
/// forces, |ΔV|; on a ground without loss those of the first landing.  A summary takes the one that was asked for, else
/// that of the first probe, else the largest force or impulse.
[[nodiscard]] std::string ranking_column(const RowLayout& layout, std::size_t probe, bool landing_alone = false);
/// Whether a column's least number is its worst: a margin.
[[nodiscard]] bool is_worst_least(std::string_view column);

/// The hardest that a point of the body goes through in the impacts of a scene, and in those of its first landing.
struct LargestShock {
  Estimated delta_v;    ///< [m/s]
  int impact = 0;       ///< its number, from 1; 0: there was no impact
  Estimated peak_g;     ///< of the specific force, in g; the continuous model alone
  int peak_impact = 0;  ///< the number of the impact that has it
  Estimated width;      ///< for which it stays above a tenth of that [s]
  Estimated margin;     ///< the least, of a part
  int margin_impact = 0;
  Estimated landing_delta_v, landing_peak_g, landing_margin;  ///< likewise
  int landing_impact = 0, landing_peak_impact = 0, landing_margin_impact = 0;

  /// What tells the numbers of rows from each other.
  struct Terms {
    const RowLayout& layout;  ///< of the probes and their parts
    bool has_peaks = true;    ///< of the continuous model; without them a margin is that by |ΔV|
    double landing_end = 0;   ///< as landing_end() has it [s]
  };
  /// Takes the hardest of rows of probes, the first of equal ones.
  [[nodiscard]] static std::vector<LargestShock> of(const std::vector<ShockRow>& rows, const Terms& terms);
};

/// Where the rows of one scene go, and what they hold besides its numbers.
struct RowForm {
  CellWriter& out;
  const std::string& prefix;
  const RowLayout& layout;
  bool errors = true;       ///< whether errors were asked for
  bool predictions = true;  ///< whether their growth was
  std::string reason;
  std::string warning{};                   ///< what the law does that no contact does
  std::vector<LargestShock> shocks{};      ///< of the layout's probes
  std::optional<Estimated> energy_loss{};  ///< where impacts and contacts that are not listed take some, too [J]
  std::optional<RestFace> rest{};          ///< where the layout asks for it
  std::optional<Estimated> curve_depth{};  ///< of a pad: depth in the first landing over that of its last point
};
/// Appends the rows of one scene.
void append_rows(const RowForm& form, const Run& run);
/// The one row of a scene without numbers.
void append_failure(const RowForm& form, const char* outcome);

/// Counts the scenes that fall short of what was asked, those with a reason that were neither refused nor outside the
/// model; these; those that end at run.impacts, and those that warn.
class ShortfallCount {
 public:
  ShortfallCount(const RowLayout& layout, bool packed);

  /// Takes whole rows; lines of a head of CSV are skipped.
  void add(std::string_view rows);

  [[nodiscard]] const Shortfalls& found() const { return found_; }
  /// "50 of 300 scenes are refused; 2: WHY".
  [[nodiscard]] ScenesTold told(long long all, const char* what = "scenes") const;
  /// Scenes that end at run.impacts, where more impacts may follow.
  [[nodiscard]] long long cut() const { return cut_; }
  /// Scenes whose rows have a warning.
  [[nodiscard]] long long warned() const { return warned_; }

 private:
  void add_row(std::string_view row);
  /// The texts of a row.
  struct Words {
    std::string_view outcome, warning, reason;
  };
  void count(std::string_view index, const Words& row);

  bool packed_, warns_;
  std::size_t outcome_ = 0;  ///< place of that column
  std::vector<PackedCell> cells_;
  Shortfalls found_, refused_, outside_;
  std::string last_;  ///< index of the last of them
  long long cut_ = 0;
  std::string last_cut_;
  long long warned_ = 0;
  std::string last_warned_;
};

}  // namespace clatter::validation
