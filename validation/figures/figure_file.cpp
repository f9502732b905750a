#include "validation/figures/figure_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "validation/output/sink.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {

void make_folder(const std::string& folder, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder)) return;
  throw BadInput(fmt::format("{} {}: must be a folder that exists or can be made", option, folder));
}

void write_figure(const Figure& figure, const std::string& folder) {
  Sink sink((std::filesystem::path(folder) / figure.file_name()).string());
  sink.write(figure_csv(figure));
  sink.commit();
}

}  // namespace clatter::validation
