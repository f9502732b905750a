// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sequence/sequence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/space/sequence/sustained_contact.hpp"
#include "validation/output/number.hpp"
#include "validation/run/impact_rows.hpp"
#include "validation/run/rest_face.hpp"
#include "validation/run/run.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/run/states.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;

constexpr int most_notes = 4;  // of one kind

/// "1.25000 ± 0.00012"
std::string with_error(const Estimated& number, const Shown& shown) {
  const std::string text = known_text(number, shown);
  return number.is_known() && number.error > 0 ? text + " ± " + significant(number.error, 2) : text;
}

/// Until which impact rows can be trusted; empty: all can.
std::string trust_words(const Run& run) {
  const auto lost = std::ranges::find(run.impacts, false, &Impact::predictable);
  if (lost == run.impacts.end()) return "";
  return lost == run.impacts.begin()
             ? "?: not to be trusted: how errors grow is not known"
             : fmt::format("?: trust ends with impact {}: after it rounding decides what happens",
                           lost - run.impacts.begin());
}

/// What was asked against what rounding leaves; empty where nothing is known.
std::string accuracy_words(int digits, double error) {
  if (!std::isfinite(error)) return "";
  return fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves", digits,
                     std::max(-std::log10(error), 0.0));
}

std::string tail_words(int digits, const RunTail& tail) {
  const Estimated end{tail.sum.value.start, tail.sum.error.start};
  return fmt::format("…: the last row sums up all further impacts; they end at {} s, {}",
                     with_error(end, {.digits = digits + 3}), tail.closed_form ? "in closed form" : "by extrapolation");
}

/// "+x-y+z, +x+y+z"
std::string names_of(const Scene& scene, const space::Body& body, const std::vector<int>& corners) {
  std::string names;
  for (const int i : corners) {
    const auto index = static_cast<std::size_t>(i);
    space::Corner corner{.index = i};
    if (index < body.vertices.size()) corner.place = body.vertices[index];
    names += (names.empty() ? "" : ", ") + corner_name(scene, corner);
  }
  return names;
}

/// How the body goes on where the sequence ends with a corner or an edge that stays on the ground; nothing also where
/// that cannot be computed.
std::optional<space::SustainedContact> lasting_contact(const Scene& scene, const space::Drop& drop,
                                                       const space::Sequence& sequence) {
  if (scene.until_rest) return {};
  try {
    return contact_after(drop, sequence);
  } catch (const analytic::NumericalError&) {
    return {};
  }
}

std::string contact_words(const Scene& scene, const space::Body& body, const space::SustainedContact& contact,
                          int digits) {
  const Estimated end{contact.begin + contact.duration, contact.error.time};
  const std::string corners = names_of(scene, body, contact.corners);
  const std::string until = with_error(end, {.digits = std::min(digits, 6)}) + " s";
  switch (contact.end) {
    case space::ContactEnd::arrival:
      return fmt::format("the body turns on {} until {} strikes at {}, {} m/s fast", corners,
                         names_of(scene, body, contact.arriving), until, significant(contact.approach_speed, 3));
    case space::ContactEnd::lift_off: return fmt::format("the body turns on {}, which lifts off at {}", corners, until);
    case space::ContactEnd::joining:
      return fmt::format("the body turns on {} until {}: {} stay on the ground", corners, until,
                         names_of(scene, body, contact.pivots));
    case space::ContactEnd::rest: return fmt::format("the body lies on {} at {}", corners, until);
    case space::ContactEnd::open: break;
  }
  return fmt::format("the body turns on {} until {}: {}", corners, until, contact.reason);
}

/// The first contacts that lasted between impacts.
void add_contact_notes(const Scene& scene, const space::Body& body, const space::Sequence& sequence,
                       std::vector<std::string>& notes) {
  constexpr std::size_t most = most_notes;
  const auto& contacts = sequence.contacts;
  for (std::size_t i = 0; i < std::min(contacts.size(), most); ++i) {
    notes.push_back(fmt::format("after impact {}{}: {}", contacts[i].rows, contacts[i].tail ? " and its hops" : "",
                                contact_words(scene, body, contacts[i], scene.accuracy.digits)));
  }
  if (contacts.size() > most)
    notes.push_back(fmt::format("{} further contacts like these are in JSON", contacts.size() - most));
}

