// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files that were damaged are read or refused in one line, and break nothing.
#include <array>
#include <boost/test/unit_test.hpp>
#include <random>
#include <string>

#include "validation/embedded/embedded.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"

using namespace clatter::validation;

namespace {

constexpr int rounds = CLATTER_TEST_SLOW_BUILD ? 50 : 400;  // of every kind of damage, for every case
constexpr std::array hard_texts{"1e308",  "-1e308", "4.9e-324", "-0.0", "nan", "inf", "99999999999999999999",
                                "0x7fff", "[]",     "[1, [2]]", "''",   "{}",  "true"};

class Damage {
 public:
  explicit Damage(std::string text) : text_(std::move(text)) {}

  std::string cut() { return text_.substr(0, below(text_.size())); }
  std::string with_another_byte() {
    std::string text = text_;
    text[below(text.size())] = static_cast<char>(below(256));
    return text;
  }
  std::string without_a_line() {
    const std::size_t begin = line_begin(), end = line_end();
    return text_.substr(0, begin) + text_.substr(end);
  }
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
  std::string hard() { return hard_texts[below(hard_texts.size())]; }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::size_t line_begin() {
    const std::size_t before = text_.rfind('\n', below(text_.size()));
    return line_ = before == std::string::npos ? 0 : before + 1;
  }
  /// Of the line whose begin was drawn last.
  [[nodiscard]] std::size_t line_end() const { return std::min(text_.find('\n', line_), text_.size() - 1) + 1; }

  std::string text_;
  std::size_t line_ = 0;
  std::mt19937 random_{11};
};

struct Count {
  int read = 0, refused = 0;
};

template <class Read>
void try_to_read(const std::string& what, Count& count, Read&& read) {
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
