// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps: values of the scenes, order of the rows, and what a run finds of an earlier one.
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "numeric/base/errors.hpp"
#include "tests/support.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/keys.hpp"
#include "validation/sweep/points.hpp"
#include "validation/sweep/sweep_file.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace {

std::function<void()> before_lock;  ///< runs once, when a file is about to be locked

}  // namespace

/// The system's, after the test's interference.
extern "C" int flock(int file, int operation) noexcept {
  if (const auto interfere = std::exchange(before_lock, nullptr)) interfere();
  return static_cast<int>(syscall(SYS_flock, file, operation));
}

namespace {

using namespace clatter::validation;

using clatter::test::mentions;

std::vector<double> values_of(const SweepPoints& points, long long point) {
  std::vector<double> values;
  points.at(point, values);
  return values;
}

/// A folder that goes away with its files.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("clatter_sweep_test." + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::string at(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

void write_text(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

const SweepFileForm form{.head = "# head\nindex,x\n", .scenes = 10};

using Found = std::pair<long long, std::string>;

/// What a new run finds once the part or its digests have been changed: the scenes that are done and what is left of
/// the text.  The part was "0,1\n" for scene 0, then "1,1\n2,1\n" for scenes 1 and 2, then "3,1\n3,2\n" for scene 3.
Found found_after(const std::function<void(const std::string& part)>& change, bool restart = false) {
  const Folder folder;
  const std::string path = folder.at("out.csv"), part = path + ".part";
  {
    SweepFile file(path, form, false);
    file.write("0,1\n", 1);
    file.flush();
    file.write("1,1\n2,1\n", 2);
    file.flush();
    file.write("3,1\n3,2\n", 1);
    file.flush();
  }
  change(part);
  const SweepFile file(path, form, restart);
  return {file.scenes(), text_of(part)};
}

void replace_text(const std::string& path, const std::string& before, const std::string& after) {
  std::string text = text_of(path);
  text.replace(text.find(before), before.size(), after);
  write_text(path, text);
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_numbers_begin_with_the_known_answer_of_the_authors_of_philox) {
  // Counter 0 and key 0 give 6627e8d5 e169c58d bc57ac4c 9b00dbd8; a number is made of the first 53 bits.
  BOOST_TEST(uniform_at(0, 0, 0) == static_cast<double>(0x6627e8d5e169c58dULL >> 11) * 0x1p-53);
  BOOST_TEST(uniform_at(0, 0, 1) != uniform_at(0, 0, 0));
  BOOST_TEST(uniform_at(0, 0, 0, 1) != uniform_at(0, 0, 0));
  BOOST_TEST(uniform_at(0, 0, 0, 1) != uniform_at(0, 0, 1));
  BOOST_TEST(uniform_at(0, 1ULL << 32, 0) != uniform_at(0, 0, 0));
  BOOST_TEST(uniform_at(1ULL << 32, 0, 0) != uniform_at(0, 0, 0));
}

BOOST_AUTO_TEST_CASE(a_grid_has_clean_decimals_and_both_its_ends) {
  const SweepAxis up = read_grid_axis("k", "0:1:0.1", false);
  BOOST_TEST(up.count == 11);
  for (int i = 0; i <= 10; ++i)
    BOOST_TEST(up.at(i) == std::stod(std::to_string(i / 10) + "." + std::to_string(i % 10)));
  const SweepAxis down = read_grid_axis("k", "3:-2.5:-1", false);
  BOOST_TEST(down.count == 6);
  BOOST_TEST(down.at(5) == -2);
  BOOST_TEST(down.last == -2);
  BOOST_TEST(read_grid_axis("k", "5:5:1", false).count == 1);
  // The first value is the one given, to its last digit.
  BOOST_TEST(read_grid_axis("k", "0.12345678901234568:1:0.5", false).at(0) == 0.12345678901234568);
}

BOOST_AUTO_TEST_CASE(a_logarithmic_grid_has_clean_decades_and_both_its_ends) {
  const SweepAxis decades = read_grid_axis("k", "1e-3:1e4:log:8", false);
  BOOST_TEST(decades.count == 8);
  for (int i = 0; i < 8; ++i) BOOST_TEST(decades.at(i) == std::stod("1e" + std::to_string(i - 3)));
  const SweepAxis fine = read_grid_axis("k", "0:90:lin:10001", false);
  BOOST_TEST(fine.count == 10001);
  BOOST_TEST(fine.at(0) == 0.);
  BOOST_TEST(fine.at(1) == 0.009);
  BOOST_TEST(fine.at(5000) == 45.);
  BOOST_TEST(fine.at(10000) == 90.);
  const SweepAxis falling = read_grid_axis("k", "1:0:lin:4", false);
  BOOST_TEST(falling.at(1) == 0.666666666666667);
  BOOST_TEST(falling.at(3) == 0.);
  BOOST_TEST(read_grid_axis("k", "1:9:lin:5", true).at(3) == 7.);
  const SweepAxis down = read_grid_axis("k", "-300:-7:log:5", false);
  BOOST_TEST(down.at(0) == -300);
  BOOST_TEST(down.at(4) == -7);
  for (int i = 1; i < 4; ++i)
    BOOST_TEST(down.at(i) / down.at(i - 1) == down.at(i + 1) / down.at(i), boost::test_tools::tolerance(1e-13));
  const SweepAxis extreme = read_grid_axis("k", "1e-200:1e-190:log:2", false);
  BOOST_TEST(extreme.at(0) == 1e-200);
  BOOST_TEST(extreme.at(1) == 1e-190);
}

BOOST_AUTO_TEST_CASE(a_list_is_taken_value_by_value) {
  const SweepAxis list = read_grid_axis("k", "20,10,45.5", false);
  BOOST_TEST((list.count == 3 && list.at(0) == 20 && list.at(1) == 10 && list.at(2) == 45.5));
  BOOST_TEST((list.first == 10 && list.last == 45.5));  // the ends are what the scene is checked at
}

BOOST_AUTO_TEST_CASE(axes_that_make_no_sense_are_refused_by_name) {
  const auto refused = [](const char* why, const std::vector<const char*>& texts, bool whole, auto read) {
    for (const char* text : texts) {
      CHECK_REFUSED_SAYING(read("key", text, whole), BadInput, why);
      CHECK_REFUSED_SAYING(read("key", text, whole), BadInput, "key=");
    }
  };
  refused("FROM:TO:STEP", {"1:2", "1:2:3:4"}, false, read_grid_axis);
  refused("STEP must not be 0", {"1:2:0"}, false, read_grid_axis);
  refused("sign", {"1:2:-1", "2:1:1", "0:1:log:3", "-1:1:log:3"}, false, read_grid_axis);
  refused("FROM", {"nan:2:1"}, false, read_grid_axis);
  refused("TO", {"1:inf:1", "1::1"}, false, read_grid_axis);
  refused("STEP", {"1:2:"}, false, read_grid_axis);
  refused("more than 1000000000 scenes", {"0:1:1e-10", "1:2:log:2e9", "-1e308:1e308:1"}, false, read_grid_axis);
  refused("each value of a list", {"1,,2", "1,2:3"}, false, read_grid_axis);
  refused("COUNT", {"1:2:log:1", "1:2:log:2.5", "1:2:lin:1", "1:2:lin:x"}, false, read_grid_axis);
  refused("whole", {"1,2.5", "1:8:log:4", "1:2:0.5", "1:4:lin:3"}, true, read_grid_axis);
  refused("LOW:HIGH", {"1:2:3"}, false, read_random_axis);
  refused("LOW", {"nan:1"}, false, read_random_axis);
  refused("greater", {"2:1", "0:1:log"}, false, read_random_axis);
  refused("whole", {"1:2:log"}, true, read_random_axis);
  const SweepAxis wide = read_grid_axis("key", "1:100000:1", false);
  CHECK_REFUSED_SAYING(SweepPoints({wide, wide}), BadInput, "more than 1000000000 scenes");
}

BOOST_AUTO_TEST_CASE(random_values_depend_on_seed_and_scene_alone) {
  const std::vector<SweepAxis> axes{read_random_axis("a", "-1:3", false), read_random_axis("b", "1e-3:1e3:log", false),
                                    read_random_axis("c", "2:4", true)};
  const SweepPoints many(axes, 1000, 7), few(axes, 10, 7), other(axes, 1000, 8);
  std::set<double> first;
  for (long long i = 999; i >= 0; --i) {  // backwards: no scene knows of another
    const std::vector<double> values = values_of(many, i);
    if (i < 10) BOOST_TEST(values == values_of(few, i));
    BOOST_TEST(values != values_of(other, i));
    BOOST_TEST((values[0] >= -1 && values[0] <= 3));
    BOOST_TEST((values[1] >= 1e-3 && values[1] <= 1e3));
    BOOST_TEST((values[2] == 2 || values[2] == 3 || values[2] == 4));
    first.insert(values[0]);
  }
  BOOST_TEST(first.size() == 1000u);
  // Another axis leaves the ones before it as they are.
  const SweepAxis any{.key = "drop.attitude", .any_attitude = true};
  const SweepPoints fewer_axes({axes[0]}, 1000, 7), attitudes({axes[0], any}, 1000, 7), others({axes[0], any}, 10, 8);
  BOOST_TEST(values_of(fewer_axes, 5)[0] == values_of(many, 5)[0]);
  BOOST_TEST(values_of(attitudes, 5)[0] == values_of(many, 5)[0]);
  BOOST_TEST(values_of(attitudes, 5) == values_of(SweepPoints({axes[0], any}, 10, 7), 5));
  BOOST_TEST(values_of(attitudes, 5) != values_of(others, 5));
}

/// The largest distance of the values' distribution from the one on [0, 1], times √n: Kolmogorov's statistic.
double kolmogorov(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto before = static_cast<double>(i);
    distance = std::max({distance, values[i] - before / n, (before + 1) / n - values[i]});
  }
  return distance * std::sqrt(n);
}

/// Of rotations that are uniform, one in 10⁶ samples has a larger statistic: 2 exp(−2 D²) = 1e-6.
const double allowed_statistic = std::sqrt(std::log(2e6) / 2);

BOOST_AUTO_TEST_CASE(numbers_fill_their_ranges_evenly_and_attitudes_have_the_angles_and_axes_of_uniform_rotations) {
  constexpr int n = 20'000;
  SweepAxis attitudes{.key = "drop.attitude", .any_attitude = true};
  const SweepAxis number = read_random_axis("a", "-1:3", false), decades = read_random_axis("b", "1e-3:1e3:log", false);
  const SweepPoints points({number, decades, attitudes}, n, 1);
  enum { numbers, logarithms, sums, angles, turns, heights, azimuths, samples };
  std::vector<double> sample[samples], values, by_angle;
  for (int i = 0; i < n; ++i) {
    points.at(i, values);
    BOOST_REQUIRE(values.size() == 6u);
    const double w = values[2], x = values[3], y = values[4], z = values[5];
    BOOST_REQUIRE(std::fabs(w * w + x * x + y * y + z * z - 1) <= 1e-15 * 8);
    BOOST_REQUIRE(w >= 0);
    sample[numbers].push_back((values[0] + 1) / 4);
    sample[logarithms].push_back((std::log10(values[1]) + 3) / 6);
    const double sum = sample[numbers].back() + sample[logarithms].back();  // the axes do not know of each other
    sample[sums].push_back(sum < 1 ? sum * sum / 2 : 1 - (2 - sum) * (2 - sum) / 2);
    const double angle = 2 * std::atan2(std::hypot(x, y, z), w);
    sample[angles].push_back((angle - std::sin(angle)) / std::numbers::pi);  // of the density (1 − cos θ)/π
    sample[turns].push_back((std::atan2(y, x) / std::numbers::pi + 1) / 2);  // about which axis
    // Where the body's x axis points: its height is uniform on a sphere, as Archimedes knew.
    sample[heights].push_back((2 * (x * z - w * y) + 1) / 2);
    sample[azimuths].push_back((std::atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z)) / std::numbers::pi + 1) / 2);
    // Angles uniform in [0, π] are what drawing an axis and an angle would give: the test sees them.
    const double other = uniform_at(1, i, 0) * std::numbers::pi;
    by_angle.push_back((other - std::sin(other)) / std::numbers::pi);
  }
  for (int k = 0; k < samples; ++k) BOOST_TEST(kolmogorov(sample[k]) <= allowed_statistic, k);
  BOOST_TEST(kolmogorov(by_angle) > 5 * allowed_statistic);
}

