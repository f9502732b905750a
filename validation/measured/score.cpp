// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/score.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "analytic/base/errors.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "validation/measured/track.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/names.hpp"
#include "validation/scene/scene.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {
namespace {

using analytic::space::FirstContact;
using analytic::space::FreeFlight;
using analytic::space::PrincipalAxes;
using analytic::space::State;

constexpr double one_in_two_to_54 = 0x1p-54;  // uniform_at() may be 0
constexpr int most_impacts = 200, most_touches = 20;
constexpr double frames_of_a_flight = 3;

/// A body's attitude and angular velocity a time later in flight.
void turn_freely(const TrackedBody& body, State& state, double time) {
  if (body.turns_steadily()) {
    state.attitude = (rotation_of(time * state.angular_velocity) * state.attitude).normalized();
    return;
  }
  const State later = FreeFlight(PrincipalAxes(body.core().inertia), state, 0).at(time);
  state.attitude = later.attitude;
  state.angular_velocity = later.angular_velocity;
}

double point_speed(const TrackedBody& body, const State& state, int corner) {
  return (state.velocity + state.angular_velocity.cross(body.arm(state.attitude, corner))).z();
}

/// Normal impulse over the mass.
double jump(const State& before, const State& after) { return after.velocity.z() - before.velocity.z(); }

/// A sample of a measured state.
State sample_of(const MeasuredState& measured, std::uint64_t seed, std::uint64_t sample) {
  const Eigen::SelfAdjointEigenSolver<StateCovariance> axes(measured.covariance);
  StateVector standard;
  for (std::uint32_t i = 0; i < 12; ++i) standard[i] = normal_at(seed, sample, i);
  const StateVector off = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseProduct(standard);
  State state = measured.state;
  state.position += off.head<3>();
  state.attitude = (rotation_of(off.segment<3>(3)) * state.attitude).normalized();
  state.velocity += off.segment<3>(6);
  state.angular_velocity += off.tail<3>();
  return state;
}

/// Samples of the start, each as a state after its first impact.
struct Samples {
  std::map<int, int> first, second, scattered;  ///< corner → how many samples
  std::vector<MotionParts> after;
  std::vector<double> times;
};

/// A motion after an impact with the law's own scatter; a planar body stays in its plane.
State scattered(const ForecastModel& model, const TrackImpact& start, State after, std::uint64_t seed,
                std::uint64_t number) {
  const double own = model.law_scatter * motion_size(model.body, start.before.state);
  const double turning = own / std::sqrt(model.body.gyration_square());
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (!model.planar || axis != 1) after.velocity[axis] += own * normal_at(seed, number, 13 + axis);
    if (!model.planar || axis == 1) after.angular_velocity[axis] += turning * normal_at(seed, number, 16 + axis);
  }
  return after;
}

Samples samples_of(const ForecastModel& model, const TrackImpact& start, const ForecastRequest& request) {
  Samples samples;
  for (int i = 0; i < request.samples; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    State state = sample_of(start.before, request.seed, number);
    const double late = start.time_error * normal_at(request.seed, number, 12);
    state.attitude = (rotation_of(late * state.angular_velocity) * state.attitude).normalized();
    const int corner = model.body.lowest(state.attitude);
    ++samples.first[corner];
    const State after = struck(model.body, state, corner, model.law);
    samples.after.push_back(motion_parts(model.body, after));
    const auto next = next_contact(model.body, after, corner, start.gravity);
    ++samples.second[next ? next->corner : -1];
    if (next) samples.times.push_back(next->time);
    const auto other =
        next_contact(model.body, scattered(model, start, after, request.seed, number), corner, start.gravity);
    ++samples.scattered[other ? other->corner : -1];
  }
  return samples;
}

double share_of(const std::map<int, int>& counts, int corner, int samples) {
  const auto found = counts.find(corner);
  return found == counts.end() || samples == 0 ? 0 : static_cast<double>(found->second) / samples;
}

MotionParts half_widths(const ForecastModel& model, const TrackImpact& start, const Samples& samples) {
  MotionParts mean = MotionParts::Zero(), square = MotionParts::Zero();
  for (const MotionParts& after : samples.after) mean += after / static_cast<double>(samples.after.size());
  for (const MotionParts& after : samples.after)
    square += (after - mean).cwiseAbs2() / std::max(1.0, static_cast<double>(samples.after.size()) - 1);
  const double own = model.law_scatter * motion_size(model.body, start.before.state);
  return model.width_factor * (square.array() + own * own).sqrt();
}

