// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_run.hpp"

#include <algorithm>
#include <cmath>

#include "validation/scene/failure.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

/// Places of the probes, from the centre of mass of the body that a model drops [m].
std::vector<Vector3> places_of(const Scene& scene, const std::vector<Probe>& probes, Model model) {
  return places_from(body_properties(scene, model).centre, probes);
}

/// Impacts from the first on that can be predicted.
int known_impacts(const std::vector<ShockRow>& rows) {
  int known = 0;
  for (const ShockRow& row : rows) {
    if (!row.predictable || !std::isfinite(row.error.delta_v_size)) break;
    known = row.impact;
  }
  return known;
}

/// The axis along which the probe's velocity changes most in one impact.
int main_axis(const std::vector<ShockRow>& rows, std::size_t probe) {
  Vector3 largest = Vector3::Zero();
  for (const ShockRow& row : rows) {
    if (row.probe == probe) largest = largest.cwiseMax(row.delta_v_body.cwiseAbs());
  }
  int axis = 0;
  largest.maxCoeff(&axis);
  return axis;
}

/// The parts of a drop of which spectra are made, each longer than the one before, and how many impacts each has.
std::vector<std::pair<Blows, int>> parts_of(int known, int first) {
  if (known == 0) return {};
  std::vector<std::pair<Blows, int>> parts{{Blows::impact_1, 1}};
  const auto add = [&](Blows blows, int impacts) {
    if (impacts > parts.back().second) parts.emplace_back(blows, impacts);
  };
  add(Blows::first, std::min(first, known));
  add(Blows::all, known);
  return parts;
}

/// Adds to the errors of points by the polynomials how far the other recorded run is.
void add_distance(const std::vector<BasePiece>& other, double quality, double error_per_distance,
                  ResponsePoint& point) {
  const ResponseExtremes mine = point.whole(), theirs = response(other, point.frequency, quality).whole();
  point.acceleration_error +=
      error_per_distance * std::fabs(mine.acceleration.maximax() - theirs.acceleration.maximax());
  point.pseudo_velocity_error +=
      error_per_distance * std::fabs(mine.pseudo_velocity.maximax() - theirs.pseudo_velocity.maximax());
}

/// What an oscillator feels of a filtered history along an axis, its errors by the other recorded run.
ResponsePoint filtered_response(const FilteredHistory& history, const FilteredHistory& other, int axis,
                                double frequency, const ShockRequest& request, double error_per_distance) {
  const auto of = [&](const FilteredHistory& one) {
    std::vector<BaseSample> samples;
    for (std::size_t i = 0; i < one.values.size(); ++i) samples.push_back({one.time(i), one.values[i][axis]});
    return response(samples, frequency, request.quality);
  };
  ResponsePoint point = of(history);
  const ResponseExtremes mine = point.whole(), theirs = of(other).whole();
  const auto error = [&](const Extremes& here, const Extremes& there) {
    return error_per_distance * std::fabs(here.maximax() - there.maximax()) +
           FilteredHistory::relative_error * here.maximax();
  };
  point.acceleration_error += error(mine.acceleration, theirs.acceleration);
  point.pseudo_velocity_error += error(mine.pseudo_velocity, theirs.pseudo_velocity);
  return point;
}

