// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/submission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>
#include <variant>

#include "validation/gradient/gradient_report.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"

namespace clatter::validation {
namespace {

/// A column of derivatives of a list: of a number with respect to one of the drop, the angle, in space the
/// tilt (both per radian), the speed at the first touch, restitution or friction.
struct GradientColumn {
  std::string name;  ///< in the header: "dV/dangle", "dPz/dtilt", …
  std::string number, parameter;
  std::size_t index = 0;  ///< of the number in gradient_numbers()
};

constexpr double degree = std::numbers::pi / 180;
constexpr double close = 1e-3;  ///< of a mistake that explains a derivative, relative

/// "dV/dangle" cut in two; nothing for another name.
std::optional<GradientColumn> read_gradient_column(const std::string& name, bool in_space) {
  const std::size_t slash = name.find("/d");
  if (!name.starts_with('d') || slash == std::string::npos) return {};
  const std::string number = name.substr(1, slash - 1), parameter = name.substr(slash + 2);
  const auto known = gradient_numbers(in_space);
  const auto found = std::find_if(known.begin(), known.end(), [&](const GradientNumber& one) {
    return one.in_lists != nullptr && number == one.in_lists;
  });
  std::vector<std::string> parameters{"angle", "speed", "restitution", "friction"};
  if (in_space) parameters.emplace_back("tilt");
  const bool is_known = std::find(parameters.begin(), parameters.end(), parameter) != parameters.end();
  if (found == known.end() || !is_known) return {};
  return GradientColumn{name, number, parameter, static_cast<std::size_t>(found - known.begin())};
}

/// The derivatives of one column, impact by impact; none where there are none.
struct Wanted {
  std::vector<std::optional<double>> values;
  std::string reason;  ///< why there are none from some impact on
  double size = 0;     ///< that errors are relative to
};

/// The size of a number of the drop's impacts.
double size_of(const std::string& number, const ReferenceSequence& sequence) {
  double size = 0;
  for (const TruthRow& row : sequence.truth) {
    const double one = number == "t"           ? row.time
                       : number == "Omega"     ? row.angular_velocity.norm()
                       : number.front() == 'W' ? row.angular_velocity.norm()
                       : number.front() == 'P' ? row.impulse.norm()
                                               : row.velocity.norm();
    size = std::fmax(size, one);
  }
  return size;
}

Wanted wanted_of(const GradientColumn& column, const DropGradient& gradient, const ReferenceSequence& sequence) {
  const auto parameter = std::find_if(gradient.parameters.begin(), gradient.parameters.end(),
                                      [&](const ParameterGradient& one) { return one.name == column.parameter; });
  Wanted wanted{.values = {}, .reason = parameter->refused.reason, .size = size_of(column.number, sequence)};
  if (wanted.reason.empty()) wanted.reason = "it grazes, or another may come first";
  for (std::size_t n = 0; n < sequence.truth.size(); ++n) {
    const Derivatives* const of = parameter->of(n);
    wanted.values.push_back(of != nullptr ? std::optional(of->value[column.index]) : std::nullopt);
    if (of != nullptr) wanted.size = std::fmax(wanted.size, std::fabs(of->value[column.index]));
  }
  return wanted;
}

/// A mistake that gives this number in place of the right one; empty: none of those known.
std::string mistake(const GradientColumn& column, double given, double right) {
  if (right == 0) return "";
  const double ratio = given / right;
  const auto is = [&](double other) { return std::fabs(ratio / other - 1) <= close; };
  const bool is_turn = column.parameter == "angle" || column.parameter == "tilt";
  if (given == 0) return ": it is left out";
  if (is(-1)) return ": the other sign";
  if (is_turn && is(degree)) return ": per degree, not per radian";
  if (is_turn && is(-degree)) return ": per degree, and the other sign";
  return "";
}

/// The cell of a row: a number, or nothing for "none".
std::optional<double> read_cell(const NumericTable& table, std::size_t row, const std::string& column) {
  const std::string& text = table.word(row, column);
  if (text == "none") return {};
  double value = 0;
  if (!read_number(text, value)) table.refuse(row, column, "a number, or none");
  return value;
}

class GradientJudge {
 public:
  GradientJudge(const Answer& answer, Score& score) : answer_(answer), score_(score) {}

