// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that share a sweep: one, or those that mpirun started (CMake option CLATTER_MPI).
#pragma once

#include <vector>

#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation::inline sweep {

/// This process among those of a sweep.  Process 0 writes; the others compute what it hands out to them, one thread
/// each. Whatever ends process 0 early lets the others end, too.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] bool several() const { return count_ > 1; }
  [[nodiscard]] bool writes() const { return rank_ == 0; }

  /// Process 0 of several: hands out all ranges, takes their rows.
  /// @throws std::runtime_error if the others end before.
  void hand_out(RangeQueue& queue, const SweepHooks& hooks);
  /// Any other process: computes until process 0 has no more.
  void serve(const ComputeRange& compute);

 private:
  int count_ = 1, rank_ = 0;
  // Of process 0:
  int working_ = 0;        ///< others that have not ended
  std::vector<int> idle_;  ///< those of them that wait for a range
};

}  // namespace clatter::validation::inline sweep
