// SPDX-License-Identifier: GPL-3.0-or-later
// The batch's arithmetic for one width of vectors.  lane_kernels.cpp includes this once for each instruction set,
// inside a namespace of its own and with CLATTER_LANES lanes, so there is no guard.
//
// A flight is followed in the angle turned, τ = ωt, ω = |Ω|, σ = sign Ω.  The height of a vertex is then
//     h(τ) = h₀ + v τ − b τ² + p (1 − cos τ) + q (τ − sin τ),   b = g/(2ω²), p = −d_n, q = σ d_t,          (1)
//     h″(τ) = R sin ψ − 2b,   ψ = τ + δ,   δ = −(α + polar) for σ > 0, α + polar + π for σ < 0,             (2)
// R the reach of the vertex, so that the pieces on which h is convex or concave are known without a search.

typedef double Vector __attribute__((vector_size(8 * CLATTER_LANES)));
typedef long long Mask __attribute__((vector_size(8 * CLATTER_LANES)));

inline Vector all(double value) { return value - Vector{}; }
inline Vector select(Mask mask, Vector yes, Vector no) { return mask ? yes : no; }
inline Vector magnitude(Vector a) { return (Vector)((Mask)a & 0x7fffffffffffffffLL); }
inline Vector least(Vector a, Vector b) { return a < b ? a : b; }
inline Vector greatest(Vector a, Vector b) { return a > b ? a : b; }
inline Vector root(Vector a) {
  Vector result;
  for (int i = 0; i < CLATTER_LANES; ++i) result[i] = __builtin_sqrt(a[i]);
  return result;
}
inline bool any(Mask mask) {
  long long bits = 0;
  for (int i = 0; i < CLATTER_LANES; ++i) bits |= mask[i];
  return bits != 0;
}
inline Vector load(const Block& block, int first) {
  Vector result;
  __builtin_memcpy(&result, block.data() + first, sizeof result);
  return result;
}
inline void store(Vector value, Block& block, int first) {
  __builtin_memcpy(block.data() + first, &value, sizeof value);
}

/// The nearest whole number; |a| < 2^51.
inline Vector nearest(Vector a) { return (a + 0x1.8p52) - 0x1.8p52; }

struct SineCosine {
  Vector sine, cosine;
};

/// Accuracy: 1.5 ulp for |x| <= 100, away from the zeros beyond the first; near those 1e-16 absolute.  Reduced by π/2
/// in two parts; kernels of fdlibm on [−π/4, π/4].
inline SineCosine sine_cosine(Vector x) {
  const Vector shifted = x * 0x1.45f306dc9c883p-1 + 0x1.8p52;
  const Vector turns = shifted - 0x1.8p52;
  const Vector r = (x - turns * 1.57079632673412561417e+00) - turns * 6.07710050650619224932e-11;
  const Vector z = r * r;
  const Vector sine_tail =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  const Vector sine = r + (z * r) * (-1.66666666666666324348e-01 + z * sine_tail);
  const Vector cosine_tail =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 +
                z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11))));
  const Vector half = 0.5 * z, main = 1 - half;
  const Vector cosine = main + (((1 - main) - half) + z * z * cosine_tail);
  const Mask quarter = (Mask)shifted;
  const Mask swapped = (quarter & 1) != 0;
  const Vector first = swapped ? cosine : sine, second = swapped ? sine : cosine;
  return {(quarter & 2) != 0 ? -first : first, ((quarter + 1) & 2) != 0 ? -second : second};
}

/// arccos to 3e-8, which shifts a least height by 1e-15 of it only.  Source: Abramowitz and Stegun 4.4.46.
inline Vector rough_arccos(Vector x) {
  const Vector a = least(magnitude(x), all(1));
  const Vector sum =
      1.5707963050 +
      a * (-0.2145988016 +
           a * (0.0889789874 + a * (-0.0501743046 +
                                    a * (0.0308918810 + a * (-0.0170881256 + a * (0.0066700901 - a * 0.0012624911))))));
  const Vector value = root(1 - a) * sum;
  return x < 0 ? pi - value : value;
}

