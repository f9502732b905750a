// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>
#include <unordered_map>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/palette.hpp"

namespace clatter::validation {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr int fold_points = 241;
constexpr long long least_side = 360;
constexpr std::string_view at_least = ">=";

struct Colour {
  std::array<std::uint8_t, 3> parts{};

  explicit Colour(const char* hex) {
    for (std::size_t i = 0; i < 3; ++i)
      parts[i] = static_cast<std::uint8_t>(std::strtol(std::string(hex + 1 + 2 * i, 2).c_str(), nullptr, 16));
  }
};

double number_in(const std::string& text) { return text.empty() ? missing : std::strtod(text.c_str(), nullptr); }

/// The number of a count's words: infinite ones are inf, none nan.
double count_in(const std::string& text) {
  if (text == "infinite") return std::numeric_limits<double>::infinity();
  if (text.starts_with(at_least)) return number_in(text.substr(at_least.size()));
  return text.find_first_not_of("0123456789") == std::string::npos ? number_in(text) : missing;
}

bool is_count(const MapQuantity& quantity) {
  const std::string name = quantity.name;
  return name == "impacts" || name == "hardest";
}

/// Where a class stands in the legend: counts by their size, then what has none.
struct ClassOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    const auto rank = [](const std::string& text) {
      const double count = count_in(text);
      return std::isnan(count) ? 1e300 : std::fmin(count, 1e200) + (text.starts_with(at_least) ? 0.5 : 0);
    };
    return std::pair(rank(a), std::string_view(a)) < std::pair(rank(b), std::string_view(b));
  }
};

using Legend = std::map<std::string, const char*, ClassOrder>;

const char* class_colour(const std::string& text, std::size_t place) {
  if (text == "infinite") return palette::infinite;
  if (text.starts_with(at_least) || text == "goes on") return palette::beyond;
  if (text == "refused" || text == "outside-model" || text == "not-computed") return palette::refused;
  const double count = count_in(text);
  const std::size_t index = std::isnan(count) ? place : static_cast<std::size_t>(count) - 1;
  return palette::classes[std::min(index, palette::classes.size() - 1)];
}

/// The image's classes with their colours.
Legend legend_of(const MapImage& image) {
  Legend legend;
  for (const auto& row : image.rows) {
    const std::string* last = nullptr;
    for (const MapPixel& pixel : row) {
      if (!last || *last != pixel.value) legend.try_emplace(pixel.value, nullptr);
      last = &pixel.value;
    }
  }
  std::size_t place = 0;
  for (auto& [text, colour] : legend) colour = class_colour(text, place++);
  return legend;
}

/// The numbers that the colours span: all but half a per cent at either end, which may lie far off.
struct Span {
  double low = 0, high = 1;
  bool is_clipped = false;

  explicit Span(const MapImage& image) {
    std::vector<double> numbers;
    for (const auto& row : image.rows) {
      for (const MapPixel& pixel : row) {
        const double number = number_in(pixel.value);
        if (std::isfinite(number)) numbers.push_back(number);
      }
    }
    if (numbers.empty()) return;
    const auto at = [&](std::size_t i) {
      std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(i), numbers.end());
      return numbers[i];
    };
    const double least = at(0), most = at(numbers.size() - 1);
    low = at(numbers.size() / 200);
    high = at(numbers.size() - 1 - numbers.size() / 200);
    is_clipped = most - least > 1.5 * (high - low) && high > low;
    if (!is_clipped) low = least, high = most;
    if (!(high > low)) high = low + std::fmax(1e-9 * std::fabs(low), 1e-300);
  }
};

Colour mixed(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (palette::numbers.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), palette::numbers.size() - 2);
  const Colour first(palette::numbers[i]), second(palette::numbers[i + 1]);
  Colour colour = first;
  for (std::size_t k = 0; k < 3; ++k) {
    const double rest = place - static_cast<double>(i);
    colour.parts[k] = static_cast<std::uint8_t>(std::lround(first.parts[k] * (1 - rest) + second.parts[k] * rest));
  }
  return colour;
}

void append(const Colour& colour, std::string& out) { out.append(colour.parts.begin(), colour.parts.end()); }

std::string class_bytes(const MapImage& image, const Legend& legend) {
  std::unordered_map<std::string, Colour> colours;
  for (const auto& [text, colour] : legend) colours.emplace(text, colour);
  const Colour open(palette::open);
  std::string bytes;
  for (const auto& row : image.rows) {
    for (const MapPixel& pixel : row) append(pixel.is_open ? open : colours.at(pixel.value), bytes);
  }
  return bytes;
}