  void judge(const GradientColumn& column, const Wanted& wanted) {
    double worst = -1;
    std::string finding;
    const double sign = column.number == "Omega" && answer_.is_counter_clockwise ? -1 : 1;
    for (std::size_t n = 0; n < std::min(answer_.table.rows(), wanted.values.size()); ++n) {
      const auto given = read_cell(answer_.table, n, column.name);
      const auto& right = wanted.values[n];
      double error = 0;
      std::string words;
      if (given && right) {
        error = std::fabs(sign * *given - *right) / wanted.size;
        words = fmt::format("is {}, must be {}{}", shortest(*given), significant(sign * *right, 6),
                            mistake(column, sign * *given, *right));
      } else if (given || right) {
        error = Score::unknown;
        words = given ? "is " + shortest(*given) + ", and there is none: " + wanted.reason
                      : "is none, must be " + significant(sign * *right, 6);
      }
      score_.gradient_error = worse(score_.gradient_error, error);
      if (!(error <= tolerance_) && !(error <= worst)) {
        worst = error;
        finding = fmt::format("{} of impact {} {}", column.name, n + 1, words);
      }
    }
    if (!finding.empty()) score_.findings.push_back(finding);
  }

 private:
  static constexpr double tolerance_ = 1e-6;
  const Answer& answer_;
  Score& score_;
};

const ReferenceSequence& sequence_of(const Reference& reference, const std::string& law) {
  const auto found = std::find_if(reference.sequences.begin(), reference.sequences.end(),
                                  [&](const ReferenceSequence& one) { return one.law.is_named(law); });
  return found != reference.sequences.end() ? *found : reference.sequences.front();
}

/// The columns of a header that are such.
std::vector<GradientColumn> gradient_columns_of(const std::vector<std::string>& header, bool in_space) {
  std::vector<GradientColumn> columns;
  for (const std::string& name : header) {
    if (auto column = read_gradient_column(name, in_space)) columns.push_back(std::move(*column));
  }
  return columns;
}

/// Judges the columns of derivatives of a list whose impacts are scored: a cell is a number, or "none" where there is
/// no derivative, as at a fold.  Sets Score::gradient_error, of a derivative over the largest of its column, at least
/// the size of its number; unknown for a number where there is none and the other way round.
/// @param columns  as gradient_columns_of(), read as words
/// @throws BadInput for a cell that is neither
void score_gradients(const Answer& answer, const std::vector<GradientColumn>& columns, const Reference& reference,
                     Score& score) {
  if (columns.empty()) return;
  const ReferenceSequence& sequence = sequence_of(reference, score.law);
  const bool is_of_problem = sequence.law.name != "any";  // the discrete model has derivatives of a scene's law
  if (reference.is_compliant || (sequence.law.is_moreau && is_of_problem) || reference.ground_end) {
    score.findings.emplace_back(
        fmt::format("derivatives are not judged: none are known of this {}", reference.ground_end ? "ground" : "law"));
    return;
  }
  DiscreteDrop drop = reference.drop;
  std::visit([&](auto& one) { one.law = sequence.law.law; }, drop);
  const DropGradient gradient = drop_gradient(drop, static_cast<int>(sequence.truth.size()));
  GradientJudge judge(answer, score);
  for (const GradientColumn& column : columns) judge.judge(column, wanted_of(column, gradient, sequence));
}

/// A file's text as a table of the kind that its header says.
struct ReadFile {
  NumericTable table;
  bool is_list;
  std::vector<GradientColumn> gradients;  ///< of a list
};

ReadFile read_file(const std::string& path, const ColumnNames& names) {
  std::string text = NumericTable::text_of(path);
  const std::vector<std::string> header = NumericTable::header_of(text);
  const auto has = [&](const char* name) {
    return names.contains(name) || std::find(header.begin(), header.end(), name) != header.end();
  };
  const bool is_list = has("place");
  if (!is_list) {
    TableRequest request = Motion::request(Motion::is_in_space(header, names), names);
    if (!has("z") && has("y") && has("vy")) request.renaming = "if y points up --columns z=y,vz=vy reads it so";
    return {NumericTable::parse(path, std::move(text), request), is_list, {}};
  }
  TableRequest request = impact_list_request(has("Px"), names);
  std::vector<GradientColumn> gradients = gradient_columns_of(header, has("Px"));
  for (const GradientColumn& column : gradients) request.words.push_back(column.name);
  return {NumericTable::parse(path, std::move(text), request), is_list, std::move(gradients)};
}

SubmissionHead head_of(const NumericTable& table) {
  const auto text = [&](const char* key) { return table.comment(key).value_or(""); };
  SubmissionHead head{.problem = text("problem"),
                      .engine = text("engine"),
                      .version = text("version"),
                      .settings = text("settings"),
                      .step = stated_step(table)};
  if (table.comment("law")) head.law = read_law(place_of(table, "law"), text("law"));
  return head;
}

/// A run of another law than the scene's is right by that law, and would only look wrong.
void require_law(const NumericTable& table, const SubmissionHead& head, const analytic::ImpactLaw& law) {
  if (head.law.empty() || !law.has_cone() || law.friction_value == 0 ||
      law.law == analytic::RestitutionLaw::viscoelastic)
    return;
  const bool is_moreau = law.friction == analytic::FrictionKind::moreau;
  const std::string own = std::string(law_name(law.law)) + (is_moreau ? " moreau" : " routh");
  if (head.law != own)
    throw BadInput("{} = {}: must be the scene's, {}; --restitution-law and --impact-friction-law change that",
                   place_of(table, "law"), head.law, own);
}

/// The value of a line that has few of them; nothing without the line.
std::optional<std::string> chosen_comment(const NumericTable& table, const std::string& key,
                                          const std::vector<std::string>& allowed) {
  const auto given = table.comment(key);
  if (given && std::find(allowed.begin(), allowed.end(), *given) == allowed.end()) {
    throw BadInput(
        fmt::format("{} = {}: must be {}", place_of(table, key), shown_field(*given), fmt::join(allowed, " or ")));
  }
  return given;
}

Ending ending_of(const NumericTable& table) {
  Ending ending{.nothing_approaches = chosen_comment(table, "ended", {"nothing approaches"}).has_value(), .energy = {}};
  const auto energy = table.comment("energy");
  double value = 0;
  if (energy && !read_number(trimmed(*energy), value))
    throw BadInput(fmt::format("{} = {}: must be a number of joules", place_of(table, "energy"), shown_field(*energy)));
  if (energy) ending.energy = value;
  return ending;
}

/// A list in the plane says which turn its Omega counts as positive: a guess would hide a wrong sign.
Score judge_list(const Answer& answer, const SubmissionHead& head, const Reference& reference) {
  const NumericTable& table = answer.table;
  Score score =
      score_list(listed_impacts(table, reference, answer.is_counter_clockwise), reference, head.law, answer.ending);
  if (table.column("Omega") && !table.comment("Omega")) {
    score.left_out = "no line \"# Omega: clockwise\" or \"# Omega: counter-clockwise\"";
    score.findings.insert(score.findings.begin(), "incomplete: " + score.left_out);
  }
  return score;
}

Submission judge(const ReadFile& file, const SubmissionHead& head, const Reference& reference) {
  Submission submission{.path = file.table.path(),
                        .name = std::filesystem::path(file.table.path()).filename().string(),
                        .head = head,
                        .asked = reference.name,
                        .tolerances = reference.tolerances,
                        .is_list = file.is_list,
                        .gradients = !file.gradients.empty()};
  const std::string other = "counter-clockwise";
  const Answer answer{
      .table = file.table,
      .is_list = file.is_list,
      .is_counter_clockwise = file.is_list && chosen_comment(file.table, "Omega", {"clockwise", other}) == other,
      .ending = ending_of(file.table)};
  std::string step_words;
  if (file.is_list) {
    submission.score = judge_list(answer, head, reference);
  } else {
    const Motion motion(file.table, reference);
    submission.score = score_motion(motion, reference, head.law, answer.ending);
    if (head.step && motion.step() < *head.step) {
      step_words = fmt::format("{} {} s: rows are {} s apart, less than the step, and are taken for it",
                               place_of(file.table, "step"), significant(*head.step, 3), significant(motion.step(), 3));
      submission.head.step = motion.step();
    }
  }
  score_gradients(answer, file.gradients, reference, submission.score);
  if (!step_words.empty()) submission.score.findings.push_back(step_words);
  submission.verdict = verdict_of(submission.score, reference.tolerances);
  if (!(submission.score.impacts_error() <= reference.tolerances[1]) || submission.score.ends_early) {
    Diagnosis diagnosis = diagnosis_of(answer, reference, submission.score);
    if (!diagnosis.remark.empty()) submission.score.findings.push_back(diagnosis.remark);
    submission.causes = std::move(diagnosis.causes);
    submission.law_is_unexplained = diagnosis.law_is_unexplained;
  }
  return submission;
}

/// ln(step), ln(error), and the variance of that by its phases, 0 for one alone.
struct OrderPoint {
  double step, error, variance;
};

/// Slope and the variance that the points' own give it; with `without` one of them is left out.
Estimated slope_of(const std::vector<OrderPoint>& points, std::size_t without) {
  double x = 0, y = 0, n = 0, xx = 0, xy = 0, variance = 0, left = 0;
  const auto each = [&](auto&& add) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i != without) add(points[i]);
    }
  };
  each([&](const OrderPoint& p) { x += p.step, y += p.error, ++n; });
  x /= n, y /= n;
  each([&](const OrderPoint& p) {
    xx += (p.step - x) * (p.step - x), xy += (p.step - x) * (p.error - y);
    variance += (p.step - x) * (p.step - x) * p.variance;
  });
  each([&](const OrderPoint& p) { left += std::pow(p.error - y - xy / xx * (p.step - x), 2); });
  return {xy / xx, std::fmax(std::sqrt(variance) / xx, n > 2 ? std::sqrt(left / (n - 2) / xx) : 0)};
}

