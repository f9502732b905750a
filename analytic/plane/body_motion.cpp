// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/body_motion.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "analytic/base/angle.hpp"

namespace clatter::analytic {

namespace {

constexpr double root3 = 1.732050807568877293527446341505872367;
constexpr double cosines[6] = {1, 0.5, -0.5, -1, -0.5, 0.5};
/// sin(nπ/3)·2/√3
constexpr double sines[6] = {0, 1, 1, 0, -1, -1};

int wrap(int sextant) { return ((sextant % 6) + 6) % 6; }

/// cos(nπ/3) − cos(nπ/3 + deviation): the exact part is left out, so that it can be added last.
double shortfall(int sextant, double deviation) {
  return cosines[sextant] * detail::versine(deviation) + root3 / 2 * (sines[sextant] * std::sin(deviation));
}

double cosine_of(int sextant, double deviation) { return cosines[sextant] - shortfall(sextant, deviation); }

}  // namespace

double tilt_tangent(double sine, double cosine) {
  const double c = std::fabs(cosine);
  return sine * sine / (1 + c) / (1 + 3 * c);
}

ReflectionAxis reflection_axis(bool left_end, double sine, double cosine) {
  const double c = std::fabs(cosine);
  const double tilt = std::atan(root3 * tilt_tangent(sine, c));
  return {.sense = left_end == (cosine >= 0) ? 1 : -1,
          .tilt = tilt,
          .cosine = 0.5 * std::cos(tilt) + root3 / 2 * std::sin(tilt)};
}

double ElasticFrame::normal() const { return speed * cosine_of(sextant, deviation); }

double ElasticFrame::angular(double length) const {
  return speed / length *
         (3 * sines[sextant] * (1 - detail::versine(deviation)) + 2 * root3 * (cosines[sextant] * std::sin(deviation)));
}

double ElasticFrame::contact_velocity(const ReflectionAxis& axis) const {
  const double across = cosine_of(wrap(sextant - axis.sense), deviation + axis.sense * axis.tilt);
  return speed * across / axis.cosine;
}

double ElasticFrame::reflect(const ReflectionAxis& axis) {
  // 2 cos(χ − ψ) cos ψ = cos χ + cos(χ − 2ψ)
  const int mirrored = wrap(sextant - 2 * axis.sense);
  const double exact = cosines[sextant] + cosines[mirrored];
  const double small = shortfall(sextant, deviation) + shortfall(mirrored, deviation + 2 * axis.sense * axis.tilt);
  sextant = wrap(2 * axis.sense + 3 - sextant);
  deviation = -2 * axis.sense * axis.tilt - deviation;
  return speed * (small - exact);
}

namespace {

using detail::sine_deficit;

/// Solves sin(a+x) − sin a − K x = rise by Newton's method.  For small angles the first guess comes
/// from `rise`, since the one given holds no digits of x.
double solve_offset(double a, double k, double rise, double guess) {
  double x = a < 0.03 ? rise / (std::cos(a) - k) : guess;
  for (int i = 0; i < 3; ++i) {
    const double value = 2 * std::cos(a + x / 2) * std::sin(x / 2) - k * x - rise;
    const double slope = std::cos(a + x) - k;
    const double step = value / slope;
    if (!(std::fabs(step) <= 1e-3 * std::fabs(x))) break;  // at a fold, or nothing to gain
    x -= step;
  }
  if (!(std::fabs(x) < 0.05)) return x;
  // The same equation with its largest term alone on the left, which rounds least.
  return (rise + std::cos(a) * sine_deficit(x) + std::sin(a) * detail::versine(x)) / (std::cos(a) - k);
}

}  // namespace

double first_offset(const Angle& theta, double beta) {
  const double t = theta.radians;
  const double c = theta.cosine;
  const double k1 = theta.sine * theta.sine * (1 + 3 * c) / (6 * c * (1 + c));
  const double rise = 1.5 * k1 * t - sine_deficit(t) + sine_deficit(t / 2);
  return solve_offset(t / 2, k1 - 1.0 / 3, rise, beta - t / 2);
}

double second_offset(const Angle& theta, double eta, double gamma) {
  const double t = theta.radians;
  const double beta = t / 2 + eta;
  // K₂ = tan(π/6 + 2δ₁ + 2δ₂)/√3, by the addition theorems of the tangent with tan δ = √3 u.
  const double u1 = tilt_tangent(theta.sine, theta.cosine);
  const double u2 = tilt_tangent(std::sin(beta), std::cos(beta));
  const double single = 3 * (u1 + u2) / (1 - 3 * u1 * u2);      // √3 tan(δ₁ + δ₂)
  const double twice = 2 * single / (1 - single * single / 3);  // √3 tan(2δ₁ + 2δ₂)
  const double k2 = 4 * twice / (9 - 3 * twice);
  const double rise = 1.5 * k2 * t + (k2 + 4.0 / 3) * eta + sine_deficit(t) - sine_deficit(beta);
  return solve_offset(t, k2 + 1.0 / 3, rise, gamma - t);
}

namespace {

// π/2 as the sum of two doubles.
constexpr double quarter_high = 1.5707963267948966;
constexpr double quarter_low = 6.123233995736766e-17;

/// The body seen from a frame that is turned by 90°: inclinations in that frame are smaller by 90°.
PlanarBody turned_by_a_quarter(PlanarBody body) {
  for (Vertex& vertex : body.vertices) vertex = {-vertex.z, vertex.x};
  return body;
}

/// A face's end that comes down more slowly than this part of the faster end's approach speed is the edge that the body
/// turned about.
constexpr double pivot_part = 1e-11;

/// A face that is given with no more tilt lands level [rad]: rounding of an attitude in space could make as much.  The
/// heights of a thin rod's ends are exact products.
constexpr double level_tilt = 8 * std::numeric_limits<double>::epsilon();

VertexSet only(int vertex) { return static_cast<VertexSet>(1u << vertex); }

/// The two vertices of a set that are farthest apart along the ground.
struct Pair {
  int first, second;
};
Pair outermost(const BodyMotion& motion, VertexSet set) {
  Pair pair{std::countr_zero(set), std::countr_zero(set)};
  for (int i = 0; i < motion.body().vertex_count; ++i) {
    if (!(set >> i & 1)) continue;
    const double x = motion.contact_point(i).tangential;
    if (x < motion.contact_point(pair.first).tangential) pair.first = i;
    if (x > motion.contact_point(pair.second).tangential) pair.second = i;
  }
  return pair;
}

}  // namespace

BodyMotion::BodyMotion(const PlanarBody& body, const Angle& inclination, const PlanarVelocity& velocity, double gravity,
                       double gravity_along)
    : body_(body), turned_(body), gravity_(gravity), gravity_along_(gravity_along), inclination_(inclination.radians),
      sine_(inclination.sine), cosine_(inclination.cosine), initial_(inclination), remainder_(velocity) {
  turn_to_face_below();
  if (body.vertex_count > 2 && std::fabs(sine_) <= level_tilt) inclination_ = sine_ = 0, cosine_ = 1;
  if (body.uniform_thin_rod && velocity.normal < 0 && inclination.cosine >= 0) {
    frame_ = {.speed = -velocity.normal, .sextant = 3};
    remainder_.normal = 0;
    renew_frame_velocity();
    collapse_frame();
  }
  centre_height_ = -contact_point(std::countr_zero(lowest_vertices())).normal;
}

VertexSet BodyMotion::lowest_vertices() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < body_.vertex_count; ++i) lowest = std::fmin(lowest, contact_point(i).normal);
  VertexSet set = 0;
  for (int i = 0; i < body_.vertex_count; ++i) {
    if (contact_point(i).normal == lowest) set |= only(i);
  }
  return set;
}