BOOST_AUTO_TEST_CASE(attitudes_scatter_about_the_listed_ones_by_normal_turns_about_each_axis) {
  constexpr int n = 15'000;
  constexpr double sigma = 0.05;
  SweepAxis list = read_attitude_axis("drop.attitude", "[1,0,0,0],[0.5,-0.5,0.5,-0.5],[0,0.6,0.8,0]");
  const std::vector<SweptAttitude> bases = list.attitudes;
  list.scatter = sigma;
  const SweepPoints points({list}, n, 1), few({list}, 10, 1), other({list}, n, 2);
  std::vector<double> parts[3];
  for (int i = 0; i < n; ++i) {
    const std::vector<double> q = values_of(points, i);
    const SweptAttitude& b = bases[static_cast<std::size_t>(i % 3)];
    BOOST_REQUIRE(points.attitude_of(i) == i % 3);
    // q b⁻¹ by Hamilton's product: its vector is sin(½|v|) v/|v|.
    const double w = q[0] * b[0] + q[1] * b[1] + q[2] * b[2] + q[3] * b[3];
    const double x = -q[0] * b[1] + q[1] * b[0] - q[2] * b[3] + q[3] * b[2];
    const double y = -q[0] * b[2] + q[2] * b[0] - q[3] * b[1] + q[1] * b[3];
    const double z = -q[0] * b[3] + q[3] * b[0] - q[1] * b[2] + q[2] * b[1];
    const double size = std::hypot(x, y, z), scale = 2 * std::atan2(size, w) / size;
    BOOST_REQUIRE(std::fabs(w * w + size * size - 1) <= 1e-14);
    const double vector[] = {x * scale, y * scale, z * scale};
    for (std::size_t k = 0; k < 3; ++k) parts[k].push_back((1 + std::erf(vector[k] / (sigma * std::sqrt(2.0)))) / 2);
  }
  for (const std::vector<double>& part : parts) BOOST_TEST(kolmogorov(part) <= allowed_statistic);
  BOOST_TEST(values_of(points, 7) == values_of(few, 7));
  BOOST_TEST(values_of(points, 7) != values_of(other, 7));
  list.scatter = 0;
  BOOST_TEST(values_of(SweepPoints({list}, 10, 1), 4) == (std::vector<double>{0.5, -0.5, 0.5, -0.5}));
}

