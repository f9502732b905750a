// SPDX-License-Identifier: GPL-3.0-or-later
// Tracks of the discrete model's own sequences, with noise, lost and torn frames, and a ground that lies elsewhere.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "analytic/space/flight/free_flight.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "validation/measured/score.hpp"
#include "validation/sweep/counter_random.hpp"

namespace clatter::validation::synthetic {

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
  double restitution = 0, impulse_ratio = 0;  // of impact 1
  int frames_before = 0;                      // of the flight before impact 1
};

struct Synthetic {
  TrackFile file;
  std::vector<Truth> truth;
};

inline TrackDescription description_of(const Recipe& recipe) {
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
    const auto& first = sequence.rows[0].impact;
    truth.restitution = first.restitution();
    truth.impulse_ratio = first.impulse.head<2>().norm() / first.impulse.z();
    truth.flights.assign(truth.impact_times.size(), 0);
    Track track{.name = std::to_string(index_), .frames = {}};
    for (int sample = 0; sample / recipe_.rate < end; ++sample) add_frame(drop, sequence, sample, before, track, truth);
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
    drop.law.law = {.restitution = recipe_.restitution,
                    .law = analytic::RestitutionLaw::poisson,
                    .friction = analytic::FrictionKind::coulomb,
                    .friction_value = recipe_.friction};
    return drop;
  }

  void add_frame(const analytic::space::Drop& drop, const analytic::space::Sequence& sequence, int sample,
                 double before, Track& track, Truth& truth) {
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
    static_cast<void>(drop);
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

inline Synthetic make(const Recipe& recipe) {
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

}  // namespace clatter::validation::synthetic