/// x less whole turns, in (0, 2π].
inline Vector within_turn(Vector x) {
  const Vector reduced = x - nearest(x * (1 / (2 * pi))) * (2 * pi);
  return reduced <= 0 ? reduced + 2 * pi : reduced;
}

/// Coefficients of (1), with reach and phase of (2).
struct Height {
  Vector height, velocity, gravity, versine, sine, reach, phase;
};

struct Value {
  Vector height, velocity, acceleration;
  Vector scale;  ///< sum of the magnitudes of the terms of h
};

inline Value value_at(const Height& h, Vector angle) {
  const SineCosine half = sine_cosine(0.5 * angle);
  const Vector sine = 2 * half.sine * half.cosine, versine = 2 * half.sine * half.sine;
  const Vector y = angle * angle;
  // The series costs less than the digits that angle − sine loses below 1/2.
  const Vector series =
      angle * y *
      (1.0 / 6 -
       y * (1.0 / 120 - y * (1.0 / 5040 - y * (1.0 / 362880 - y * (1.0 / 39916800 - y * (1.0 / 6227020800.0))))));
  const Vector deficit = magnitude(angle) < 0.5 ? series : angle - sine;
  const Vector a = h.velocity * angle, b = h.gravity * angle * angle, c = h.versine * versine, d = h.sine * deficit;
  return {h.height + ((a + d) + (c - b)), (h.velocity - 2 * h.gravity * angle) + (h.versine * sine + h.sine * versine),
          (h.versine * (1 - versine) + h.sine * sine) - 2 * h.gravity,
          (h.height + magnitude(a)) + (b + magnitude(c) + magnitude(d))};
}

/// What errors of the state add to the height of a vertex at the angle τ: constant + slope τ.
struct Blur {
  Vector constant, slope;

  /// What the height must differ from zero by for its sign to be certain: rounding of its terms is below 2⁻⁴² of them.
  [[nodiscard]] Vector margin(const Value& h, Vector angle) const {
    return 0x1p-42 * h.scale + (constant + slope * angle);
  }
};

/// Where a vertex may strike first.
struct Prospect {
  Mask strikes;        ///< h has its first root in [low, high], where it falls once through zero
  Mask open;           ///< rounding decides
  Vector low, high;    ///< [rad]
  Vector guess;        ///< of the root
  Vector none_before;  ///< without a root there is none before this angle
};

/// What the prospects of all vertices of one reach share.
struct Swing {
  Vector k;           ///< K = V/(ωR); with gravity 2b/R
  Vector half_width;  ///< arccos K
  Vector depth;       ///< sin arccos K − K arccos K; without gravity alone
};

inline Swing swing_without_gravity(Vector k) {
  const Vector half_width = rough_arccos(greatest(least(k, all(1)), all(-1)));
  return {k, half_width, root(greatest((1 - k) * (1 + k), all(0))) - k * half_width};
}

/// Without gravity h falls from ψ = −ψ_m to ψ_m, cos ψ_m = K = V/(ωR), and rises to the next maximum; its
/// inflection at ψ = 0 is a centre of symmetry.  With g(ψ) = sin ψ − Kψ the root is where g = y g(ψ_m), y in [−1, 1]: a
/// function of y and K alone, and smooth in √(1 − |y|) as far as the fold at y = 1.
inline Prospect prospect_without_gravity(const Height& h, const Swing& swing, const Blur& blur) {
  const Vector k = swing.k, bottom = within_turn(swing.half_width - h.phase);
  const Value least_value = value_at(h, bottom);
  const Vector margin = blur.margin(least_value, bottom);
  Prospect found;
  const Mask passes = (least_value.height > margin) | (k >= 1);
  found.strikes = (least_value.height < -margin) & (k < 1);
  found.open = ~passes & ~found.strikes;
  found.low = greatest(bottom - 2 * swing.half_width, all(0));
  found.high = bottom;
  const Vector y = 1 + least_value.height / (h.reach * swing.depth);
  const Vector s = root(greatest(1 - magnitude(y), all(0)));
  // 1 − ψ/ψ_m to 0.02 for K in [−0.9, 0.95], by least squares.
  const Vector part = 1 - s * ((0.94634 - 0.17518 * k) + s * ((-0.11920 + 0.26875 * k) + s * (0.17139 - 0.09466 * k)));
  found.guess = greatest(bottom - swing.half_width * (y < 0 ? 1 + part : 1 - part), found.low);
  found.none_before = k > 0 ? all(1e300) : bottom + 2 * (pi - swing.half_width);
  return found;
}

