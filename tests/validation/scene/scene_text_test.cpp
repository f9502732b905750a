// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene has to say so that others read the same again, what becomes of damaged ones, and how failures end.
#include <new>

#include "analytic/base/errors.hpp"
#include "numeric/base/errors.hpp"
#include "tests/support.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/program/program.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"

using namespace clatter;
using namespace clatter::validation;

namespace {

constexpr int rounds = CLATTER_TEST_SLOW_BUILD ? 50 : 100;  // of every kind of damage, for every case
constexpr std::array hard_texts{"1e308",  "-1e308", "4.9e-324", "-0.0", "nan", "inf", "99999999999999999999",
                                "0x7fff", "[]",     "[1, [2]]", "''",   "{}",  "true"};

class Damage {
 public:
  explicit Damage(std::string text) : text_(std::move(text)) {}

  std::string cut() { return text_.substr(0, random_.below(text_.size())); }
  std::string with_another_byte() {
    std::string text = text_;
    text[random_.below(text.size())] = static_cast<char>(random_.below(256));
    return text;
  }
  std::string without_a_line() { return text_.substr(0, line_begin()) + text_.substr(line_end()); }
  std::string with_a_line_twice() {
    const std::size_t begin = line_begin(), end = line_end();
    return text_.substr(0, end) + text_.substr(begin, end - begin) + text_.substr(end);
  }
  /// The value of one line is another.
  std::string with_another_value() {
    const std::size_t equals = text_.find('=', line_begin());
    if (equals == std::string::npos) return hard();
    return text_.substr(0, equals + 1) + hard() + text_.substr(std::min(text_.find('\n', equals), text_.size()));
  }
  std::string hard() { return hard_texts[random_.below(hard_texts.size())]; }

 private:
  std::size_t line_begin() {
    const std::size_t before = text_.rfind('\n', random_.below(text_.size()));
    return line_ = before == std::string::npos ? 0 : before + 1;
  }
  /// The end of the line whose begin was drawn last.
  [[nodiscard]] std::size_t line_end() const { return std::min(text_.find('\n', line_), text_.size() - 1) + 1; }

  std::string text_;
  std::size_t line_ = 0;
  test::Random random_{11};
};

struct Count {
  int read = 0, refused = 0;
};

void try_to_read(const std::string& what, Count& count, auto&& read) {
  try {
    read();
    ++count.read;
  } catch (...) {
    const Failure failure = current_failure();
    ++count.refused;
    BOOST_TEST((failure.kind != FailureKind::defect), what << "\n" << failure.message);
    BOOST_TEST(!failure.message.empty(), what);
    BOOST_TEST(failure.message.find('\n') == std::string::npos, what << "\n" << failure.message);
  }
}

void read_with_both_models(const std::string& path, const std::string& text,
                           const std::vector<SceneOverride>& overrides, Count& count) {
  try_to_read(text, count, [&] { (void)read_scene({path, text, scene_keys()}, overrides, Model::continuous); });
  try_to_read(text, count, [&] { (void)read_discrete_scene({path, text, scene_keys()}, overrides); });
}

/// Path and text of each scene that comes with the program.
std::vector<EmbeddedFile> cases() {
  std::vector<EmbeddedFile> files;
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name.starts_with("validation/cases/")) files.push_back(file);
  }
  return files;
}

bool says(const Scene& scene, std::string_view name) {
  const auto keys = said_keys(scene);
  return std::any_of(keys.begin(), keys.end(), [&](const Key* key) { return key->name == name; });
}

int status_after(const auto& error) {
  return guarded([&]() -> int { throw error; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_damaged_file_is_read_or_refused_in_one_line) {
  Count count;
  for (const EmbeddedFile& file : cases()) {
    const std::string path(file.name);
    Damage damage{std::string(file.text)};
    for (int i = 0; i < rounds; ++i) {
      for (const std::string& text : {damage.cut(), damage.with_another_byte(), damage.without_a_line(),
                                      damage.with_a_line_twice(), damage.with_another_value()}) {
        read_with_both_models(path, text, {}, count);
      }
    }
  }
  BOOST_TEST(count.read > 0);
  BOOST_TEST(count.refused > 0);
}

BOOST_AUTO_TEST_CASE(a_flag_of_any_text_is_read_or_refused_in_one_line) {
  Count count;
  for (const EmbeddedFile& file : cases()) {
    const std::string path(file.name), text(file.text);
    Damage damage(text);
    for (const Key& key : all_keys()) {
      if (*key.flag) read_with_both_models(path, text, {{key.name, key.flag, damage.hard()}}, count);
    }
    if (CLATTER_TEST_SLOW_BUILD) break;  // other files take the same ways
  }
  BOOST_TEST(count.read > 0);
  BOOST_TEST(count.refused > 0);
}

/// Left out, each of the first would be what a file's other keys make it.  Who opens a scene of someone else's must not
/// write over a file for it.
BOOST_AUTO_TEST_CASE(
    body_gravity_and_restitution_are_said_whatever_their_values_other_keys_where_flags_would_not_give_them_and_no_file) {
  Scene scene;
  BOOST_TEST(!says(scene, "drop.spin"));
  scene.world.gravity = 0;
  scene.height = 0.5;
  scene.impact.restitution = 1;
  scene.spin = 2;
  scene.history = "history.csv";
  for (const char* name :
       {"body.shape", "body.mass", "body.length", "world.gravity", "impact.restitution", "drop.spin"})
    BOOST_TEST(says(scene, name), name);
  BOOST_TEST(!says(scene, "run.history"));
}

BOOST_AUTO_TEST_CASE(bad_input_is_2_no_number_3_outside_the_model_4_and_a_defect_which_says_so_70) {
  BOOST_TEST(status_after(BadInput("x")) == 2);
  BOOST_TEST(status_after(numeric::MeshError("x")) == 2);
  BOOST_TEST(status_after(std::domain_error("x")) == 2);
  BOOST_TEST(status_after(analytic::NumericalError("x")) == 3);
  BOOST_TEST(status_after(numeric::NumericalError("x")) == 3);
  BOOST_TEST(status_after(std::runtime_error("x")) == 3);
  BOOST_TEST(status_after(std::bad_alloc()) == 3);
  BOOST_TEST(status_after(analytic::OutsideModelError("x")) == 4);
  BOOST_TEST(status_after(std::logic_error("x")) == 70);
  BOOST_TEST(status_after(std::invalid_argument("x")) == 70);
  BOOST_TEST(status_after(std::out_of_range("x")) == 70);
  BOOST_TEST(guarded([] { return 130; }) == 130);
  const auto failure_of = [](const auto& error) {
    try {
      throw error;
    } catch (...) {
      return current_failure();
    }
  };
  const Failure failure = failure_of(std::out_of_range("vector::at"));
  BOOST_TEST((failure.kind == FailureKind::defect));
  BOOST_TEST(failure.message == "a defect of the program, please report it: vector::at");
  BOOST_TEST(failure_of(std::domain_error("mass = 0: must be positive")).message == "mass = 0: must be positive");
}