BOOST_AUTO_TEST_CASE(a_point_of_a_grid_has_the_attitude_that_its_numbers_say) {
  const SweepAxis list = read_attitude_axis("drop.attitude", "[1,0,0,0],[0.5,-0.5,0.5,-0.5],[0,0.6,0.8,0]");
  const SweepAxis angle = read_grid_axis("b", "1:4:1", false);
  for (const std::vector<SweepAxis>& axes : {std::vector{list, angle}, {angle, list}, {angle, list, angle}}) {
    const SweepPoints points(axes);
    BOOST_TEST(points.attitudes() == 3);
    const auto place = static_cast<std::ptrdiff_t>(axes[0].is_attitude() ? 0 : 1);
    for (long long i = 0; i < points.count(); ++i) {
      const std::vector<double> values = values_of(points, i);
      const SweptAttitude& its = list.attitudes[static_cast<std::size_t>(points.attitude_of(i))];
      BOOST_TEST(std::equal(its.begin(), its.end(), values.begin() + place));
    }
  }
  BOOST_TEST(SweepPoints({angle}).attitudes() == 0);
}

BOOST_AUTO_TEST_CASE(a_list_of_attitudes_is_an_axis_whose_values_are_four_numbers) {
  const SweepAxis list = read_attitude_axis("drop.attitude", "[1,0,0,0],[0.5,-0.5,0.5,-5e-1]");
  BOOST_TEST(list.count == 2);
  const std::vector<std::string> names{"drop.attitude_q0", "drop.attitude_q1", "drop.attitude_q2", "drop.attitude_q3"};
  BOOST_TEST(list.names() == names);
  const SweepPoints points({list, read_grid_axis("b", "1:2:1", false)});
  BOOST_TEST(points.count() == 4);
  BOOST_TEST(values_of(points, 1) == (std::vector<double>{1, 0, 0, 0, 2}));
  BOOST_TEST(values_of(points, 2) == (std::vector<double>{0.5, -0.5, 0.5, -0.5, 1}));
  const std::pair<const char*, const char*> refused[] = {{"[1,0,0,0],[1,0,0]", "attitude 2, '[1,0,0]'"},
                                                         {"[1,0,0,0,0]", "attitude 1, '[1,0,0,0,0]'"},
                                                         {"[1,0,0,0", "attitude 1, '[1,0,0,0'"},
                                                         {"[1,0,0,0],", "attitude 1"},
                                                         {"[1,0,0,0][1,0,0,0]", "attitude 1"},
                                                         {"[1,0,0,1]", "length 1"},
                                                         {"[nan,0,0,1]", "length 1"},
                                                         {"[]", "attitude 1, '[]'"},
                                                         {"@/no/such/file", "/no/such/file: cannot be read"}};
  for (const auto& [text, why] : refused) CHECK_REFUSED_SAYING(read_attitude_axis("key", text), BadInput, why);
}

