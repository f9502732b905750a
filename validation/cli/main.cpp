// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/program.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/sweep/sweep_run.hpp"

int main(int argc, char** argv) {
  clatter::validation::become_mpi_program(argv);
  clatter::validation::occupy_closed_streams();
  clatter::validation::handle_signals();
  return clatter::validation::run_program({argv + 1, argv + argc});
}
