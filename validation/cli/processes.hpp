// SPDX-License-Identifier: GPL-3.0-or-later
// How a command shares its work among threads, or among the processes that mpirun started.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "validation/cli/command.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

/// Runs a command in each process.  Of several processes only the one that writes has something to say, and a status:
/// at another's, mpirun would end it before it has spoken.
int run_in_processes(const std::function<int(Ranks& ranks)>& command);
/// --restart and --threads.
void add_process_options(Command& command, bool& restart, std::optional<std::string>& threads);
/// Value of --threads, all cores without it.  @throws BadInput if it is no number from 1 to 1024, or under mpirun
[[nodiscard]] int read_threads(const std::optional<std::string>& given, const Ranks& ranks);
/// Computes what the queue holds, in the process that writes.
void compute_ranges(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks, Ranks& ranks);
/// The part of a process that does not write.  @returns its exit status
int serve_ranges(const MakeCompute& make, Ranks& ranks);

}  // namespace clatter::validation