std::string number_bytes(const MapPlan& plan, const MapImage& image, const Span& span) {
  std::vector<Colour> scale;
  for (int i = 0; i <= 1023; ++i) scale.push_back(mixed(i / 1023.0));
  const Colour open(palette::open), none(palette::refused);
  std::string bytes;
  for (const auto& row : image.rows) {
    for (const MapPixel& pixel : row) {
      const double number = number_in(pixel.value) / (plan.counts() ? static_cast<double>(plan.samples) : 1);
      const double part = std::clamp((number - span.low) / (span.high - span.low), 0.0, 1.0);
      if (pixel.is_open) append(open, bytes);
      else if (std::isnan(number)) append(none, bytes);
      else append(scale[static_cast<std::size_t>(part * 1023)], bytes);
    }
  }
  return bytes;
}

/// A number's place on an axis of the picture.
double placed(const SweepAxis& axis, double value) { return axis.logarithmic ? std::log10(value) : value; }

/// Range, and on a logarithmic axis its decades.
std::string axis_text(const SweepAxis& axis, char name) {
  std::string text = fmt::format("set {}range [{}:{}]\nset {}label {} noenhanced\n", name, placed(axis, axis.first),
                                 placed(axis, axis.last), name, gnuplot_quoted(axis_words(axis.key)));
  if (!axis.logarithmic) return text;
  std::string tics;
  const int first = static_cast<int>(std::ceil(placed(axis, axis.first) - 1e-9));
  for (int k = first; k <= placed(axis, axis.last) + 1e-9; ++k)
    tics += fmt::format("{}'10^{{{}}}' {}", tics.empty() ? "" : ", ", k, k);
  return text + fmt::format("set {}tics ({})\n", name, tics);
}

std::string heading(const MapPlan& plan) {
  const std::string unit = plan.quantity->unit;
  if (plan.counts()) return fmt::format("probability of {} {}", plan.quantity->words, plan.wanted);
  return unit.empty() ? plan.quantity->words : fmt::format("{} [{}]", plan.quantity->words, unit);
}

std::string colour_bar(const MapPlan& plan, const Span& span) {
  std::string steps;
  for (std::size_t i = 0; i < palette::numbers.size(); ++i)
    steps += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, palette::numbers[i]);
  return fmt::format("set palette defined ({})\nset cbrange [{}:{}]\nset cblabel {} noenhanced\n", steps, span.low,
                     span.high, gnuplot_quoted(heading(plan) + (span.is_clipped ? ", ends clipped" : "")));
}

/// Curves as data blocks, and what the plot command says of them.
std::string curve_blocks(const MapPlan& plan, const std::vector<FoldCurve>& curves) {
  std::string text;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    text += fmt::format("$fold{} << EOD\n", i);
    for (const auto& [x, y] : curves[i].points) {
      if (std::isfinite(x) && std::isfinite(y))
        text += fmt::format("{} {}\n", placed(plan.across(), x), placed(plan.upward(), y));
      else text += "\n";
    }
    text += "EOD\n";
  }
  return text;
}

std::string curve_commands(const std::vector<FoldCurve>& curves, double scale) {
  std::string text;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* const dash = i == 0 ? "1" : "2";
    text += fmt::format(
        ", \\\n  $fold{} with lines lw {} lc rgb '#ffffff' notitle, $fold{} with lines lw {} dt {} lc rgb "
        "'{}' title {}",
        i, 3.2 * scale, i, 1.4 * scale, dash, palette::ink, gnuplot_quoted(curves[i].name));
  }
  return text;
}

