// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "validation/compare/comparison.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/facet_words.hpp"

namespace clatter::validation {

namespace {

/// Zero in both models and in the limit, by symmetry; a limit that misses is something.
bool is_nothing(const Comparison& comparison, const ComparedImpact& impact, std::size_t q) {
  if (impact.has_landing() && !(std::fabs(NumberPair{impact, q}.miss()) <= impact.allowance[q])) return false;
  const double tiny = 1e-12 * comparison.discrete.scales[q];
  return std::fabs((*impact.discrete)[q]) <= tiny && impact.continuous && std::fabs((*impact.continuous)[q]) <= tiny;
}

/// The impact's number, marked if its limit misses the discrete value.
Cell number_cell(const ComparedImpact& impact) {
  return {impact.n, std::to_string(impact.n) + (impact.has_landing() && !impact.lands() ? "!" : "")};
}

/// The corner, or how many they are.
std::string short_end(const std::string& end) {
  const auto spaces = std::count(end.begin(), end.end(), ' ');
  return spaces == 0 ? end : fmt::format("{} at once", spaces + 1);
}

/// A difference, to two digits at most.
Cell difference_cell(const Estimated& difference, double scale) {
  Cell cell = known_cell(difference, {6, scale});
  cell.digits = std::min(cell.digits, 2);
  return cell;
}

/// By how much the limit is off; 0 where the error bar, which stands beside it, leaves no digit.
Cell miss_cell(const Estimated& miss) {
  const int digits = known_digits(miss.value, miss.error);
  return digits > 0 || !miss.is_known() ? Cell(miss.value, std::min(digits, 2)) : Cell(miss.value, std::string("0"));
}

void add_rows(const Comparison& comparison, const ComparedImpact& impact, Grid& grid) {
  bool first = true;
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    if (!impact.discrete || is_nothing(comparison, impact, q)) continue;
    const NumberPair pair{impact, q};
    const double scale = comparison.discrete.scales[q];
    Row row{first ? number_cell(impact) : Cell(), first ? Cell(short_end(impact.discrete_end)) : Cell(), Cell(heading),
            known_cell(pair.given_number(), {6, scale})};
    if (comparison.as_given) row.push_back(known_cell(pair.discrete_number(), {6, scale}));
    const std::size_t width = row.size() + 5;
    if (impact.reason.empty()) {
      row.insert(row.end(), {known_cell(pair.continuous_number(), {6, scale}),
                             difference_cell(pair.deviation_number(), scale), Cell(pair.predicted(), 2)});
    } else {
      row.insert(row.end(), {Cell("–"), Cell(), Cell()});
    }
    if (impact.has_limit()) row.insert(row.end(), {miss_cell(pair.miss_number()), Cell(pair.bar(), 2)});
    row.resize(width);
    grid.rows.push_back(std::move(row));
    first = false;
  }
}

/// Why impacts are not compared; those that follow one in one line.
std::vector<std::string> reasons(const Comparison& comparison) {
  std::vector<std::string> notes;
  for (const ComparedImpact& impact : comparison.impacts) {
    if (impact.reason.empty()) continue;
    const int last = static_cast<int>(comparison.impacts.size());
    std::string note = fmt::format("Impact {} is not compared: {}", impact.n, impact.reason);
    if (impact.has_landing()) note += fmt::format("; on stiffer ground it {}", impact.lands() ? "agrees" : "differs");
    if (impact.n < last) note += fmt::format("; nor are those that follow, up to {}", last);
    notes.push_back(note);
    break;
  }
  return notes;
}

/// In space, why impacts have no limit that lands; one line for those in a row that share it.
std::vector<std::string> explanations(const Comparison& comparison) {
  std::vector<std::string> notes;
  const auto& impacts = comparison.impacts;
  for (std::size_t i = 0; i < impacts.size();) {
    const std::size_t first = i;
    while (i < impacts.size() && impacts[i].explanation == impacts[first].explanation) ++i;
    std::string why = impacts[first].explanation;
    if (why.empty()) continue;
    const std::string& told = impacts[first].reason;  // in the line on why the impact is not compared
    if (first == 0 && why == told) why = "none, for the same reason";
    else if (first == 0 && !told.empty() && why.ends_with(": " + told)) why.resize(why.size() - told.size() - 2);
    notes.push_back(i == first + 1 ? fmt::format("Limit of impact {}: {}", i, why)
                                   : fmt::format("Limit of impacts {} to {}: {}", first + 1, i, why));
  }
  return notes;
}

/// A number in which the models differ.
struct Difference {
  const ComparedImpact* impact = nullptr;
  ComparedQuantity quantity{};
  double relative = 0;  ///< beside the size of such numbers
};

Difference largest_difference(const Comparison& comparison) {
  Difference largest;
  for (const ComparedImpact& impact : comparison.impacts) {
    if (!impact.reason.empty() || !impact.discrete || !impact.continuous) continue;
    for (const ComparedQuantity& quantity : comparison.discrete.quantities) {
      const std::size_t q = quantity.place;
      const double relative = std::fabs(NumberPair{impact, q}.deviation()) / comparison.discrete.scales[q];
      if (relative > largest.relative) largest = {&impact, quantity, relative};
    }
  }
  return largest;
}

/// What part of the discrete model's omissions brings most of the largest difference on this ground, and how long the
/// contact before lasts; empty: the models do not differ, or nothing is known of it.
std::string cause_words(const Comparison& comparison) {
  using Part = std::pair<const char*, MotionNumbers PredictedSize::*>;
  constexpr std::array parts{Part{"gravity, which acts during contacts too", &PredictedSize::gravity},
                             Part{"how far the body turns during contacts", &PredictedSize::turning},
                             Part{"the point of contact, which lies inside the corner", &PredictedSize::indentation},
                             Part{"the time that the contacts before take", &PredictedSize::delay},
                             Part{"the tipping of the face", &PredictedSize::tipping}};
  const auto [impact, quantity, relative] = largest_difference(comparison);
  if (impact == nullptr) return "";
  if (!comparison.agrees() && !comparison.other_law.empty()) {
    return "Why they differ: by their laws of impact, see the last line. Without [impact], --restitution and "
           "--friction "
           "the discrete model takes the ground's, which --floor-restitution and --sliding-friction set.";
  }
  const PredictedSize& size = impact->predicted;
  const std::size_t q = quantity.place;
  const auto& [words, most] =
      *std::ranges::max_element(parts, {}, [&](const Part& part) { return (size.*part.second)[q]; });
  if (!((size.*most)[q] > 0 && std::isfinite((size.*most)[q]))) return "";
  const ComparedImpact& struck = impact->n > 1 ? comparison.impacts[static_cast<std::size_t>(impact->n - 2)] : *impact;
  std::string contact = fmt::format("contact {} lasts {} ms", struck.n, significant(1e3 * struck.contact_time, 3));
  if (impact->n > 1 && struck.discrete)
    contact += fmt::format(" of the {} ms to the next in the discrete model{}",
                           significant(1e3 * ((*impact->discrete)[0] - (*struck.discrete)[0]), 3),
                           comparison.as_given ? " with the mesh's corners" : "");
  return fmt::format("Why they differ on this ground: the largest difference, {} of impact {}, comes most from {}; {}.",
                     quantity.heading, impact->n, words, contact);
}

std::string limit_words(const Comparison& comparison) {
  const StiffLimit& limit = comparison.limit;
  if (limit.rows.empty()) return "No limit: the impacts do not come apart on stiffer ground either.";
  const char* const name = limit.by_modulus ? "E*" : "k";
  const char* const unit = limit.by_modulus ? "Pa" : "N/m³";
  return fmt::format(
      "limit off: by how much the limit {0} → ∞ is off the discrete value, ± its error bar; from {1} runs up to {0} = "
      "{2} {3}, over the contact time, which falls like {0}^{4}",
      name, limit.runs, significant(limit.stiffness, 2), unit, significant(-limit.power, 3));
}

std::string verdict_words(const Comparison& comparison) {
  const auto landed = std::count_if(comparison.impacts.begin(), comparison.impacts.end(),
                                    [](const ComparedImpact& impact) { return impact.has_landing(); });
  if (!comparison.agrees()) {
    return "The models DIFFER: a limit (!) misses the discrete value" +
           (comparison.other_law.empty() ? "."
                                         : "; the law of [impact] is not the ground's: " + comparison.other_law + ".");
  }
  if (landed == 0)
    return comparison.has_content() ? "No limit is to be the discrete value." : "Nothing could be compared.";
  const bool tips = std::any_of(comparison.impacts.begin(), comparison.impacts.end(), [](const ComparedImpact& impact) {
    return impact.has_landing() && impact.predicted.tipping != MotionNumbers{};
  });
  return fmt::format(
      "The models agree as the ground gets ever stiffer: the limit is the discrete value {}{}for {} of {} impacts.",
      comparison.as_given ? "of the mesh's corners " : "", tips ? "up to the tipping of a face " : "", landed,
      comparison.impacts.size());
}

/// Whether every number of either model is known to its error.
bool is_predictable(const Comparison& comparison, const ComparedImpact& impact) {
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    if (impact.discrete && !std::isfinite(impact.discrete_error[q])) return false;
    if (impact.continuous && !std::isfinite(impact.continuous_error[q])) return false;
  }
  return true;
}

