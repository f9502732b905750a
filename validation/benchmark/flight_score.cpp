// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/flight_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"

namespace clatter::validation::inline benchmark {
namespace {

using analytic::space::State;
using analytic::space::Vector3;

/// Scores of the motion between impacts.
class Flights {
 public:
  Flights(const Motion& motion, const Reference& reference, const ReferenceSequence& sequence,
          const std::vector<FoundImpact>& impacts)
      : motion_(motion), reference_(reference), sequence_(sequence), impacts_(impacts) {}

  void score(Score& score) {
    energy_ = reference_.energy(reference_.start);
    const double end = motion_.first_touch() + last_time();
    std::size_t row = 0;
    const std::size_t count = std::min(impacts_.size(), sequence_.truth.size());
    for (std::size_t i = 0; i <= count; ++i) {
      std::size_t last = i < impacts_.size() ? impacts_[i].first_row : motion_.size() - 1;
      while (i == count && last > row && motion_.time(last) > end) --last;
      if (last > row) follow(row, last, score, i);
      if (i < count) row = impacts_[i].last_row;
    }
    if (reference_.energy_alone) long_run(score);
  }

 private:
  [[nodiscard]] double last_time() const {
    const double last = sequence_.truth.back().time;
    return reference_.until && !reference_.energy_alone ? *reference_.until : last + 0.2 * last;
  }

  /// From one row to another without impacts in between; `n` impacts came before.
  void follow(std::size_t from, std::size_t to, Score& score, std::size_t n) const {
    const double start = motion_.energy(from);
    double drift = 0;
    for (std::size_t row = from; row <= to; ++row) {
      drift = worse(drift, std::fabs(motion_.energy(row) - start) / energy_);
    }
    if (drift > score.energy_error) {
      score.energy_error = drift;
      score.drift = n;
    }
    const State begin = motion_.state(from), end = motion_.state(to);
    const State flown = reference_.flight(begin).at(motion_.time(to) - motion_.time(from));
    double away = (flown.position - end.position).norm();
    const std::vector<Vector3> wanted = reference_.arms(flown.attitude), arms = reference_.arms(end.attitude);
    for (std::size_t i = 0; i < arms.size(); ++i) away = worse(away, (arms[i] - wanted[i]).norm());
    if (away / reference_.reach() > score.flight_error) {
      score.flight_error = away / reference_.reach();
      score.stray = n;
    }
  }

  /// Energy at the end of a long run, whatever impacts there are.
  void long_run(Score& score) const {
    const double end = motion_.first_touch() + *reference_.until;
    std::size_t row = motion_.size() - 1;
    // The last step may end beyond it.
    if (2 * motion_.time(row) - motion_.time(row - 1) < end) {
      score.energy_error = Score::unknown;
      score.findings.push_back(fmt::format("the run ends before {} s", shortest(*reference_.until)));
      return;
    }
    while (row > 0 && motion_.time(row) > end) --row;
    const double wanted = reference_.energy(sequence_.after.back());
    const double error = std::fabs(motion_.energy(row) - wanted) / energy_;
    if (error > score.energy_error) {
      score.energy_error = error;
      score.drift = sequence_.truth.size();
    }
  }

  const Motion& motion_;
  const Reference& reference_;
  const ReferenceSequence& sequence_;
  const std::vector<FoundImpact>& impacts_;
  double energy_ = 1;
};

}  // namespace

void score_flights(const Motion& motion, const Reference& reference, const ReferenceSequence& sequence,
                   const std::vector<FoundImpact>& impacts, Score& score) {
  Flights(motion, reference, sequence, impacts).score(score);
}

}  // namespace clatter::validation::inline benchmark