/// Which corners stay on the ground, on which face and by when the body settles, and how far it slides there.
void add_end_notes(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence,
                   std::vector<std::string>& notes) {
  if (sequence.tail && drop.body.rims.empty() && drop.body.ellipsoids.empty())
    notes.push_back("the further impacts are those of " + names_of(scene, drop.body, sequence.tail->corners));
  add_contact_notes(scene, drop.body, sequence, notes);
  if (const auto contact = lasting_contact(scene, drop, sequence))
    notes.push_back(contact_words(scene, drop.body, *contact, scene.accuracy.digits));
  if (!sequence.rest) return;
  const std::string face = names_of(scene, drop.body, sequence.rest->corners);
  const double latest = sequence.rest->latest;
  notes.push_back(std::isfinite(latest)
                      ? fmt::format("the body settles on the face of {} before {} s", face, significant(latest, 3))
                      : fmt::format("the body settles on the face of {}, when is not known", face));
}

std::string near_miss_words(int digits, const Run& run) {
  if (!run.near_miss || !std::isfinite(run.near_miss->clearance)) return "";
  const Impact& last = run.impacts.back();
  const Estimated clearance{run.near_miss->clearance, last.predictable ? run.near_miss->margin : last.error.start};
  return fmt::format("closest approach after the last impact: {} m above the ground",
                     known_text(clearance, {.digits = std::min(digits, 6)}));
}

const char* convention_words(const space::GroupImpact& group) {
  return group.is_whole ? "the body rebounds as a whole" : "they strike one after the other, the fastest first";
}

using OutcomeSets = std::map<std::size_t, space::OutcomeSet>;

/// What small tilts make of the rows in which several corners arrive together, by the rows' places.
OutcomeSets outcome_sets(const PreparedScene& prepared, const DiscreteRun& found, const space::TiltEffort& most) {
  OutcomeSets sets;
  const auto* const sequence = std::get_if<space::Sequence>(&found.sequence);
  if (sequence == nullptr) return sets;
  const auto& drop = std::get<space::Drop>(prepared.drop);
  for (std::size_t i = 0; i < sequence->rows.size(); ++i) {
    const space::ImpactRow& row = sequence->rows[i];
    if (row.group && row.held == 0) sets[i] = tilted_outcomes(drop.body, row.before, row.corners, drop.law, most);
  }
  return sets;
}

/// The first rows in which several corners arrive together.
void add_group_notes(const DiscreteRun& found, const OutcomeSets& sets, std::vector<std::string>& notes) {
  std::size_t told = 0;
  for (const auto& [i, set] : sets) {
    if (++told > most_notes) {
      notes.push_back(fmt::format("{} further landings like these are in JSON", sets.size() - most_notes));
      return;
    }
    const space::ImpactRow& row = std::get<space::Sequence>(found.sequence).rows[i];
    const double speed = std::max(row.before.velocity.norm(), row.impact.approach_speed);
    std::string words =
        fmt::format("impact {}: {}, {}", i + 1, landing_words(row.corners), convention_words(*row.group));
    if (set.velocity_spread > 1e-6 * speed || !set.is_complete()) words += ", by convention; " + tilt_words(set);
    notes.push_back(words);
  }
}

/// How far the run can be trusted, its sum, its accuracy and why it ended.
std::vector<std::string> notes_of(const PreparedScene& prepared, const DiscreteRun& found, const OutcomeSets& sets) {
  const int digits = prepared.scene.accuracy.digits;
  const Run& run = found.run;
  std::vector<std::string> notes;
  if (run.first_touch) notes.push_back(words_of(*run.first_touch));
  add_group_notes(found, sets, notes);
  if (run.tail) notes.push_back(tail_words(digits, *run.tail));
  if (const auto* const sequence = std::get_if<space::Sequence>(&found.sequence))
    add_end_notes(prepared.scene, std::get<space::Drop>(prepared.drop), *sequence, notes);
  for (const std::string& words :
       {trust_words(run),
        fmt::format("Sum of normal impulses: {} N·s", known_text(totals(run).normal_impulse, {.digits = digits})),
        accuracy_words(digits, run.relative_error), fmt::format("{}: {}", run.outcome, run.message),
        near_miss_words(digits, run)}) {
    notes.push_back(words);
  }
  for (const std::string& words : state_notes(run)) notes.push_back(words);
  std::erase(notes, "");
  return notes;
}

Value tail_fields(const RunTail& tail) {
  const Numbers &value = tail.sum.value, &error = tail.sum.error;
  return Value::Fields{{"end", text_or_nothing(tail.sum.end)},
                       {"end_time", value.start},
                       {"end_time_error", rounded_up(error.start)},
                       {"impulse_normal", value.impulse[2]},
                       {"impulse_normal_error", rounded_up(error.impulse[2])},
                       {"impulse_tangential", value.impulse[0]},
                       {"impulse_tangential_error", rounded_up(error.impulse[0])},
                       {"impulse", value.impulse},
                       {"closed_form", tail.closed_form},
                       {"velocity_after", value.velocity_after},
                       {"angular_velocity_after", value.angular_velocity_after}};
}

