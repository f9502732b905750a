# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ source with the texts of FILES (relative to ROOT): cmake -DROOT=.. -DOUTPUT=.. -DFILES=.. -P embed.cmake
set(entries "")
string(REPLACE "|" ";" files "${FILES}")
foreach(name ${files})
  file(READ "${ROOT}/${name}" text)
  string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by the build from the files named in it.
#include \"validation/embedded/embedded.hpp\"

#include <stdexcept>
#include <string>

namespace clatter::validation {

const std::vector<EmbeddedFile>& embedded_files() {
  static const std::vector<EmbeddedFile> files{
${entries}  };
  return files;
}

std::string_view embedded_text(std::string_view name) {
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name == name) return file.text;
  }
  throw std::out_of_range(\"no file \" + std::string(name));
}

}  // namespace clatter::validation
")