/// Gives a probe's rows peak and width behind the filter, each looked for as far as the middle of the flights about it.
void filter_rows(const FilteredHistory& history, const FilteredHistory& other, std::size_t probe,
                 ContinuousShock& shock) {
  constexpr double level = 0.1;  // of the peak, at which its width is measured
  std::vector<ShockRow*> rows;
  for (ShockRow& row : shock.rows) {
    if (row.probe == probe) rows.push_back(&row);
  }
  const auto numbers = [&](const FilteredHistory& of, double begin, double end, double start) {
    std::size_t first = of.values.size(), last = 0, peak = 0;
    for (std::size_t i = 0; i < of.values.size(); ++i) {
      if (of.time(i) < begin || of.time(i) > end) continue;
      if (first == of.values.size()) first = peak = i;
      last = i;
      if (of.values[i].norm() > of.values[peak].norm()) peak = i;
    }
    ShockNumbers found;
    if (first > last) return found;
    found.peak = of.values[peak];
    found.peak_size = found.peak.norm();
    found.peak_time = of.time(peak) - start;
    std::size_t low = peak, high = peak;
    while (low > first && of.values[low].norm() > level * found.peak_size) --low;
    while (high < last && of.values[high].norm() > level * found.peak_size) ++high;
    found.width = of.time(high) - of.time(low);
    return found;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ShockRow& row = *rows[i];
    const double end = row.start + row.duration;
    const double from = i > 0 ? (rows[i - 1]->start + rows[i - 1]->duration + row.start) / 2 : history.begin;
    const double to = i + 1 < rows.size() ? (end + rows[i + 1]->start) / 2 : history.time(history.values.size());
    const ShockNumbers mine = numbers(history, from, to, row.start), theirs = numbers(other, from, to, row.start);
    ShockNumbers &value = row.value, &error = row.error;
    const double per = shock.error_per_distance, left = FilteredHistory::relative_error * mine.peak_size;
    if (std::isfinite(error.peak_size)) {
      error.peak = per * (mine.peak - theirs.peak).cwiseAbs() + Vector3::Constant(left);
      error.peak_size = per * std::fabs(mine.peak_size - theirs.peak_size) + left;
      error.peak_time = per * std::fabs(mine.peak_time - theirs.peak_time) + history.step;
      error.width = per * std::fabs(mine.width - theirs.width) + 2 * history.step;
    }
    value.peak = mine.peak;
    value.peak_size = mine.peak_size;
    value.peak_time = mine.peak_time;
    value.width = mine.width;
    row.sensitivity.reset();
  }
}

/// Shock of a probe in the continuous model.
void add_continuous(const ContinuousShock& shock, double mass, const Vector3& place, const ShockRequest& request,
                    const Spectrum& begun, std::vector<Spectrum>& spectra) {
  const Vector3 axis = Vector3::Unit(begun.axis);
  const std::vector<BasePiece> pieces = base_pieces(shock.motion.pieces(), place, mass, axis);
  const std::vector<BasePiece> others = base_pieces(shock.other.pieces(), place, mass, axis);
  for (const auto& [blows, impacts] : parts_of(known_impacts(shock.rows), request.first)) {
    Spectrum spectrum = begun;
    spectrum.blows = begun.blows == Blows::flat ? Blows::flat : blows;
    spectrum.impacts = impacts;
    const std::vector<BasePiece> part = first_pieces(pieces, impacts), other = first_pieces(others, impacts);
    const auto filtered = [&](const MotionRecorder& motion) {
      std::vector<MotionPiece> these;
      for (const MotionPiece& piece : motion.pieces()) {
        if (piece.piece.impact < impacts || (piece.piece.impact == impacts && piece.piece.in_contact))
          these.push_back(piece);
      }
      return filtered_history(these, place, mass, *request.filter);
    };
    FilteredHistory mine, theirs;
    if (request.filter) {
      mine = filtered(shock.motion);
      theirs = filtered(shock.other);
    }
    for (const double frequency : request.natural_frequencies()) {
      if (request.filter) {
        spectrum.points.push_back(
            filtered_response(mine, theirs, begun.axis, frequency, request, shock.error_per_distance));
        continue;
      }
      spectrum.points.push_back(response(part, frequency, request.quality));
      add_distance(other, request.quality, shock.error_per_distance, spectrum.points.back());
    }
    spectra.push_back(std::move(spectrum));
  }
}

std::vector<VelocityStep> steps_of(const std::vector<ShockRow>& rows, std::size_t probe, int axis) {
  std::vector<VelocityStep> steps;
  for (const ShockRow& row : rows) {
    if (row.probe != probe) continue;
    steps.push_back({row.start, row.delta_v_body[axis], row.error.delta_v_size, row.start_error});
  }
  return steps;
}

