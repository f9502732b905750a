// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/interrupt.hpp"
#include "validation/program/program.hpp"

int main(int argc, char** argv) {
  clatter::validation::hand_over(argv);
  clatter::validation::occupy_closed_streams();
  clatter::validation::handle_signals();
  return clatter::validation::run_program(clatter::validation::all_commands(), {argv + 1, argv + argc});
}
