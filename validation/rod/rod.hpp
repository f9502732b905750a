// SPDX-License-Identifier: GPL-3.0-or-later
// The thin rod that strikes with one end and then the other: its parameters, contact angles and impulses of its first
// three impacts, an angle θ a row, and how many impacts happen, over a parameter.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

// Values of a swept quantity: from, to, and a step or a count.

/// What is asked of a swept quantity.
struct RangeRequest {
  std::optional<double> from, to, step;
  std::optional<int> count;
};
/// @param what  the quantity, in words
[[nodiscard]] Arguments range_arguments(RangeRequest& request, const std::string& what);

struct Sweep {
  double from = 0;
  double to = 0;
  long long count = 0;
  double step = 0;  ///< 0: equal parts of [from, to]
  bool logarithmic = false;
  /// Value i.  With a step, from + i·step is rounded to 15 digits, so that steps that are decimal
  /// fractions give clean decimals; with a count, the last value is `to` exactly.
  [[nodiscard]] double value(long long i) const;
};
struct SweepDefault {
  double from, to, step;
};
/// @throws BadInput where an end lies outside `allowed`, or step and count are both given
[[nodiscard]] Sweep sweep_of(const RangeRequest& request, const SweepDefault& fallback, const Range& allowed);

struct RodRequest {
  std::optional<double> gravity_number;
  std::optional<double> gravity;  ///< [m/s²], with the next two in place of the gravity number
  double length = 1, speed = 1;   ///< [m], [m/s]
  double restitution = 1, impulse_ratio = 0;
};
[[nodiscard]] Arguments rod_arguments(RodRequest& request);
/// @throws BadInput where gravity is given twice, or the gravity number overflows
[[nodiscard]] analytic::RodParameters rod_parameters(const RodRequest& request);
/// The parameters under their names in JSON.
[[nodiscard]] Value rod_fields(const analytic::RodParameters& parameters);
/// "thin rod, m = L = |vₙ| = 1, G = …, e = …, μᵢ = …"; of a gravity in m/s² with what G comes from.
[[nodiscard]] std::string rod_summary(const RodRequest& request);
/// Where an impulse ratio pushes along the slip of impact 1, as no friction does; empty: no ratio.
[[nodiscard]] std::string ratio_warning(const analytic::RodParameters& parameters);

// Contact angles and impulses over θ.

/// What may be given.
struct AnglesOptions {
  RangeRequest range;  ///< of θ [°]
  RodRequest rod;
  bool as_printed = false;
  int digits = 6;
};
[[nodiscard]] Arguments angles_arguments(AnglesOptions& options);

/// What is asked for.
struct AnglesRequest {
  std::function<double(long long)> theta;  ///< of row i [°]
  long long count = 0;
  analytic::RodParameters rod;
  std::string rod_words{};  ///< as rod_summary()
  bool as_printed = false;  ///< also β by the paper's printed gravity term
  int digits = 6;           ///< shown in tables
};

/// @throws BadInput as sweep_of() and rod_parameters()
[[nodiscard]] AnglesRequest angles_request(const AnglesOptions& options);

/// Names, headings and units of a row's numbers.
[[nodiscard]] std::vector<Column> angles_columns(const AnglesRequest& request);
/// The numbers of a row in the order of the columns, the printed forms last.
using AnglesRow = std::array<double, 19>;
/// Row i; NaN for what does not happen with β, γ ≤ 90° and for what was not asked for.
[[nodiscard]] AnglesRow angles_row(const AnglesRequest& request, long long i);

/// The report without rows.
[[nodiscard]] Report angles_frame(const AnglesRequest& request);
/// A row for each angle, with the error of each number that is computed: a bound, as of contact_angles().
[[nodiscard]] Report angles_report(const AnglesRequest& request);
/// CSV of the rows from `begin` up to `end`; empty fields for what does not happen, and for errors that are not known.
[[nodiscard]] std::string angles_csv_rows(const AnglesRequest& request, long long begin, long long end);

/// β and γ (or β beside its printed forms) and the impulses over θ.  Of more than 4000 rows every n-th is drawn, and
/// both rows between which an impact begins or ceases to happen, so that the branches end where they do.
[[nodiscard]] Picture angles_picture(const AnglesRequest& request);

// How many impacts happen.

/// What is asked for.
struct RegimesRequest {
  std::size_t over = 0;  ///< the quantity that varies: gravity number, restitution, impulse ratio
  RangeRequest range;
  bool logarithmic = false;
  RodRequest rod;
  int digits = 8;
};
[[nodiscard]] Arguments regimes_arguments(RegimesRequest& request);

/// One value of the parameter.
struct Regimes {
  double value;
  analytic::RegimeBoundary second, third;
};

/// The regimes over the values of a quantity.
struct FoundRegimes {
  const char* name = "";     ///< of the quantity
  const char* words = "";    ///< for an axis of a picture
  bool logarithmic = false;  ///< that axis; a value that is not positive is then left out, and the axis says so
  std::vector<double> values;
  std::vector<Regimes> all;
  std::function<std::vector<Regimes>()> curve;  ///< as many values from the least to the greatest as a picture needs
  std::string rod_words;                        ///< the parameters that all rows share
  std::vector<std::string> script_head;         ///< of a picture's script
  Report report;
};
/// @throws BadInput as the command.
[[nodiscard]] FoundRegimes find_regimes(const RegimesRequest& request);

[[nodiscard]] std::vector<Column> regimes_columns();

/// θ₂ and θ₃ over the parameter, and the areas of one, two and three impacts: curves through many values, and marks at
/// those of the table.
[[nodiscard]] Picture regimes_picture(const FoundRegimes& found);

}  // namespace clatter::validation
