#include "validation/demo/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <thread>

#include "validation/demo/api.hpp"

namespace clatter::validation {
namespace {

using httplib::Request;
using httplib::Response;
using Handled = httplib::Server::HandlerResponse;

constexpr const char* this_machine = "127.0.0.1";
constexpr std::size_t largest_body = 64 * 1024;
constexpr int bad_input = 2, most_waiting = 1024;
constexpr const char* json_type = "application/json; charset=utf-8";
// Scripts, styles and fonts are in the page itself; it may talk to nobody but this server.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void refuse(Response& response, int status, const std::string& words) {
  response.status = status;
  response.set_content(error_json(words, bad_input), json_type);
}

bool is_api(const Request& request) { return request.path.starts_with("/api/"); }

}  // namespace

struct DemoServer::State {
  httplib::Server server;
  std::string page;
  int port = 0;
  socket_t socket = 0;  ///< that is listened on

  /// A browser sends the name that it was given: a foreign one means that a foreign name leads here.
  [[nodiscard]] bool is_own_host(const std::string& host) const {
    return host == fmt::format("{}:{}", this_machine, port) || host == fmt::format("localhost:{}", port);
  }
  [[nodiscard]] bool is_own_origin(const std::string& origin) const {
    return origin.starts_with("http://") && is_own_host(origin.substr(7));
  }

  /// What must hold before anything is looked at.
  Handled guard(const Request& request, Response& response) const {
    if (request.get_header_value_count("Host") != 1 || !is_own_host(request.get_header_value("Host"))) {
      refuse(response, 403, "Host: must be this server's own address");
      return Handled::Handled;
    }
    if (request.has_header("Origin") && !is_own_origin(request.get_header_value("Origin"))) {
      refuse(response, 403, "Origin: must be this server's own page");
      return Handled::Handled;
    }
    const bool reads = request.method == "GET" || request.method == "HEAD";
    const bool known = request.path == "/" || request.path == "/api/cases";
    if (!(reads && known) && !(request.method == "POST" && is_api(request) && !known)) {
      const bool other_method = known || (is_api(request) && reads);
      refuse(response, other_method ? 405 : 404,
             fmt::format("{} {}: there is no such thing", request.method, request.path));
      return Handled::Handled;
    }
    return Handled::Unhandled;
  }

  static void answer(const Request& request, Response& response) {
    if (!request.get_header_value("Content-Type").starts_with("application/json")) {
      return refuse(response, 415, "Content-Type: must be application/json");
    }
    const ApiAnswer answer = answer_request(request.path, request.body);
    response.status = answer.status;
    response.set_content(answer.body, json_type);
  }

  void add_routes() {
    server.set_pre_routing_handler(
        [this](const Request& request, Response& response) { return guard(request, response); });
    server.Get("/", [this](const Request&, Response& response) {
      response.set_header("Content-Security-Policy", page_policy);
      response.set_content(page, "text/html; charset=utf-8");
    });
    server.Get("/api/cases", [](const Request&, Response& response) { response.set_content(cases_json(), json_type); });
    server.Post(R"(/api/[^/]*)", answer);
    server.set_error_handler([](const Request& request, Response& response) {
      if (!response.body.empty()) return;
      if (response.status == 413)
        refuse(response, 413, "the body: at most 64 KiB");
      else
        refuse(response, response.status,
               fmt::format("{}: cannot be answered", request.path.empty() ? "the request" : request.path));
    });
  }
};

DemoServer::DemoServer(std::string page) : state_(std::make_unique<State>()) {
  state_->page = std::move(page);
  httplib::Server& server = state_->server;
  server.set_payload_max_length(largest_body);
  server.set_default_headers(
      {{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}, {"Referrer-Policy", "no-referrer"}});
  // A connection that stays open would keep one of few threads.
  server.set_keep_alive_max_count(1);
  server.set_tcp_nodelay(true);
  server.new_task_queue = [] { return new httplib::ThreadPool(std::max(4u, 2 * std::thread::hardware_concurrency())); };
  server.set_socket_options([this](socket_t socket) {
    const int yes = 1;  // not the library's own choice, which lets two servers share a port
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    state_->socket = socket;
  });
  state_->add_routes();
}

DemoServer::~DemoServer() = default;

bool DemoServer::bind(int port) {
  state_->port = port == 0 ? state_->server.bind_to_any_port(this_machine)
                           : (state_->server.bind_to_port(this_machine, port) ? port : -1);
  if (state_->port <= 0) return false;
  // The library lets five wait to be accepted, and a sixth may be turned away.
  return listen(state_->socket, most_waiting) == 0;
}

int DemoServer::port() const { return state_->port; }

void DemoServer::run() { state_->server.listen_after_bind(); }

void DemoServer::stop() { state_->server.stop(); }

}  // namespace clatter::validation
