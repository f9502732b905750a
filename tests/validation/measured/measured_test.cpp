// SPDX-License-Identifier: GPL-3.0-or-later
// Tracked drops: found, measured, fitted.  The oracle is what a track was made from, or conservation of momentum.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/validation/measured/synthetic_tracks.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/measured/score.hpp"

using namespace clatter;
using namespace clatter::validation;
using synthetic::make;
using synthetic::Recipe;
using synthetic::Synthetic;

namespace {

constexpr double ninety_five = 1.96;  // standard deviations

TrackPart all_of(const MeasuredFile& file) {
  TrackPart all(file.tracks.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

/// 1000 tracks, half of them planar.  The ground lies 30 mm lower than the description says.
struct Thousand {
  std::vector<Synthetic> made;
  std::vector<MeasuredFile> files;
  Thousand() {
    for (const bool planar : {true, false}) {
      made.push_back(make({.planar = planar, .tracks = 500, .ground = -0.03, .body = {}, .seed = planar ? 11u : 12u}));
      files.push_back(measure_tracks(made.back().file));
    }
  }
};
const Thousand& thousand() {
  static const Thousand all;
  return all;
}

/// The impact found at a true time, within a frame of 250 Hz.
const Meeting* found_at(const MeasuredTrack& track, double time) {
  const auto near = [&](const Meeting& meeting) {
    return meeting.before.last() - 0.004 < time && time < meeting.after.first() + 0.004;
  };
  const auto found = std::find_if(track.meetings.begin(), track.meetings.end(), near);
  return found == track.meetings.end() ? nullptr : &*found;
}

struct Counted {
  int inside = 0, of = 0;
  [[nodiscard]] double share() const { return static_cast<double>(inside) / of; }
  void take(double off, double bar) {
    ++of;
    if (std::fabs(off) <= bar) ++inside;
  }
};

MeasuredFile kept(const std::string& name) {
  const std::string csv = "validation/measured/" + name + ".csv";
  return measure_tracks(parse_tracks(csv, std::string(embedded_text(csv)), read_description(name)));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(measured_test)

BOOST_AUTO_TEST_CASE(every_impact_with_six_frames_of_flight_on_both_sides_is_found) {
  int expected = 0, found = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t i = 0; i < thousand().made[f].truth.size(); ++i) {
      const synthetic::Truth& truth = thousand().made[f].truth[i];
      for (std::size_t k = 0; k < truth.impact_times.size(); ++k) {
        const int before = k == 0 ? truth.frames_before : truth.flights[k - 1];
        if (before < 6 || truth.flights[k] < 6) continue;
        ++expected;
        if (found_at(thousand().files[f].tracks[i], truth.impact_times[k])) ++found;
      }
    }
  }
  BOOST_TEST_MESSAGE(found << " of " << expected);
  BOOST_TEST(expected >= 1000);
  BOOST_TEST(found == expected);
}

BOOST_AUTO_TEST_CASE(
    restitution_and_friction_lie_inside_their_95_percent_intervals_in_93_to_97_percent_of_1000_tracks) {
  Counted restitution, friction;
  for (std::size_t f = 0; f < 2; ++f) {
    const MeasuredFile& file = thousand().files[f];
    const CalibrationResult calibration = calibrate(file, all_of(file), {.axes = false, .inertia = false});
    BOOST_TEST(std::fabs(calibration.calibration.ground + 0.03) < 1e-4);
    const TrackedBody body(file.file.description, calibration.calibration);
    for (const PartImpact& item : impacts_of(file, all_of(file), body, calibration.ground_spread, 1)) {
      const synthetic::Truth& truth = thousand().made[f].truth[item.track];
      restitution.take(item.impact.restitution - truth.restitution, ninety_five * item.impact.restitution_error);
      friction.take(item.impact.impulse_ratio - truth.impulse_ratio, ninety_five * item.impact.impulse_ratio_error);
    }
    BOOST_TEST_MESSAGE("e " << restitution.share() << " of " << restitution.of << ", mu " << friction.share() << " of "
                            << friction.of);
  }
  BOOST_TEST(restitution.of == 1000);
  BOOST_TEST(restitution.share() >= 0.93);
  BOOST_TEST(restitution.share() <= 0.97);
  BOOST_TEST(friction.share() >= 0.93);
  BOOST_TEST(friction.share() <= 0.97);
}

BOOST_AUTO_TEST_CASE(parameters_fitted_to_25_tracks_lie_inside_their_95_percent_intervals) {
  Counted counted;
  for (const MeasuredFile& file : thousand().files) {
    const CalibrationResult calibration = calibrate(file, all_of(file), {.axes = false, .inertia = false});
    const TrackedBody body(file.file.description, calibration.calibration);
    for (std::size_t first = 0; first + 25 <= file.tracks.size(); first += 25) {
      TrackPart part;
      for (std::size_t i = 0; i < 25; ++i) part.push_back(first + i);
      const LawFit fit = fit_law(body, impacts_of(file, part, body, calibration.ground_spread, 1),
                                 analytic::RestitutionLaw::poisson, false);
      counted.take(fit.law.restitution - 0.5, fit.fit.half_width(0));
      counted.take(fit.law.friction - 0.2, fit.fit.half_width(1));
    }
  }
  BOOST_TEST_MESSAGE(counted.share() << " of " << counted.of);
  BOOST_TEST(counted.of == 80);
  // Of 80 intervals that hold with 95 %, fewer than 71 do so once in 100 trials (binomial).
  BOOST_TEST(counted.inside >= 71);
}

BOOST_AUTO_TEST_CASE(torn_frames_inside_a_flight_are_recognised_and_lost_ones_counted) {
  int torn = 0, seen = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t i = 0; i < thousand().made[f].truth.size(); ++i) {
      const synthetic::Truth& truth = thousand().made[f].truth[i];
      const Track& track = thousand().made[f].file.tracks[i];
      const MeasuredTrack& measured = thousand().files[f].tracks[i];
      BOOST_TEST(measured.missing == track.missing);
      for (const double time : truth.torn_times) {
        if (time > truth.impact_times[0] - 0.03 || time < 0.03) continue;  // well inside the first flight
        ++torn;
        const auto is_it = [&](std::size_t k) { return std::fabs(track.frames[k].time - time) < 1e-9; };
        seen += static_cast<int>(std::count_if(measured.flights.torn.begin(), measured.flights.torn.end(), is_it));
      }
    }
  }
  BOOST_TEST(torn >= 30);
  BOOST_TEST(seen == torn);
}

