// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/gnuplot.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/report.hpp"
#include "validation/output/symbols.hpp"

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
  explicit TemporaryFile(const std::string& text) : path_((temporary_folder() / "clatter-XXXXXX").string()) {
    const int file = create();
    if (file < 0)
      throw std::runtime_error("no temporary file can be made in " + temporary_folder().string() + " (TMPDIR)");
    std::FILE* stream = fdopen(file, "w");
    const bool is_whole = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    if (std::fclose(stream) == 0 && is_whole) return;
    remove();
    throw std::runtime_error("a temporary file in " + temporary_folder().string() + " (TMPDIR) cannot be written");
  }
  ~TemporaryFile() { remove(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int create() {
    const SignalsWait no_signal;
    const int file = mkostemp(path_.data(), O_CLOEXEC);
    if (file >= 0) remove_on_interrupt(path_);
    return file;
  }
  void remove() {
    unlink(path_.c_str());
    keep_on_interrupt(path_);
  }

  std::string path_;
};

/// The first line that says something.
std::string first_line(const std::string& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  }
  return "it said nothing";
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const TemporaryFile file(script), complaints("");
  const std::string command = fmt::format("gnuplot -d {} 2>{}", shell_word(file.path()), shell_word(complaints.path()));
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("gnuplot cannot be started");
  std::string text;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw BadInput("gnuplot is not on PATH; install the package gnuplot-nox");
  if (status != 0) throw std::runtime_error("gnuplot failed: " + first_line(complaints.path()));
  return text;
}

std::string run_gnuplot(const std::string& script, const std::string& data) {
  const TemporaryFile file(data);
  return run_gnuplot(fmt::format("data = {}\n{}", gnuplot_quoted(file.path()), script));
}

void require_gnuplot(const std::string& purpose, const std::string& terminal) {
  try {
    static_cast<void>(run_gnuplot(fmt::format("set terminal {}\n", terminal)));
  } catch (const BadInput& error) {
    throw BadInput(purpose + ": " + error.what());
  }
}

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : printable(text)) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

namespace {

// Fewer points that draw the same curve.

/// A point of a curve; not finite: a gap.
struct CurvePoint {
  double x = 0, y = 0;
  double low = 0;               ///< lower end of an area, else 0
  double x_end = 0, y_end = 0;  ///< other end of a segment, else 0
  [[nodiscard]] bool is_gap() const;
};

/// Curves up to this length are drawn whole.
constexpr std::size_t whole_curve = 4000;

constexpr double strips = 1000;
using Place = std::vector<CurvePoint>::const_iterator;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Span span_of(const std::vector<CurvePoint>& points) {
  Span span;
  for (const CurvePoint& point : points) {
    if (point.is_gap()) continue;
    span.low = std::min(span.low, point.x);
    span.high = std::max(span.high, point.x);
  }
  return span;
}

double strip_of(const CurvePoint& point, const Span& span) {
  return std::floor(strips * (point.x - span.low) / (span.high - span.low));
}

/// First, last, highest and lowest of a run.
void keep(Place begin, Place end, std::vector<CurvePoint>& kept) {
  const auto [lowest, highest] =
      std::minmax_element(begin, end, [](const CurvePoint& a, const CurvePoint& b) { return a.y < b.y; });
  for (Place at = begin; at != end; ++at) {
    if (at == begin || at == lowest || at == highest || at + 1 == end) kept.push_back(*at);
  }
}

bool CurvePoint::is_gap() const { return !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(low); }

/// A longer curve: its range in x is cut into a thousand strips, narrower than a pixel.  Of the points that run through
/// a strip one after the other only the first, the last, the highest and the lowest stay, in their order.  A gap ends
/// such a run, so that both ends of each branch stay, and peaks however narrow.
std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& points) {
  if (points.size() <= whole_curve) return points;
  const Span span = span_of(points);
  std::vector<CurvePoint> kept;
  for (Place begin = points.begin(); begin != points.end();) {
    if (begin->is_gap()) {
      kept.push_back(*begin++);
      continue;
    }
    const Place end = std::find_if(begin + 1, points.end(), [&](const CurvePoint& point) {
      return point.is_gap() || strip_of(point, span) != strip_of(*begin, span);
    });
    keep(begin, end, kept);
    begin = end;
  }
  return kept;
}

using Style = FigureCurve::Style;

/// The palette, pale enough for lines on top.
constexpr std::array<const char*, 3> area_colours{"#bcd9ea", "#f6d3ba", "#c4e5da"};
constexpr std::array<int, 6> shapes{6, 2, 4, 8, 10, 12};

std::string range(const Range2& range) {
  const auto bound = [](double value) { return std::isfinite(value) ? shortest(value) : std::string("*"); };
  return fmt::format("[{}:{}]", bound(range.low), bound(range.high));
}

bool within(double x, const Range2& range) { return !(x < range.low) && !(x > range.high); }

/// The number in a column, NaN if the row ends before it or the axis cannot show it.
double number_at(const std::vector<double>& row, std::size_t column, bool logarithmic) {
  if (column >= row.size() || (logarithmic && !(row[column] > 0))) return std::nan("");
  return row[column];
}