void add_discrete(const std::vector<ShockRow>& rows, const ShockRequest& request, const Spectrum& begun,
                  std::vector<Spectrum>& spectra) {
  if (request.filter) return;  // a step of velocity has no length that a filter could see
  const std::vector<VelocityStep> steps = steps_of(rows, begun.probe, begun.axis);
  for (const auto& [blows, impacts] : parts_of(known_impacts(rows), request.first)) {
    Spectrum spectrum = begun;
    spectrum.continuous = false;
    spectrum.blows = begun.blows == Blows::flat ? Blows::flat : blows;
    spectrum.impacts = impacts;
    const std::span<const VelocityStep> part(steps.data(), static_cast<std::size_t>(impacts));
    for (const double frequency : request.natural_frequencies())
      spectrum.points.push_back(response(part, frequency, request.quality));
    spectra.push_back(std::move(spectrum));
  }
}

/// The scene dropped flat: at 0°, without spin or motion along the ground, from the same height or with the same speed.
Scene flat_scene(const Scene& scene) {
  Scene flat = scene;
  flat.angle_deg = flat.tilt_deg = flat.spin = flat.tangential_velocity = 0;
  flat.attitude.clear();
  flat.orientation.reset();
  flat.angular_velocity.clear();
  if (!scene.velocity.empty()) flat.velocity = {0, 0, scene.velocity[2]};
  flat.request.impacts = 1;
  flat.until_rest = false;
  return flat;
}

/// Rows of the discrete model; why there are none.
std::string run_discrete_side(const Scene& scene, const std::vector<Probe>& probes, std::vector<ShockRow>& rows,
                              std::optional<Run>* run) {
  const auto failure = failure_of_scene([&] {
    const PreparedScene drop = prepared(scene);
    const DiscreteRun found = run_discrete(drop);
    rows = discrete_shock(drop.drop, found.sequence, places_of(scene, probes, Model::discrete));
    if (run) *run = found.run;
  });
  return failure ? failure->message : "";
}

/// As `compare` tells it: by the corners that the continuous model has.
PartedBlows parted(const Scene& scene, const numeric::Body& body, const std::vector<numeric::ImpactRecord>& records) {
  DiscreteBody given(scene, body), mesh(body);
  const bool is_other = !scene.body.is_polyhedron() && has_other_corners(given.drop(scene), mesh.drop(scene));
  return parted_blows(discrete_side(scene, is_other ? mesh : given), records, body);
}

/// The spectra of the flat drop, where it can be run.
void add_flat(const numeric::Body* body, const numeric::Observer& observer, ShockRun& run) {
  const Scene flat = flat_scene(run.scene);
  ShockRequest request = run.request;
  request.first = 1;
  std::vector<ShockRow> rows;
  if (!run.discrete.empty()) static_cast<void>(run_discrete_side(flat, run.probes, rows, nullptr));
  std::optional<ContinuousShock> shock;
  const std::vector<Vector3> places = places_of(flat, run.probes, body ? Model::continuous : Model::discrete);
  if (body)
    static_cast<void>(failure_of_scene([&] { shock = continuous_shock(flat, *body, places, {.observer = observer}); }));
  for (std::size_t i = 0; i < places.size(); ++i) {
    Spectrum begun{.probe = i, .blows = Blows::flat, .points = {}};
    const std::vector<ShockRow>& first = shock ? shock->rows : rows;
    begun.axis = main_axis(first, i);
    if (shock) add_continuous(*shock, body->mass(), places[i], request, begun, run.spectra);
    add_discrete(rows, request, begun, run.spectra);
  }
}

}  // namespace

std::vector<double> ShockRequest::natural_frequencies() const {
  std::vector<double> all = frequencies(low, high, count);
  all.insert(all.end(), breakpoints.begin(), breakpoints.end());
  std::ranges::sort(all);
  const auto twins = std::ranges::unique(all);
  all.erase(twins.begin(), twins.end());
  return all;
}