analytic::space::Sequence sequence_of(const ForecastModel& model, const TrackImpact& start) {
  analytic::space::Drop drop;
  drop.body = model.body.sharp();
  drop.attitude = start.before.state.attitude;
  drop.velocity = start.before.state.velocity;
  drop.angular_velocity = start.before.state.angular_velocity;
  drop.gravity = std::max(0.0, start.gravity);
  const double mass = model.law.slope == 0 ? 0 : effective_mass(model.body, start.before.state, start.corner);
  drop.law = {.restitution = model.law.restitution_at(mass),
              .law = model.law.law,
              .friction = analytic::FrictionKind::coulomb,
              .friction_value = std::max(0.0, model.law.friction)};
  return analytic::space::impact_sequence(drop, {.impacts = most_impacts, .digits = 3, .amplification = false});
}

ForecastEnd sequence_end(const ForecastModel& model, const TrackImpact& start) {
  const analytic::space::Sequence sequence = sequence_of(model, start);
  ForecastEnd end{.impacts = 1, .face = 0, .outcome = outcome_name(sequence.outcome)};
  for (std::size_t i = 1; i < sequence.rows.size(); ++i) {
    if ((sequence.rows[i].start - sequence.rows[i - 1].start) * model.rate >= frames_of_a_flight) ++end.impacts;
  }
  if (!model.body.faces().empty()) end.face = model.body.down_face(sequence.rows.back().before.attitude);
  return end;
}

/// Scatter of the law and the factor that makes its intervals hold 90 % of the parts.
void add_intervals(const MeasuredFile& file, const std::vector<PartImpact>& impacts, MeasuredFit& fit) {
  ForecastModel model = forecast_model(file, fit);
  std::vector<double> parts;
  const auto each = [&](const auto& use) {
    for (const PartImpact& item : impacts) {
      if (!item.impact.is_point) continue;
      const Forecast made = forecast(model, item.impact, {});
      const MotionParts off = motion_parts(model.body, item.impact.after.state) - motion_parts(model.body, made.after);
      for (const int part : active_parts(file.file.description)) use(item, made, off[part], part);
    }
  };
  each([&](const PartImpact& item, const Forecast&, double off, int) {
    parts.push_back(std::fabs(off) / motion_size(model.body, item.impact.before.state));
  });
  fit.law_scatter = model.law_scatter = deviation_of_median * median(parts);
  model.width_factor = 1;
  std::vector<double> standard;
  each([&](const PartImpact&, const Forecast& made, double off, int part) {
    standard.push_back(std::fabs(off) / made.half_width[part]);
  });
  fit.width_factor = quantile(standard, 0.9);
}

/// Whether the point impacts' effective masses differ enough for restitution to depend on them.
bool has_effective_masses(const TrackedBody& body, const std::vector<PartImpact>& impacts) {
  constexpr double least_range = 0.01;
  double least = 1, largest = 0;
  for (const PartImpact& item : impacts) {
    if (!item.impact.is_point) continue;
    const double mass = effective_mass(body, item.impact.before.state, item.impact.corner);
    least = std::min(least, mass);
    largest = std::max(largest, mass);
  }
  return largest - least > least_range;
}

/// Contacts shorter than a frame are caught by a frame with the probability T × rate.
void add_contact_time(const MeasuredFile& file, const std::vector<PartImpact>& impacts, MeasuredFit& fit) {
  double points = 0, caught = 0;
  for (const PartImpact& item : impacts) {
    if (!item.impact.is_point) continue;
    ++points;
    if (item.impact.between > 0) ++caught;
  }
  const double share = caught / points;
  fit.contact_time = share / file.file.description.rate;
  fit.contact_time_error = std::sqrt(share * (1 - share) / points) / file.file.description.rate;
}

constexpr double sure = 0.95;  // share of the samples that agree where the start leaves no doubt

/// Motion after all impacts within `duration` of the first, as a sequence of impacts and flights; gravity aside, which
/// the flights on both sides have.
State after_touches(const ForecastModel& model, const TrackImpact& start, double duration) {
  State state = struck(model.body, start.before.state, start.corner, model.law);
  int corner = start.corner;
  double time = 0;
  for (int touch = 0; touch < most_touches; ++touch) {
    const auto next = next_contact(model.body, state, corner, start.gravity);
    if (!next || !(time + next->time < duration)) break;
    time += next->time;
    corner = next->corner;
    turn_freely(model.body, state, next->time);
    state.velocity.z() -= start.gravity * next->time;
    state = struck(model.body, state, corner, model.law);
  }
  state.velocity.z() += start.gravity * time;
  return state;
}

