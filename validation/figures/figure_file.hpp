// SPDX-License-Identifier: GPL-3.0-or-later
// Figures as files.
#pragma once

#include <string>
#include <vector>

#include "validation/figures/figure.hpp"

namespace clatter::validation::inline figures {

/// Creates the folder if it is not there.  @throws BadInput if it cannot be, or is a file.
void make_folder(const std::string& folder, const std::string& option);

/// Where figures go, and in what form.
struct FigureFiles {
  std::string folder;
  TextStyle style;

  /// FOLDER/figure_07.csv, or .txt, .json, .md, .tex.
  [[nodiscard]] std::string path(int number) const;
};

/// @throws BadInput if a file of these figures cannot be written, or two of them are one by links.
void check_figure_files(const std::vector<int>& numbers, const FigureFiles& files);

/// Writes the figure's file, whole or not at all.  @throws BadInput naming the file if it cannot be written.
void write_figure(const Figure& figure, const FigureFiles& files);

}  // namespace clatter::validation::inline figures