/// What a number put into a scene does is what the reader does with the same number in the file.
BOOST_AUTO_TEST_CASE(every_number_of_a_scene_can_be_put_where_the_reader_puts_it) {
  const std::string ground = "\n[ground]\nstiffness = 1e8\nsliding_friction = 0\nstatic_friction = 0.1\n";
  const std::string tilted = "[drop]\nangle_deg = 10" + ground, lying = "[drop]\nangle_deg = 0" + ground,
                    on_half_space = "[drop]\nangle_deg = 10\n[ground]\nmodulus = 1e8\n",
                    on_pad = "[drop]\nangle_deg = 10\n[ground]\ncurve = [[0.5, 1e4], [0.7, 2e4]]\nthickness = 1\n";
  const std::map<std::string, std::string> grounds{
      {"drop.topple", lying},
      {"drop.release.angle_deg", "[drop]\nrelease.height = 9" + ground},
      {"drop.release.spin", "[drop]\nangle_deg = 10\nrelease.height = 9" + ground},
      {"ground.dissipation", on_half_space},
      {"ground.body_modulus", on_half_space},
      {"ground.thickness", on_pad},
      {"ground.under", on_pad}};
  const std::vector<std::string> shapes{"[body]\nshape = 'rod'\n", "[body]\nshape = 'box'\nsize = [1, 1, 1]\n",
                                        "[body]\nshape = 'mesh'\nmesh = { file = 'a.msh' }\n"};
  int put = 0;
  for (const Key& number : all_keys()) {
    if (!number.is_number()) continue;
    const std::string key = number.name;
    const bool whole = number.is_whole() || key == "drop.orientation";
    const std::string text = whole ? "5" : "0.0625";
    const std::vector<SceneOverride> overrides{{key, "--set", text}};
    const Model model = number.use == Use::discrete ? Model::discrete : Model::continuous;
    bool read = false;
    for (const std::string& shape : shapes) {
      const std::string& drop = grounds.contains(key) ? grounds.at(key) : tilted;
      const SceneValues values("scene.toml", drop + shape, scene_keys());
      try {
        const Scene expected = read_scene(values, overrides, model);
        Scene scene = read_scene(values, {{key, "--set", whole ? "4" : "0.03125"}}, model);
        BOOST_TEST(scene_line(scene, model) != scene_line(expected, model), key);
        number.put_number(scene, std::stod(text));
        scene.settle();
        scene.settle_restitution();
        BOOST_TEST(scene_line(scene, model) == scene_line(expected, model), key);
        read = true;
      } catch (const BadInput&) {                     // a key of another shape
      } catch (const clatter::numeric::MeshError&) {  // or one that needs the body, whose file is none
      }
    }
    BOOST_TEST(read, key);
    ++put;
  }
  BOOST_TEST(put >= 30);
}