/// The first strikes, each with the names of its corners.
Value order_value(const Scene& scene, const space::ImpactRow& row, const space::GroupImpact& impact) {
  constexpr std::size_t most = 32;
  Value::List order;
  for (std::size_t i = 0; i < std::min(impact.order.size(), most); ++i) {
    std::vector<std::string> names;
    for (const space::Corner& corner : row.corners) {
      if (std::ranges::count(impact.order[i], corner.index) > 0) names.push_back(corner_name(scene, corner));
    }
    order.emplace_back(names);
  }
  return order;
}

Value outcome_fields(const Scene& scene, const space::ImpactRow& row, const space::TiltedOutcome& outcome) {
  constexpr double degree = std::numbers::pi / 180;
  const space::GroupImpact& impact = outcome.impact;
  Value::List sectors;
  for (const space::TiltSector& sector : outcome.sectors)
    sectors.emplace_back(std::vector<double>{sector.from / degree, (sector.from + sector.width) / degree});
  return Value::Fields{{"share", outcome.share},
                       {"tilt_direction_deg", outcome.tilt_direction / degree},
                       {"tilt_sectors_deg", sectors},
                       {"velocity_after", impact.velocity_after},
                       {"angular_velocity_after", impact.angular_velocity_after},
                       {"energy_loss", impact.energy_loss},
                       {"strikes", impact.order.size()},
                       {"order", order_value(scene, row, impact)}};
}

/// Adds to the impact of several corners what small tilts make of it.
void add_outcomes(const Scene& scene, const space::ImpactRow& row, const space::OutcomeSet& set, Value& impact) {
  Value::List outcomes;
  for (const space::TiltedOutcome& outcome : set.outcomes) outcomes.push_back(outcome_fields(scene, row, outcome));
  impact["convention"] = convention_words(*row.group);
  impact["convention_share"] = set.convention_share;
  impact["outcomes"] = outcomes;
  impact["outcomes_vary"] = set.varies;
  impact["outcomes_complete"] = set.is_complete();
  impact["outcomes_open_share"] = set.open_share;
  impact["outcomes_range"] = Value::Fields{{"velocity_after", set.range.velocity},
                                           {"angular_velocity_after", set.range.angular_velocity},
                                           {"energy_loss", set.range.energy_loss}};
}

/// How friction acts on corners that stay on the ground.
const char* contact_mode(const space::Drop& drop, const space::SustainedContact& contact) {
  const analytic::ImpactLaw& law = drop.law;
  if (law.friction == analytic::FrictionKind::none || law.friction_value == 0) return "frictionless";
  return contact.slips && contact.sticks ? "slip-stick" : contact.slips ? "slip" : "stick";
}

Value contact_value(const Scene& scene, const space::Drop& drop, const space::SustainedContact& contact) {
  const space::Quaternion& q = contact.after.attitude;
  const space::StateErrors& error = contact.error;
  const char* const ends[] = {"impact", "lift-off", "joining", "rest", "open"};
  return Value::Fields{
      {"start", contact.begin},
      {"duration", contact.duration},
      {"corners", names_of(scene, drop.body, contact.corners)},
      {"mode", contact_mode(drop, contact)},
      {"end", ends[static_cast<std::size_t>(contact.end)]},
      {"message", text_or_nothing(contact.reason)},
      {"corners_at_end", names_of(scene, drop.body, contact.pivots)},
      {"arriving", names_of(scene, drop.body, contact.arriving)},
      {"approach_speed", contact.approach_speed},
      {"impulse_normal", contact.normal_impulse},
      {"energy_loss", contact.energy_loss},
      {"attitude", std::vector<double>{q.w(), q.x(), q.y(), q.z()}},
      {"velocity_after", contact.after.velocity},
      {"angular_velocity_after", contact.after.angular_velocity},
      {"error_estimate", Value::Fields{{"end", rounded_up(error.time)},
                                       {"attitude", rounded_up(error.attitude)},
                                       {"velocity_after", rounded_up(error.velocity)},
                                       {"angular_velocity_after", rounded_up(error.angular_velocity)}}}};
}