PlanarVelocity BodyMotion::velocity() const {
  if (frame_.speed == 0) return remainder_;
  return {.normal = frame_velocity_.normal + remainder_.normal,
          .tangential = remainder_.tangential,
          .angular = frame_velocity_.angular + remainder_.angular};
}

void BodyMotion::renew_frame_velocity() {
  const double length = body_.vertices[1].x - body_.vertices[0].x;
  frame_velocity_ = {.normal = frame_.normal(), .angular = frame_.angular(length)};
}

/// The frame helps while the rod lies low and the remainder is the smaller part; otherwise the two
/// would cancel each other, and everything goes to the remainder.
void BodyMotion::collapse_frame() {
  if (frame_.speed == 0) return;
  const double square =
      remainder_.normal * remainder_.normal + body_.gyration_square * (remainder_.angular * remainder_.angular);
  if (std::fabs(cosine_) >= 0.5 && square <= frame_.speed * frame_.speed / 4) return;
  remainder_ = velocity();
  frame_ = {};
}

/// Describes a body whose faces can come to rest by the face that is now below.
void BodyMotion::turn_to_face_below() {
  const bool has_ends = !body_.uniform_thin_rod;
  if (cosine_ >= (has_ends ? std::fabs(sine_) : 0.0) || frame_.speed != 0) return;
  const double sine = sine_, cosine = cosine_;
  const int turns = !has_ends || cosine < -std::fabs(sine) ? 2 : sine > 0 ? 1 : -1;
  for (int i = 0; i < (turns + 4) % 4; ++i) turned_ = turned_by_a_quarter(turned_);
  quarters_ += turns;
  if (quarters_ > 2) quarters_ -= 4;
  if (quarters_ < -1) quarters_ += 4;
  sine_ = (turns == 2 ? -sine : -turns * cosine) + 0.0;  // no negative zero
  cosine_ = turns == 2 ? -cosine : turns * sine;
  inclination_ = std::atan2(sine_, cosine_);
}