std::vector<std::string> lines_of(const std::string& words, double columns) {
  std::vector<std::string> lines;
  std::istringstream stream(wrapped(words, static_cast<std::size_t>(columns), ""));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The picture's parts in pixels.  A small map's pixels are squares, so that there is room for the words beside it;
/// those of a narrow one are only as wide and as high as that takes.
struct Sheet {
  long long across, upward;  ///< sides of a pixel of the map
  double scale, left, right, width;
  std::vector<std::string> subtitles;
  double top, bottom, height;

  /// @param below  entries of a legend below the map
  Sheet(const MapPlan& plan, const std::string& words, std::size_t below)
      : across(side(plan.columns, plan.rows)), upward(side(plan.rows, plan.columns)),
        scale(std::clamp(static_cast<double>(plan.rows * upward) / 600, 0.75, 3.0)), left(115 * scale),
        right(250 * scale), width(left + static_cast<double>(plan.columns * across) + right),
        subtitles(lines_of(words, (width - left) / (8.2 * scale))),
        top((40 + 17 * static_cast<double>(subtitles.size())) * scale),
        bottom((72 + 20 * static_cast<double>(below)) * scale),
        height(top + static_cast<double>(plan.rows * upward) + bottom) {}

  /// The side of a pixel, where the map has so many along it and so many beside it.
  static long long side(long long along, long long beside) {
    const long long square = std::max({1LL, least_side / along, least_side / beside});
    return along * square <= 4 * least_side ? square : std::max(1LL, least_side / along);
  }

  [[nodiscard]] std::string text() const {
    return fmt::format(
        "set encoding utf8\nset terminal pngcairo size {:.0f},{:.0f} font 'sans-serif,{:.0f}' background '#ffffff'\n"
        "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n"
        "set border lc rgb '{}' lw {}\nset tics out nomirror\n",
        width, height, 13 * scale, left / width, 1 - right / width, bottom / height, 1 - top / height, palette::ink,
        scale);
  }
};

/// All that the map was made of.
std::string words_of(const MapPlan& plan, const MapImage& image) {
  const long long open = image.open();
  std::string words = open > 0 ? fmt::format("{} pixels left open by rounding or a fold", open) : "";
  for (const std::string& line : plan.report().head) words += (words.empty() ? "" : "; ") + line;
  return words;
}

std::string title_text(const MapPlan& plan, const Sheet& sheet) {
  const auto label = [&](int n, const std::string& words, double up, const char* font) {
    return fmt::format("set label {} {} at screen {}, screen {} left noenhanced font '{},{:.0f}'\n", n,
                       gnuplot_quoted(words), sheet.left / sheet.width, 1 - up * sheet.scale / sheet.height, font,
                       (n == 1 ? 15 : 11) * sheet.scale);
  };
  std::string text = label(1, plan.counts() ? heading(plan) : plan.quantity->words, 20, "sans-serif Bold");
  int n = 1;
  for (const std::string& line : sheet.subtitles) {
    text += label(n + 1, line, 26 + 17 * n, "sans-serif");
    ++n;
  }
  return text;
}

const char* impact_word(const std::string& text) { return text == "1" ? " impact" : " impacts"; }

std::string class_word(const MapQuantity& quantity, const std::string& text) {
  if (std::string(quantity.name) == "impacts" && text == "infinite") return "infinitely many";
  const bool counts = std::string(quantity.name) == "impacts" && !std::isnan(count_in(text));
  if (counts) return (text.starts_with(at_least) ? "≥ " + text.substr(2) : text) + impact_word(text);
  if (quantity.tells_rest() && text == "none") return "no face";
  return std::string(quantity.name) == "hardest" ? "impact " + text : text;
}

/// Whether a pixel has neither class nor number.
bool has_empty(const MapImage& image) {
  const auto has_none = [](const MapPixel& pixel) { return pixel.value.empty(); };
  return std::ranges::any_of(image.rows, [&](const auto& row) { return std::ranges::any_of(row, has_none); });
}

/// What stands beside the colours: the classes, then what is open and, of numbers, what has none.
std::string legend_commands(const MapPlan& plan, const MapImage& image, const Legend& legend, double scale) {
  std::string text;
  const auto entry = [&](const char* colour, const std::string& words) {
    text += fmt::format(", \\\n  NaN with points pt 5 ps {} lc rgb '{}' title {}", 2.2 * scale, colour,
                        gnuplot_quoted(words));
  };
  // Classes of one colour have one entry: the least of counts stands for all.
  std::vector<std::pair<const char*, std::string>> entries;
  for (const auto& [words, colour] : legend) {
    const auto same = std::ranges::find(entries, colour, &std::pair<const char*, std::string>::first);
    if (same == entries.end()) entries.emplace_back(colour, class_word(*plan.quantity, words));
    else if (colour == palette::refused) same->second += ", " + words;
    else if (colour == palette::classes.back())
      same->second = is_count(*plan.quantity) ? fmt::format("{} and more", palette::classes.size()) : "others";
  }
  for (const auto& [colour, words] : entries) entry(colour, words);
  if (image.open() > 0) entry(palette::open, "left open");
  if (legend.empty() && has_empty(image)) entry(palette::refused, "no drop, or no number");
  return text;
}

/// The thin rod's parameters of a drop; none where its angles do not depend on them alone.
std::optional<analytic::RodParameters> rod_of(const DiscreteDrop& drop) {
  const auto* planar = std::get_if<analytic::Drop>(&drop);
  using analytic::FrictionKind;
  if (!planar || !planar->body.uniform_thin_rod || planar->velocity.angular != 0 || !(planar->velocity.normal < 0) ||
      planar->law.law != analytic::RestitutionLaw::newton ||
      (planar->law.has_cone() && planar->law.friction_value != 0)) {
    return {};
  }
  const double length = 2 * planar->body.reach(), fall = planar->velocity.normal;
  return analytic::RodParameters{.gravity_number = planar->gravity * length / (fall * fall),
                                 .restitution = planar->law.restitution,
                                 .impulse_ratio = planar->law.friction_value};
}

/// The angle at which the impact ends, in degrees; NaN where it does not, or the scene has no drop.
double fold_angle(const MapPlan& plan, analytic::ImpactNumber impact, const std::vector<double>& values) {
  using analytic::BoundaryKind;
  try {
    Scene scene = plan.sweep.scene;
    plan.sweep.put_point(values, scene);
    const auto rod = rod_of(discrete_drop(scene));
    if (!rod) return missing;
    const auto found = analytic::regime_boundary(impact, *rod);
    const bool ends = found.kind != BoundaryKind::always && found.kind != BoundaryKind::never;
    return ends ? found.theta * analytic::degrees_per_radian : missing;
  } catch (const std::exception&) {
    return missing;  // at e = 0 and beyond jamming there is no boundary to draw
  }
}

}  // namespace