std::optional<Estimated> observed_order(const std::vector<SubmissionGroup::Step>& steps) {
  std::vector<OrderPoint> points;
  for (const SubmissionGroup::Step& one : steps) {
    if (!one.step || !(one.motion_error > 0) || !std::isfinite(one.motion_error)) continue;
    const auto n = static_cast<double>(one.motion_errors.size());
    double mean = 0, square = 0;
    for (const double error : one.motion_errors) mean += error / n;
    for (const double error : one.motion_errors) square += (error / mean - 1) * (error / mean - 1);
    points.push_back({std::log(*one.step), std::log(mean), n > 1 ? square / (n - 1) / n : 0});
  }
  const std::size_t n = points.size();
  if (n < 2 || !(points.front().step - points.back().step > 1e-6)) return std::nullopt;
  Estimated order = slope_of(points, n);
  if (n < 3) return Estimated{order.value, std::nan("")};
  double mean = 0, square = 0;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < n; ++i) slopes.push_back(slope_of(points, i).value);
  const auto count = static_cast<double>(n);
  for (const double slope : slopes) mean += slope / count;
  for (const double slope : slopes) square += (slope - mean) * (slope - mean);
  order.error = std::fmax(order.error, std::sqrt((count - 1) / count * square));
  return order;
}

void add_causes(const Submission& one, SubmissionGroup& group) {
  std::set<std::string> names;  // either of two causes may have one name
  for (const Cause& cause : one.causes) names.insert(cause.name);
  if (one.law_is_unexplained) names.insert(unexplained_law);
  const std::string first = one.law_is_unexplained ? unexplained_law
                            : one.causes.empty()   ? ""
                                                   : one.causes.front().name;
  for (const std::string& name : names) {
    auto found = std::ranges::find(group.causes, name, &SubmissionGroup::CauseCount::name);
    if (found == group.causes.end()) found = group.causes.insert(found, {.name = name});
    ++found->files;
    found->leads += name == first ? 1 : 0;
  }
  const bool is_right = one.causes.empty() && one.verdict <= Verdict::sharp;
  if (!is_right)
    group.unexplained =
        worse(group.unexplained,
              one.causes.empty() ? Score::unknown : one.causes.front().unexplained.value_or(Score::unknown));
}

}  // namespace

