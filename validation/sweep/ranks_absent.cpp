// SPDX-License-Identifier: GPL-3.0-or-later
// The program without MPI, so that its start does not wait for MPI's libraries: always one process.
#include <unistd.h>

#include <climits>
#include <string>

#include "validation/output/bad_input.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

void become_mpi_program(char** words) {
  char self[PATH_MAX];
  const ssize_t size = is_started_by_mpirun() ? readlink("/proc/self/exe", self, sizeof self) : -1;
  if (size <= 0) return;
  const std::string path(self, static_cast<std::size_t>(size));
  const std::string other = path.substr(0, path.rfind('/') + 1) + "clatter-mpi";
  execv(other.c_str(), words);  // returns only where there is no such program
}

Ranks::Ranks() {
  if (!is_started_by_mpirun()) return;
  throw BadInput(
      "started by mpirun or srun, but this program has no MPI, and each process would compute everything; install "
      "clatter-mpi beside it (./clatter --mpi builds it)");
}
Ranks::~Ranks() = default;
void Ranks::hand_out(RangeQueue&, const MakeCompute&, const SweepHooks&) {}
void Ranks::serve(const ComputeRange&) {}

}  // namespace clatter::validation