/// Where the parabola through (0, height) with this velocity and through (width, at_end) falls through zero.
inline Vector parabola_root(Vector height, Vector velocity, Vector width, Vector at_end) {
  const Vector c = ((at_end - height) / width - velocity) / width;
  const Vector square = root(greatest(velocity * velocity - 4 * c * height, all(0)));
  return velocity > 0 ? (velocity + square) / (-2 * c) : 2 * height / (square - velocity);
}

/// With gravity the pieces from the angle `base` on, where h >= 0: concave, convex and concave again, as far as the
/// angle `last`, at which the vertex would be below the ground however the body is turned.
struct Pieces {
  Vector base, first, second, third, last;  ///< [rad]
  Value start, one, two, three;             ///< h there
  Mask has_bottom;                          ///< h has a minimum in the convex piece
  Vector bottom;                            ///< [rad]
  Value low;                                ///< h there
};

inline Pieces pieces_of(const Height& h, const Swing& swing, Vector base, Vector last) {
  Pieces p;
  p.base = base;
  p.last = last;
  const Vector second = base + within_turn(pi / 2 + swing.half_width - h.phase - base);
  const Mask is_concave = swing.k >= 1;
  p.first = least(is_concave ? last : greatest(second - 2 * swing.half_width, base), last);
  p.second = least(is_concave ? last : second, last);
  p.third = least(is_concave ? last : second + 2 * (pi - swing.half_width), last);
  p.start = Value{h.height, h.velocity, all(0), all(0)};
  if (any(base > 0)) p.start = value_at(h, base);
  p.one = value_at(h, p.first);
  p.two = value_at(h, p.second);
  p.three = value_at(h, p.third);
  p.has_bottom = (p.first < p.second) & (p.one.velocity < 0) & (p.two.velocity > 0);
  p.bottom = p.second;
  p.low = p.two;
  return p;
}

/// The bottom of the convex piece, by Newton's method on h′ from where the chord of h′ vanishes.
inline void find_bottom(const Height& h, Pieces& p) {
  p.bottom = p.first - p.one.velocity * (p.second - p.first) / (p.two.velocity - p.one.velocity);
  for (int i = 0; i < 5; ++i) {
    p.low = value_at(h, p.bottom);
    p.bottom = greatest(least(p.bottom - p.low.velocity / p.low.acceleration, p.second), p.first);
  }
  p.low = value_at(h, p.bottom);
}

/// The first of the pieces in which h falls through zero.
inline Prospect prospect_with_gravity(const Height& h, const Swing& swing, Vector base, Vector last, const Blur& blur) {
  Pieces p = pieces_of(h, swing, base, last);
  const Vector m1 = blur.margin(p.one, p.first), m2 = blur.margin(p.two, p.second);
  if (any(p.has_bottom & (p.two.height > -m2))) find_bottom(h, p);
  const Vector m3 = blur.margin(p.three, p.third), low_margin = blur.margin(p.low, p.bottom);
  const Mask above_first = (p.one.height > m1) | (p.first <= base), in_first = p.one.height < -m1;
  const Mask dips = above_first & p.has_bottom & (p.two.height > -m2) & (p.low.height < -low_margin);
  const Mask falls = above_first & (p.two.height < -m2);
  const Mask clears = above_first & (p.two.height > m2) & (~p.has_bottom | (p.low.height > low_margin));
  const Mask in_second = dips | falls, in_third = clears & (p.three.height < -m3);
  const Mask passes = clears & (p.three.height > m3);
  Prospect found;
  found.strikes = in_first | in_second | in_third;
  found.open = ~(found.strikes | passes);
  found.low = in_second ? p.first : (in_third ? p.second : base);
  found.high = in_first ? p.first : (dips ? p.bottom : (falls ? p.second : p.third));
  const Vector height = in_second ? p.one.height : (in_third ? p.two.height : p.start.height);
  const Vector velocity = in_second ? p.one.velocity : (in_third ? p.two.velocity : p.start.velocity);
  const Vector at_end = in_first ? p.one.height : (falls ? p.two.height : p.three.height);
  const Vector width = found.high - found.low;
  const Vector dip_root = width * (1 - root(greatest(-p.low.height / (p.one.height - p.low.height), all(0))));
  const Vector step = dips ? dip_root : parabola_root(height, velocity, width, at_end);
  found.guess = greatest(least(found.low + step, found.high), found.low);
  found.none_before = p.third < last ? p.third : all(1e300);
  return found;
}

