// SPDX-License-Identifier: GPL-3.0-or-later
// Tracked drops: found, measured, fitted.  The oracle is what a track was made from, or conservation of momentum.
#include "analytic/space/flight/free_flight.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/support.hpp"
#include "validation/measured/score.hpp"
#include "validation/sweep/points.hpp"

using namespace clatter;
using namespace clatter::validation;

namespace {

/// Tracks of the discrete model's own sequences, with noise, lost and torn frames, and a ground that lies elsewhere.
struct Recipe {
  bool planar = true;
  int tracks = 10;
  double rate = 250;             // Hz
  double position_noise = 5e-5;  // m
  double rotation_noise = 5e-4;  // rad
  double lost = 0.02;            // share of the frames
  double torn = 0.005;           // likewise
  double ground = 0;             // m
  double restitution = 0.5, friction = 0.2;
  Calibration body;                         // of the body that falls, as against the one described
  double tilt_low = 0.05, tilt_high = 0.3;  // rad, of the corner's arm from the vertical
  std::uint64_t seed = 1;
};

struct Truth {
  std::vector<double> impact_times;  // of the file's clock [s]
  std::vector<int> flights;          // frames of flight between impact i and i + 1 that were kept and whole
  std::vector<double> torn_times;
  int frames_before = 0;  // of the flight before impact 1
};

struct Synthetic {
  TrackFile file;
  std::vector<Truth> truth;
};

TrackDescription description_of(const Recipe& recipe) {
  TrackDescription d;
  d.path = "synthetic";
  d.motion = recipe.planar ? TrackDescription::Motion::plane : TrackDescription::Motion::space;
  d.size = {0.1, 0.1, 0.1};
  d.mass = 0.3;
  d.rate = recipe.rate;
  d.gravity = 9.81;
  return d;
}

class TrackMaker {
 public:
  TrackMaker(const Recipe& recipe, int index)
      : recipe_(recipe), index_(static_cast<std::uint64_t>(index)), body_(description_of(recipe), recipe.body) {}

  Track make(Truth& truth) {
    const analytic::space::Drop drop = random_drop();
    const analytic::space::Sequence sequence =
        analytic::space::impact_sequence(drop, {.impacts = 6, .digits = 3, .amplification = false});
    const double before = 0.08 + 0.02 * uniform();
    const double end = before + std::min(0.6, sequence.rows.back().start + 0.05);
    for (const auto& row : sequence.rows) {
      if (before + row.start < end) truth.impact_times.push_back(before + row.start);
    }
    truth.flights.assign(truth.impact_times.size(), 0);
    Track track{.name = std::to_string(index_), .frames = {}};
    for (int sample = 0; sample / recipe_.rate < end; ++sample) add_frame(sequence, sample, before, track, truth);
    return track;
  }

 private:
  double uniform() { return uniform_at(recipe_.seed, index_, column_++); }
  double normal() { return normal_at(recipe_.seed + 1000, index_, column_++); }