std::string read_law(const std::string& where, const std::string& text) {
  const std::vector<std::string> known{"newton", "poisson", "stronge", "routh", "moreau"};
  std::string words = text, restitution, friction;
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return std::isalpha(c) ? static_cast<char>(std::tolower(c)) : ' '; });
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const auto at = std::find(known.begin(), known.end(), word);
    std::string& part = at < known.begin() + 3 ? restitution : friction;
    if (at == known.end() || !part.empty()) {
      throw BadInput(
          fmt::format("{} = {}: must be newton, poisson or stronge, then routh or moreau", where, shown_field(text)));
    }
    part = word;
  }
  if (restitution.empty()) restitution = "newton";
  if (friction.empty()) friction = "routh";
  if (words.find_first_not_of(' ') == std::string::npos || (friction == "moreau" && restitution != "newton")) {
    throw BadInput(fmt::format("{} = {}: must be newton, poisson or stronge, then routh, or newton moreau", where,
                               shown_field(text)));
  }
  return restitution + " " + friction;
}

Submission judge_file(const std::string& path, const std::string& problem, const ColumnNames& names) {
  const ReadFile file = read_file(path, names);
  SubmissionHead head = head_of(file.table);
  std::string where = place_of(file.table, "problem");
  if (!problem.empty()) head.problem = problem, where = "--problem";
  if (head.problem.empty()) throw BadInput(path + ": no line \"# problem: ID\" above the header; --problem names one");
  const Problem& named = problem_named(where, head.problem);
  static std::map<std::string, Reference> references;  // many files have the same problem
  const auto found = references.find(named.id);
  const Reference& reference =
      found != references.end() ? found->second : references.emplace(named.id, reference_of(named)).first->second;
  Submission submission = judge(file, head, reference);
  submission.problem_version = named.version;
  return submission;
}

