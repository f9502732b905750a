// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/friction_log.hpp"

#include <algorithm>

namespace clatter::numeric {
namespace {

using Kind = FrictionPhase::Kind;

constexpr double minor_part = 1e-6;             ///< of energy or time: a phase below it does not name the mode
constexpr double minor_part_of_impulse = 0.01;  ///< slip without work, by μ_k = 0, counts from this part on
constexpr std::size_t most_entries = 64;

}  // namespace

FrictionLog::FrictionLog() { entries_.reserve(most_entries); }

void FrictionLog::begin(const ContactScales& scales, double mass) {
  entries_.clear();
  least_work_ = minor_part * scales.energy;
  least_impulse_ = minor_part_of_impulse * mass * scales.speed;
  least_time_ = minor_part * scales.time;
}

void FrictionLog::close(const FrictionPhase& phase, const Sums& sums) {
  const bool slips = phase.kind == Kind::slip;
  const bool matters = slips ? sums.work - start_.work > least_work_ || sums.impulse - start_.impulse > least_impulse_
                             : sums.time - start_.time > least_time_;
  if (!matters || entries_.size() == most_entries) return;
  const bool goes_on = !entries_.empty() && entries_.back().kind == phase.kind &&
                       !(slips && entries_.back().direction.dot(phase.direction) < 0);
  if (!goes_on) entries_.push_back({phase.kind, phase.direction});
}

FrictionMode FrictionLog::mode() const {
  if (entries_.empty()) return FrictionMode::stick;
  const auto turns_back = [](const Entry& one, const Entry& next) { return one.kind == next.kind; };
  if (std::adjacent_find(entries_.begin(), entries_.end(), turns_back) != entries_.end()) {
    return FrictionMode::reverse_slip;
  }
  const bool slips_first = entries_.front().kind == Kind::slip;
  switch (entries_.size()) {
    case 1: return slips_first ? FrictionMode::slip : FrictionMode::stick;
    case 2: return slips_first ? FrictionMode::slip_stick : FrictionMode::stick_slip;
    case 3: return slips_first ? FrictionMode::slip_stick_slip : FrictionMode::stick_slip_stick;
    default: return FrictionMode::alternating;
  }
}

}  // namespace clatter::numeric
