// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/session.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

namespace clatter::validation::inline demo {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using boost::beast::error_code;

constexpr std::uint32_t largest_header = 16 * 1024;
constexpr std::uint64_t largest_body = 64 * 1024;
// From the first to the last byte of each; who has his answer gets a moment to close, so that it is not lost.
constexpr std::chrono::seconds to_send_request{10}, to_take_answer{30}, to_close{2};

}  // namespace

Session::Session(asio::ip::tcp::socket socket, const DemoSite& site, ComputationQueue& queue)
    : socket_(std::move(socket)), timer_(socket_.get_executor()), site_(site), queue_(queue) {
  parser_.header_limit(largest_header);
  parser_.body_limit(largest_body);
}

void Session::run() {
  error_code ignored;
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  close_after(to_send_request);
  read_request();
}

void Session::read_request() {
  http::async_read(socket_, buffer_, parser_, [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error) return self->request_broken(error);
    self->request_ = self->parser_.release();
    self->answer_request();
  });
}

void Session::request_broken(const error_code& error) {
  if (error == http::error::body_limit) return respond(refusal(413, "the body: at most 64 KiB"));
  if (error == http::error::header_limit) return respond(refusal(431, "the header: at most 16 KiB"));
  const bool is_end = error == http::error::end_of_stream || error == http::error::partial_message;
  const bool is_wrong = error.category() == make_error_code(http::error::bad_method).category() && !is_end;
  if (is_wrong) respond(refusal(400, "the request: is not HTTP (" + error.message() + ")"));
  else close();
}

void Session::answer_request() {
  if (!is_computation(site_, request_)) return respond(answer_at_once(site_, request_));
  timer_.cancel();
  computation_ = queue_.add(request_, [self = shared_from_this()](HttpResponse response) {
    self->computation_.reset();
    self->respond(std::move(response));
  });
  watch_client();
}

/// Whatever else the client sends is ignored; that nothing more comes means that the client has left.
void Session::watch_client() {
  is_watched_ = true;
  socket_.async_read_some(asio::buffer(ignored_), [self = shared_from_this()](const error_code& error, std::size_t) {
    if (!error) return self->watch_client();
    self->is_watched_ = false;
    if (self->computation_) self->queue_.cancel(*std::exchange(self->computation_, nullptr));
    else if (!self->is_answered_) return;  // the answer is on its way
    self->close();
  });
}

void Session::respond(HttpResponse response) {
  response_ = std::move(response);
  if (request_.method() == http::verb::head) response_.body().clear();  // how long it would be is in its header
  close_after(to_take_answer);
  http::async_write(socket_, response_, [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error) return self->close();
    self->is_answered_ = true;
    error_code ignored;
    self->socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    self->close_after(to_close);
    if (!self->is_watched_) self->watch_client();
  });
}

void Session::close_after(std::chrono::seconds time) {
  timer_.expires_after(time);
  timer_.async_wait([self = shared_from_this()](const error_code& error) {
    if (!error && self->timer_.expiry() <= asio::steady_timer::clock_type::now()) self->close();
  });
}

void Session::close() {
  error_code ignored;
  timer_.cancel();
  socket_.close(ignored);
}

}  // namespace clatter::validation::inline demo