/// Energy lost in impacts of one point, of two corners, and of more or a level rim, in hops that are summed up, and by
/// friction of corners that stay on the ground [J].
Value losses_by_contact(const space::Sequence& sequence) {
  double points = 0, edges = 0, faces = 0, hops = sequence.tail ? sequence.tail->energy_loss : 0, contacts = 0;
  for (const space::ImpactRow& row : sequence.rows) {
    const std::size_t corners = row.corners.front().radius > 0 ? 3 : row.corners.size();
    (corners == 1 ? points : corners == 2 ? edges : faces) += row.impact.energy_loss;
  }
  for (const space::SustainedContact& contact : sequence.contacts) {
    contacts += contact.energy_loss;
    if (contact.tail) hops += contact.tail->energy_loss;
  }
  return Value::Fields{{"point", points}, {"edge", edges}, {"face", faces}, {"hops", hops}, {"contacts", contacts}};
}

/// Which corners stay, how the body goes on there, and the face that it settles on; energy by kind of contact.
void add_end(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence, Value& fields) {
  if (sequence.tail) fields["tail"]["corners"] = names_of(scene, drop.body, sequence.tail->corners);
  fields["energy_losses"] = losses_by_contact(sequence);
  fields["energy_at_end"] = sequence.energy_at_end;
  if (const auto contact = lasting_contact(scene, drop, sequence))
    fields["contact"] = contact_value(scene, drop, *contact);
  if (scene.until_rest) {
    Value::List contacts;
    for (const space::SustainedContact& contact : sequence.contacts) {
      contacts.push_back(contact_value(scene, drop, contact));
      contacts.back()["after_impact"] = contact.rows;
    }
    fields["contacts"] = contacts;
  }
  if (!sequence.rest) return;
  fields["rest"]["corners"] = names_of(scene, drop.body, sequence.rest->corners);
  fields["rest"]["latest"] = sequence.rest->latest;
}

/// The fields behind the impacts.
void add_results(const Scene& scene, const Run& run, Value& fields) {
  if (run.first_touch) fields["first_touch"] = fields_of(*run.first_touch);
  if (run.tail) fields["tail"] = tail_fields(*run.tail);
  if (run.end_motion) fields["end_motion"] = fields_of(*run.end_motion);
  fields["outcome"] = run.outcome;
  fields["message"] = run.message + "; the discrete model's impacts are instantaneous: no peak force or time";
  if (!run.warnings.empty()) fields["warnings"] = run.warnings;
  if (run.near_miss) {
    fields["near_miss"] = Value::Fields{{"clearance", run.near_miss->clearance},
                                        {"margin", run.near_miss->margin},
                                        {"within_margin", run.near_miss->within_margin()}};
  }
  fields["accuracy"] =
      Value::Fields{{"asked", std::pow(10.0, -scene.accuracy.digits)}, {"achieved", run.relative_error}};
  add_totals(totals(run), fields);
  fields["shortfall"] = text_or_nothing(shortfall(scene, run));
  fields["cost"] = Value::Fields{{"force_evaluations", 0}, {"root_evaluations", run.evaluations}};
}

bool loses_energy(const Run& run) {
  return std::ranges::any_of(run.impacts, [&](const Impact& impact) {
    return std::fabs(impact.value.energy_loss) > 1e-14 * run.impacts[0].value.energy_before;
  });
}

double reach_of(const DiscreteDrop& drop) {
  return std::visit([](const auto& one) { return one.body.reach(); }, drop);
}

/// Whether a drop in space is one of an outline that moves in the plane.
bool is_planar(const PreparedScene& prepared) {
  const auto* const drop = std::get_if<space::Drop>(&prepared.drop);
  return drop == nullptr || (drop->body.is_flat() && reason_in_space(prepared.scene).empty());
}

std::vector<Column> columns_of(const PreparedScene& prepared, const Run& run) {
  const bool friction = law_of(prepared.drop).friction != analytic::FrictionKind::none;
  if (run.model == RunModel::plane) return sequence_columns(friction, loses_energy(run));
  const bool is_outline = is_planar(prepared);  // that turns about y alone
  std::vector<std::string> shown = shown_quantities(is_outline ? RunModel::plane : RunModel::space);
  if (is_outline) *std::ranges::find(shown, "end") = "corners";
  if (friction) shown.emplace_back("mode");
  return impact_columns(RunModel::space, shown);
}

