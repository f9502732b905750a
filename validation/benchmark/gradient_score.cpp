// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/gradient_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "validation/gradient/drop_gradient.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double close = 1e-3;  ///< of a mistake that explains a derivative, relative

/// "dV/dangle" cut in two; nothing for another name.
std::optional<GradientColumn> read_gradient_column(const std::string& name, bool in_space) {
  const std::size_t slash = name.find("/d");
  if (!name.starts_with('d') || slash == std::string::npos) return {};
  const std::string number = name.substr(1, slash - 1), parameter = name.substr(slash + 2);
  const auto numbers = gradient_numbers(in_space);
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const GradientNumber& one) {
    return one.in_lists != nullptr && number == one.in_lists;
  });
  std::vector<std::string> parameters{"angle", "speed", "restitution", "friction"};
  if (in_space) parameters.emplace_back("tilt");
  const bool is_known = std::find(parameters.begin(), parameters.end(), parameter) != parameters.end();
  if (found == numbers.end() || !is_known) return {};
  return GradientColumn{name, number, parameter, static_cast<std::size_t>(found - numbers.begin())};
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

}  // namespace

std::vector<GradientColumn> gradient_columns_of(const std::vector<std::string>& header, bool in_space) {
  std::vector<GradientColumn> columns;
  for (const std::string& name : header) {
    if (auto column = read_gradient_column(name, in_space)) columns.push_back(std::move(*column));
  }
  return columns;
}

void score_gradients(const Answer& answer, const std::vector<GradientColumn>& columns, const Reference& reference,
                     Score& score) {
  if (columns.empty()) return;
  const ReferenceSequence& sequence = sequence_of(reference, score.law);
  if (reference.is_compliant || sequence.law.is_moreau || reference.ground_ends) {
    score.findings.emplace_back(
        fmt::format("derivatives are not judged: none are known of this {}", reference.ground_ends ? "ground" : "law"));
    return;
  }
  DiscreteDrop drop = reference.drop;
  const auto set_law = [&](auto& one) {
    if constexpr (requires { one.law.law.restitution; }) one.law.law = sequence.law.law.law;
    else one.law = sequence.law.law.law;
  };
  std::visit(set_law, drop);
  const DropGradient gradient = drop_gradient(drop, static_cast<int>(sequence.truth.size()));
  GradientJudge judge(answer, score);
  for (const GradientColumn& column : columns) judge.judge(column, wanted_of(column, gradient, sequence));
}

}  // namespace clatter::validation
