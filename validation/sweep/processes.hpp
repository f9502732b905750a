// SPDX-License-Identifier: GPL-3.0-or-later
// How a command shares its work among threads, or among the processes that mpirun started.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "validation/command/command.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

/// Runs a command in each process.  Of several processes only the one that writes has something to say, and a status:
/// at another's, mpirun would end it before it has spoken.
int run_in_processes(const std::function<int(Ranks& ranks)>& command);
/// --restart and --threads.
void add_process_options(Command& command, bool& restart, std::optional<int>& threads);
/// --threads.
[[nodiscard]] Argument threads_argument(std::optional<int>& threads, const std::string& help,
                                        const std::string& group = "");
/// How many threads compute: all cores where none were asked for.  @throws BadInput if some were, under mpirun
[[nodiscard]] int thread_count(std::optional<int> asked, const Ranks& ranks);
/// Computes what the queue holds, in the process that writes.
void compute_ranges(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks, Ranks& ranks);
/// The part of a process that does not write.  @returns its exit status
int serve_ranges(const MakeCompute& make, Ranks& ranks);

}  // namespace clatter::validation
