// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a sweep: CSV with numbers in their shortest round-trip form.
#pragma once

#include <string>
#include <string_view>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/output/report.hpp"
#include "validation/record/impact_quantities.hpp"
#include "validation/scene/shortfall.hpp"
#include "validation/sweep/sweep_plan.hpp"

namespace clatter::validation::inline sweep {

/// Index and swept keys, then per scene
///     impacts, outcome, total_normal_impulse [N·s], first_peak_force, largest_peak_force [N] (continuous model),
///     energy_loss [J] and last_start [s] over the impacts listed, predictable, the error of each of these numbers,
///     reason;
/// or per impact what `clatter sequence` and `clatter simulate` write as CSV, the scene's outcome and reason; where
/// scenes may leave their plane, what `clatter sequence` writes in space.
/// The reason says why a scene has no numbers, fewer impacts than asked for or fewer digits than required; else it is
/// empty.  Errors and predictable are empty where no errors were asked for, an error alone where it is not known.
[[nodiscard]] std::vector<Column> sweep_columns(const SweepPlan& plan);

/// What all rows of a scene begin with.
[[nodiscard]] std::string row_prefix(long long index, const std::vector<double>& values);

/// Where the rows of one scene go, and what they hold besides its numbers.
struct RowForm {
  std::string& out;
  const std::string& prefix;
  RowKind rows = RowKind::scene;
  bool in_space = false;    ///< SweepPlan::in_space
  bool errors = true;       ///< whether errors were asked for
  bool predictions = true;  ///< whether their growth was
  std::string reason;
};
/// Appends the rows of one scene.  @param drop_deg its inclination [°]
void append_rows(const RowForm& form, const analytic::Sequence& sequence, double drop_deg);
void append_rows(const RowForm& form, const analytic::space::Sequence& sequence, const std::vector<SpaceRow>& rows);
void append_rows(const RowForm& form, const numeric::Simulation& run);
/// The one row of a scene without numbers.
void append_failure(const RowForm& form, Model model, const char* outcome);

/// Counts the scenes that fall short of what was asked: those with a reason that were neither refused nor outside the
/// model.
class ShortfallCount {
 public:
  explicit ShortfallCount(const SweepPlan& plan);

  /// Takes whole rows; lines of a head are skipped.
  void add(std::string_view rows);

  [[nodiscard]] const Shortfalls& found() const { return found_; }

 private:
  void add_row(std::string_view row);

  std::size_t outcome_ = 0;  ///< place of that column
  Shortfalls found_;
  std::string last_;  ///< index of the last of them
};

}  // namespace clatter::validation::inline sweep
