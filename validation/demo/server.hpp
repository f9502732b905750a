// The page and its API over HTTP, for this machine alone.
#pragma once

#include <memory>
#include <string>

namespace clatter::validation {

/// Serves `page` at "/" and the API below "/api/" on 127.0.0.1.  Anything else is refused: another path (404) or method
/// (405), a body over 64 KiB (413) or not JSON by its type (415), a Host or Origin that is not this server (403), so
/// that no page from elsewhere can use it.  Files cannot be reached.
class DemoServer {
 public:
  explicit DemoServer(std::string page);
  ~DemoServer();
  DemoServer(const DemoServer&) = delete;
  DemoServer& operator=(const DemoServer&) = delete;

  /// @return whether the port could be had.  @param port 0: any free one
  [[nodiscard]] bool bind(int port);
  [[nodiscard]] int port() const;
  /// Answers until stop() is called.
  void run();
  /// From any thread.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clatter::validation