double BodyMotion::inclination() const {
  if (quarters_ == 0) return inclination_;
  const double sum = inclination_ + quarters_ * quarter_high + quarters_ * quarter_low;
  return sum > pi ? sum - 2 * pi : sum;
}

double BodyMotion::beyond_turned_body() const {
  const double quarters = quarters_ * quarter_high;
  return inclination_ + quarters > pi ? quarters - 2 * pi : quarters;
}

double BodyMotion::contact_angle() const {
  if (quarters_ % 2 == 0) return acute_angle(inclination_);
  return quarter_high - (acute_angle(inclination_) - quarter_low);
}

BodyMotion::Strike BodyMotion::strike(VertexSet vertices, const ImpactLaw& law) {
  collapse_frame();
  touching_ |= vertices;
  if (std::popcount(vertices) > 1) {
    const auto [first, second] = outermost(*this, vertices);
    const PlanarVelocity before = velocity();
    const auto impact = strike_flat(body_, before, contact_point(first), contact_point(second), law);
    if (impact) {
      frame_ = {};
      remainder_ = impact->after;
      scale_ = {.normal = std::fabs(before.normal),
                .tangential = std::fabs(before.tangential) + std::fabs(impact->slip_after)};
      slip_ = impact->slip_after;
      const bool is_given = law.law != RestitutionLaw::viscoelastic && !impact->is_limited;
      const double e = is_given ? law.restitution : impact->restitution();
      const double of_first = -normal_velocity(before, contact_point(first)),
                   of_second = -normal_velocity(before, contact_point(second));
      const bool pivots = gravity_ > 0 && std::fmin(of_first, of_second) <= pivot_part * std::fmax(of_first, of_second);
      reference_ = pivots && of_second < of_first ? second : first;
      rebound_speed_ = pivots ? 0 : e * of_first;
      if (impact->tilts) {  // the vertex that rises, or rises faster
        const double first_after = normal_velocity(impact->after, contact_point(first)),
                     second_after = normal_velocity(impact->after, contact_point(second));
        reference_ = first_after >= second_after ? first : second;
        rebound_speed_ = std::fmax(first_after, second_after);
      }
      return {*impact, vertices};
    }
    const bool first_faster =
        normal_velocity(before, contact_point(first)) <= normal_velocity(before, contact_point(second));
    vertices = only(first_faster ? first : second);
  }
  return {strike_point(std::countr_zero(vertices), law), vertices};
}

