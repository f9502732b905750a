// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy of contact_angles(): every number against 50 digits, at 100 000 angles and at the folds.
//
// The error of a double is counted in ulp and divided by 2 + 2κ, κ = |θ q′(θ)/q|; the contract of
// contact_angles.hpp is that this never exceeds 1.  The worst rows go to the Markdown file that
// CLATTER_ACCURACY_TABLE names, if it is set.

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>

#include "analytic/plane/contact_angles.hpp"
#include "tests/support.hpp"
#include "tests/two_threads.hpp"
#include "validation/oracles/rod_oracle.hpp"

namespace analytic = clatter::analytic;
namespace oracle = clatter::oracle;
using oracle::Digits150;
using oracle::Digits50;
using oracle::Quantity;

namespace {

/// The contract: |error| <= (2 + 2κ) ulp, κ the sum of |x ∂q/∂x|/|q| over the data x: θ and whichever of
/// G, e and μ_i is in play.
constexpr double allowed_ulp = 2;
constexpr double allowed_ulp_per_condition = 2;

/// Smaller numbers may err by as much as this one: their factors pass through the subnormal doubles.
constexpr double smallest_checked = 1e-300;

/// An end that turns back below this height has nearly touched [L]; higher up, "none" says enough.
constexpr double near_miss = 0.1;
/// A clearance is a sum of heights of order 1 that cancel at a fold [L].
constexpr double clearance_tolerance = 16 * std::numeric_limits<double>::epsilon();

/// Below this, 50 digits are too few for 2 − ΣP ~ θ⁴ [rad]: 22 digits are left there.
constexpr double fifty_digits_suffice_from = 1e-7;

/// How many doubles in all around a fold may be called undecidable.
constexpr int most_within_margin = 20;

/// Gravity, restitution and friction enter the velocities through sums that the elastic rod is spared, so their rows
/// are allowed a multiple of the contract: what headers and documents state for them.
constexpr double multiple_with_gravity = 4;
constexpr double multiple_with_restitution_and_friction = 12;
constexpr int fold_neighbourhood = 1000;                    // [ulp] to either side
constexpr int thinning = CLATTER_TEST_SLOW_BUILD ? 20 : 1;  // of all samples

enum Region : std::size_t {
  to_0,
  bulk,
  to_fold_3,
  to_fold_2,
  to_90,
  with_gravity,
  with_restitution_and_friction,
  region_count
};

constexpr std::array<const char*, region_count> region_names = {"to 0°",  "bulk",  "to fold 3",     "to fold 2",
                                                                "to 90°", "G > 0", "e < 1, μ_i > 0"};

struct Sample {
  Region region = bulk;
  double theta = 0;  ///< [rad]
};

using Rod = analytic::RodParameters;

/// Without these γ − θ and 2 − ΣP have expressions of their own, free of cancellation.
bool is_elastic(const Rod& rod) { return rod.gravity_number == 0 && rod.restitution == 1 && rod.impulse_ratio == 0; }

template <class Real>
oracle::RodCase<Real> with(const Rod& rod, const Real& theta) {
  return {theta, Real(rod.gravity_number), Real(rod.restitution), Real(rod.impulse_ratio)};
}

/// Distance of doubles at this magnitude, but at least at `smallest_checked`.
double ulp_of(double value) { return std::ldexp(1.0, std::ilogb(std::max(std::abs(value), smallest_checked)) - 52); }

/// Which entry of the result is which quantity; `other_end` contacts only, but for times.
double entry(const analytic::ContactAngles& result, Quantity q) {
  switch (q) {
    case oracle::beta: return result.beta.angle;
    case oracle::gamma: return result.gamma.angle;
    case oracle::impulse_1: return result.impulse[0];
    case oracle::impulse_2: return result.impulse[1];
    case oracle::impulse_3: return result.impulse[2];
    case oracle::velocity_1: return result.velocity[0];
    case oracle::velocity_2: return result.velocity[1];
    case oracle::velocity_3: return result.velocity[2];
    case oracle::angular_1: return result.angular[0];
    case oracle::angular_2: return result.angular[1];
    case oracle::angular_3: return result.angular[2];
    case oracle::time_1: return result.beta.time;
    case oracle::time_2: return result.gamma.time;
    case oracle::gamma_minus_theta: return result.gamma_minus_theta;
    case oracle::impulse_deficit: return result.impulse_deficit;
    case oracle::quantity_count: break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

analytic::NextImpact expected_next(const std::optional<oracle::Contact>& contact) {
  if (!contact) return analytic::NextImpact::not_reached;
  switch (*contact) {
    case oracle::Contact::other_end: return analytic::NextImpact::other_end;
    case oracle::Contact::beyond_upright: return analytic::NextImpact::beyond_upright;
    case oracle::Contact::same_end: return analytic::NextImpact::same_end;
    case oracle::Contact::none: break;
  }
  return analytic::NextImpact::none;
}

struct Deviation {
  double ulp = 0;
  double ratio = 0;  ///< ulp/(allowed ulp); the contract is <= 1
};

template <class Real>
double error_in_ulp(double computed, const Real& exact) {
  if (!std::isfinite(computed)) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(Real(abs(Real(computed) - exact) / ulp_of(static_cast<double>(exact))));
}

Deviation deviation(double ulp, double condition) {
  return {ulp, ulp / (allowed_ulp + allowed_ulp_per_condition * condition)};
}

/// The conditions of all quantities with respect to the data besides θ.
using Conditions = std::array<double, oracle::quantity_count>;

template <class Real>
Conditions other_conditions(const oracle::RodCase<Real>& rod) {
  Conditions sum{};
  const std::pair<bool, oracle::Parameter> data[] = {{rod.gravity_number != 0, oracle::Parameter::gravity_number},
                                                     {rod.restitution != 1, oracle::Parameter::restitution},
                                                     {rod.impulse_ratio != 0, oracle::Parameter::impulse_ratio}};
  for (const auto& [in_play, parameter] : data) {
    if (!in_play) continue;
    const auto solution = oracle::RodSolver<Real>(rod, parameter).solve(3);
    for (std::size_t q = 0; q < oracle::quantity_count; ++q) {
      if (solution.quantities[q]) sum[q] += static_cast<double>(solution.condition(static_cast<Quantity>(q)));
    }
  }
  return sum;
}

template <class Real>
double condition(const oracle::RodSolution<Real>& exact, Quantity q) {
  return static_cast<double>(exact.condition(q));
}

/// Worst and mean deviation of one quantity in one region.
struct Statistics {
  long rows = 0;
  double sum_ulp = 0;
  Deviation worst;  ///< each field the worst of its own
  double theta_of_worst_ratio = 0;

  void add(const Deviation& d, double theta) { merge({1, d.ulp, d, theta}); }
  void merge(const Statistics& other) {
    rows += other.rows;
    sum_ulp += other.sum_ulp;
    if (!(other.worst.ulp <= worst.ulp)) worst.ulp = other.worst.ulp;
    if (other.worst.ratio <= worst.ratio || std::isnan(worst.ratio)) return;
    worst.ratio = other.worst.ratio;
    theta_of_worst_ratio = other.theta_of_worst_ratio;
  }
};

struct Report {
  std::array<std::array<Statistics, oracle::quantity_count>, region_count> statistics;
  std::set<double> within_margin;  ///< angles left out because rounding decides there
  std::vector<std::string> wrong;  ///< decisions and clearances, in words

  void merge(const Report& other) {
    for (std::size_t r = 0; r < region_count; ++r)
      for (std::size_t q = 0; q < oracle::quantity_count; ++q) statistics[r][q].merge(other.statistics[r][q]);
    within_margin.insert(other.within_margin.begin(), other.within_margin.end());
    wrong.insert(wrong.end(), other.wrong.begin(), other.wrong.end());
  }
};

class Judge {
 public:
  explicit Judge(const Rod& rod) : rod_(rod), small_angles_(with(rod, Digits150(0))) {}

  void row(const Sample& sample, Report& report) const {
    if (sample.theta < oracle::SmallAngleLaw::validity)
      judge(sample, small_angles_.at(Digits150(sample.theta)), report);
    else if (sample.theta < fifty_digits_suffice_from)
      judge(sample, oracle::solve_rod(with(rod_, Digits150(sample.theta))), report);
    else judge(sample, oracle::solve_rod(with(rod_, Digits50(sample.theta))), report);
  }

 private:
  template <class Real>
  void judge(const Sample& sample, const oracle::RodSolution<Real>& exact, Report& report) const {
    const auto angle = analytic::Angle::from_radians(sample.theta);
    const auto result = analytic::contact_angles(angle, rod_);
    if (result.beta.within_margin || result.gamma.within_margin) {
      report.within_margin.insert(sample.theta);
      return;
    }
    const bool right =
        result.beta.next == expected_next(exact.second) && result.gamma.next == expected_next(exact.third);
    if (!right) report.wrong.push_back(describe(sample, result, exact.second, exact.third));
    if (!right) return;
    // Towards θ = 0 these conditions tend to constants.
    const Conditions others = other_conditions(with(rod_, Digits50(std::max(sample.theta, fifty_digits_suffice_from))));
    for (std::size_t i = 0; i < oracle::quantity_count; ++i)
      quantity(sample, result, exact, static_cast<Quantity>(i), others, report);
    if (result.beta.next == analytic::NextImpact::none)
      clearance(sample, result.beta.clearance, static_cast<double>(exact.clearance), clearance_tolerance, report);
    // The second flight starts from β, whose error near its fold it inherits.
    if (result.gamma.next == analytic::NextImpact::none)
      clearance(sample, result.gamma.clearance, static_cast<double>(exact.clearance),
                clearance_tolerance * (1 + condition(exact, oracle::beta)), report);
  }

  static void clearance(const Sample& sample, double computed, double exact, double tolerance, Report& report) {
    if (!(exact < near_miss) || std::abs(computed - exact) <= tolerance) return;
    std::ostringstream out;
    out << std::setprecision(17) << "theta " << sample.theta << ": clearance " << computed << " instead of " << exact;
    report.wrong.push_back(out.str());
  }

  template <class Real>
  void quantity(const Sample& sample, const analytic::ContactAngles& result, const oracle::RodSolution<Real>& exact,
                Quantity q, const Conditions& others, Report& report) const {
    const bool difference = q == oracle::gamma_minus_theta || q == oracle::impulse_deficit;
    if (difference && !is_elastic(rod_)) return;
    if (!exact.quantities[q]) {
      if (must_be_nan(exact, q) && !std::isnan(entry(result, q)))
        report.wrong.push_back(std::string(oracle::quantity_names[q]) + " of no impact is a number");
      return;
    }
    const double ulp = error_in_ulp(entry(result, q), exact.quantities[q]->value);
    report.statistics[sample.region][q].add(deviation(ulp, condition(exact, q) + others[q]), sample.theta);
  }

  /// Impulse and velocities of an impact that does not happen.
  template <class Real>
  static bool must_be_nan(const oracle::RodSolution<Real>& exact, Quantity q) {
    const bool of_third = q == oracle::impulse_3 || q == oracle::velocity_3 || q == oracle::angular_3;
    const bool of_second = q == oracle::impulse_2 || q == oracle::velocity_2 || q == oracle::angular_2;
    if (of_second) return exact.second == oracle::Contact::none;
    return of_third && (exact.second == oracle::Contact::none || exact.third == oracle::Contact::none);
  }

  [[nodiscard]] std::string describe(const Sample& sample, const analytic::ContactAngles& result,
                                     oracle::Contact second, const std::optional<oracle::Contact>& third) const {
    const auto number = [](analytic::NextImpact next) { return static_cast<int>(next); };
    std::ostringstream out;
    out << std::setprecision(17) << "theta " << sample.theta << " G " << rod_.gravity_number << " e "
        << rod_.restitution << " mu_i " << rod_.impulse_ratio << ": next " << number(result.beta.next) << ", "
        << number(result.gamma.next) << " instead of " << number(expected_next(second)) << ", "
        << number(expected_next(third));
    return out.str();
  }

  Rod rod_;
  oracle::SmallAngleLaw small_angles_;
};

Report judge_all(const Rod& rod, const std::vector<Sample>& samples) {
  const Judge judge(rod);
  return clatter::test::shared_out<Report>(samples.size(),
                                           [&](std::size_t i, Report& report) { judge.row(samples[i], report); });
}

/// Angles whose distances from a point are spread evenly over the decades.
class Samples {
 public:
  void add(Region region, double theta) {
    if (theta > 0 && theta < analytic::pi / 2) samples_.push_back({region, theta});
  }
  struct Decades {
    double from = 0, to = 0;  ///< log10 of the distance [rad]
  };
  /// @param side +1 above the point, −1 below it
  void add_towards(Region region, double point, int side, const Decades& decades, int count) {
    std::uniform_real_distribution<double> exponent(decades.from, decades.to);
    for (int i = 0; i < count / thinning; ++i) add(region, point + side * std::pow(10, exponent(random_)));
  }
  void add_uniform(Region region, int count) {
    std::uniform_real_distribution<double> angle(0, analytic::pi / 2);
    for (int i = 0; i < count / thinning; ++i) add(region, angle(random_));
  }
  [[nodiscard]] const std::vector<Sample>& all() const { return samples_; }

 private:
  std::mt19937_64 random_{20051};
  std::vector<Sample> samples_;
};

double fold(oracle::Fold which) { return static_cast<double>(oracle::elastic_fold<Digits50>(which)); }

constexpr double degree_decade = -1.758;  // log10 of 1° [rad]
constexpr double ulp_decade = -15.5;      // about an ulp at the folds and at 90°

std::vector<Sample> elastic_samples() {
  Samples samples;
  samples.add_towards(to_0, 0, +1, {-300, -20}, 3000);
  samples.add_towards(to_0, 0, +1, {-20, -8}, 1000);
  samples.add_towards(to_0, 0, +1, {-8, degree_decade}, 4500);
  samples.add_towards(to_90, analytic::pi / 2, -1, {ulp_decade, degree_decade}, 4000);
  for (const int side : {-1, 1}) {
    samples.add_towards(to_fold_2, fold(oracle::Fold::second), side, {ulp_decade, degree_decade}, 2000);
    samples.add_towards(to_fold_3, fold(oracle::Fold::third), side, {ulp_decade, degree_decade}, 2000);
  }
  samples.add_uniform(bulk, 81000);
  return samples.all();
}

std::vector<Sample> fewer_samples(Region region) {
  Samples samples;
  samples.add_towards(region, 0, +1, {-12, degree_decade}, 500);
  samples.add_towards(region, analytic::pi / 2, -1, {ulp_decade, degree_decade}, 200);
  samples.add_uniform(region, 1300);
  return samples.all();
}

/// Everything that the cases of this file have found, for the table.
Report& collected() {
  static Report report;
  return report;
}

void check(const Report& report, double multiple) {
  for (std::size_t r = 0; r < region_count; ++r)
    for (std::size_t q = 0; q < oracle::quantity_count; ++q) {
      const Statistics& s = report.statistics[r][q];
      BOOST_TEST(s.worst.ratio <= multiple, region_names[r]
                                                << ": " << oracle::quantity_names[q] << " errs by " << s.worst.ratio
                                                << " of what is allowed at theta = " << std::setprecision(17)
                                                << s.theta_of_worst_ratio << " rad");
    }
  constexpr std::size_t shown = 5;
  BOOST_TEST(report.wrong.empty(), report.wrong.size() << " wrong decisions or clearances");
  for (std::size_t i = 0; i < std::min(shown, report.wrong.size()); ++i) BOOST_TEST_MESSAGE(report.wrong[i]);
  constexpr std::size_t folds = 2;
  BOOST_TEST(report.within_margin.size() <= folds * most_within_margin);
}

void check_case(const Rod& rod, const std::vector<Sample>& samples, double multiple = 1) {
  BOOST_TEST_CONTEXT("G " << rod.gravity_number << " e " << rod.restitution << " mu_i " << rod.impulse_ratio) {
    const Report report = judge_all(rod, samples);
    check(report, multiple);
    collected().merge(report);
  }
}

void write_table(std::ostream& out) {
  out << "| region | quantity | rows | worst error [ulp] | worst error/(2 + 2κ) | at θ [°] | "
         "mean error [ulp] |\n|---|---|---:|---:|---:|---:|---:|\n";
  for (std::size_t r = 0; r < region_count; ++r)
    for (std::size_t q = 0; q < oracle::quantity_count; ++q) {
      const Statistics& s = collected().statistics[r][q];
      if (s.rows == 0) continue;
      out << "| " << region_names[r] << " | " << oracle::quantity_names[q] << " | " << s.rows << " | "
          << std::setprecision(3) << s.worst.ulp << " | " << s.worst.ratio << " | " << std::setprecision(9)
          << s.theta_of_worst_ratio * analytic::degrees_per_radian << " | " << std::setprecision(2)
          << s.sum_ulp / static_cast<double>(s.rows) << " |\n";
    }
}

struct TableWriter {
  ~TableWriter() {
    const char* path = std::getenv("CLATTER_ACCURACY_TABLE");
    if (path == nullptr || *path == '\0') return;
    std::ofstream file(path);
    write_table(file);
  }
};

BOOST_TEST_GLOBAL_FIXTURE(TableWriter);

analytic::ContactAngle decision(double theta, oracle::Fold which) {
  const auto result = analytic::contact_angles(analytic::Angle::from_radians(theta), {});
  return which == oracle::Fold::second ? result.beta : result.gamma;
}

void check_fold(oracle::Fold which) {
  const auto exact = oracle::elastic_fold<Digits50>(which);
  const double nearest = static_cast<double>(exact);
  const double ulp = ulp_of(nearest);
  int margin = 0;
  int wrong = 0;
  for (int i = -fold_neighbourhood; i <= fold_neighbourhood; ++i) {
    const double theta = nearest + i * ulp;
    const auto at = decision(theta, which);
    const auto right = Digits50(theta) < exact ? analytic::NextImpact::other_end : analytic::NextImpact::none;
    if (at.within_margin) ++margin;
    if (at.next != right && !at.within_margin) ++wrong;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(margin <= most_within_margin);
}

}  // namespace

BOOST_AUTO_TEST_CASE(elastic_rod_without_gravity_keeps_its_accuracy_at_100000_angles) {
  const auto samples = elastic_samples();
  BOOST_TEST(samples.size() >= 100'000U / thinning);
  check_case({}, samples);
}

BOOST_AUTO_TEST_CASE(gravity_keeps_the_accuracy) {
  for (const double g : {1e-6, 0.01, 1.0, 9.81})
    check_case({.gravity_number = g, .restitution = 1, .impulse_ratio = 0}, fewer_samples(with_gravity),
               multiple_with_gravity);
}

BOOST_AUTO_TEST_CASE(restitution_and_impulse_ratio_keep_the_accuracy) {
  for (const double e : {0.3, 0.9})
    for (const double mu : {0.1, 0.3})
      check_case({.gravity_number = 0, .restitution = e, .impulse_ratio = mu},
                 fewer_samples(with_restitution_and_friction), multiple_with_restitution_and_friction);
}

BOOST_AUTO_TEST_CASE(every_double_near_the_folds_of_the_second_and_third_impact_is_decided_rightly) {
  check_fold(oracle::Fold::second);
  check_fold(oracle::Fold::third);
}