BOOST_AUTO_TEST_CASE(samples_that_are_left_out_without_being_counted_are_no_impact) {
  Synthetic made = make({.planar = true, .tracks = 20, .lost = 0, .torn = 0, .body = {}, .seed = 5});
  int planted = 0, seen = 0;
  for (std::size_t i = 0; i < made.file.tracks.size(); ++i) {
    std::vector<Frame>& frames = made.file.tracks[i].frames;
    const double from = 0.04;  // ten frames fall out of the first flight, and the clock does not know
    if (made.truth[i].impact_times[0] < from + 0.02) continue;
    const auto first =
        std::find_if(frames.begin(), frames.end(), [&](const Frame& f) { return f.time > from - 0.016; });
    for (auto frame = frames.erase(first, first + 5); frame != frames.end(); ++frame) frame->time -= 5 / 250.0;
    ++planted;
  }
  for (const MeasuredTrack& track : measure_tracks(made.file).tracks) {
    for (const Meeting& change : track.other_changes) {
      if (change.change != Change::skipped || change.number != 0) continue;
      ++seen;
      BOOST_TEST(std::fabs(change.skipped - 0.02) < 1e-3);
    }
  }
  BOOST_TEST(planted == 20);
  BOOST_TEST(seen == planted);
}

BOOST_AUTO_TEST_CASE(inertia_and_axes_of_a_body_that_is_not_as_described_are_found) {
  for (const bool planar : {true, false}) {
    Recipe recipe{.planar = planar, .tracks = 60, .body = {}, .seed = 7};
    recipe.body.inertia_factor = 1.4;
    Synthetic made = make(recipe);
    const MeasuredFile file = measure_tracks(made.file);
    const CalibrationResult found = calibrate(file, all_of(file), {});
    BOOST_TEST(std::fabs(found.calibration.inertia_factor - 1.4) <= 2 * found.inertia_half_width + 0.01);
    BOOST_TEST(found.calibration.rounding <= 1e-3);
    BOOST_TEST(found.lever_after < 0.2 * found.lever_before);
  }
  // Poses at rest on faces, of a body whose axes are turned.
  const Vector3 turn(0.01, -0.02, 0.015);
  Recipe recipe{.planar = false, .tracks = 0, .body = {}};
  MeasuredFile file{.file = make(recipe).file, .model = {}, .tracks = {}};
  for (int i = 0; i < 30; ++i) {
    const Quaternion upright = Quaternion::FromTwoVectors(Vector3::Unit(i % 3), (i % 2 ? -1 : 1) * Vector3::UnitZ());
    MeasuredTrack track;
    track.rest = rotation_of(0.7 * i * Vector3::UnitZ()) * upright * rotation_of(-turn);
    file.tracks.push_back(track);
  }
  const CalibrationResult rest = calibrate(file, all_of(file), {.axes = true, .inertia = false});
  BOOST_TEST(rest.resting == 30u);
  BOOST_TEST((rest.calibration.turn - turn).norm() < 2e-3);  // of the second order in the turn
}

