// SPDX-License-Identifier: GPL-3.0-or-later
// What a request to the page's server gets: an answer at once, or a computation.  No network here.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <string>

namespace clatter::validation::inline demo {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// What the server knows of itself.
struct DemoSite {
  std::string page;
  int port = 0;
};

/// The path of a request without its query.
[[nodiscard]] std::string path_of(const HttpRequest& request);

/// Whether answer_request has the answer; otherwise answer_at_once has it.
[[nodiscard]] bool is_computation(const DemoSite& site, const HttpRequest& request);

/// The page, the cases, or the refusal of a request that is none of a computation.
[[nodiscard]] HttpResponse answer_at_once(const DemoSite& site, const HttpRequest& request);

/// {"error": words}, with the program's exit status for bad input, or for a number that was not computed at 5xx.
[[nodiscard]] HttpResponse refusal(unsigned http_status, const std::string& words);
[[nodiscard]] HttpResponse json_response(unsigned http_status, std::string json);

}  // namespace clatter::validation::inline demo
