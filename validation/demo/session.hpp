// SPDX-License-Identifier: GPL-3.0-or-later
// One connection to the page's server, for one request.
#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <memory>

#include "validation/demo/computation.hpp"

namespace clatter::validation::inline demo {

/// Reads a request, has it answered and closes the connection.  Who sends the request or takes the answer too slowly is
/// left; who leaves before the answer is there has his computation ended.  All of this waits on no thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(boost::asio::ip::tcp::socket socket, const DemoSite& site, ComputationQueue& queue);
  void run();

 private:
  void read_request();
  void request_broken(const boost::beast::error_code& error);
  void answer_request();
  void watch_client();
  void respond(HttpResponse response);
  /// Unless it is called again before.
  void close_after(std::chrono::seconds time);
  void close();

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  const DemoSite& site_;
  ComputationQueue& queue_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::string_body> parser_;
  HttpRequest request_;
  HttpResponse response_;
  std::shared_ptr<Computation> computation_;
  std::array<char, 4096> ignored_{};
  bool is_watched_ = false, is_answered_ = false;
};

}  // namespace clatter::validation::inline demo