BOOST_AUTO_TEST_CASE(an_impact_on_two_corners_at_once_is_no_point_impact) {
  // A square lands on its face: no impulse at one corner explains a rebound without turning.
  const Recipe recipe{.planar = true, .tracks = 30, .body = {}, .tilt_low = 0.78, .tilt_high = 0.785, .seed = 3};
  const MeasuredFile file = measure_tracks(make(recipe).file);
  const TrackedBody body(file.file.description, {});
  int marked = 0, impacts = 0;
  for (const MeasuredTrack& track : file.tracks) {
    if (track.meetings.empty()) continue;
    const TrackImpact impact = measured_impact(track.meetings[0], body, 1e-4, 0.1);
    if (impact.between == 0 && impact.angle < 0.7) continue;
    ++impacts;
    if (!impact.is_point) ++marked;
  }
  BOOST_TEST(impacts >= 20);
  BOOST_TEST(marked >= impacts - 1);
  // The corner that struck is the one about which momentum is kept.
  const MeasuredFile& thousands = thousand().files[1];
  int right = 0, points = 0;
  const TrackedBody cube(thousands.file.description, {.turn = Vector3::Zero(), .ground = -0.03});
  for (const PartImpact& item : impacts_of(thousands, all_of(thousands), cube, 1e-4, 1)) {
    if (!item.impact.is_point) continue;
    ++points;
    if (item.impact.momentum_corner == item.impact.corner) ++right;
  }
  BOOST_TEST(points >= 450);
  BOOST_TEST(right >= 0.99 * points);
}

BOOST_AUTO_TEST_CASE(no_impulse_inside_the_friction_cone_beats_the_floor) {
  const MeasuredFile& file = thousand().files[1];
  const TrackedBody body(file.file.description, {.turn = Vector3::Zero(), .ground = -0.03});
  for (const PartImpact& item : impacts_of(file, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, body, 1e-4, 1)) {
    const double floor = floor_error(body, item.impact, 0.2);
    for (const double e : {0.3, 0.5, 0.7}) {
      for (const double mu : {0.0, 0.1, 0.2}) {
        const auto after =
            struck(body, item.impact.before.state, item.impact.corner, {analytic::RestitutionLaw::poisson, e, 0, mu});
        BOOST_TEST(floor <= relative_error(body, item.impact, after) + 1e-6);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(no_drop_is_both_fitted_to_and_scored) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const TrackSplit split = split_by_seed(500, seed, 0.5);
    BOOST_TEST(split.fitted.size() + split.scored.size() == 500u);
    BOOST_TEST(split.fitted.size() > 200u);
    BOOST_TEST(split.scored.size() > 200u);
    for (const std::size_t i : split.fitted)
      BOOST_TEST(!std::binary_search(split.scored.begin(), split.scored.end(), i));
  }
  BOOST_TEST((split_by_seed(500, 1, 0.5).fitted != split_by_seed(500, 2, 0.5).fitted));
}

BOOST_AUTO_TEST_CASE(squares_that_were_measured_are_met_to_12_percent_and_cubes_to_9) {
  for (const auto& [name, bar] : {std::pair("square-drops", 0.12), std::pair("cube-tosses", 0.09)}) {
    const MeasuredFile file = kept(name);
    const TrackSplit split = split_by_seed(file.tracks.size(), 1, 0.5);
    const MeasuredFit fit = fit_measured(file, split.fitted);
    const Scores scores = score_measured(file, fit, split.scored, false);
    const auto row = [&](const std::string& what) {
      const auto found =
          std::find_if(scores.rows.begin(), scores.rows.end(), [&](const auto& r) { return r.name == what; });
      return median(found->errors);
    };
    BOOST_TEST_MESSAGE(name << ": " << row("as fitted") << ", floor " << row("floor: any impulse there"));
    BOOST_TEST(scores.rows[0].errors.size() >= 8u);
    BOOST_TEST(row("as fitted") <= bar);
    BOOST_TEST(row("floor: any impulse there") <= row("as fitted"));
    BOOST_TEST(row("as fitted") < 0.5 * row("flat rebound"));
    BOOST_TEST(row("flat rebound") < row("no change"));
  }
}

BOOST_AUTO_TEST_SUITE_END()
