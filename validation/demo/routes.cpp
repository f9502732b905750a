// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/routes.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "validation/demo/api.hpp"

namespace clatter::validation::inline demo {
namespace {

namespace http = boost::beast::http;

constexpr int bad_input = 2, not_computed = 3;
constexpr const char* json_type = "application/json; charset=utf-8";
// Scripts, styles and fonts are in the page itself; it may talk to nobody but this server.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// A browser sends the name that it was given: a foreign one means that a foreign name leads here.
bool is_own_host(const DemoSite& site, std::string_view host) {
  return host == fmt::format("127.0.0.1:{}", site.port) || host == fmt::format("localhost:{}", site.port);
}

bool is_own_origin(const DemoSite& site, std::string_view origin) {
  return origin.starts_with("http://") && is_own_host(site, origin.substr(7));
}

HttpResponse text_response(unsigned status, std::string text, const char* type) {
  HttpResponse response{static_cast<http::status>(status), 11};
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.keep_alive(false);
  response.body() = std::move(text);
  response.prepare_payload();
  return response;
}

/// What must hold before anything is looked at.
std::optional<HttpResponse> refused(const DemoSite& site, const HttpRequest& request) {
  if (request.count(http::field::host) != 1 || !is_own_host(site, view(request[http::field::host]))) {
    return refusal(403, "Host: must be this server's own address");
  }
  const std::size_t origins = request.count(http::field::origin);
  if (origins > 1 || (origins == 1 && !is_own_origin(site, view(request[http::field::origin])))) {
    return refusal(403, "Origin: must be this server's own page");
  }
  const std::string path = path_of(request);
  const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
  const bool known = path == "/" || path == "/api/cases", is_api = path.starts_with("/api/");
  if ((reads && known) || (request.method() == http::verb::post && is_api && !known)) return std::nullopt;
  return refusal(known || (is_api && reads) ? 405 : 404,
                 fmt::format("{} {}: there is no such thing", view(request.method_string()), path));
}

}  // namespace

std::string path_of(const HttpRequest& request) {
  const std::string_view target = view(request.target());
  return std::string(target.substr(0, target.find('?')));
}

bool is_computation(const DemoSite& site, const HttpRequest& request) {
  return !refused(site, request) && request.method() == http::verb::post &&
         view(request[http::field::content_type]).starts_with("application/json");
}

HttpResponse answer_at_once(const DemoSite& site, const HttpRequest& request) {
  if (auto refusal_of_all = refused(site, request)) return std::move(*refusal_of_all);
  if (request.method() == http::verb::post) return refusal(415, "Content-Type: must be application/json");
  if (path_of(request) == "/api/cases") return json_response(200, cases_json());
  HttpResponse response = text_response(200, site.page, "text/html; charset=utf-8");
  response.set("Content-Security-Policy", page_policy);
  return response;
}

HttpResponse refusal(unsigned http_status, const std::string& words) {
  return json_response(http_status, error_json(words, http_status >= 500 ? not_computed : bad_input));
}

HttpResponse json_response(unsigned http_status, std::string json) {
  return text_response(http_status, std::move(json), json_type);
}

}  // namespace clatter::validation::inline demo