long long MapImage::open() const {
  long long count = 0;
  for (const auto& row : rows) count += std::ranges::count_if(row, &MapPixel::is_open);
  return count;
}

long long MapImage::without_drop() const {
  const auto has_none = [](const MapPixel& pixel) {
    using analytic::BatchEnd;
    return std::ranges::any_of(std::array{BatchEnd::refused, BatchEnd::outside, BatchEnd::not_computed},
                               [&](BatchEnd end) { return pixel.value == end_words(end); });
  };
  long long count = 0;
  for (const auto& row : rows) count += std::ranges::count_if(row, has_none);
  return count;
}

std::vector<FoldCurve> fold_curves(const MapPlan& plan) {
  const bool is_across = plan.across().key == "drop.angle_deg";
  if (!is_across && plan.upward().key != "drop.angle_deg") return {};
  const SweepAxis &angle = is_across ? plan.across() : plan.upward(),
                  &other = is_across ? plan.upward() : plan.across();
  std::vector<FoldCurve> curves{{"second impact ends", {}}, {"third impact ends", {}}};
  for (std::size_t k = 0; k < curves.size(); ++k) {
    for (int i = 0; i < fold_points; ++i) {
      const double value = other.drawn(i / (fold_points - 1.0));
      std::vector<double> values{angle.first, value};
      if (!is_across) std::swap(values[0], values[1]);
      double theta = fold_angle(plan, k == 0 ? analytic::ImpactNumber::second : analytic::ImpactNumber::third, values);
      if (theta < angle.first || theta > angle.last) theta = missing;
      curves[k].points.push_back(is_across ? std::array{theta, value} : std::array{value, theta});
    }
  }
  std::erase_if(curves, [](const FoldCurve& curve) {  // one point, without friction say, is no curve
    const auto is_missing = [](const auto& at) { return !(std::isfinite(at[0]) && std::isfinite(at[1])); };
    return std::ranges::adjacent_find(curve.points, [&](const auto& one, const auto& next) {
             return !is_missing(one) && !is_missing(next);
           }) == curve.points.end();
  });
  return curves;
}

namespace {

/// The legend stands beside a map of classes, in one column; curves alone have theirs below the map.
/// @param others  entries that are no classes, about
std::string key_text(const Sheet& sheet, const Legend& legend, std::size_t others) {
  if (legend.empty()) {
    return others == 0 ? "unset key\n"
                       : fmt::format("set key at screen {}, screen {} left bottom Left reverse vertical samplen 1.6\n",
                                     sheet.left / sheet.width, 6 * sheet.scale / sheet.height);
  }
  const double entries = static_cast<double>(std::min(legend.size(), palette::classes.size() + 4) + others);
  const double room = (sheet.height - sheet.top - sheet.bottom) / (entries * 22 * sheet.scale);
  return fmt::format("set key at screen {}, screen {} left top Left reverse vertical samplen 1.6 spacing {}\n",
                     1 - (sheet.right - 16 * sheet.scale) / sheet.width, 1 - sheet.top / sheet.height,
                     std::clamp(room, 0.7, 1.4));
}

/// Each pixel of three bytes as a rectangle.
std::string magnified(const std::string& bytes, long long columns, const Sheet& sheet) {
  if (sheet.across == 1 && sheet.upward == 1) return bytes;
  std::string out;
  const auto width = static_cast<std::size_t>(3 * columns);
  for (std::size_t begin = 0; begin < bytes.size(); begin += width) {
    std::string line;
    for (std::size_t i = begin; i < begin + width; i += 3) {
      for (long long k = 0; k < sheet.across; ++k) line.append(bytes, i, 3);
    }
    for (long long k = 0; k < sheet.upward; ++k) out += line;
  }
  return out;
}

}  // namespace