/// Forecasts beside measurements, drop by drop.
class Scorer {
 public:
  Scorer(const MeasuredFile& file, const MeasuredFit& fit, bool sequences)
      : file_(file), fit_(fit), model_(forecast_model(file, fit)), request_{.sequence = sequences} {
    if (const auto& stated = file.file.description.published)
      published_ = FittedLaw{analytic::RestitutionLaw::newton, stated->restitution, 0, stated->friction};
    add_row("as fitted");
    if (fit.dependent) add_row("restitution by effective mass");
    add_row("body as described");
    for (const LawFit& law : fit.laws) add_row(law_name(law.law.law));
    if (published_) add_row("published parameters");
    for (const char* name : {"flat rebound", "no change", "floor: any impulse there", "no point impact: one impact",
                             "no point impact: the sequence"})
      add_row(name);
  }

  void take(std::size_t index) {
    const MeasuredTrack& track = file_.tracks[index];
    if (track.meetings.empty()) return;
    ScoredDrop drop;
    drop.name = track.name;
    drop.measured = impact(track, 0);
    drop.predicted = forecast(model_, drop.measured, request_);
    drop.error = relative_error(model_.body, drop.measured, drop.predicted.after);
    drop.measured_impacts = static_cast<int>(track.meetings.size());
    if (track.meetings.size() > 1) drop.second = impact(track, 1);
    if (track.rest && !model_.body.is_ball()) drop.face = model_.body.down_face(model_.body.attitude(*track.rest));
    scores_.points.take(drop.measured.is_point);
    if (drop.measured.is_point) take_point(track, drop);
    else take_several(track, drop);
    take_end(drop);
    scores_.drops.push_back(std::move(drop));
  }

  Scores finish() { return std::move(scores_); }

 private:
  void add_row(const std::string& name) { scores_.rows.push_back({name, {}}); }

  [[nodiscard]] TrackImpact impact(const MeasuredTrack& track, std::size_t number) const {
    return measured_impact(track.meetings[number], model_.body, model_.ground_error,
                           file_.file.description.lever_tolerance);
  }

  void put(const std::string& name, double error) {
    std::ranges::find(scores_.rows, name, &ErrorRow::name)->errors.push_back(error);
  }

  void take_point(const MeasuredTrack& track, const ScoredDrop& drop) {
    const TrackedBody& body = model_.body;
    const TrackImpact& m = drop.measured;
    const State& before = m.before.state;
    put("as fitted", drop.error);
    if (fit_.dependent)
      put("restitution by effective mass",
          relative_error(body, m, struck(body, before, m.corner, fit_.dependent->law)));
    for (const LawFit& law : fit_.laws)
      put(law_name(law.law.law), relative_error(body, m, struck(body, before, m.corner, law.law)));
    State flat = before;
    flat.velocity.z() *= -fit_.laws[fit_.best].law.restitution;
    put("flat rebound", relative_error(body, m, flat));
    put("no change", relative_error(body, m, before));
    put("floor: any impulse there", floor_error(body, m, fit_.laws[fit_.best].law.friction));
    take_described(track);
    if (!body.is_ball()) scores_.first_corner.take(m.momentum_corner == drop.predicted.corner);
    take_second(track, drop);
    take_intervals(drop);
  }

  /// An impact that one point does not explain: the sequence of impacts until the next frames of flight beside it.
  void take_several(const MeasuredTrack& track, const ScoredDrop& drop) {
    const State after = after_touches(model_, drop.measured, track.meetings[0].after.first() - drop.measured.time);
    put("no point impact: one impact", drop.error);
    put("no point impact: the sequence", relative_error(model_.body, drop.measured, after));
  }

  /// The same impact with the body as it is described.
  void take_described(const MeasuredTrack& track) {
    const TrackDescription& description = file_.file.description;
    const TrackedBody body(description, fit_.as_described.calibration);
    const TrackImpact m =
        measured_impact(track.meetings[0], body, fit_.as_described.ground_spread, description.lever_tolerance);
    put("body as described", relative_error(body, m, struck(body, m.before.state, m.corner, fit_.described.law)));
    if (published_)
      put("published parameters", relative_error(body, m, struck(body, m.before.state, m.corner, *published_)));
  }