BOOST_AUTO_TEST_CASE(rows_that_come_in_any_order_are_taken_in_that_of_their_scenes) {
  RangeQueue queue({3, 25}, 10);
  const SceneRange a = *queue.hand_out(), b = *queue.hand_out(), c = *queue.hand_out();
  BOOST_TEST(c.first == 23);
  BOOST_TEST(c.count == 5);
  BOOST_TEST(queue.all_handed_out());
  BOOST_TEST(!queue.hand_out());
  queue.add(c, {"c", 5});
  queue.add(b, {"b", 10});
  BOOST_TEST(!queue.take());
  queue.add(a, {"a", 10});
  for (const char* const text : {"a", "b", "c"}) BOOST_TEST(queue.take()->text == text);
  BOOST_TEST(queue.is_complete());
}

BOOST_AUTO_TEST_CASE(nothing_is_taken_after_a_range_that_was_stopped) {
  RangeQueue queue({0, 20}, 10);
  const SceneRange a = *queue.hand_out(), b = *queue.hand_out();
  queue.add(a, {"a", 4});
  queue.add(b, {"b", 10});
  BOOST_TEST(queue.take()->text == "a");
  BOOST_TEST((!queue.take() && queue.taken() == 4 && !queue.is_complete()));
}

BOOST_AUTO_TEST_CASE(nothing_is_handed_out_while_too_many_rows_wait_for_a_slow_scene) {
  RangeQueue queue({0, 1000}, 1);
  const SceneRange slow = *queue.hand_out();
  int ahead = 0;
  while (const auto range = queue.hand_out()) {
    queue.add(*range, {std::string(1 << 20, 'x'), 1});
    ++ahead;
  }
  BOOST_TEST((ahead >= 64 && ahead <= 66));
  queue.add(slow, {"slow", 1});
  while (queue.take()) continue;
  BOOST_TEST(queue.hand_out().has_value());
}