std::string map_picture(const MapPlan& plan, const MapImage& image) {
  const bool has_classes = plan.quantity->is_class() && !plan.counts();
  const Legend legend = has_classes ? legend_of(image) : Legend{};
  const std::vector<FoldCurve> curves = plan.counts() ? std::vector<FoldCurve>{} : fold_curves(plan);
  const std::size_t others = curves.size() + (image.open() > 0 ? 1 : 0) + (!has_classes && has_empty(image) ? 1 : 0);
  const Sheet sheet(plan, words_of(plan, image), has_classes ? 0 : others);
  std::string script = sheet.text() + axis_text(plan.across(), 'x') + axis_text(plan.upward(), 'y') +
                       title_text(plan, sheet) + curve_blocks(plan, curves);
  std::string bytes, rest;
  if (has_classes) {
    bytes = class_bytes(image, legend);
  } else {
    Span span(image);
    if (plan.counts()) span.low = 0, span.high = 1, span.is_clipped = false;
    script += colour_bar(plan, span);
    bytes = number_bytes(plan, image, span);
    rest = ", \\\n  NaN with points palette notitle";
  }
  const std::string entries = legend_commands(plan, image, legend, sheet.scale);
  script += key_text(sheet, legend, others);
  const long long columns = plan.columns * sheet.across, rows = plan.rows * sheet.upward;
  const double left = placed(plan.across(), plan.across().first), right = placed(plan.across(), plan.across().last);
  const double low = placed(plan.upward(), plan.upward().first), high = placed(plan.upward(), plan.upward().last);
  const double dx = (right - left) / static_cast<double>(columns), dy = (high - low) / static_cast<double>(rows);
  script += fmt::format(
      "plot data binary array=({},{}) format='%uchar%uchar%uchar' origin=({},{}) dx={} dy={} using 1:2:3 with rgbimage "
      "notitle{}{}\n",
      columns, rows, left + dx / 2, low + dy / 2, dx, dy, rest + entries, curve_commands(curves, sheet.scale));
  return run_gnuplot(script, magnified(bytes, plan.columns, sheet));
}

namespace {

/// The head of a file in NumPy's format 1.0.
std::string array_head(const std::string& type, const std::string& shape) {
  std::string head = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  head.resize((head.size() + 11 + 63) / 64 * 64 - 11, ' ');
  head += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(head.size() & 0xff);
  out += static_cast<char>(head.size() >> 8);
  return out + head;
}

/// All numbers of a map that number(pixel) gives, as bytes.
template <class Number>
std::string numbers_of(const MapImage& image, Number&& number) {
  std::string out;
  for (const auto& row : image.rows) {
    for (const MapPixel& pixel : row) {
      const auto bytes = std::bit_cast<std::array<char, sizeof(double)>>(number(pixel));
      out.append(bytes.begin(), bytes.end());
    }
  }
  return out;
}

std::string named_array(const MapImage& image, const std::string& shape) {
  const auto name = [](const MapPixel& pixel) { return pixel.is_open ? std::string("open") : pixel.value; };
  std::size_t width = 1;
  for (const auto& row : image.rows) {
    for (const MapPixel& pixel : row) width = std::max(width, name(pixel).size());
  }
  std::string out = array_head(fmt::format("|S{}", width), shape);
  for (const auto& row : image.rows) {
    for (const MapPixel& pixel : row) out += name(pixel) + std::string(width - name(pixel).size(), '\0');
  }
  return out;
}

}  // namespace

std::string map_array(const MapPlan& plan, const MapImage& image) {
  const std::string shape = fmt::format("{}, {}", plan.rows, plan.columns);
  if (plan.counts()) {
    std::string out = array_head("<f8", "3, " + shape);
    for (const auto part : {&Wilson::part, &Wilson::low, &Wilson::high}) {
      out += numbers_of(image, [&](const MapPixel& pixel) {
        return Wilson(std::strtoll(pixel.value.c_str(), nullptr, 10), plan.samples).*part;
      });
    }
    return out;
  }
  const bool has_counts = is_count(*plan.quantity);
  if (plan.quantity->is_class() && !has_counts) return named_array(image, shape);
  return array_head("<f8", shape) + numbers_of(image, [&](const MapPixel& pixel) {
           return pixel.is_open ? missing : has_counts ? count_in(pixel.value) : number_in(pixel.value);
         });
}

}  // namespace clatter::validation
