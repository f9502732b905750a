// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/score.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/sweep/counter_random.hpp"

namespace clatter::validation::inline measured {
namespace {

using analytic::space::State;

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

}  // namespace

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
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    (names.contains(file.tracks[i].name) ? split.fitted : split.scored).push_back(i);
  }
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
  for (const analytic::RestitutionLaw law : fitted_laws()) fit.laws.push_back(fit_law(body, impacts, law, false));
  for (std::size_t i = 1; i < fit.laws.size(); ++i) {
    if (fit.laws[i].fit.loss() < fit.laws[fit.best].fit.loss()) fit.best = i;
  }
  const LawFit& best = fit.laws[fit.best];
  for (const LawFit& law : fit.laws) fit.against_best.push_back(paired_difference(law.fit.losses, best.fit.losses));
  fit.dependent = fit_law(body, impacts, best.law.law, true);
  fit.dependent_gain = paired_difference(best.fit.losses, fit.dependent.fit.losses);
  const TrackedBody plain(description, fit.as_described.calibration);
  fit.described = fit_law(plain, impacts_of(file, part, plain, fit.as_described.ground_spread, 1), best.law.law, false);
  add_contact_time(file, impacts, fit);
  add_intervals(file, impacts, fit);
  return fit;
}

}  // namespace clatter::validation::inline measured
