// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C, SIGTERM and SIGHUP: status 130, nothing half-written.
#pragma once

#include <signal.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace clatter::validation {

/// Installs the handlers; a broken pipe and a file that may not grow become write errors instead of signals.  SIGHUP
/// stays ignored where nohup wants that.
void handle_signals();

/// The signals that ask this process to end.
[[nodiscard]] std::vector<int> ending_signals();

/// Each of stdin, stdout and stderr that was closed becomes an unusable one, so that no file gets its number: reading
/// and writing fail, only what is said on stderr is lost without an error.
void occupy_closed_streams();

/// While such an object lives, signals that end the process wait.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

/// While such an object lives, a first interrupt only sets the flag, so that rows so far can be printed.
class CooperativeInterrupt {
 public:
  CooperativeInterrupt();
  ~CooperativeInterrupt();
  [[nodiscard]] bool requested() const;
};

/// The handler removes this file, until it is told to keep it.  @throws std::length_error beyond 32 files at once
void remove_on_interrupt(const std::string& path);
void keep_on_interrupt(const std::string& path);

/// Whether this is a terminal that knows colours and moves its cursor, and NO_COLOR is not set.
[[nodiscard]] bool is_lively(int stream);
/// Whether progress may be shown, on stderr.
[[nodiscard]] inline bool shows_progress() { return is_lively(STDERR_FILENO); }

/// Status of an interrupted run.
inline constexpr int interrupted_status = 130;

}  // namespace clatter::validation
