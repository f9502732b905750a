#include "validation/output/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <string_view>

namespace clatter::validation {
namespace {

std::atomic<bool> requested_flag{false};
std::atomic<bool> cooperative{false};

/// A file to remove; a fixed array, since a signal handler may not allocate.
struct Doomed {
  std::array<char, 4096> path{};
  std::atomic<bool> is_set{false};
};
std::array<Doomed, 8> doomed;

extern "C" void on_signal(int) {
  const bool again = requested_flag.exchange(true);
  if (cooperative && !again) return;
  for (const Doomed& file : doomed) {
    if (file.is_set) unlink(file.path.data());
  }
  _exit(interrupted_status);
}

}  // namespace

void handle_signals() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

CooperativeInterrupt::CooperativeInterrupt() { cooperative = true; }
CooperativeInterrupt::~CooperativeInterrupt() { cooperative = false; }
bool CooperativeInterrupt::requested() const { return requested_flag; }

bool shows_progress() {
  const char* const terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

void remove_on_interrupt(const std::string& path) {
  const auto file = std::find_if(doomed.begin(), doomed.end(), [](const Doomed& one) { return !one.is_set; });
  if (file == doomed.end() || path.size() >= file->path.size()) return;
  *std::copy(path.begin(), path.end(), file->path.begin()) = '\0';
  file->is_set = true;
}

void keep_on_interrupt(const std::string& path) {
  for (Doomed& file : doomed) {
    if (file.is_set && path == file.path.data()) file.is_set = false;
  }
}

}  // namespace clatter::validation