  analytic::space::Drop random_drop() {
    analytic::space::Drop drop;
    drop.body = body_.sharp();
    const Vector3 corner =
        drop.body
            .vertices[static_cast<std::size_t>(uniform() * 0.999 * static_cast<double>(drop.body.vertices.size()))];
    const double tilt = recipe_.tilt_low + (recipe_.tilt_high - recipe_.tilt_low) * uniform();
    const Vector3 axis = recipe_.planar
                             ? Vector3(0, uniform() < 0.5 ? -1 : 1, 0)
                             : Vector3(std::cos(6.28 * uniform()), std::sin(6.28 * uniform()), 0).normalized();
    drop.attitude = (rotation_of(tilt * axis) * Quaternion::FromTwoVectors(corner, Vector3(0, 0, -1))).normalized();
    drop.velocity = {uniform() - 0.5, recipe_.planar ? 0 : uniform() - 0.5, -1.5 - uniform()};
    const Vector3 spin(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    drop.angular_velocity = recipe_.planar ? Vector3(0, 8 * spin.y(), 0) : Vector3(8 * spin);
    drop.gravity = 9.81;
    drop.law = {.restitution = recipe_.restitution,
                .law = analytic::RestitutionLaw::poisson,
                .friction = analytic::FrictionKind::coulomb,
                .friction_value = recipe_.friction};
    return drop;
  }

  void add_frame(const analytic::space::Sequence& sequence, int sample, double before, Track& track, Truth& truth) {
    const double time = sample / recipe_.rate, t = time - before;
    const double fate = uniform();
    Frame frame{.time = time};
    int flight = -1;
    analytic::space::State state = sequence.rows[0].before;
    double since = t;
    if (t > 0) {
      flight = 0;
      while (static_cast<std::size_t>(flight) + 1 < sequence.rows.size() &&
             sequence.rows[static_cast<std::size_t>(flight) + 1].start <= t)
        ++flight;
      const auto& row = sequence.rows[static_cast<std::size_t>(flight)];
      state = row.before;
      state.velocity = row.impact.velocity_after;
      state.angular_velocity = row.impact.angular_velocity_after;
      since = t - row.start;
    }
    frame.position = state.position + since * state.velocity - 4.905 * since * since * Vector3::UnitZ() +
                     recipe_.ground * Vector3::UnitZ();
    const Quaternion turned = rotation_of(since * state.angular_velocity) * state.attitude;
    frame.attitude = (turned * rotation_of(-recipe_.body.turn)).normalized();
    add_noise(frame);
    if (fate < recipe_.lost) {
      ++track.missing;
      return;
    }
    if (fate < recipe_.lost + recipe_.torn) {
      frame.position += Vector3(0.01, 0, 0.02);
      truth.torn_times.push_back(time);
    } else if (flight < 0) {
      ++truth.frames_before;
    } else if (static_cast<std::size_t>(flight) < truth.flights.size()) {
      ++truth.flights[static_cast<std::size_t>(flight)];
    }
    track.frames.push_back(frame);
  }

  void add_noise(Frame& frame) {
    Vector3 shift(normal(), normal(), normal()), turn(normal(), normal(), normal());
    if (recipe_.planar) shift.y() = turn.x() = turn.z() = 0;
    frame.position += recipe_.position_noise * shift;
    frame.attitude = (rotation_of(recipe_.rotation_noise * turn) * frame.attitude).normalized();
  }

  const Recipe& recipe_;
  std::uint64_t index_;
  std::uint32_t column_ = 0;
  TrackedBody body_;
};

Synthetic make(const Recipe& recipe) {
  Synthetic made;
  made.file.path = "synthetic";
  made.file.description = description_of(recipe);
  for (int i = 0; i < recipe.tracks; ++i) {
    made.truth.emplace_back();
    made.file.tracks.push_back(TrackMaker(recipe, i).make(made.truth.back()));
    made.file.frames += made.file.tracks.back().frames.size();
  }
  return made;
}

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

/// Whether an impact is found at a true time, within a frame of 250 Hz.
bool is_found_at(const MeasuredTrack& track, double time) {
  return std::ranges::any_of(track.meetings, [&](const Meeting& meeting) {
    return meeting.before.last() - 0.004 < time && time < meeting.after.first() + 0.004;
  });
}

/// Poses at rest, each as flat(i) says, of a body whose axes are turned; the turn is found from them.
void check_resting_poses(MeasuredFile file, int count, const std::function<Quaternion(int)>& flat) {
  const Vector3 turn(0.01, -0.02, 0.015);
  for (int i = 0; i < count; ++i) {
    file.tracks.emplace_back();
    file.tracks.back().rest = rotation_of(0.7 * i * Vector3::UnitZ()) * flat(i) * rotation_of(-turn);
  }
  const CalibrationResult rest = calibrate(file, all_of(file), {.axes = true, .inertia = false});
  BOOST_TEST(rest.resting == static_cast<std::size_t>(count));
  BOOST_TEST((rest.calibration.turn - turn).norm() < 2e-3);  // of the second order in the turn
}

}  // namespace

BOOST_AUTO_TEST_SUITE(measured_test)

BOOST_AUTO_TEST_CASE(every_impact_with_six_frames_of_flight_on_both_sides_is_found) {
  int expected = 0, found = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t i = 0; i < thousand().made[f].truth.size(); ++i) {
      const Truth& truth = thousand().made[f].truth[i];
      for (std::size_t k = 0; k < truth.impact_times.size(); ++k) {
        const int before = k == 0 ? truth.frames_before : truth.flights[k - 1];
        if (before < 6 || truth.flights[k] < 6) continue;
        ++expected;
        if (is_found_at(thousand().files[f].tracks[i], truth.impact_times[k])) ++found;
      }
    }
  }
  BOOST_TEST(expected >= 1000);
  BOOST_TEST(found == expected);
}