/// The drops of CLATTER_LANES lanes, from impact to impact.
class Lanes {
 public:
  Lanes(const LaneBody& body, const LaneDrops& drops, int first, const BatchRequest& request)
      : body_(body), first_(first), limit_(request.limit), only_counts_(request.only_counts),
        inclination_(load(drops.inclination, first)), normal_(load(drops.normal, first)),
        tangential_(load(drops.tangential, first)), angular_(load(drops.angular, first)),
        gravity_(load(drops.gravity, first)), restitution_(load(drops.restitution, first)),
        ratio_(load(drops.impulse_ratio, first)), inclination_error_(ulp * magnitude(inclination_)),
        normal_error_(ulp * magnitude(normal_)), angular_error_(ulp * magnitude(angular_)) {}

  void run(LaneResults& results) {
    turn_to(inclination_);
    choose_lowest();
    while (any(active_)) {
      strike(results);
      if (only_counts_) stop_at_accumulation();
      stop_at_limit();
      if (!any(active_)) break;
      fly();
    }
    write(results);
  }

 private:
  /// What may be the beginning of infinitely many impacts is the scalar code's, which sums them up from four shrinking
  /// ones of one vertex, or periods of several, after the first.
  void stop_at_limit() {
    const Mask stops = active_ & (impacts_ >= (double)limit_);
    const Mask shrinks = limit_ < 5 ? Mask{} : (limit_ < 9 ? repeats_ : ~Mask{});
    fail(stops & (restitution_ < 1) & shrinks);
    active_ &= ~stops;
  }

  /// Infinitely many impacts of two vertices a and b in turn, close to flat, without gravity and friction.
  ///
  /// After an impact of a, which leaves at u_a, b comes down at u_b from the height H; ρ = u_a/|u_b|.  Flat, with
  /// heights that are linear in time, b's impact makes it, whatever H is,
  ///     ρ′ = e/(C_b − ρ),   C_b = (1 + e) c_b,   c_b = −(1 + d_a d_b/κ²)/(1 + d_b²/κ²),                    (3)
  /// and the height of a is then ρH.  Where C_a C_b >= 4e, a ρ of at most C_b/2 gives ρ′ <= C_a/2 and ρρ′ <= e, for
  /// ever, so that heights stay below R H, R the greater of 1 and C/2.  An angle φ = R H/span from flat changes d by
  /// ε d, ε = φ (up + reach φ)/d: velocities by less than (1 + R) ε |u_b| in a flight, c by less than 2.1 ε (1 + 2c),
  /// and (3) still holds with a C less than 5ε R² + (1 + e) 2.1 ε (1 + 2c) away.  A ρ above 5ε R², which e > 5ε R² C
  /// leaves it, keeps the vertex that rises from touching again.
  void stop_at_accumulation() {
    const Mask may = active_ & (gravity_ == 0) & (ratio_ == 0) & (restitution_ < 1);
    if (!any(may)) return;
    const Vector x = of_touching(body_.x), z = of_touching(body_.z), inverse = all(body_.inverse_gyration_square);
    const Vector along = x * cosine_ - z * sine_, up = x * sine_ + z * cosine_;
    const Partner partner = partner_of(along, up);
    const Vector coupling = -(1 + along * partner.along * inverse), both = 1 + restitution_;
    const Vector own = coupling / (1 + along * along * inverse);
    const Vector other = coupling / (1 + partner.along * partner.along * inverse);
    const Vector most = greatest(all(1), 0.5 * both * greatest(own, other));
    const Vector span = magnitude(along - partner.along), height = most * partner.height, angle = height / span;
    const Vector shortest = least(magnitude(along), magnitude(partner.along));
    const Vector part =
        most * most * angle * (greatest(magnitude(up), magnitude(partner.up)) + body_.most_reach * angle) / shortest;
    const Vector own_change = part * (5 + 2.1 * both * (1 + 2 * own));
    const Vector other_change = part * (5 + 2.1 * both * (1 + 2 * other));
    const Vector own_least = both * own - own_change, other_least = both * other - other_change;
    const Vector ratio = rebound_ / partner.fall, largest = both * greatest(own, other) + own_change + other_change;
    // A height between those of the two vertices leaves their range by the body's width at most.
    const Mask is_alone = partner.others > 2 * (1 + 2 * body_.most_reach / span) * height;
    const Mask infinite = may & (partner.fall > 0) & (along * partner.along < 0) & (part < 0.05) & (own_least > 0) &
                          (other_least > 0) & (own_least * other_least >= (4 + 1e-8) * restitution_) &
                          (ratio <= 0.5 * other_least) & (ratio > 5 * part) & (restitution_ > 5 * part * largest) &
                          is_alone;
    infinite_ |= infinite;
    active_ &= ~infinite;
  }

