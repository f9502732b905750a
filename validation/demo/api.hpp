// SPDX-License-Identifier: GPL-3.0-or-later
// What the page of `clatter demo` asks for, answered with the program's JSON.  No network here.
#pragma once

#include <string>

namespace clatter::validation::inline demo {

struct ApiAnswer {
  int status = 200;  ///< of HTTP: 200; 400 bad input; 404 no such path; 422 not computed or outside the model
  std::string body;  ///< JSON
};

/// @param path "/api/sequence", "/api/angles", "/api/explain", "/api/simulate", "/api/compare"; "/api/scene" reads the
///             "text" of a scene file called "name" as {"arguments": {…}, "notes": […]}, "/api/file" writes arguments
///             as
///             {"file": text}
/// @param body a flat JSON object: flags of the command without dashes, "_" for "-"; sequence, explain, simulate and
///             compare also "case", a scene that comes with the program, simulate "history", explain "impact".  Nothing
///             in it names a file that is read or written.
/// Thread-safe.  Does not throw: what goes wrong is {"error": one line, "status": the program's exit status}.
[[nodiscard]] ApiAnswer answer_request(const std::string& path, const std::string& body);

/// {"cases": {NAME: scene, …}}, the scenes that come with the program.
[[nodiscard]] std::string cases_json();

/// {"error": words, "status": exit status}
[[nodiscard]] std::string error_json(const std::string& words, int exit_status);

}  // namespace clatter::validation::inline demo
