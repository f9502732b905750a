// Figures as files.
#pragma once

#include <string>

#include "validation/figures/figure.hpp"

namespace clatter::validation {

/// Creates the folder if it is not there.  @throws BadInput if it cannot be, or is a file.
void make_folder(const std::string& folder, const std::string& option);

/// Writes DIR/figure_NN.csv, whole or not at all.  @throws BadInput naming the file if it cannot be written.
void write_figure(const Figure& figure, const std::string& folder);

}  // namespace clatter::validation