  /// The vertex next above the ground.
  struct Partner {
    Vector height, fall;  ///< [m], downward speed [m/s]
    Vector along, up;     ///< from the centre of mass [m]
    Vector others;        ///< least height of all the others [m]
  };

  /// The partner of the vertex that touches, which is `touching_along` and `touching_up` from the centre of mass.
  [[nodiscard]] Partner partner_of(Vector touching_along, Vector touching_up) const {
    Partner partner{.height = all(1e300), .fall = {}, .along = {}, .up = {}, .others = all(1e300)};
    for (int j = 0; j < body_.vertex_count; ++j) {
      const auto i = (std::size_t)j;
      const Vector along = body_.x[i] * cosine_ - body_.z[i] * sine_, up = body_.x[i] * sine_ + body_.z[i] * cosine_;
      const Vector above = touching_ == (double)j ? all(1e300) : up - touching_up;
      const Mask lower = above < partner.height;
      partner.others = lower ? partner.height : least(partner.others, above);
      partner.fall = lower ? angular_ * (along - touching_along) - rebound_ : partner.fall;
      partner.along = lower ? along : partner.along;
      partner.up = lower ? up : partner.up;
      partner.height = lower ? above : partner.height;
    }
    return partner;
  }

  void turn_to(Vector inclination) {
    inclination_ = inclination;
    const SineCosine turned = sine_cosine(inclination);
    sine_ = turned.sine;
    cosine_ = turned.cosine;
  }

  /// A number of the vertex that touches.
  Vector of_touching(const std::array<double, max_vertices>& of_vertex) const {
    Vector value = all(of_vertex[0]);
    for (int j = 1; j < body_.vertex_count; ++j)
      value = touching_ == (double)j ? all(of_vertex[(std::size_t)j]) : value;
    return value;
  }

  void fail(Mask mask) {
    certain_ &= ~mask;
    active_ &= ~mask;
  }

  /// Two vertices that are as low as rounding can tell land flat.
  void choose_lowest() {
    Vector lowest = all(1e300), next = all(1e300);
    for (int j = 0; j < body_.vertex_count; ++j) {
      const auto i = (std::size_t)j;
      const Vector depth = body_.x[i] * sine_ + body_.z[i] * cosine_;
      const Mask lower = depth < lowest;
      next = lower ? lowest : least(next, depth);
      touching_ = lower ? all(j) : touching_;
      lowest = lower ? depth : lowest;
    }
    fail(~(next - lowest > 1e-12 * body_.reach[0]));
  }

