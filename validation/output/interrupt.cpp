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
std::array<char, 4096> doomed{};
std::atomic<bool> has_doomed{false};

extern "C" void on_signal(int) {
  const bool again = requested_flag.exchange(true);
  if (cooperative && !again) return;
  if (has_doomed) unlink(doomed.data());
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
  has_doomed = false;
  if (path.empty() || path.size() >= doomed.size()) return;
  *std::copy(path.begin(), path.end(), doomed.begin()) = '\0';
  has_doomed = true;
}

}  // namespace clatter::validation
