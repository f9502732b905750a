#include "validation/figures/figure_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "validation/output/sink.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {

void make_folder(const std::string& folder, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder, error)) return;
  throw BadInput(fmt::format("{} {}: must be a folder that exists or can be made", option, folder));
}

void check_figure_files(const std::vector<int>& numbers, const std::string& folder) {
  std::vector<RunFile> files;
  for (const int number : std::set<int>(numbers.begin(), numbers.end())) {
    Figure figure;
    figure.number = number;
    files.push_back({"--output", (std::filesystem::path(folder) / figure.file_name()).string()});
  }
  refuse_shared_files(files, {});
  for (const RunFile& file : files) require_writable(file);
}

void write_figure(const Figure& figure, const std::string& folder) {
  Sink sink((std::filesystem::path(folder) / figure.file_name()).string());
  sink.write(figure_csv(figure));
  sink.commit();
}

}  // namespace clatter::validation
