// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace clatter::validation {
namespace {

std::atomic<bool> requested_flag{false};
std::atomic<bool> cooperative{false};

/// A file to remove; a fixed array, since a signal handler may not allocate.
struct Doomed {
  std::array<char, PATH_MAX> path{};  // longer ones cannot be created
  std::atomic<bool> is_set{false};
};
std::array<Doomed, 32> doomed;

extern "C" void on_signal(int) {
  const bool again = requested_flag.exchange(true);
  if (cooperative && !again) return;
  for (const Doomed& file : doomed) {
    if (file.is_set) unlink(file.path.data());
  }
  _exit(interrupted_status);
}

}  // namespace

std::vector<int> ending_signals() {
  std::vector<int> signals{SIGINT, SIGTERM};
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) signals.push_back(SIGHUP);
  return signals;
}

void handle_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int number : ending_signals()) sigaction(number, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number, this one, is given out.
    if (open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY) != stream) _exit(EXIT_FAILURE);
  }
}

SignalsWait::SignalsWait() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int number : ending_signals()) sigaddset(&ending, number);
  pthread_sigmask(SIG_BLOCK, &ending, &before_);
}
SignalsWait::~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

CooperativeInterrupt::CooperativeInterrupt() { cooperative = true; }
CooperativeInterrupt::~CooperativeInterrupt() { cooperative = false; }
bool CooperativeInterrupt::requested() const { return requested_flag; }

bool is_lively(int stream) {
  const char* const terminal = std::getenv("TERM");
  return isatty(stream) == 1 && std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

void remove_on_interrupt(const std::string& path) {
  const auto file = std::find_if(doomed.begin(), doomed.end(), [](const Doomed& one) { return !one.is_set; });
  if (file == doomed.end() || path.size() >= file->path.size())
    throw std::length_error("too many files at once: " + path);
  *std::copy(path.begin(), path.end(), file->path.begin()) = '\0';
  file->is_set = true;
}

void keep_on_interrupt(const std::string& path) {
  for (Doomed& file : doomed) {
    if (file.is_set && path == file.path.data()) file.is_set = false;
  }
}

}  // namespace clatter::validation
