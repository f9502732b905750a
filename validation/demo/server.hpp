// SPDX-License-Identifier: GPL-3.0-or-later
// The page and its API over HTTP, for this machine alone.
#pragma once

#include <chrono>
#include <memory>
#include <string>

namespace clatter::validation::inline demo {

/// Serves `page` at "/" and the API below "/api/" on 127.0.0.1.  Anything else is refused: another path (404) or method
/// (405), a body over 64 KiB (413), a header over 16 KiB (431), a body that is not JSON by its type (415), a Host or
/// Origin that is not this server or is given twice (403), so that no page from elsewhere can use it.  Files cannot be
/// reached.  A header that asks for a part of the page gets the whole, as HTTP allows.
///
/// One thread waits for all connections, and processes compute: open connections cost next to nothing, a computation
/// that takes longer than `limit` is ended (503), so is one whose client has left, and all of them at the end.
class DemoServer {
 public:
  DemoServer(std::string page, std::chrono::milliseconds limit);
  ~DemoServer();
  DemoServer(const DemoServer&) = delete;
  DemoServer& operator=(const DemoServer&) = delete;

  /// @return whether the port could be had.  @param port 0: any free one
  [[nodiscard]] bool bind(int port);
  [[nodiscard]] int port() const;
  /// Answers until SIGINT, SIGTERM or SIGHUP comes, or has come since this object was made.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clatter::validation::inline demo