Impact BodyMotion::strike_point(int vertex, const ImpactLaw& law) {
  const ContactPoint d = contact_point(vertex);
  const ContactVelocity contact = contact_velocity(vertex);
  if (frame_.speed != 0 && !frame_carries(vertex, contact)) {
    remainder_ = velocity();
    frame_ = {};
  }
  Impact impact = analytic::strike(body_, velocity(), contact, d, law);
  if (impact.approach_speed > 0) {
    // Strong friction is no small departure from an elastic impact.
    if (frame_.speed != 0 && std::fabs(impact.impulse_ratio()) < 1) strike_framed(vertex, impact), scale_ = velocity();
    else {
      keep_contact_velocity(d, impact);
      frame_ = {};
      remainder_ = impact.after;
    }
  }
  reference_ = vertex;
  rebound_speed_ = impact.separation_speed;
  slip_ = impact.slip_after;
  return impact;
}

/// The impact as an elastic reflection of the frame plus what the real one does differently:
///     P = P_elastic + u_f [(1−e)A − 2 μ_i B]/(A (A − μ_i B)) − (1+e) u_r/(A − μ_i B),
/// u_f, u_r the contact velocities of frame and remainder, e and μ_i as they came out.
void BodyMotion::strike_framed(int vertex, Impact& impact) {
  const ContactPoint d = contact_point(vertex);
  const ReflectionAxis axis = reflection_axis(body_.vertices[vertex].x < 0, sine_, cosine_);
  const double e = impact.restitution();
  const double ratio = impact.impulse_ratio();
  const double coupled = ratio * contact_inertia(body_.gyration_square, d).coupling;
  const double inertia = std::fma(3 * cosine_, cosine_, 1.0);
  const double denominator = inertia - coupled;

  const bool from_fall =
      frame_.sextant == 3 && frame_.deviation == 0 && remainder_.normal == 0 && remainder_.angular == 0;
  const double of_frame = frame_.contact_velocity(axis);
  const double of_remainder = normal_velocity(remainder_, d);
  const double elastic = frame_.reflect(axis);
  renew_frame_velocity();
  const double difference =
      of_frame * ((1 - e) * inertia - 2 * coupled) / (inertia * denominator) - (1 + e) * of_remainder / denominator;
  const double normal = elastic + difference;
  remainder_.normal += difference;
  remainder_.tangential += ratio * normal;
  remainder_.angular += (ratio * normal * d.normal - difference * d.tangential) / body_.gyration_square;

  impact.approach_speed = -(of_frame + of_remainder);
  impact.separation_speed = e * impact.approach_speed;
  impact.normal_impulse = body_.mass * normal;
  impact.tangential_impulse = ratio * impact.normal_impulse;
  impact.after = velocity();
  if (from_fall && difference == 0) {  // V₁ = −(1 − 3c²)/(1 + 3c²) v_n, about its limit for θ → 0
    impact.after.normal = frame_.speed * (1.5 * sine_ * sine_ / inertia - 0.5);
  }
}

Departure BodyMotion::departure() const {
  Departure departure = local_departure();
  if (quarters_ == 0) return departure;
  const double sine = sine_, cosine = cosine_;
  departure.inclination = inclination();
  departure.sine = quarters_ == 2 ? -sine : quarters_ * cosine;
  departure.cosine = quarters_ == 2 ? -cosine : -quarters_ * sine;
  return departure;
}

Departure BodyMotion::local_departure() const {
  const PlanarVelocity v = velocity();
  return {.inclination = inclination_,
          .sine = sine_,
          .cosine = cosine_,
          .normal = v.normal,
          .angular = v.angular,
          .gravity = gravity_,
          .gravity_along = gravity_along_,
          .touching = touching_,
          .reference = reference_,
          .rebound_speed = rebound_speed_};
}