  void strike(LaneResults& results) {
    const Vector x = of_touching(body_.x), z = of_touching(body_.z), inverse = all(body_.inverse_gyration_square);
    const Vector along = x * cosine_ - z * sine_, up = x * sine_ + z * cosine_;
    const Vector approach = struck_ ? approach_ : angular_ * along - normal_, slip = tangential_ + angular_ * up;
    const Vector approach_error =
        normal_error_ + body_.most_reach * (angular_error_ + magnitude(angular_) * inclination_error_);
    fail(active_ & ~(approach > 0x1p-42 * (magnitude(normal_) + magnitude(angular_ * along)) + 4 * approach_error));
    const Vector inertia = 1 + along * along * inverse, coupling = along * up * inverse;
    const Vector denominator = inertia - ratio_ * coupling;
    fail(active_ & ~(denominator > 1e-3 * inertia));
    const Vector impulse = (1 + restitution_) * approach / denominator;
    spread_errors(along, up, impulse, approach_error / approach, 1 / denominator);
    rebound_ = restitution_ * approach;
    normal_ += impulse;
    tangential_ += ratio_ * impulse;
    angular_ -= impulse * inverse * (along - ratio_ * up);
    up_ = up;
    record(results, impulse, approach, slip + (tangential_ + angular_ * up));
  }

  /// Errors of the velocities after an impulse, to first order.
  void spread_errors(Vector along, Vector up, Vector impulse, Vector approach_part, Vector per_denominator) {
    const Vector inverse = all(body_.inverse_gyration_square), ratio = magnitude(ratio_);
    const Vector turned =
        inverse * (2 * magnitude(along * up) + ratio * body_.most_reach * body_.most_reach) * inclination_error_;
    const Vector impulse_error = impulse * (approach_part + turned * per_denominator + 4 * ulp);
    const Vector arm = magnitude(along) + ratio * magnitude(up), other_arm = magnitude(up) + ratio * magnitude(along);
    normal_error_ += impulse_error + ulp * magnitude(normal_);
    angular_error_ +=
        inverse * (impulse_error * arm + impulse * other_arm * inclination_error_) + ulp * magnitude(angular_);
  }

  void record(LaneResults& results, Vector per_mass, Vector approach, Vector slips) {
    const Vector impulse = body_.mass * per_mass;
    loss_ += active_ ? 0.5 * impulse * (approach - rebound_ - ratio_ * slips) : Vector{};
    impacts_ += active_ ? all(1) : Vector{};
    total_ += active_ ? impulse : Vector{};
    repeats_ = (touching_ == last_vertex_) & (impulse < last_impulse_);
    last_impulse_ = impulse;
    const Mask harder = active_ & (impulse > largest_);
    largest_ = harder ? impulse : largest_;
    hardest_ = harder ? impacts_ : hardest_;
    last_vertex_ = active_ ? touching_ : last_vertex_;
    last_start_ = active_ ? time_ : last_start_;
    if (struck_ >= results.impulse.size()) return;
    const Vector half_turns = nearest(inclination_ * (1 / pi));
    const Vector contact = magnitude((inclination_ - half_turns * pi) - half_turns * 1.2246467991473532e-16);
    const Vector none = all(__builtin_nan(""));
    store(active_ ? impulse : none, results.impulse[struck_], first_);
    store(active_ ? contact : none, results.contact_angle[struck_], first_);
    store(active_ ? time_ : none, results.start[struck_], first_);
    ++struck_;
  }

  [[nodiscard]] Height height_of(int vertex, Vector per_rate, Mask is_clockwise) const {
    const auto i = (std::size_t)vertex;
    const Vector x = body_.x[i] - of_touching(body_.x), z = body_.z[i] - of_touching(body_.z);
    const Vector above = x * sine_ + z * cosine_, beside = x * cosine_ - z * sine_;
    const Vector along = body_.x[i] * cosine_ - body_.z[i] * sine_, up = body_.x[i] * sine_ + body_.z[i] * cosine_;
    const Vector phase = inclination_ + body_.polar[i];
    return {greatest(above, all(0)),
            (rebound_ - angular_ * beside) * per_rate,
            0.5 * gravity_ * per_rate * per_rate,
            -up,
            is_clockwise ? along : -along,
            all(body_.reach[i]),
            is_clockwise ? -phase : phase + pi};
  }

