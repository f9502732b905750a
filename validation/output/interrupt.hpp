// Ctrl-C and SIGTERM: status 130, nothing half-written.
#pragma once

#include <string>

namespace clatter::validation {

/// Installs the handlers; a broken pipe becomes a write error instead of a signal.
void handle_signals();

/// While such an object lives, a first interrupt only sets the flag, so that rows so far can be printed.
class CooperativeInterrupt {
 public:
  CooperativeInterrupt();
  ~CooperativeInterrupt();
  [[nodiscard]] bool requested() const;
};

/// The handler removes this file, until it is told to keep it.  It knows up to eight.
void remove_on_interrupt(const std::string& path);
void keep_on_interrupt(const std::string& path);

/// Whether progress may be shown: stderr is a terminal that moves its cursor, and NO_COLOR is not set.
[[nodiscard]] bool shows_progress();

/// Status of an interrupted run.
inline constexpr int interrupted_status = 130;

}  // namespace clatter::validation