/// Fields of a number: nothing where a model, or the limit, has none.
/// @param is_of_mesh  the mesh has other corners than the body as given
Row number_row(const NumberPair& pair, bool is_of_mesh) {
  const ComparedImpact& impact = pair.impact;
  const PredictedSize& size = impact.predicted;
  const std::size_t q = pair.quantity;
  const bool comparable = impact.reason.empty();
  const auto where = [](bool known, const auto& get) { return Cell(known ? Value(get()) : Value()); };
  const bool has_given = impact.as_given || (impact.discrete && !is_of_mesh);
  const Estimated given = has_given ? pair.given_number() : Estimated{};
  return {where(has_given, [&] { return given.value; }),
          where(impact.continuous.has_value(), [&] { return pair.continuous(); }),
          where(has_given, [&] { return error_or_nothing(given); }),
          where(impact.continuous.has_value(), [&] { return error_or_nothing(pair.continuous_number()); }),
          where(comparable, [&] { return pair.deviation(); }),
          where(comparable, [&] { return error_or_nothing(pair.deviation_number()); }),
          where(comparable, [&] { return pair.predicted(); }),
          where(comparable, [&] { return size.gravity[q]; }),
          where(comparable, [&] { return size.turning[q]; }),
          where(comparable, [&] { return size.indentation[q]; }),
          where(comparable, [&] { return size.delay[q]; }),
          where(comparable, [&] { return size.tipping[q]; }),
          where(impact.limit.has_value(), [&] { return impact.limit->value[q]; }),
          where(impact.limit.has_value(), [&] { return rounded_up(impact.limit->error[q]); }),
          where(impact.limit.has_value(), [&] { return pair.allowance(); }),
          where(is_of_mesh && impact.discrete, [&] { return pair.discrete(); }),
          where(is_of_mesh && impact.discrete, [&] { return error_or_nothing(pair.discrete_number()); }),
          where(is_of_mesh && impact.discrete && has_given, [&] { return pair.discrete() - given.value; })};
}