std::vector<CurvePoint> points_of(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve) {
  const std::size_t x = column_index(data.columns, curve.x), y = column_index(data.columns, curve.y);
  const bool is_area = curve.style == Style::area;
  const bool is_segment = curve.style == Style::segments;
  const std::size_t low = is_area ? column_index(data.columns, curve.y_low) : 0;
  const std::size_t x_end = is_segment ? column_index(data.columns, curve.x_end) : 0;
  const std::size_t y_end = is_segment ? column_index(data.columns, curve.y_end) : 0;
  std::vector<CurvePoint> points;
  for (const std::vector<double>& row : data.rows) {
    const bool is_chosen = std::all_of(curve.where.begin(), curve.where.end(), [&](const auto& one) {
      return row[column_index(data.columns, one.first)] == one.second;
    });
    if (!is_chosen) continue;
    const double at = plot.x_factor * number_at(row, x, plot.logarithmic_x);
    if (!std::isfinite(at) || !within(at, plot.x)) continue;
    CurvePoint point{at, number_at(row, y, plot.logarithmic_y)};
    if (is_area) point.low = number_at(row, low, false);
    if (is_segment) point.x_end = number_at(row, x_end, false), point.y_end = number_at(row, y_end, false);
    const bool ends_nothing = points.empty() || points.back().is_gap();
    if (!point.is_gap() || !ends_nothing) points.push_back(point);
  }
  return points;
}

bool has_gaps(Style style) {
  return style == Style::line || style == Style::dashed || style == Style::dotted || style == Style::line_points ||
         style == Style::area || style == Style::regions;
}

bool has_numbers(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve) {
  return !points_of(data, plot, curve).empty();  // a gap is only kept after a point
}

bool has_numbers(const PlotData& data, const FigurePlot& plot) {
  return std::any_of(plot.curves.begin(), plot.curves.end(),
                     [&](const FigureCurve& curve) { return has_numbers(data, plot, curve); });
}

std::string column_words(const PlotData& data, const std::string& name) {
  const FigureColumn& column = data.columns[column_index(data.columns, name)];
  return column.quantity + (column.unit == "1" ? "" : fmt::format(" [{}]", column.unit));
}

/// Rows of a curve as a gnuplot data block; gaps become empty lines.
std::string data_block(const PlotData& data, const FigurePlot& plot, const FigureCurve& curve,
                       const std::string& name) {
  const bool is_area = curve.style == Style::area, is_segment = curve.style == Style::segments;
  std::string text = fmt::format("{} << END\n# {}; {}{}\n", name, column_words(data, curve.x),
                                 is_area ? column_words(data, curve.y_low) + "; " : "", column_words(data, curve.y));
  std::vector<CurvePoint> points = points_of(data, plot, curve);
  if (curve.style != Style::regions) points = thinned(points);
  for (const CurvePoint& point : points) {
    if (!point.is_gap()) {
      text += shortest(point.x) + " " + (is_area ? shortest(point.low) + " " : "") + shortest(point.y) +
              (is_segment ? " " + shortest(point.x_end) + " " + shortest(point.y_end) : "") + "\n";
    } else if (has_gaps(curve.style)) {
      text += "\n";
    }
  }
  return text + "END\n";
}

/// How many areas and marks the curves before have used.
struct Used {
  std::size_t areas = 0, marks = 0;

  void add(Style style) {
    if (style == Style::area) ++areas;
    if (style == Style::marks) ++marks;
  }
};

std::string style_text(Style style, const std::string& colour, const Used& used) {
  const auto drawn = [&](const char* how) { return fmt::format("with {} lc rgb '{}'", how, colour); };
  switch (style) {
    case Style::line: return drawn("lines lw 2");
    case Style::dashed: return drawn("lines lw 1.2 dt 2");
    case Style::dotted: return drawn("lines lw 1.5 dt 3");
    case Style::points: return drawn("points pt 6 ps 0.6");
    case Style::squares: return drawn("points pt 4 ps 0.6");
    case Style::crosses: return drawn("points pt 2 ps 0.7");
    case Style::bars: return drawn("boxes fs solid 0.6");
    case Style::line_points: return drawn("linespoints lw 2 pt 7 ps 0.35");
    case Style::marks:
      return drawn(
          fmt::format("points pt {} ps {} lw 1.8", shapes[used.marks % shapes.size()], used.marks == 0 ? 1.5 : 1)
              .c_str());
    case Style::sticks: return drawn("impulses lw 2");
    case Style::regions: return drawn("filledcurves closed fs solid noborder");
    case Style::segments: return "with vectors nohead lw 2 lc palette";
    case Style::area:
      return fmt::format("with filledcurves fs solid noborder lc rgb '{}'",
                         colour.empty() ? area_colours[used.areas % area_colours.size()] : colour);
  }
  return "";
}

const char* columns_text(Style style) {
  if (style == Style::segments) return "1:2:($3-$1):($4-$2):0";
  return style == Style::area ? "1:2:3" : "1:2";
}

