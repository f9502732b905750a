// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/server.hpp"

#include <sys/resource.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include "validation/demo/session.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation::inline demo {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr int most_waiting = 1024;  // to be accepted
constexpr rlim_t most_files = 16384;
constexpr std::chrono::milliseconds until_files_are_free{100};

/// Of connections there may be as many as files may be open.
void allow_many_files() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur >= most_files) return;
  files.rlim_cur = std::min(most_files, files.rlim_max);
  setrlimit(RLIMIT_NOFILE, &files);
}

}  // namespace

struct DemoServer::State {
  asio::io_context context{1};
  DemoSite site;
  ComputationQueue queue;
  tcp::acceptor acceptor{context};
  asio::signal_set signals{context};
  asio::steady_timer pause{context};

  explicit State(std::chrono::milliseconds limit) : queue(context, limit) {}

  void accept() {
    acceptor.async_accept([this](const error_code& error, tcp::socket socket) {
      if (!error) {
        std::make_shared<Session>(std::move(socket), site, queue)->run();
        return accept();
      }
      pause.expires_after(until_files_are_free);
      pause.async_wait([this](const error_code&) { accept(); });
    });
  }
};

DemoServer::DemoServer(std::string page, std::chrono::milliseconds limit) : state_(std::make_unique<State>(limit)) {
  state_->site.page = std::move(page);
  for (const int number : ending_signals()) state_->signals.add(number);
  state_->signals.async_wait([this](const error_code&, int) { state_->context.stop(); });
}

DemoServer::~DemoServer() = default;

bool DemoServer::bind(int port) {
  tcp::acceptor& acceptor = state_->acceptor;
  const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
  error_code error, ignored;
  acceptor.open(here.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(here, error);
  if (!error) acceptor.listen(most_waiting, error);
  if (!error) state_->site.port = acceptor.local_endpoint(error).port();
  if (error) acceptor.close(ignored);
  return !error;
}

int DemoServer::port() const { return state_->site.port; }

void DemoServer::run() {
  allow_many_files();
  state_->accept();
  state_->context.run();
  state_->queue.cancel_all();
}

}  // namespace clatter::validation::inline demo