const std::vector<Column>& number_columns() {
  static const std::vector<Column> columns{
      {"discrete", "", "", "value of the discrete model, as `clatter sequence` has it"},
      {"continuous", "", "", "value of the continuous model"},
      {"discrete_error", "", "", "bound on the error of the discrete value"},
      {"continuous_error", "", "", "estimated error of the continuous value"},
      {"deviation", "", "", "continuous − discrete, with the mesh's corners"},
      {"deviation_error", "", "", "error of the deviation"},
      {"predicted", "", "", "size of the deviation that the discrete model's omissions bring"},
      {"predicted_gravity", "", "", "of that: gravity during contacts"},
      {"predicted_turning", "", "", "of that: turning during contacts"},
      {"predicted_indentation", "", "", "of that: the contact point inside the corner"},
      {"predicted_delay", "", "", "of that: the duration of contacts before"},
      {"predicted_tipping", "", "", "of that: a face that its friction tips on an even bed, however stiff"},
      {"limit", "", "", "of the continuous model for an ever stiffer ground"},
      {"limit_error", "", "", "error bar of the limit"},
      {"allowance", "", "", "by which the limit may miss the discrete value"},
      {"mesh_corners", "", "",
       "value of the discrete model with the mesh's corners, which limit and deviation are held against; empty where "
       "they "
       "are the body's"},
      {"mesh_corners_error", "", "", "bound on its error"},
      {"mesh_corners_off", "", "", "that value − the discrete model's"}};
  return columns;
}