/// Least and greatest number of the plot's curves on one axis, widened to whole decades that begin and end `margin`
/// decades or more beyond them.
Range2 decades(const PlotData& data, const FigurePlot& plot, double CurvePoint::*axis, double margin) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const FigureCurve& curve : plot.curves) {
    for (const CurvePoint& point : points_of(data, plot, curve)) {
      if (point.is_gap()) continue;
      least = std::min(least, point.*axis);
      greatest = std::max(greatest, point.*axis);
    }
  }
  if (!(greatest > 0)) return {};
  const double low = std::floor(std::log10(least) - margin), high = std::ceil(std::log10(greatest) + margin);
  return {std::pow(10, low), std::pow(10, std::max(high, low + 1))};
}

/// With both ends, where there is no number to take them from.
Range2 whole_range(const Range2& range) {
  if (std::isfinite(range.low)) return {range.low, std::isfinite(range.high) ? range.high : range.low + 1};
  return std::isfinite(range.high) ? Range2{range.high - 1, range.high} : Range2{0, 1};
}

bool is_given(const Range2& range) { return std::isfinite(range.low) || std::isfinite(range.high); }

/// Tics at 1, 2 and 5 of each decade: within two of them those of the decades alone are too few.
std::string few_tics(const Range2& range) {
  std::vector<std::string> tics;
  for (double decade = std::pow(10, std::floor(std::log10(range.low))); decade <= range.high; decade *= 10) {
    for (const double tic : {decade, 2 * decade, 5 * decade}) {
      if (tic >= range.low && tic <= range.high) tics.push_back(fmt::format("{:.1g}", tic));
    }
  }
  return fmt::format("set format x '%g'\nset xtics ({})\n", fmt::join(tics, ", "));
}

}  // namespace

std::string data_blocks(const PlotData& data, const FigurePlot& plot, const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    if (has_numbers(data, plot, plot.curves[i]))
      text += data_block(data, plot, plot.curves[i], name + std::to_string(i));
  }
  return text;
}

std::string axes_text(const PlotData& data, const FigurePlot& plot) {
  Range2 x = plot.x, y = plot.y;
  if (plot.logarithmic_x && !is_given(x)) x = decades(data, plot, &CurvePoint::x, 0);
  if (plot.logarithmic_y && !is_given(y)) y = decades(data, plot, &CurvePoint::y, 0.2);
  if (!has_numbers(data, plot)) {
    x = whole_range(x);
    y = whole_range(y);
  }
  std::string text = fmt::format("set xlabel {}\n", gnuplot_quoted(plot.x_label));
  if (!plot.title.empty()) text += fmt::format("set title {}\n", gnuplot_quoted(plot.title));
  const bool logarithmic = plot.logarithmic_x || plot.logarithmic_y;
  text += fmt::format("set xrange {}\nset yrange {}\nset offsets 0, 0, {}, 0\n", range(x), range(y),
                      logarithmic ? "0" : "graph 0.05");
  const bool has_segments = std::any_of(plot.curves.begin(), plot.curves.end(),
                                        [](const FigureCurve& curve) { return curve.style == Style::segments; });
  if (has_segments) text += "set palette defined (0 '#c6dbef', 1 '#0072b2', 2 '#08306b')\nunset colorbox\n";
  if (plot.equal_scales) text += "set size ratio -1\nset offsets 0, 0, 0, 0\n";
  if (plot.no_axes) text += "unset border\nunset tics\nunset grid\n";
  if (plot.ring) {
    text +=
        "set label 11 '0°' at 1.05, 0 left\nset label 12 '90°' at 0, 1.14 "
        "center\nset label 13 '180°' at -1.05, 0 right\nset label 14 '270°' at 0, -1.14 center\n";
  }
  if (plot.logarithmic_x)
    text += "set logscale x\n" + (x.high < 200 * x.low ? few_tics(x) : "set format x '10^{%T}'\n");
  if (plot.logarithmic_y) text += "set logscale y\nset format y '10^{%T}'\n";
  return text;
}

std::string plot_command(const PlotData& data, const FigurePlot& plot, const std::string& name) {
  if (!has_numbers(data, plot))
    return "set label 9 'no number to draw here' at graph 0.5, graph 0.5 center\nplot NaN notitle\nunset label 9\n";
  std::string command = "plot ", separator;
  const std::vector<std::string> colours = curve_colours(plot);
  Used used;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const FigureCurve& curve = plot.curves[i];
    if (!has_numbers(data, plot, curve)) continue;
    const std::string title = curve.legend.empty() ? "notitle" : "title " + gnuplot_quoted(curve.legend);
    const std::string every = curve.every > 1 ? fmt::format("every {} ", curve.every) : "";
    command += fmt::format("{}{}{} {}using {} {} {}", separator, name, i, every, columns_text(curve.style),
                           style_text(curve.style, colours[i], used), title);
    separator = ", \\\n  ";
    used.add(curve.style);
    if (curve.style == Style::sticks) {
      command +=
          fmt::format("{}{}{} using 1:2 with points pt 7 ps 0.5 lc rgb '{}' notitle", separator, name, i, colours[i]);
    }
  }
  return command + "\n";
}

}  // namespace clatter::validation