  void take_second(const MeasuredTrack& track, const ScoredDrop& drop) {
    if (!drop.second || !drop.predicted.next) return;
    const auto between = [](const Meeting& change) { return change.number == 1; };
    if (std::any_of(track.other_changes.begin(), track.other_changes.end(), between)) return;
    const NextImpact& next = *drop.predicted.next;
    const bool right = next.corner == drop.second->corner;
    if (!model_.body.is_ball()) take_second_corner(drop, next, right);
    if (!right) return;
    const double flown = drop.second->time - drop.measured.time;
    scores_.time_errors.push_back(std::fabs(next.time / flown - 1));
    const auto change = [](const TrackImpact& i) { return jump(i.before.state, i.after.state); };
    const double ratio = change(*drop.second) / change(drop.measured);
    scores_.ratio_errors.push_back(std::fabs(next.impulse_ratio / ratio - 1));
  }

  void take_second_corner(const ScoredDrop& drop, const NextImpact& next, bool right) {
    const auto flown_to =
        next_contact(model_.body, drop.measured.after.state, drop.measured.corner, drop.measured.gravity);
    scores_.second_corner_flown.take(flown_to && flown_to->corner == drop.second->corner);
    scores_.second_corner.take(right);
    if (next.certainty >= sure) scores_.second_corner_sure.take(right);
    if (next.law_certainty >= sure) scores_.second_corner_clear.take(right);
  }

  void take_intervals(const ScoredDrop& drop) {
    const MotionParts off =
        motion_parts(model_.body, drop.measured.after.state) - motion_parts(model_.body, drop.predicted.after);
    for (const int part : active_parts(file_.file.description)) {
      scores_.inside.take(std::fabs(off[part]) <= drop.predicted.half_width[part]);
    }
  }

  void take_end(ScoredDrop& drop) {
    if (!request_.sequence || !drop.face || !drop.predicted.end) return;
    scores_.face.take(drop.predicted.end->face == *drop.face);
    scores_.count.take(std::abs(drop.predicted.end->impacts - drop.measured_impacts) <= 1);
    if (!published_) return;
    ForecastModel stated = model_;
    stated.law = *published_;
    const Forecast other = forecast(stated, drop.measured, {.samples = 2, .sequence = true});
    if (!other.end) return;
    scores_.published_face.take(other.end->face == *drop.face);
  }

  const MeasuredFile& file_;
  const MeasuredFit& fit_;
  ForecastModel model_;
  ForecastRequest request_;
  std::optional<FittedLaw> published_;
  Scores scores_;
};

ResidualBin bin_of(const std::vector<ScoredDrop>& drops, const std::string& quantity, const std::string& unit,
                   double low, double high, double (*value)(const ScoredDrop&)) {
  ResidualBin bin{.quantity = quantity, .unit = unit, .low = low, .high = high};
  std::vector<double> errors, levers, restitutions;
  for (const ScoredDrop& drop : drops) {
    const double v = value(drop);
    if (!(v >= low && v < high)) continue;
    ++bin.impacts;
    levers.push_back(drop.measured.lever_miss);
    if (!drop.measured.is_point) continue;
    ++bin.points;
    errors.push_back(drop.error);
    restitutions.push_back(drop.measured.restitution);
  }
  bin.error = median(errors);
  bin.lever = median(levers);
  bin.restitution = median(restitutions);
  return bin;
}

constexpr std::uint64_t split_seed = 1;

MeasuredFile kept_file(const std::string& name) { return measure_tracks(carried_tracks(name, read_description(name))); }

Scores scores_of(const MeasuredFile& file, const TrackPart& fitted, const TrackPart& scored) {
  return score_measured(file, fit_measured(file, fitted), scored, false);
}

}  // namespace

double normal_at(std::uint64_t seed, std::uint64_t sample, std::uint32_t column) {
  return gsl_cdf_ugaussian_Pinv(std::max(one_in_two_to_54, uniform_at(seed, sample, column)));
}

MotionParts motion_parts(const TrackedBody& body, const State& state) {
  MotionParts parts;
  parts << state.velocity, std::sqrt(body.gyration_square()) * state.angular_velocity;
  return parts;
}