/// The quantities of an impact as fields, and as rows of CSV behind `front`.
Value add_numbers(const Comparison& comparison, const ComparedImpact& impact, const Row& front, Grid& grid) {
  Value numbers;
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    const Row values = number_row({impact, q}, comparison.as_given.has_value());
    numbers[name] = row_object(number_columns(), values);
    Row& row = grid.rows.emplace_back(front);
    row.insert(row.end(), {Cell(impact.n), Cell(name), Cell(is_predictable(comparison, impact)),
                           Cell(text_or_nothing(impact.reason))});
    row.insert(row.end(), values.begin(), values.end());
  }
  return numbers;
}

Value impact_fields(const Comparison& comparison, const ComparedImpact& impact, const Row& front, Grid& grid) {
  Value fields(Value::Fields{{"n", impact.n},
                             {"comparable", impact.reason.empty()},
                             {"predictable", is_predictable(comparison, impact)},
                             {"reason", text_or_nothing(impact.reason)},
                             {"discrete_end", text_or_nothing(impact.discrete_end)},
                             {"continuous_end", text_or_nothing(impact.continuous_end)},
                             {"contact_time", impact.continuous ? Value(impact.contact_time) : Value()},
                             {"limit_is_discrete", impact.has_landing() ? Value(impact.lands()) : Value()},
                             {"numbers", add_numbers(comparison, impact, front, grid)}});
  if (comparison.discrete.in_space) fields["explanation"] = text_or_nothing(impact.explanation);
  return fields;
}

/// How far the mesh's corners are from the body's; null: they are the same.
Value corners_value(const Comparison& comparison) {
  if (!comparison.as_given) return {};
  const CornersApart apart = comparison.corners_apart();
  return Value::Fields{{"largest_off", apart.largest},
                       {"impact", apart.impact > 0 ? Value(apart.impact) : Value()},
                       {"same_impacts", static_cast<long long>(apart.same_count)}};
}

/// What the column of the mesh's corners is, and how far it is from the body's; empty: they are the same.
std::string corners_words(const Comparison& comparison) {
  if (!comparison.as_given) return "";
  const CornersApart apart = comparison.corners_apart();
  const std::size_t count = comparison.impacts.size();
  std::string words =
      "corners: the discrete model with the mesh's corners, to which the limit k → ∞ is held; the discrete column has "
      "the body itself";
  if (apart.impact > 0) {
    words += fmt::format("; the two are up to {} of the scale apart ({} of impact {})", significant(apart.largest, 2),
                         apart.quantity, apart.impact);
  } else if (apart.same_count > 0) {
    words += "; the two are equal";
  }
  if (apart.same_count == count) return words;
  return words + fmt::format("; from impact {} on they are other impacts", apart.same_count + 1);
}

/// The head without rows.
/// @param approach  speed of the first contact in the discrete model [m/s]; none: it is swept
Report begun_comparison(const Scene& scene, std::optional<double> approach) {
  Report report = begun_report("compare", "discrete and continuous model, impact by impact");
  report.head = scene_head(scene, Model::continuous, approach);
  if (!approach) report.head.push_back("discrete model: " + law_words(scene, {}));
  report.fields["model"] = "comparison";
  report.fields["scene"] = scene_value(scene, Model::continuous, approach);
  report.fields["body"] = body_value(scene);
  report.grid.columns = comparison_columns();
  report.digest.emplace().leading = 3;
  return report;
}

