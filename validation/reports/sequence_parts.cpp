// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/sequence_parts.hpp"

#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/scene_value.hpp"

namespace clatter::validation::inline reports {

void grow(Scales& scales, Scale scale, double number) {
  double& size = scales[static_cast<std::size_t>(scale)];
  size = std::max(size, std::fabs(number));
}

Scales begun_scales() {
  Scales scales{};
  grow(scales, Scale::angle, 90);
  grow(scales, Scale::ratio, 1);
  return scales;
}

std::string with_error(const Estimated& number, const Shown& shown) {
  const std::string text = known_text(number, shown);
  return number.is_known() && number.error > 0 ? text + " ± " + significant(number.error, 2) : text;
}

std::string trust_words(std::size_t known, std::size_t all) {
  if (known == all) return "";
  return known == 0 ? "?: not to be trusted: how errors grow is not known"
                    : fmt::format("?: trust ends with impact {}: after it rounding decides what happens", known);
}

std::string accuracy_words(int digits, double error) {
  if (!std::isfinite(error)) return "";
  return fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves", digits,
                     std::max(-std::log10(error), 0.0));
}

Report begun_sequence_report(const Scene& scene, const DiscreteDrop& drop, const std::string& what,
                             const Totals& sums) {
  Report report = begun_report("sequence", what);
  const double approach = first_approach_speed(drop);
  report.head = scene_head(scene, Model::discrete, approach);
  report.remarks = {totals_line(sums)};
  report.fields["model"] = "discrete";
  report.fields["scene"] = scene_value(scene, Model::discrete, approach);
  report.fields["body"] = body_value(scene, Model::discrete);
  return report;
}

}  // namespace clatter::validation::inline reports