BOOST_AUTO_TEST_CASE(what_threads_throw_is_thrown_on) {
  RangeQueue queue({0, 1000}, 7);
  const SweepHooks hooks{[](const RangeRows&) {}, [] {}, [] { return false; }};
  const MakeCompute fails = [](const auto&) {
    return [](const SceneRange& range) -> RangeRows {
      if (range.first >= 70) throw std::runtime_error("no");
      return {"", range.count};
    };
  };
  BOOST_CHECK_EXCEPTION(run_on_threads(queue, 3, fails, hooks), std::runtime_error, mentions("no"));
}

BOOST_AUTO_TEST_CASE(progress_off_a_terminal_is_at_most_a_line_a_minute_and_a_tenth) {
  const auto said = [](int seconds_a_scene) {
    const RunProgress::Clock::time_point begin = RunProgress::Clock::now();
    RunProgress progress(0, 200, "scenes");
    std::vector<int> at;
    for (int done = 1; done <= 200; ++done)
      if (progress.is_due(begin + std::chrono::seconds(1 + done * seconds_a_scene), done)) at.push_back(done);
    return at;
  };
  BOOST_TEST((said(0).empty()));
  BOOST_TEST(said(1) == std::vector({60, 120, 180}));
  BOOST_TEST(said(30) == std::vector({20, 40, 60, 80, 100, 120, 140, 160, 180, 200}));
}