/// One comparison's fields, and its rows, each behind the cells `front`.
void add_comparison(const Comparison& comparison, const Row& front, Value& fields, Grid& grid) {
  fields["impacts"] = Value::List{};
  for (const ComparedImpact& impact : comparison.impacts)
    fields["impacts"].push_back(impact_fields(comparison, impact, front, grid));
  fields["limit"] = Value::Fields{
      {"stiffness", comparison.limit.stiffness}, {"power", -comparison.limit.power}, {"runs", comparison.limit.runs}};
  fields["discrete_ended"] = (comparison.as_given ? *comparison.as_given : comparison.discrete).message;
  fields["continuous_ended"] = comparison.run.message;
  fields["agrees"] = comparison.agrees();
  fields["shortfall"] = text_or_nothing(comparison.shortfall);
  fields["mesh_corners"] = corners_value(comparison);
  fields["message"] = verdict_words(comparison);
}

/// How often first impacts are not compared (–), by reason.
void add_swept_reasons(const std::vector<SweptComparison>& swept, Report& report) {
  std::map<std::string, int> counts;
  for (const auto& [value, comparison] : swept) {
    if (!comparison.impacts.empty() && !comparison.impacts[0].reason.empty()) ++counts[comparison.impacts[0].reason];
  }
  for (const auto& [reason, count] : counts) {
    report.notes.push_back(
        fmt::format("–: not compared at this stiffness, {} of {} values: {}", count, swept.size(), reason));
  }
}

/// How far the mesh's corners are from the body's at most, where they are not the same.
void add_swept_corners(const std::vector<SweptComparison>& swept, Report& report) {
  const auto off = [](const SweptComparison& one) {
    return one.comparison.as_given ? one.comparison.corners_apart().largest : -1;
  };
  const auto worst = std::ranges::max_element(swept, {}, off);
  if (worst == swept.end() || off(*worst) < 0) return;
  report.notes.push_back(fmt::format("corners, at {} {}: {}", report.grid.columns.front().name, shortest(worst->value),
                                     corners_words(worst->comparison).substr(std::string("corners: ").size())));
}

std::string landing_word(const ComparedImpact& impact) {
  return !impact.has_landing() ? "" : impact.lands() ? "agrees" : "DIFFERS";
}

Row worst_row(double value, const Comparison& comparison, const ComparedImpact& impact) {
  const WorstNumber worst = worst_number(comparison, impact);
  Row row{impact.n == 1 ? Cell(value, 6) : Cell(), Cell(impact.n), Cell(impact.discrete_end)};
  if (impact.reason.empty()) {
    row.insert(row.end(), {difference_cell({worst.deviation, worst.deviation_error}, 1), Cell(worst.predicted, 2)});
  } else {
    row.insert(row.end(), {Cell("–"), Cell()});
  }
  if (impact.has_landing()) row.insert(row.end(), {miss_cell({worst.miss, worst.miss_error}), Cell(worst.bar, 2)});
  row.resize(7);
  row.emplace_back(landing_word(impact));
  return row;
}

}  // namespace

std::vector<Column> comparison_columns() {
  std::vector<Column> columns{{"n", "", "", "number of the impact, from 1"},
                              {"quantity", "", "",
                               "name of the number; time in s, angles in °, impulses in N·s, "
                               "velocities in m/s, angular velocity in rad/s"},
                              {"predictable", "", "", "whether each number of the impact is known to its error"},
                              {"not_compared_because", "", "", "why the impact cannot be compared at this stiffness"}};
  columns.insert(columns.end(), number_columns().begin(), number_columns().end());
  return columns;
}