BOOST_AUTO_TEST_CASE(parameters_fitted_to_25_tracks_lie_inside_their_95_percent_intervals) {
  Share counted;
  for (const MeasuredFile& file : thousand().files) {
    const CalibrationResult calibration = calibrate(file, all_of(file), {.axes = false, .inertia = false});
    BOOST_TEST(std::fabs(calibration.calibration.ground + 0.03) < 1e-4);
    const TrackedBody body(file.file.description, calibration.calibration);
    for (std::size_t first = 0; first + 25 <= file.tracks.size(); first += 25) {
      TrackPart part;
      for (std::size_t i = 0; i < 25; ++i) part.push_back(first + i);
      const LawFit fit = fit_law(body, impacts_of(file, part, body, calibration.ground_spread, 1),
                                 analytic::RestitutionLaw::poisson, false);
      counted.take(std::fabs(fit.law.restitution - 0.5) <= fit.fit.half_width(0));
      counted.take(std::fabs(fit.law.friction - 0.2) <= fit.fit.half_width(1));
    }
  }
  BOOST_TEST(counted.of == 80);
  // Of 80 intervals that hold with 95 %, fewer than 71 do so once in 100 trials (binomial).
  BOOST_TEST(counted.right >= 71);
}

BOOST_AUTO_TEST_CASE(torn_frames_inside_a_flight_are_recognised_and_lost_ones_counted) {
  int torn = 0, seen = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t i = 0; i < thousand().made[f].truth.size(); ++i) {
      const Truth& truth = thousand().made[f].truth[i];
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
  check_resting_poses(
      {.file = make({.planar = false, .tracks = 0, .body = {}}).file, .model = {}, .tracks = {}}, 30,
      [](int i) { return Quaternion::FromTwoVectors(Vector3::Unit(i % 3), (i % 2 ? -1 : 1) * Vector3::UnitZ()); });
}

BOOST_AUTO_TEST_CASE(axes_of_a_mesh_are_found_from_poses_at_rest_on_its_faces) {
  TrackedMesh mesh;
  mesh.body = analytic::space::polyhedron(
      {{0.04, 0.04, 0.04}, {0.04, -0.04, -0.04}, {-0.04, 0.04, -0.04}, {-0.04, -0.04, 0.04}},
      {.mass = 0.3, .centre = Vector3::Zero(), .inertia = 1e-4 * Matrix3::Identity()});
  mesh.faces = resting_faces(mesh.body.vertices);
  BOOST_TEST_REQUIRE(mesh.faces.size() == 4u);
  MeasuredFile file;
  file.file.description = description_of({.planar = false, .body = {}});
  file.file.description.mesh = std::make_shared<const TrackedMesh>(mesh);
  check_resting_poses(file, 40, [&](int i) {
    return analytic::space::turn_between(mesh.faces[static_cast<std::size_t>(i % 4)].normal, {0, 0, -1});
  });
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

BOOST_AUTO_TEST_SUITE_END()