BOOST_AUTO_TEST_CASE(a_run_goes_on_after_the_last_rows_that_their_digest_confirms) {
  const std::string one = form.head + "0,1\n", three = one + "1,1\n2,1\n", four = three + "3,1\n3,2\n";
  const auto found = [](const Found& is, long long scenes, const std::string& text) {
    BOOST_TEST(is.first == scenes);
    BOOST_TEST(is.second == text);
  };
  found(found_after([](const std::string&) {}), 4, four);
  for (std::size_t size = 0; size <= four.size(); ++size) {  // cut anywhere
    const Found is = found_after([&](const std::string& part) { std::filesystem::resize_file(part, size); });
    if (size == four.size()) found(is, 4, four);
    else if (size >= three.size()) found(is, 3, three);
    else if (size >= one.size()) found(is, 1, one);
    else found(is, 0, form.head);
  }
  const auto replaced = [&](const char* of, const char* before, const char* after, long long scenes,
                            const std::string& text) {
    found(found_after([&](const std::string& part) { replace_text(part + of, before, after); }), scenes, text);
  };
  replaced("", "0,1", "0,7", 0, form.head);
  replaced("", "2,1", "2,7", 1, one);
  replaced("", "1,1\n2,1", "2,1\n1,1", 1, one);
  replaced("", "3,2", "3,3", 3, three);
  for (const char* other : {" 5 ", " 11 ", " x "}) replaced(".digests", " 4 ", other, 3, three);
  found(found_after([&](const std::string& part) { write_text(part, four + "4,1\n"); }), 4, four);  // no digest yet
  found(found_after([&](const std::string& part) { std::filesystem::remove(part); }), 0, form.head);
  BOOST_CHECK_EXCEPTION(found_after([&](const std::string& part) { std::filesystem::remove(part + ".digests"); }),
                        BadInput, mentions("which tells how many of them are whole, is not there"));
  found(found_after([](const std::string&) {}, true), 0, form.head);
  found(found_after([](const std::string& part) { write_text(part, "another thing\n"); }, true), 0, form.head);
}

BOOST_AUTO_TEST_CASE(a_part_of_another_sweep_is_refused_and_kept) {
  const auto refused = [](const std::string& text, const char* why) {
    const Folder folder;
    write_text(folder.at("x.part"), text);
    CHECK_REFUSED_SAYING(SweepFile(folder.at("x"), form, false), BadInput, why);
    BOOST_TEST(text_of(folder.at("x.part")) == text);
  };
  refused("# other\nindex,x\n0,1\n", "('# other' there, '# head' here)");
  refused("# head\nindex,y\n0,1\n", "('index,y' there, 'index,x' here)");
}

BOOST_AUTO_TEST_CASE(a_part_takes_its_name_at_the_end_belongs_to_one_run_and_is_none_without_a_row) {
  const Folder folder;
  const std::string path = folder.at("out.csv");
  write_text(path, "old");
  {
    SweepFile file(path, form, false);
    file.write("0,1\n", 1);
    file.flush();
    BOOST_CHECK_EXCEPTION(SweepFile(path, form, false), BadInput, mentions("another run"));
    BOOST_TEST(text_of(path) == "old");
    file.commit();
  }
  BOOST_TEST(text_of(path) == form.head + "0,1\n");
  { const SweepFile without_a_row(path + ".other", form, false); }
  for (const char* left : {".part", ".part.digests", ".other.part", ".other.part.digests"})
    BOOST_TEST(!std::filesystem::exists(path + left), left);
}

BOOST_AUTO_TEST_CASE(a_sweep_that_finishes_while_another_opens_its_part_keeps_its_rows) {
  const Folder folder;
  const std::string path = folder.at("out.csv");
  auto first = std::make_unique<SweepFile>(path, form, false);
  first->write("0,1\n", 1);
  before_lock = [&] {  // between the second run's opening the part and its locking it
    first->commit();
    first.reset();
  };
  const SweepFile second(path, form, false);
  BOOST_TEST(text_of(path) == form.head + "0,1\n");
  BOOST_TEST(second.scenes() == 0);
  BOOST_TEST(text_of(path + ".part") == form.head);
}

BOOST_AUTO_TEST_CASE(the_digest_is_the_published_crc_of_its_name) {
  Digest digest;
  digest.add("1234");
  digest.add("56789");
  BOOST_TEST(digest.value() == 0x995dc9bbdf1939faU);  // the check value of CRC-64/XZ in the catalogue of CRCs
}