  /// While the centre of mass is above its reach no vertex can touch: where the first pieces end then, those that begin
  /// as it comes down to its reach follow.
  [[nodiscard]] Prospect prospect_in_fall(const Height& h, const Swing& swing, Vector rise) const {
    const Vector twice = 2 * h.gravity, square = rise * rise;
    const Vector last = (rise + root(square + 2 * twice * (h.reach - up_))) / twice;
    Prospect found = prospect_with_gravity(h, swing, Vector{}, last, blur_);
    const Mask later = active_ & ~found.strikes & ~found.open & (found.none_before < 1e300);
    if (!any(later)) return found;
    const Vector span = root(square - 2 * twice * (h.reach + up_));
    const Vector reached = (rise - span) / twice, left = (rise + span) / twice;
    const Vector base = greatest(left, found.none_before);
    const Prospect next = prospect_with_gravity(h, swing, base, last, blur_);
    const Mask takes = later & (found.none_before >= reached);
    return {(takes & next.strikes) | (~takes & found.strikes),
            (takes & next.open) | (~takes & found.open),
            select(takes, next.low, found.low),
            select(takes, next.high, found.high),
            select(takes, next.guess, found.guess),
            select(takes, next.none_before, found.none_before)};
  }

  void fly() {
    const Vector rate = magnitude(angular_), per_rate = 1 / rate, rise = normal_ * per_rate;
    const Mask falls = gravity_ > 0, turns = (rate * body_.reach[0] > 1e-9 * (magnitude(normal_) + rebound_)) &
                                             (angular_error_ < 1e-3 * rate);
    blur_ = {2 * body_.most_reach * inclination_error_, (normal_error_ + body_.most_reach * angular_error_) * per_rate};
    // An end that hardly leaves the ground, or a body that hardly turns and does not just rise, is the scalar code's.
    fail(active_ & ~((rebound_ > 0) & (turns | ((normal_ > 0) & ~falls))));
    any_falls_ = any(active_ & falls);
    Vector earliest = all(1e300), chosen = all(-1), first_open = all(1e300);
    Swing swing{};
    for (int j = 0; j < body_.vertex_count; ++j) {
      const double per_reach = 1 / body_.reach[(std::size_t)j];
      const Height& h = heights_[j] = height_of(j, per_rate, angular_ > 0);
      if (j == 0 || body_.reach[(std::size_t)j] != body_.reach[(std::size_t)j - 1]) {
        const Vector bend = 2 * h.gravity * per_reach;
        swing =
            any_falls_ ? Swing{bend, rough_arccos(least(bend, all(1))), bend} : swing_without_gravity(rise * per_reach);
      }
      const Prospect& p = prospects_[j] =
          any_falls_ ? prospect_in_fall(h, swing, rise) : prospect_without_gravity(h, swing, blur_);
      fail(active_ & p.open);
      const Mask sooner = p.strikes & (p.guess < earliest);
      earliest = sooner ? p.guess : earliest;
      chosen = sooner ? all(j) : chosen;
      first_open = p.strikes ? first_open : least(first_open, p.none_before);
    }
    const Mask nothing = chosen < 0;
    fail(active_ & nothing & ((first_open < 1e300) | falls));
    active_ &= ~nothing;
    if (any(active_)) arrive(earliest, chosen, first_open, per_rate);
  }

  struct Falling {
    Height height;
    Vector low, high;  ///< of its prospect [rad]
  };

  /// The fall of the vertex with this index.
  [[nodiscard]] Falling of_vertex(Vector chosen) const {
    Height h = heights_[0];
    Vector low = prospects_[0].low, high = prospects_[0].high;
    for (int j = 1; j < body_.vertex_count; ++j) {
      const Mask here = chosen == (double)j;
      const Height& other = heights_[j];
      h = {select(here, other.height, h.height),
           select(here, other.velocity, h.velocity),
           h.gravity,
           select(here, other.versine, h.versine),
           select(here, other.sine, h.sine),
           h.reach,
           h.phase};
      low = select(here, prospects_[j].low, low);
      high = select(here, prospects_[j].high, high);
    }
    return {h, low, high};
  }

  /// No other vertex with a root may have had it before, or within the error of the angle of touch.
  void check_others(Vector touch, Vector error, Vector chosen) {
    for (int j = 0; j < body_.vertex_count; ++j) {
      const Prospect& p = prospects_[j];
      const Mask late = active_ & (chosen != (double)j) & p.strikes & ~(touch + error < p.low);
      if (!any(late)) continue;
      const Value other = value_at(heights_[j], touch);
      const Vector margin = blur_.margin(other, touch) + 2 * magnitude(other.velocity) * error;
      fail(late & ~((touch < p.high) & (other.height > margin)));
    }
  }