Submission judge_file(const std::string& path, const Reference& reference, const ColumnNames& names) {
  const ReadFile file = read_file(path, names);
  const SubmissionHead head = head_of(file.table);
  require_law(file.table, head, reference.sequences.front().law.law);
  return judge(file, head, reference);
}

void name_apart(std::vector<Submission>& submissions) {
  std::map<std::string, std::set<std::filesystem::path>> paths;
  for (const Submission& one : submissions) paths[one.name].insert(one.path);
  for (Submission& one : submissions) {
    const std::set<std::filesystem::path>& alike = paths[one.name];
    const std::filesystem::path path = one.path;
    // The whole path where the folder above does not tell them apart.
    const auto above = [](const std::filesystem::path& of) { return of.parent_path().filename(); };
    std::set<std::filesystem::path> folders;
    for (const std::filesystem::path& other : alike) folders.insert(above(other));
    if (alike.size() == 1) continue;
    one.name =
        (folders.size() == alike.size() && path.has_parent_path() ? above(path) / path.filename() : path).string();
  }
}

std::vector<SubmissionGroup> group_submissions(const std::vector<Submission>& submissions) {
  std::vector<SubmissionGroup> groups;
  for (const Submission& one : submissions) {
    const SubmissionHead& head = one.head;
    const auto is_its = [&](const SubmissionGroup& other) { return other.head.group() == head.group(); };
    auto found = std::ranges::find_if(groups, is_its);
    if (found == groups.end()) found = groups.insert(found, SubmissionGroup{});
    SubmissionGroup& group = *found;
    group.head = head;
    group.verdict = std::max(group.verdict, one.verdict);
    ++group.files;
    group.incomplete += one.verdict == Verdict::incomplete || one.score.ends_early ? 1 : 0;
    add_causes(one, group);
    auto step = std::find_if(group.steps.begin(), group.steps.end(),
                             [&](const SubmissionGroup::Step& other) { return other.step == head.step; });
    if (step == group.steps.end()) step = group.steps.insert(step, {.step = head.step});
    ++step->files;
    step->motion_errors.push_back(one.score.order_is_right ? one.score.motion_error() : Score::unknown);
    step->motion_error = std::max(step->motion_error, step->motion_errors.back());
    step->verdict = std::max(step->verdict, one.verdict);
    step->law_error = std::max(step->law_error, one.score.law_error);
    step->error = std::max(step->error, one.score.error());
  }
  std::ranges::sort(groups, {}, [](const SubmissionGroup& group) { return group.head.group(); });
  for (SubmissionGroup& group : groups) {
    std::ranges::sort(group.steps, std::greater{}, [](const auto& one) { return one.step.value_or(0); });
    std::ranges::stable_sort(group.causes, std::greater{},
                             [](const auto& one) { return std::pair(one.files, one.leads); });
    group.order = observed_order(group.steps);
  }
  return groups;
}

}  // namespace clatter::validation
