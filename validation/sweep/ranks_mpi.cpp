// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "validation/output/bad_input.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

/// To process 0: ready for a range; the rows of one; this process ends.  From it: a range, with no scenes the last one.
enum Tag : int { ready, rows, gone, range };

using RangeMessage = std::array<long long, 2>;

/// Short beside the work of a range, of which each process has one in hand meanwhile; long beside a look, for the
/// thread that looks shares its core with the one that computes.
constexpr std::chrono::milliseconds between_looks{1};

void send_range(int to, const SceneRange& one) {
  const RangeMessage message{one.first, one.count};
  MPI_Send(message.data(), 2, MPI_LONG_LONG, to, range, MPI_COMM_WORLD);
}

void send_rows(const SceneRange& one, const RangeRows& result) {
  const std::array<long long, 3> numbers{one.first, one.count, result.scenes};
  std::vector<char> message(sizeof numbers + result.text.size());
  std::memcpy(message.data(), numbers.data(), sizeof numbers);
  std::memcpy(message.data() + sizeof numbers, result.text.data(), result.text.size());
  MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, 0, rows, MPI_COMM_WORLD);
}

void add_rows(const std::vector<char>& message, RangeQueue& queue) {
  std::array<long long, 3> numbers{};
  std::memcpy(numbers.data(), message.data(), sizeof numbers);
  queue.add({numbers[0], numbers[1]}, {std::string(message.begin() + sizeof numbers, message.end()), numbers[2]});
}

/// Receives a message from anybody, if there is one.
bool receive(MPI_Status& status, std::vector<char>& message) {
  int there = 0, size = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return false;
  MPI_Get_count(&status, MPI_CHAR, &size);
  message.resize(static_cast<std::size_t>(size));
  MPI_Recv(message.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, &status);
  return true;
}

}  // namespace

void become_mpi_program(char**) {}

Ranks::Ranks() {
  if (!is_started_by_mpirun()) return;  // spares itself the third of a second that MPI_Init takes
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  if (writes()) working_ = count_ - 1;
  const char* const tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  if (several() || std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || tasks == nullptr || std::string_view(tasks) == "1")
    return;
  MPI_Finalize();
  throw BadInput(
      fmt::format("srun started {} processes that MPI does not join, and each would compute everything; "
                  "srun --mpi=pmix joins them",
                  tasks));
}

Ranks::~Ranks() {
  int has_begun = 0;
  MPI_Initialized(&has_begun);
  if (has_begun == 0) return;
  MPI_Status status;
  std::vector<char> message;
  for (const int process : idle_) send_range(process, {});
  while (working_ > 0) {  // an exception ended process 0
    if (!receive(status, message)) std::this_thread::sleep_for(between_looks);
    else if (status.MPI_TAG != gone) send_range(status.MPI_SOURCE, {});
    else --working_;
  }
  if (!writes()) MPI_Send(nullptr, 0, MPI_CHAR, 0, gone, MPI_COMM_WORLD);
  MPI_Finalize();
}

void Ranks::take_message(RangeQueue& queue) {
  MPI_Status status;
  std::vector<char> message;
  if (!receive(status, message)) return std::this_thread::sleep_for(between_looks);
  if (status.MPI_TAG == rows) add_rows(message, queue);
  if (status.MPI_TAG == gone) --working_;
  else idle_.push_back(status.MPI_SOURCE);
}

void Ranks::answer_idle(RangeQueue& queue, bool stop) {
  std::erase_if(idle_, [&](int process) {
    const auto next = stop ? std::nullopt : queue.hand_out();
    const bool over = stop || queue.all_handed_out();
    if (next || over) send_range(process, next.value_or(SceneRange{}));
    return next || over;
  });
}

void Ranks::hand_out(RangeQueue& queue, const MakeCompute& make, const SweepHooks& hooks) {
  Crew crew(queue, hooks);
  crew.start(1, make);
  while (working_ > 0 || crew.works()) {
    if (working_ > 0) take_message(queue);
    answer_idle(queue, crew.stops());
    crew.write_next();
  }
  crew.finish();
  if (!hooks.stop() && !queue.is_complete())
    throw std::runtime_error("the other processes of the sweep ended before its scenes were done");
}

void Ranks::serve(const ComputeRange& compute) {
  // With one range in hand and one under way no process waits for process 0.
  int expected = 2;
  for (int i = 0; i < expected; ++i) MPI_Send(nullptr, 0, MPI_CHAR, 0, ready, MPI_COMM_WORLD);
  while (expected > 0) {
    RangeMessage message{};
    MPI_Recv(message.data(), 2, MPI_LONG_LONG, 0, range, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const SceneRange one{message[0], message[1]};
    if (one.count == 0) --expected;
    else send_rows(one, compute(one));
  }
}

}  // namespace clatter::validation