std::optional<NextImpact> next_contact(const TrackedBody& body, State after, int corner, double gravity) {
  const Vector3 arm = body.core_arm(after.attitude, corner);
  after.position = {0, 0, -arm.z()};
  try {
    const FreeFlight flight(PrincipalAxes(body.core().inertia), after, std::max(0.0, gravity));
    const double leaving = (after.velocity + after.angular_velocity.cross(arm)).z();
    const std::vector<analytic::space::Touch> touch{{corner, leaving}};
    const FirstContact contact = analytic::space::first_contact(body.core(), flight, touch);
    if (contact.end != analytic::FlightEnd::contact) return std::nullopt;
    NextImpact next;
    next.corner = contact.point;
    next.time = contact.time;
    return next;
  } catch (const analytic::NumericalError&) {
    return std::nullopt;
  }
}

std::vector<HeightAt> predicted_heights(const ForecastModel& model, const TrackImpact& start, double until,
                                        int per_flight) {
  const analytic::space::Sequence sequence = sequence_of(model, start);
  std::vector<HeightAt> heights;
  for (std::size_t i = 0; i < sequence.rows.size() && sequence.rows[i].start <= until; ++i) {
    const analytic::space::ImpactRow& row = sequence.rows[i];
    const bool is_last = i + 1 == sequence.rows.size();
    const double flown = is_last ? 0 : std::min(until, sequence.rows[i + 1].start) - row.start;
    for (int k = 0; k < per_flight; ++k) {
      const double t = flown * k / per_flight;
      heights.push_back({row.start + t, row.before.position.z() + t * (row.impact.velocity_after.z() -
                                                                       std::max(0.0, start.gravity) * t / 2)});
    }
  }
  return heights;
}

Forecast forecast(const ForecastModel& model, const TrackImpact& start, const ForecastRequest& request) {
  const TrackedBody& body = model.body;
  const State& before = start.before.state;
  Forecast result;
  result.corner = body.lowest(before.attitude);
  result.after = struck(body, before, result.corner, model.law);
  const Samples samples = samples_of(model, start, request);
  result.certainty = share_of(samples.first, result.corner, request.samples);
  result.half_width = half_widths(model, start, samples);
  if (point_speed(body, before, result.corner) >= 0) return result;
  result.next = next_contact(body, result.after, result.corner, start.gravity);
  if (result.next) {
    NextImpact& next = *result.next;
    next.law_certainty = share_of(samples.scattered, next.corner, request.samples);
    next.certainty = share_of(samples.second, next.corner, request.samples);
    next.time_half_width = (quantile(samples.times, 0.95) - quantile(samples.times, 0.05)) / 2;
    const FreeFlight flight(PrincipalAxes(body.core().inertia), result.after, std::max(0.0, start.gravity));
    const State arriving = flight.at(next.time);
    next.impulse_ratio = jump(arriving, struck(body, arriving, next.corner, model.law)) / jump(before, result.after);
  }
  if (!request.sequence) return result;
  try {
    result.end = sequence_end(model, start);
  } catch (const std::exception&) {  // no sequence can be had: the forecast has no end
    result.end.reset();
  }
  return result;
}

std::vector<int> active_parts(const TrackDescription& description) {
  return description.is_planar() ? std::vector<int>{0, 2, 4} : std::vector<int>{0, 1, 2, 3, 4, 5};
}

TrackSplit split_by_seed(std::size_t tracks, std::uint64_t seed, double share) {
  TrackSplit split;
  for (std::size_t i = 0; i < tracks; ++i) (uniform_at(seed, i, 0) < share ? split.fitted : split.scored).push_back(i);
  return split;
}

TrackSplit split_by_list(const TrackFile& file, const std::string& option, const std::string& list) {
  std::set<std::string> names;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    const std::size_t dash = item.find('-', 1);
    long long low = 0, high = 0;
    const bool ranged = dash != std::string::npos && read_integer(item.substr(0, dash), low) &&
                        read_integer(item.substr(dash + 1), high) && low <= high && high - low < 1000000;
    if (!ranged) {
      const auto same = [&](const Track& track) { return track.name == item; };
      if (std::none_of(file.tracks.begin(), file.tracks.end(), same))
        throw BadInput(option + " " + list + ": no drop is called " + item);
      names.insert(item);
    }
    for (long long i = low; ranged && i <= high; ++i) names.insert(std::to_string(i));
  }
  TrackSplit split;
  for (std::size_t i = 0; i < file.tracks.size(); ++i)
    (names.contains(file.tracks[i].name) ? split.fitted : split.scored).push_back(i);
  return split;
}

ForecastModel forecast_model(const MeasuredFile& file, const MeasuredFit& fit) {
  return {.body = TrackedBody(file.file.description, fit.calibration.calibration),
          .law = fit.laws[fit.best].law,
          .law_scatter = fit.law_scatter,
          .width_factor = fit.width_factor,
          .ground_error = fit.calibration.ground_spread,
          .rate = file.file.description.rate,
          .planar = file.file.description.is_planar()};
}