/// The report without its rows, which are made one at a time; all of it must outlive this.
class SequenceRows {
 public:
  SequenceRows(const PreparedScene& prepared, const DiscreteRun& found, const space::TiltEffort& tilts)
      : prepared_(prepared), found_(found),
        sets_(outcome_sets(prepared, found, tilts)), digits_{.digits = prepared.scene.accuracy.digits,
                                                             .scales = scales_of(found.run, reach_of(prepared.drop))},
        report_(begun()) {}

  [[nodiscard]] const Report& report() const { return report_; }
  [[nodiscard]] std::size_t impacts() const { return found_.run.impacts.size(); }
  /// A row for each impact, and one for the tail.
  [[nodiscard]] std::size_t count() const { return impacts() + (found_.run.tail ? 1 : 0); }

  [[nodiscard]] Row row(std::size_t i) const {
    const Run& run = found_.run;
    const bool is_tail = i == impacts();
    Row row = impact_row(is_tail ? run.tail->sum : run.impacts[i], run.model, digits_);
    if (is_tail) row[0].shown = "…";
    else if (!run.impacts[i].predictable) row[0].shown = fmt::format("{}?", run.impacts[i].n);
    return row;
  }

  /// An impact of JSON.
  [[nodiscard]] Value impact(std::size_t i) const {
    Value impact = row_object(report_.grid.columns, row(i));
    const auto set = sets_.find(i);
    if (set != sets_.end())
      add_outcomes(prepared_.scene, std::get<space::Sequence>(found_.sequence).rows[i], set->second, impact);
    return impact;
  }

 private:
  [[nodiscard]] Report begun() const;

  const PreparedScene& prepared_;
  const DiscreteRun& found_;
  OutcomeSets sets_;
  ImpactDigits digits_;
  Report report_;
};

Report SequenceRows::begun() const {
  const Scene& scene = prepared_.scene;
  const Run& run = found_.run;
  const bool in_space = run.model == RunModel::space;
  Report report = scene_report(
      "sequence", in_space ? "impact sequence, discrete model in space" : "impact sequence, discrete model", "discrete",
      scene, Model::discrete, first_approach_speed(prepared_.drop));
  report.remarks = {totals_line(totals(run))};
  report.notes = notes_of(prepared_, found_, sets_);
  report.grid.columns = columns_of(prepared_, run);
  report.fields["impacts"] = Value::List{};
  if (scene.has_times()) {
    const Scales scales = scales_of(run, reach_of(prepared_.drop));
    const auto of = [&](Scale scale) { return scales[static_cast<std::size_t>(scale)]; };
    const StateSizes sizes{.length = reach_of(prepared_.drop),
                           .speed = of(Scale::speed),
                           .rate = of(Scale::rate),
                           .energy = of(Scale::energy)};
    report.further = state_grid(run, !in_space || is_planar(prepared_), scene.accuracy.digits, sizes);
    report.fields["states"] = row_objects(*report.further);
  }
  add_results(scene, run, report.fields);
  if (const auto rest = rest_face(scene, prepared_.drop, found_.sequence)) report.fields["rest"] = fields_of(*rest);
  if (const auto* const sequence = std::get_if<space::Sequence>(&found_.sequence))
    add_end(scene, std::get<space::Drop>(prepared_.drop), *sequence, report.fields);
  return report;
}

}  // namespace

std::vector<Column> sequence_columns(bool friction, bool loses) {
  std::vector<std::string> shown = shown_quantities(RunModel::plane);
  if (friction) shown.insert(shown.end(), {"impulse_tangential", "velocity_after_x", "energy_loss", "mode"});
  else if (loses) shown.emplace_back("energy_loss");
  return impact_columns(RunModel::plane, shown);
}

Report sequence_report(const PreparedScene& prepared, const DiscreteRun& found, const space::TiltEffort& tilts) {
  const SequenceRows rows(prepared, found, tilts);
  Report report = rows.report();
  for (std::size_t i = 0; i < rows.count(); ++i) report.grid.rows.push_back(rows.row(i));
  for (std::size_t i = 0; i < rows.impacts(); ++i) report.fields["impacts"].push_back(rows.impact(i));
  return report;
}

void write_sequence(const PreparedScene& prepared, const DiscreteRun& found, const space::TiltEffort& tilts,
                    const TextStyle& style, const WriteText& write) {
  const SequenceRows rows(prepared, found, tilts);
  if (style.format == Format::json) {
    write_json(
        rows.report().fields, "impacts", rows.impacts(), [&](std::size_t i) { return rows.impact(i); }, write);
    return;
  }
  Row row;
  write_rows(rows.report(), {rows.count(), [&](std::size_t i) -> const Row& { return row = rows.row(i); }}, style,
             write);
}

}  // namespace clatter::validation
