// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time, which does not depend on what else the machine does.
#pragma once

#include <ctime>

namespace clatter::validation {

/// Processor time of the calling thread since it began [s].
[[nodiscard]] inline double thread_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace clatter::validation
