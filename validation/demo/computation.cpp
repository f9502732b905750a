// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/computation.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <cerrno>
#include <climits>
#include <cstring>
#include <thread>

#include "validation/demo/api.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation::inline demo {
namespace {

namespace asio = boost::asio;

constexpr int pipe_in_child = 3;
constexpr rlim_t most_memory = rlim_t{2} << 30;

/// A long history could take all memory.  A sanitizer's own memory is beyond any such limit.
void limit_memory() {
#ifndef __SANITIZE_ADDRESS__
  const rlimit limit{most_memory, most_memory};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

std::size_t most_at_once() { return std::max(2U, std::thread::hardware_concurrency()); }

/// The new process: writes "STATUS BODY" to the pipe and ends.  It keeps no other file of the server's, whose
/// connections would stay open with it, and no exception leads back into the server's code.
[[noreturn]] void compute(int pipe, pid_t server, const std::string& path, const std::string& body) noexcept {
  for (const int number : ending_signals()) signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != server) _exit(EXIT_FAILURE);
  if (pipe != pipe_in_child && dup2(pipe, pipe_in_child) < 0) _exit(EXIT_FAILURE);
  close_range(pipe_in_child + 1, UINT_MAX, 0);
  limit_memory();
  const ApiAnswer answer = answer_request(path, body);
  const std::string text = fmt::format("{} {}", answer.status, answer.body);
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = write(pipe_in_child, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) _exit(EXIT_FAILURE);
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
  _exit(EXIT_SUCCESS);
}

}  // namespace

Computation::Computation(asio::io_context& context, std::string path, std::string body)
    : context_(context), path_(std::move(path)), body_(std::move(body)), pipe_(context), timer_(context) {}

Computation::~Computation() { cancel(); }

void Computation::start(std::chrono::milliseconds limit, Done done) {
  done_ = std::move(done);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return fail_to_start("the server has no more files; try again");
  const pid_t server = getpid();
  process_ = fork();
  if (process_ == 0) compute(ends[1], server, path_, body_);
  close(ends[1]);
  if (process_ < 0) {
    close(ends[0]);
    return fail_to_start("the server can start no more processes; try again");
  }
  pipe_.assign(ends[0]);
  watch_time(limit);
  read();
}

void Computation::fail_to_start(const char* words) {
  asio::post(context_, [self = shared_from_this(), words] { self->finish(refusal(503, words)); });
}

void Computation::watch_time(std::chrono::milliseconds limit) {
  timer_.expires_after(limit);
  timer_.async_wait([self = shared_from_this(), limit](const boost::system::error_code& error) {
    if (error) return;
    self->finish(refusal(503, fmt::format("takes more than {} s, and was ended; the command line has no such limit",
                                          static_cast<double>(limit.count()) / 1000)));
  });
}

void Computation::read() {
  asio::async_read(pipe_, asio::dynamic_buffer(answer_),
                   [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
                     // The end may have been read, and be told, when the computation is cancelled already.
                     if (error == asio::error::eof && self->done_) self->finish(self->answer());
                   });
}

/// What the process wrote, if it came to its end.
HttpResponse Computation::answer() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
  const std::size_t space = answer_.find(' ');
  if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS || space == std::string::npos) {
    return refusal(500, "the computation broke off");
  }
  return json_response(static_cast<unsigned>(std::stoi(answer_)), answer_.substr(space + 1));
}

void Computation::finish(HttpResponse response) {
  if (!done_) return;
  const Done done = std::exchange(done_, nullptr);
  cancel();
  done(std::move(response));
}

void Computation::cancel() {
  done_ = nullptr;
  timer_.cancel();
  boost::system::error_code ignored;
  pipe_.close(ignored);
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
}

ComputationQueue::Lane& ComputationQueue::lane_of(const Computation& computation) {
  const bool is_continuous = computation.path() == "/api/simulate" || computation.path() == "/api/compare";
  return is_continuous ? continuous_ : discrete_;
}

std::shared_ptr<Computation> ComputationQueue::add(const HttpRequest& request, Computation::Done done) {
  auto computation = std::make_shared<Computation>(context_, path_of(request), request.body());
  Lane& lane = lane_of(*computation);
  lane.waiting.push_back({computation, std::move(done)});
  start_next(lane);
  return computation;
}

void ComputationQueue::start_next(Lane& lane) {
  while (!lane.waiting.empty() && lane.running.size() < most_at_once()) {
    Job job = std::move(lane.waiting.front());
    lane.waiting.pop_front();
    lane.running.push_back(job.computation);
    job.computation->start(
        limit_, [this, &lane, running = job.computation.get(), done = std::move(job.done)](HttpResponse response) {
          leave(lane, running);
          done(std::move(response));
        });
  }
}

void ComputationQueue::leave(Lane& lane, const Computation* computation) {
  std::erase_if(lane.running, [&](const auto& running) { return running.get() == computation; });
  std::erase_if(lane.waiting, [&](const Job& job) { return job.computation.get() == computation; });
  start_next(lane);
}

void ComputationQueue::cancel(Computation& computation) {
  computation.cancel();
  leave(lane_of(computation), &computation);
}

void ComputationQueue::cancel_all() {
  for (Lane* const lane : {&discrete_, &continuous_}) {
    lane->waiting.clear();
    for (const auto& running : lane->running) running->cancel();
    lane->running.clear();
  }
}

}  // namespace clatter::validation::inline demo
