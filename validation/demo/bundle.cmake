# SPDX-License-Identifier: GPL-3.0-or-later
# Bundles the page with Node.js and writes OUTPUT, a C++ source that holds it.
#   cmake -DPAGE=folder of the page's sources -DWORK=folder to build in -DNPM=npm -DOUTPUT=.. -P bundle.cmake
# Without the packages from npm (no network) the source holds no page and the build goes on: `clatter demo` says so.
file(GLOB sources ${PAGE}/*)
list(FILTER sources EXCLUDE REGEX "/(node_modules|dist)$")
file(COPY ${sources} DESTINATION ${WORK})

function(run what)
  execute_process(COMMAND ${NPM} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status OUTPUT_VARIABLE said
                  ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(WARNING "clatter demo will have no page: ${what} failed:\n${said}")
    set(failed TRUE PARENT_SCOPE)
  endif()
endfunction()

file(SHA256 ${PAGE}/package-lock.json lock)
set(installed "")
if(EXISTS ${WORK}/installed)
  file(READ ${WORK}/installed installed)
endif()
set(failed FALSE)
if(NOT installed STREQUAL lock)
  run("npm ci" ci --ignore-scripts --no-audit --no-fund --loglevel=error)
  if(NOT failed)
    file(WRITE ${WORK}/installed ${lock})
  endif()
endif()
if(NOT failed)
  run("npm run build" run --silent build)
endif()

set(page "")
set(requests "")
if(NOT failed)
  file(READ ${WORK}/dist/index.html page)
  file(READ ${WORK}/dist/requests.json requests)
endif()
file(WRITE ${OUTPUT} "// Made by the build from validation/demo/page/.
#include \"validation/demo/page.hpp\"

namespace clatter::validation::inline demo {

std::string_view demo_page() {
  return R\"clatter-demo(${page})clatter-demo\";
}

std::string_view demo_requests() {
  return R\"clatter-demo(${requests})clatter-demo\";
}

}  // namespace clatter::validation::inline demo
")
