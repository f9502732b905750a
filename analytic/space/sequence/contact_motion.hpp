// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion of a body one or two corners of which stay on the ground, solved from event to event.
//
// Steps are explicit, but for those in which slip begins: they are implicit in its direction (slip_start.hpp), until
// explicit ones are stable.
#pragma once

#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analytic/base/limits.hpp"
#include "analytic/space/sequence/slip_start.hpp"

namespace clatter::analytic::space {

class ContactMotion {
 public:
  ContactMotion(const Drop& drop, const State& now, const std::vector<int>& corners);
  /// A neighbour of that motion at its beginning: the same corners stick.
  ContactMotion(const ContactMotion& base, const State& now);
  ContactMotion(const ContactMotion&) = delete;
  ContactMotion& operator=(const ContactMotion&) = delete;

  /// Up to the end of the contact; once.
  /// @throws NumericalError if 5 000 steps do not end it
  SustainedContact follow();
  /// For this time, wherever others come down and if the ground has to pull; whether that can be computed.
  bool advance(double duration);

  [[nodiscard]] const Drop& drop() const { return drop_; }
  [[nodiscard]] State state() const { return state_of(motion_, points_); }
  [[nodiscard]] bool slips() const { return !std::ranges::all_of(points_, &GroundPoint::sticks); }
  /// Least speed of corners that slip with friction, infinite without [m/s].
  [[nodiscard]] double least_slip() const;
  /// √(g reach) + |ω| reach [m/s].
  [[nodiscard]] double speed_scale() const;
  /// What turns negative where the contact ends, by arrival of the vertex or lift-off.
  [[nodiscard]] double margin(ContactEnd end, int vertex) const;
  /// Rates of change, at the end, of state and margin with time.
  struct Rates {
    Vector3 acceleration, turning;  ///< V̇, ω̇
    double margin;
    double bend = 0;  ///< second derivative of a height
  };
  [[nodiscard]] Rates rates(ContactEnd end, int vertex) const;

 private:
  using Motion = GroundMotion;
  enum class Event { none, arrival, lifts, gives_way, digs_in };

  /// Local error of a step, relative to the sizes of attitude and velocities.
  static constexpr double step_error = 1e-14;
  /// Slip slower than this part of the body's speeds has stopped, or has not begun.
  static constexpr double no_slip = 1e-13;
  /// The same of slip that hops before the contact have left.
  static constexpr double left_slip = 1e-7;
  static constexpr double longest_step = 0.1;  ///< [rad], and of √(reach/g)
  static constexpr int most_steps = 5'000;

  [[nodiscard]] GroundForces forces(const Motion& y) const;
  [[nodiscard]] bool touches(int vertex) const;
  [[nodiscard]] const Vector3& place(int vertex) const { return drop_.body.vertices[static_cast<std::size_t>(vertex)]; }
  [[nodiscard]] double height(const State& s, std::size_t vertex) const;
  [[nodiscard]] double room(const Motion& y, Event event, std::size_t number) const;
  static int derivative(double, const double y[], double rate[], void* motion);
  bool give_way();
  [[nodiscard]] bool turns_back() const;
  [[nodiscard]] std::optional<bool> still_begins(const State& start, double length) const;
  void note_directions(const State& start, bool begins);
  bool keep_or_begin_slip();
  [[nodiscard]] bool begin_slip();
  bool stop_slips();
  [[nodiscard]] double longest(const State& start, const GroundForces& f) const;
  [[nodiscard]] bool is_clear(const State& start, const State& end, double length) const;
  void locate_first(const Motion& from);
  [[nodiscard]] bool digs_in() const;
  void step();
  [[nodiscard]] double least_between(const State& from, const State& to, double length, int vertex) const;
  bool locate(const Motion& from, double length, Event event, std::size_t number);
  void apply(Motion& y, double length, Motion& error);
  [[nodiscard]] std::vector<int> arriving() const;
  [[nodiscard]] State levelled(State s) const;
  void take(State s);
  void hold(const State& s);
  /// Whether an edge sticks, about which the body turns.
  [[nodiscard]] bool is_hinge() const {
    return points_.size() == 2 && std::ranges::all_of(points_, &GroundPoint::sticks);
  }
  void keep_hinge();
  void stick_where_slow();
  void leave(std::size_t number);
  [[nodiscard]] std::optional<SustainedContact> pass_event();
  bool go_on();
  [[nodiscard]] bool lies() const;
  [[nodiscard]] SustainedContact ended(ContactEnd end, const std::string& reason) const;
  [[nodiscard]] bool is_free() const { return duration_ < detail::infinite; }

  struct StepDeleter {
    void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
  };

  const Drop& drop_;
  GroundLaw law_;
  double reach_, falling_;    ///< reach, √(reach/g)
  double given_;              ///< energy of the state given
  std::vector<int> corners_;  ///< at the beginning
  std::vector<GroundPoint> points_, began_with_;
  State start_;
  Motion motion_;
  double time_ = 0, length_ = 0;
  double duration_ = detail::infinite;  ///< of advance()
  bool slips_ = false, sticks_ = false;
  Event event_ = Event::none;
  std::size_t number_ = 0;
  double stiffness_ = 0;  ///< rate at which the direction of slip that begins is driven back [1/s]
  gsl_odeiv2_system system_{derivative, nullptr, GroundMotion::SizeAtCompileTime, this};
  std::unique_ptr<gsl_odeiv2_step, StepDeleter> step_{
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, GroundMotion::SizeAtCompileTime)};
};

}  // namespace clatter::analytic::space
