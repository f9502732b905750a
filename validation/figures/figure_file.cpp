// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/figure_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "validation/output/bad_input.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation::inline figures {

void make_folder(const std::string& folder, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder, error)) return;
  throw BadInput(fmt::format("{} {}: must be a folder that exists or can be made", option, folder));
}

std::string FigureFiles::path(int number) const {
  const char* const extensions[]{"txt", "csv", "json", "md", "tex"};  // in the order of Format
  const char* const extension = extensions[static_cast<std::size_t>(style.format)];
  return (std::filesystem::path(folder) / fmt::format("figure_{:02}.{}", number, extension)).string();
}

void check_figure_files(const std::vector<int>& numbers, const FigureFiles& figures) {
  for (const int number : std::set<int>(numbers.begin(), numbers.end()))
    require_writable({"--output", figures.path(number)});
}

void write_figure(const Figure& figure, const FigureFiles& files) {
  Sink sink(files.path(figure.number));
  sink.write(report_text(figure_report(figure), files.style));
  sink.commit();
}

}  // namespace clatter::validation::inline figures