Report comparison_report(const Scene& scene, const Comparison& comparison) {
  Report report = begun_comparison(scene, comparison.approach_speed);
  add_comparison(comparison, {}, report.fields, report.grid);
  if (const std::string facets = facet_words(scene, comparison.run); !facets.empty()) {
    report.head.push_back(facets);
    report.fields["message"] = verdict_words(comparison) + " " + facets;
  }
  const bool in_space = comparison.discrete.in_space;
  report.digest->columns = {{"n", "n", ""},
                            {"end", in_space ? "corner" : "end", ""},
                            {"quantity", "", ""},
                            {"discrete", "discrete", ""},
                            {"continuous", "contin.", ""},
                            {"deviation", in_space ? "dev." : "deviation", ""},
                            {"predicted", in_space ? "pred." : "predicted", ""},
                            {"miss", "limit off", ""},
                            {"allowance", "±", ""}};
  if (comparison.as_given) {
    auto& columns = report.digest->columns;
    columns.insert(columns.begin() + 4, Column{"mesh_corners", "corners", ""});
  }
  for (const ComparedImpact& impact : comparison.impacts) add_rows(comparison, impact, *report.digest);
  report.notes = reasons(comparison);
  for (const std::string& note : explanations(comparison)) report.notes.push_back(note);
  report.notes.push_back(fmt::format(
      "t in s, angles in °, P in N·s, V in m/s, Ω in rad/s; deviation: continuous − {}; predicted: about how much the "
      "number should change because contacts take time and go into the ground, this one and those before; no bound",
      comparison.as_given ? "corners" : "discrete"));
  for (const std::string& words : {comparison.shortfall, corners_words(comparison), cause_words(comparison),
                                   limit_words(comparison), verdict_words(comparison)}) {
    if (!words.empty()) report.notes.push_back(words);
  }
  return report;
}

WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact) {
  WorstNumber worst;
  double largest = -1, largest_miss = -1;
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    const NumberPair pair{impact, q};
    const double scale = comparison.discrete.scales[q];
    if (impact.reason.empty() && std::fabs(pair.deviation()) / scale > largest) {
      largest = std::fabs(pair.deviation()) / scale;
      worst.deviation = largest;
      worst.deviation_error = pair.deviation_number().error / scale;
      worst.predicted = pair.predicted() / scale;
    }
    if (impact.has_landing() && std::fabs(pair.miss()) / pair.allowance() > largest_miss) {
      largest_miss = std::fabs(pair.miss()) / pair.allowance();
      worst.miss = std::fabs(pair.miss()) / scale;
      worst.miss_error = pair.miss_number().error / scale;
      worst.bar = pair.bar() / scale;
    }
  }
  return worst;
}

Report swept_comparison_report(const Scene& scene, const std::vector<SweptComparison>& swept) {
  Report report = begun_comparison(scene, {});
  const Column value_column = swept_column(*scene.sweep);
  report.grid.columns.insert(report.grid.columns.begin(), value_column);
  report.digest->columns = {value_column,
                            {"n", "n", ""},
                            {"end", "end", ""},
                            {"deviation", "deviation", "of all"},
                            {"predicted", "predicted", "of all"},
                            {"miss", "limit off", "of all"},
                            {"allowance", "±", "of all"},
                            {"verdict", "", ""}};
  report.fields["runs"] = Value::List{};
  for (const auto& [value, comparison] : swept) {
    Value run(Value::Fields{{scene.sweep->name(), value}});
    add_comparison(comparison, {Cell(value, 6)}, run, report.grid);
    report.fields["runs"].push_back(std::move(run));
    for (const ComparedImpact& impact : comparison.impacts) {
      if (impact.discrete) report.digest->rows.push_back(worst_row(value, comparison, impact));
    }
  }
  report.notes.emplace_back(
      "of all: of the largest time, speed or momentum of the sequence; the worst number of each impact");
  const auto agreeing =
      std::count_if(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  report.fields["agrees"] = agreeing == static_cast<std::ptrdiff_t>(swept.size());
  report.notes.push_back(fmt::format("{} of {} values agree.", agreeing, swept.size()));
  add_swept_reasons(swept, report);
  add_swept_corners(swept, report);
  add_interruption(*scene.sweep, swept.size(), report);
  return report;
}

}  // namespace clatter::validation