Flight BodyMotion::fly() {
  const Departure departure = local_departure();
  const double beyond = beyond_turned_body();
  Flight flight = analytic::fly(turned_, departure, &passes_);
  if (flight.end != FlightEnd::contact) return flight;
  Arrival& arrival = flight.arrival;
  refine(arrival);
  carry(departure, arrival);
  time_ += arrival.time;
  if (arrival.time > 0) touching_ = 0;
  remainder_.normal -= gravity_ * arrival.time;
  scale_.normal += gravity_ * arrival.time;
  way_ += arrival.time * (remainder_.tangential + gravity_along_ / 2 * arrival.time);
  remainder_.tangential += gravity_along_ * arrival.time;
  scale_.tangential += std::fabs(gravity_along_) * arrival.time;
  const bool turned = arrival.time > 0 && arrival.inclination != inclination_;
  const double local = arrival.inclination;
  arrival.inclination += beyond;
  if (turned) turn_to(local, arrival.inclination);
  turn_to_face_below();
  centre_height_ = -contact_point(arrival.vertex).normal;
  return flight;
}

/// Whole turns go by way of sine and cosine: the double next to 2π, taken off k times, would leave an inclination that
/// is off from them by k ulp, and the next flight would be put together from the two.  They go by those of the given
/// body's inclination, since after many turns that of the turned body, which differs by quarters, rounds to another
/// angle.
void BodyMotion::turn_to(double local, double given) {
  if (std::fabs(local) <= pi) {
    inclination_ = local;
    sine_ = std::sin(local);
    cosine_ = std::cos(local);
    return;
  }
  const double sine = std::sin(given), cosine = std::cos(given);
  sine_ = quarters_ == 0 ? sine : quarters_ == 2 ? -sine : -quarters_ * cosine;
  cosine_ = quarters_ == 0 ? cosine : quarters_ == 2 ? -cosine : quarters_ * sine;
  inclination_ = std::atan2(sine_, cosine_);
}

/// The first two flights of a thin rod that is carried by its frame alone, a → b → a, have their angles
/// from first_offset() and second_offset().
void BodyMotion::refine(Arrival& arrival) {
  const bool on_frame =
      frame_.speed != 0 && gravity_ == 0 && remainder_.normal == 0 && remainder_.angular == 0 && initial_.radians != 0;
  const bool expected = arrival.vertex != reference_ && arrival.time > 0 && std::fabs(arrival.inclination) < pi / 2 &&
                        !arrival.within_margin;
  if (!on_frame || !expected || elastic_flights_ < 0 || elastic_flights_ > 1) {
    elastic_flights_ = -1;
    return;
  }
  Angle start = initial_;
  for (double* const part : {&start.radians, &start.degrees, &start.sine}) *part = std::fabs(*part);
  const double found = std::fabs(arrival.inclination);
  const double before = std::fabs(inclination_);
  offset_ = elastic_flights_ == 0 ? first_offset(start, found) : second_offset(start, offset_, found);
  const double angle = elastic_flights_ == 0 ? start.radians / 2 + offset_ : start.radians + offset_;
  arrival.inclination = std::copysign(angle, arrival.inclination);
  arrival.time = (before + angle) / std::fabs(velocity().angular);
  ++elastic_flights_;
}

double BodyMotion::energy() const {
  const PlanarVelocity v = velocity();
  return body_.mass *
         ((v.normal * v.normal + v.tangential * v.tangential + body_.gyration_square * (v.angular * v.angular)) / 2 +
          gravity_ * centre_height_ - gravity_along_ * way_);
}

// Velocity of the contact point of a BodyMotion, from V and Ω or carried along the flight,
// whichever keeps more digits.

ContactVelocity BodyMotion::contact_velocity(int vertex) const {
  const ContactPoint d = contact_point(vertex);
  const PlanarVelocity v = velocity();
  ContactVelocity found{normal_velocity(v, d), slip_velocity(v, d)};
  if (vertex != carried_.vertex) return found;
  if (4 * carried_.normal_scale < absolute_scale(vertex).normal) found.normal = carried_.velocity.normal;
  if (4 * carried_.slip_scale < absolute_scale(vertex).slip) found.slip = carried_.velocity.slip;
  return found;
}