  /// The root of the vertex that strikes first, and the proof that no other does before.
  void arrive(Vector angle, Vector chosen, Vector first_open, Vector per_rate) {
    const auto [h, low, high] = of_vertex(chosen);
    for (int i = 0; i < (any_falls_ ? 3 : 2); ++i) {
      const Value v = value_at(h, angle);
      const Vector step = 2 * v.height * v.velocity / (2 * v.velocity * v.velocity - v.height * v.acceleration);
      angle = greatest(least(angle - step, high), low);
    }
    const Value v = value_at(h, angle);
    const Vector per_velocity = 1 / v.velocity, step = v.height * per_velocity;
    const Vector curvature = magnitude(v.acceleration * per_velocity), touch = angle - step;
    const Vector error = (2 * ulp * v.scale + blur_.constant + blur_.slope * touch) * magnitude(per_velocity);
    // After a Newton step of this length the root is within half an ulp, and within the piece where it is the first.
    fail(active_ & ~((v.velocity < 0) & (step * step * curvature <= 0x1p-53 * angle) & (error * curvature < 1e-3) &
                     (touch > low) & (touch < high) & (touch + error < first_open)));
    check_others(touch, error, chosen);
    const Vector flight = touch * per_rate;
    time_ += flight;
    inclination_error_ += error + flight * angular_error_ + ulp * (magnitude(inclination_) + touch);
    normal_error_ += gravity_ * error * per_rate + ulp * (magnitude(normal_) + gravity_ * flight);
    fail(active_ & ~(inclination_error_ < 1e-4));  // errors stay small enough to be added up to first order
    normal_ -= gravity_ * flight;
    // From h′, since V_n − Ω d_t cancels where bounces become small.
    approach_ = (step * v.acceleration - v.velocity) * magnitude(angular_);
    touching_ = chosen;
    turn_to(inclination_ - (angular_ > 0 ? touch : -touch));
  }

  void write(LaneResults& results) const {
    for (int i = 0; i < CLATTER_LANES; ++i) {
      results.is_certain[(std::size_t)(first_ + i)] = certain_[i] != 0;
      results.is_infinite[(std::size_t)(first_ + i)] = infinite_[i] != 0;
      results.is_at_limit[(std::size_t)(first_ + i)] = impacts_[i] >= limit_;
    }
    store(impacts_, results.impacts, first_);
    store(total_, results.total, first_);
    store(largest_, results.largest, first_);
    store(hardest_, results.hardest, first_);
    store(last_vertex_, results.last_vertex, first_);
    store(last_start_, results.last_start, first_);
    store(loss_, results.loss, first_);
  }

  const LaneBody& body_;
  int first_, limit_;
  bool only_counts_;
  Vector inclination_, normal_, tangential_, angular_, gravity_, restitution_, ratio_;
  Vector sine_{}, cosine_{}, touching_{}, rebound_{}, up_{}, approach_{}, time_{};
  Vector impacts_{}, total_{}, largest_{}, hardest_{}, last_vertex_{}, last_start_{}, loss_{}, last_impulse_{};
  static constexpr double ulp = 0x1p-52;
  /// Bounds to first order of an ulp of the start and of rounding since [rad, m/s, rad/s].
  Vector inclination_error_, normal_error_, angular_error_;
  Blur blur_{};
  Mask active_ = ~Mask{}, certain_ = ~Mask{}, repeats_{}, infinite_{};
  std::size_t struck_ = 0;
  bool any_falls_ = false;
  Height heights_[max_vertices];
  Prospect prospects_[max_vertices];
};

inline void run_block(const LaneBody& body, const LaneDrops& drops, const BatchRequest& request, LaneResults& results) {
  for (int first = 0; first < block_size; first += CLATTER_LANES) {
    for (auto* rows : {&results.impulse, &results.contact_angle, &results.start}) {
      for (Block& row : *rows) store(all(__builtin_nan("")), row, first);
    }
    Lanes(body, drops, first, request).run(results);
  }
}
