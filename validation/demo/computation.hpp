// SPDX-License-Identifier: GPL-3.0-or-later
// Answers of the API, each computed by a process of its own, so that it can be ended whatever it does.
#pragma once

#include <sys/types.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validation/demo/routes.hpp"

namespace clatter::validation::inline demo {

/// One computation.  The process is this one's copy, which starts in a millisecond; it must have no other threads.
class Computation : public std::enable_shared_from_this<Computation> {
 public:
  using Done = std::function<void(HttpResponse)>;

  Computation(boost::asio::io_context& context, std::string path, std::string body);
  ~Computation();
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  /// Begins; `done` is called once and later, with the answer or, after `limit`, a refusal, unless cancel() comes
  /// before.
  void start(std::chrono::milliseconds limit, Done done);
  /// Ends the process, if there is one; `done` is not called any more.
  void cancel();
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  void fail_to_start(const char* words);
  void watch_time(std::chrono::milliseconds limit);
  void read();
  void finish(HttpResponse response);
  [[nodiscard]] HttpResponse answer();

  boost::asio::io_context& context_;
  std::string path_, body_;
  Done done_;
  pid_t process_ = -1;
  boost::asio::posix::stream_descriptor pipe_;
  boost::asio::steady_timer timer_;
  std::string answer_;
};

/// Starts computations, a few at a time: those of the discrete model, which take milliseconds, do not wait for those of
/// the continuous one.
class ComputationQueue {
 public:
  /// @param limit of time for each, from its start
  ComputationQueue(boost::asio::io_context& context, std::chrono::milliseconds limit)
      : context_(context), limit_(limit) {}

  [[nodiscard]] std::shared_ptr<Computation> add(const HttpRequest& request, Computation::Done done);
  void cancel(Computation& computation);
  void cancel_all();

 private:
  struct Job {
    std::shared_ptr<Computation> computation;
    Computation::Done done;
  };
  struct Lane {
    std::deque<Job> waiting;
    std::vector<std::shared_ptr<Computation>> running;
  };
  [[nodiscard]] Lane& lane_of(const Computation& computation);
  /// Its place is another's.
  void leave(Lane& lane, const Computation* computation);
  void start_next(Lane& lane);

  boost::asio::io_context& context_;
  std::chrono::milliseconds limit_;
  Lane discrete_, continuous_;
};

}  // namespace clatter::validation::inline demo