ContactVelocity BodyMotion::absolute_scale(int vertex) const {
  const ContactPoint d = contact_point(vertex);
  const PlanarVelocity v = velocity();
  return {.normal = std::fmax(std::fabs(v.normal), scale_.normal) + std::fabs(v.angular * d.tangential),
          .slip = std::fmax(std::fabs(v.tangential), scale_.tangential) + std::fabs(v.angular * d.normal)};
}

double BodyMotion::normal_scale(int vertex) const {
  const double absolute = absolute_scale(vertex).normal;
  return vertex == carried_.vertex && 4 * carried_.normal_scale < absolute ? carried_.normal_scale : absolute;
}

double BodyMotion::slip_scale(int vertex) const {
  const double absolute = absolute_scale(vertex).slip;
  return vertex == carried_.vertex && 4 * carried_.slip_scale < absolute ? carried_.slip_scale : absolute;
}

/// Whether frame and remainder give the normal velocity of the contact point without cancelling
/// each other.
bool BodyMotion::frame_carries(int vertex, const ContactVelocity& contact) const {
  const ReflectionAxis axis = reflection_axis(body_.vertices[vertex].x < 0, sine_, cosine_);
  const double of_frame = std::fabs(frame_.contact_velocity(axis));
  const double of_remainder = std::fabs(normal_velocity(remainder_, contact_point(vertex)));
  return of_frame + of_remainder <= 8 * std::fabs(contact.normal);
}

/// V of the centre of mass after an impact, from what loses fewer digits: V and impulse before, or
/// the contact point's velocity after it; the latter always where that was carried, so that the two
/// stay one motion.
void BodyMotion::keep_contact_velocity(const ContactPoint& d, Impact& impact) {
  const PlanarVelocity before = velocity();
  const double turn = impact.after.angular;
  scale_ = {.normal = std::fabs(before.normal) + impact.normal_impulse / body_.mass,
            .tangential = std::fabs(before.tangential) + std::fabs(impact.tangential_impulse) / body_.mass};
  const double normal_scale = impact.separation_speed + std::fabs(turn * d.tangential);
  if (-impact.approach_speed != normal_velocity(before, d) || normal_scale < scale_.normal) {
    impact.after.normal = impact.separation_speed + turn * d.tangential;
    scale_.normal = normal_scale;
  }
  const double slip_scale = std::fabs(impact.slip_after) + std::fabs(turn * d.normal);
  if (impact.slip_before != slip_velocity(before, d) || slip_scale < scale_.tangential) {
    impact.after.tangential = impact.slip_after - turn * d.normal;
    scale_.tangential = slip_scale;
  }
}

/// With h of the arriving vertex from the one that struck last: u = h′, s = s₀ + g_t t + Ω (d_n − d_n0),
/// both at the touch.
void BodyMotion::carry(const Departure& departure, const Arrival& arrival) {
  const VertexHeight height = vertex_height(turned_, departure, arrival.vertex);
  const detail::Turn turn(height.rate * arrival.time);
  const double sine_part = height.sine * turn.sine;
  const double versine_part = height.versine * turn.versine;
  const auto [along, offset] = departure.offset(turned_, reference_, arrival.vertex);
  const double of_start = departure.rebound_speed + std::fabs(departure.angular * along);
  const double gained = departure.gravity_along * arrival.time;
  const double scale = std::fabs(offset) + std::fabs(versine_part) + std::fabs(sine_part);
  carried_ = {.vertex = arrival.vertex,
              .velocity = {height.at(arrival.time, turn).velocity,
                           slip_ + gained + departure.angular * (offset + versine_part - sine_part)},
              .normal_scale = of_start + height.velocity_scale(arrival.time),
              .slip_scale = std::fabs(slip_) + std::fabs(gained) +
                            std::fabs(departure.angular) * (scale + std::fmax(turn.angle - 1, 0))};
}

}  // namespace clatter::analytic
