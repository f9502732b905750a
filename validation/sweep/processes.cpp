// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation {

int run_in_processes(const std::function<int(Ranks& ranks)>& command) {
  Ranks ranks;
  try {
    return command(ranks);
  } catch (const std::exception&) {
    if (ranks.writes()) throw;
    return 0;
  }
}

void add_process_options(Command& command, bool& restart, std::optional<int>& threads) {
  command.add_flag("--restart", restart, "begin anew where FILE.part is there, instead of going on");
  command.add(threads_argument(threads, "computing threads (all cores)"));
}

Argument threads_argument(std::optional<int>& threads, const std::string& help, const std::string& group) {
  return whole_argument("--threads", threads, 1, 1024, "N", help, group);
}

int thread_count(std::optional<int> asked, const Ranks& ranks) {
  if (!asked) return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (!ranks.several()) return *asked;
  throw BadInput(fmt::format("--threads {}: must be left out under mpirun, where each process is one thread", *asked));
}

void compute_ranges(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks, Ranks& ranks) {
  if (ranks.several()) ranks.hand_out(queue, make, hooks);
  else run_on_threads(queue, threads, make, hooks);
}

int serve_ranges(const MakeCompute& make, Ranks& ranks) {
  const CooperativeInterrupt interrupt;
  ranks.serve(make([&] { return interrupt.requested(); }));
  return interrupt.requested() ? interrupted_status : 0;
}

}  // namespace clatter::validation