MeasuredFit fit_measured(const MeasuredFile& file, const TrackPart& part) {
  const TrackDescription& description = file.file.description;
  MeasuredFit fit;
  fit.calibration = calibrate(file, part, {});
  fit.as_described = calibrate(file, part, {.axes = false, .inertia = false});
  const TrackedBody body(description, fit.calibration.calibration);
  const std::vector<PartImpact> impacts = impacts_of(file, part, body, fit.calibration.ground_spread, 1);
  fit.impacts = impacts.size();
  for (const analytic::RestitutionLaw law : fitted_laws) fit.laws.push_back(fit_law(body, impacts, law, false));
  for (std::size_t i = 1; i < fit.laws.size(); ++i) {
    if (fit.laws[i].fit.loss() < fit.laws[fit.best].fit.loss()) fit.best = i;
  }
  const LawFit& best = fit.laws[fit.best];
  for (const LawFit& law : fit.laws) fit.against_best.push_back(paired_difference(law.fit.losses, best.fit.losses));
  if (has_effective_masses(body, impacts)) {
    fit.dependent = fit_law(body, impacts, best.law.law, true);
    fit.dependent_gain = paired_difference(best.fit.losses, fit.dependent->fit.losses);
  }
  const TrackedBody plain(description, fit.as_described.calibration);
  fit.described = fit_law(plain, impacts_of(file, part, plain, fit.as_described.ground_spread, 1), best.law.law, false);
  add_contact_time(file, impacts, fit);
  add_intervals(file, impacts, fit);
  return fit;
}

std::vector<ResidualBin> residual_bins(const std::vector<ScoredDrop>& drops) {
  std::vector<ResidualBin> bins;
  struct Axis {
    const char *name, *unit;
    std::vector<double> edges;
    double (*value)(const ScoredDrop&);
  };
  const std::vector<Axis> axes{
      {"angle",
       "°",
       {std::begin(arm_angle_edges), std::end(arm_angle_edges)},
       [](const ScoredDrop& d) { return d.measured.angle_degrees(); }},
      {"approach", "m/s", {0, 1, 1.5, 2, 2.5, 3, 4}, [](const ScoredDrop& d) { return d.measured.approach; }},
      {"slip", "m/s", {0, 0.25, 0.5, 1, 1.5, 2, 4}, [](const ScoredDrop& d) { return d.measured.slip; }}};
  for (const Axis& axis : axes) {
    for (std::size_t i = 1; i < axis.edges.size(); ++i) {
      const ResidualBin bin = bin_of(drops, axis.name, axis.unit, axis.edges[i - 1], axis.edges[i], axis.value);
      if (bin.impacts > 0) bins.push_back(bin);
    }
  }
  return bins;
}

double Share::value() const { return of == 0 ? std::nan("") : static_cast<double>(right) / of; }

double Scores::middle_of(const std::string& row) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ErrorRow& one) { return one.name == row; });
  return found == rows.end() ? std::nan("") : median(found->errors);
}

Scores score_measured(const MeasuredFile& file, const MeasuredFit& fit, const TrackPart& part, bool sequences) {
  Scorer scorer(file, fit, sequences);
  for (const std::size_t index : part) scorer.take(index);
  Scores scores = scorer.finish();
  scores.bins = residual_bins(scores.drops);
  if (file.file.description.is_ball())
    std::erase_if(scores.bins, [](const ResidualBin& bin) { return bin.quantity == "angle"; });
  return scores;
}

Scores kept_scores(const std::string& name) {
  const MeasuredFile file = kept_file(name);
  const TrackSplit split = split_by_seed(file.tracks.size(), split_seed, 0.5);
  return scores_of(file, split.fitted, split.scored);
}

CrossedScores crossed_scores(const std::string& name) {
  const MeasuredFile file = kept_file(name);
  const TrackSplit split = split_by_seed(file.tracks.size(), split_seed, 0.5);
  Scores one = scores_of(file, split.fitted, split.scored);
  const Scores other = scores_of(file, split.scored, split.fitted);
  const auto flat = [](const Scores& scores) { return scores.middle_of("flat rebound"); };
  one.drops.insert(one.drops.end(), other.drops.begin(), other.drops.end());
  return {residual_bins(one.drops), std::fmax(flat(one), flat(other))};
}

}  // namespace clatter::validation
