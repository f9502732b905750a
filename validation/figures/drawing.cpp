#include "validation/figures/drawing.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

std::filesystem::path temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? std::filesystem::path("/tmp") : folder;
}

/// A file in the folder for temporary files that goes when the object does.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_((temporary_folder() / "clatter-XXXXXX").string()) {
    const int file = mkstemp(path_.data());
    if (file < 0) throw std::runtime_error("no temporary file can be made in " + temporary_folder().string() + " (TMPDIR)");
    std::FILE* stream = fdopen(file, "w");
    std::fwrite(text.data(), 1, text.size(), stream);
    std::fclose(stream);
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Colours that colour-blind readers can tell apart.
constexpr std::array<const char*, 9> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                             "#56b4e9", "#000000", "#8c564b", "#7f7f7f"};

constexpr const char* point_colour = "#222222";  // of points that lie on a line of their own colour

std::string range(const Range2& range) {
  const auto bound = [](double value) { return std::isfinite(value) ? shortest(value) : std::string("*"); };
  return fmt::format("[{}:{}]", bound(range.low), bound(range.high));
}

bool within(double x, const Range2& range) { return !(x < range.low) && !(x > range.high); }

/// Rows of a curve as a gnuplot data block; gaps become empty lines.
std::string data_block(const Figure& figure, const FigurePlot& plot, const FigureCurve& curve, std::size_t index) {
  const std::size_t x = figure.column(curve.x), y = figure.column(curve.y);
  std::string text = fmt::format("$d{} << END\n", index);
  for (const std::vector<double>& row : figure.rows) {
    if (curve.where && row[figure.column(curve.where->first)] != curve.where->second) continue;
    if (!std::isfinite(row[x]) || !within(row[x], plot.x)) continue;
    const bool gap = y >= row.size() || !std::isfinite(row[y]);
    if (gap && curve.style != FigureCurve::Style::points) text += "\n";
    if (gap) continue;
    text += shortest(row[x]) + " " + shortest(row[y]);
    if (curve.style == FigureCurve::Style::segments) {
      text += " " + shortest(row[figure.column(curve.x_end)]) + " " + shortest(row[figure.column(curve.y_end)]);
    }
    text += "\n";
  }
  return text + "END\n";
}

std::string style(const FigureCurve& curve, const char* colour) {
  switch (curve.style) {
    case FigureCurve::Style::line:
      return fmt::format("with lines lw 2 lc rgb '{}'", colour);
    case FigureCurve::Style::thin_line:
      return fmt::format("with lines lw 1.2 dt 2 lc rgb '{}'", colour);
    case FigureCurve::Style::points:
      return fmt::format("with points pt 6 ps 0.6 lc rgb '{}'", colour);
    case FigureCurve::Style::bars:
      return fmt::format("with boxes fs solid 0.6 lc rgb '{}'", colour);
    case FigureCurve::Style::segments:
      return fmt::format("with vectors nohead lw 2 lc rgb '{}'", colour);
  }
  return "";
}

const char* columns(const FigureCurve& curve) {
  return curve.style == FigureCurve::Style::segments ? "1:2:($3-$1):($4-$2)" : "1:2";
}

/// Points take the colour of the line before them if they have no name of their own.
std::string plot_command(const FigurePlot& plot) {
  std::string command = "plot ";
  std::size_t colour = 0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const FigureCurve& curve = plot.curves[i];
    if (i > 0 && !curve.legend.empty()) ++colour;
    const bool unnamed_points = curve.legend.empty() && curve.style == FigureCurve::Style::points;
    const std::string title = curve.legend.empty() ? "notitle" : fmt::format("title '{}'", curve.legend);
    command += fmt::format("{}$d{} using {} {} {}", i > 0 ? ", \\\n  " : "", i, columns(curve),
                           style(curve, unnamed_points ? point_colour : colours[colour % colours.size()]), title);
  }
  return command + "\n";
}

std::string script(const Figure& figure, const FigurePlot& plot, std::size_t index) {
  std::string text = fmt::format(
      "set encoding utf8\nset terminal svg size 560,380 dynamic font 'sans-serif,13' background '#ffffff' name "
      "'f{}_{}'\n"
      "set border 3 lc rgb '#444444'\nset tics nomirror\nset grid lc rgb '#dddddd' lt 1\nset key outside top center "
      "horizontal samplen 1.5\n"
      "set boxwidth 0.6\nset xlabel '{}'\nset ylabel '{}'\n",
      figure.number, index, plot.x_label, plot.y_label);
  if (!plot.title.empty()) text += fmt::format("set title '{}'\n", plot.title);
  text += fmt::format("set xrange {}\nset yrange {}\nset offsets 0, 0, graph 0.05, 0\n", range(plot.x), range(plot.y));
  if (plot.equal_scales) text += "set size ratio -1\nset offsets 0, 0, 0, 0\n";
  if (plot.logarithmic) text += "set logscale xy\nset format '10^{%T}'\nset offsets 0, 0, 0, 0\n";
  for (std::size_t i = 0; i < plot.curves.size(); ++i) text += data_block(figure, plot, plot.curves[i], i);
  return text + plot_command(plot);
}

std::string run_gnuplot(const std::string& path) {
  std::FILE* pipe = popen(fmt::format("gnuplot '{}' 2>&1", path).c_str(), "r");
  if (!pipe) throw std::runtime_error("gnuplot cannot be started");
  std::string text;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw std::runtime_error("gnuplot is not there; install the package gnuplot-nox");
  }
  if (status != 0) throw std::runtime_error("gnuplot failed: " + (text.empty() ? "it said nothing" : text.substr(0, text.find('\n'))));
  return text;
}

/// Without the declarations that only a file of its own may have.
std::string element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

}  // namespace

void require_gnuplot() {
  const TemporaryFile file("print 1\n");
  static_cast<void>(run_gnuplot(file.path()));
}

std::vector<std::string> draw(const Figure& figure) {
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < figure.plots.size(); ++i) {
    const TemporaryFile file(script(figure, figure.plots[i], i));
    pictures.push_back(element(run_gnuplot(file.path())));
  }
  return pictures;
}

}  // namespace clatter::validation