const Spectrum* ShockRun::spectrum(std::size_t probe, bool of_continuous, Blows blows) const {
  const auto found = std::find_if(spectra.begin(), spectra.end(), [&](const Spectrum& one) {
    return one.probe == probe && one.continuous == of_continuous && one.blows == blows;
  });
  return found == spectra.end() ? nullptr : &*found;
}

const ShockRow* ShockRun::discrete_row(int impact, std::size_t probe) const {
  if (!parted.are_one(impact)) return nullptr;
  const auto found =
      std::ranges::find_if(discrete, [&](const ShockRow& row) { return row.impact == impact && row.probe == probe; });
  return found == discrete.end() ? nullptr : &*found;
}

ShockRun::Ending ShockRun::ending() const {
  if (!continuous) return {discrete_run->outcome, discrete_run->message};
  const numeric::Simulation& simulation = continuous->planned.run;
  return {outcome_name(simulation), simulation.message};
}

bool ShockRun::ends_at_limit() const {
  return ending().outcome == std::string_view(outcome_name(numeric::Outcome::impact_limit));
}

const Spectrum* ShockRun::whole(std::size_t probe, bool of_continuous) const {
  for (const Blows blows : {Blows::all, Blows::first, Blows::impact_1}) {
    if (const Spectrum* const found = spectrum(probe, of_continuous, blows)) return found;
  }
  return nullptr;
}

ShockRun run_shock(const Scene& scene, const std::vector<Probe>& probes, const ShockRequest& request,
                   const numeric::Observer& observer) {
  ShockRun run;
  run.scene = scene;
  run.probes = probes;
  run.request = request;
  std::optional<numeric::Body> body;
  if (request.continuous) {
    body.emplace(scene.make_body());
    run.continuous =
        continuous_shock(scene, *body, places_of(scene, probes, Model::continuous),
                         {.parts = request.parts, .sensitivity = request.sensitivity, .observer = observer});
    run.discrete_reason = run_discrete_side(scene, probes, run.discrete, &run.discrete_run);
    if (run.continuous->planned.run.outcome == numeric::Outcome::interrupted) return run;
    if (!run.discrete.empty()) {
      static_cast<void>(
          failure_of_scene([&] { run.parted = parted(scene, *body, run.continuous->planned.run.impacts); }));
    }
  } else {
    const PreparedScene drop = prepared(scene);
    const DiscreteRun found = run_discrete(drop);
    run.discrete = discrete_shock(drop.drop, found.sequence, places_of(scene, probes, Model::discrete));
    run.discrete_run = found.run;
  }
  for (std::size_t i = 0; request.filter && run.continuous && i < probes.size(); ++i) {
    const Vector3 place = places_of(scene, probes, Model::continuous)[i];
    const auto of = [&](const MotionRecorder& motion) {
      return filtered_history(motion.pieces(), place, body->mass(), *request.filter);
    };
    run.filtered.push_back(of(run.continuous->motion));
    filter_rows(run.filtered.back(), of(run.continuous->other), i, *run.continuous);
  }
  for (std::size_t i = 0; i < probes.size(); ++i) {
    Spectrum begun{.probe = i, .points = {}};
    begun.axis = request.axis ? *request.axis : main_axis(run.rows(), i);
    if (run.continuous) {
      add_continuous(*run.continuous, body->mass(), places_of(scene, probes, Model::continuous)[i], request, begun,
                     run.spectra);
    }
    add_discrete(run.discrete, request, begun, run.spectra);
    const std::vector<VelocityStep> steps = steps_of(run.discrete, i, begun.axis);
    run.envelopes.emplace_back();
    if (known_impacts(run.discrete) >= 2)
      run.envelopes.back() = envelope(steps[0].delta_v, steps[1].delta_v, request.quality);
  }
  add_flat(body ? &*body : nullptr, observer, run);
  return run;
}

}  // namespace clatter::validation
