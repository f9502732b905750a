// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a report: a tree of nothing, truths, numbers and texts.
#pragma once

#include <concepts>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

namespace clatter::validation {

struct Field;

/// Nothing, a truth, a number, a text, a list of values or values by their names.  A number that is not finite becomes
/// nothing: no form of output has a word for it.  Defined apart from JSON's own type, which costs each source that
/// makes such a tree seconds to compile.
class Value {
 public:
  using List = std::vector<Value>;
  using Fields = std::vector<Field>;  ///< in the order of the output
  using Content = std::variant<std::nullptr_t, bool, long long, double, std::string, List, Fields>;

  Value();
  Value(std::nullptr_t);  // NOLINT: values are made from what they hold
  Value(bool truth);      // NOLINT
  Value(double number);   // NOLINT
  template <std::integral Whole>
  Value(Whole number) : Value(WholeNumber{static_cast<long long>(number)}) {}  // NOLINT
  Value(const char* text);                                                     // NOLINT
  Value(std::string text);                                                     // NOLINT
  Value(List list);                                                            // NOLINT
  Value(Fields fields);                                                        // NOLINT
  Value(const std::vector<std::string>& texts);                                // NOLINT
  template <std::ranges::input_range Numbers>
  requires(std::same_as<std::ranges::range_value_t<Numbers>, double>) Value(const Numbers& numbers)
      : Value(List(std::ranges::begin(numbers), std::ranges::end(numbers))) {}  // NOLINT
  ~Value();
  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(const Value& other);
  Value& operator=(Value&& other) noexcept;

  [[nodiscard]] const Content& content() const { return content_; }
  [[nodiscard]] bool is_nothing() const { return std::holds_alternative<std::nullptr_t>(content_); }
  /// The number, or none.
  [[nodiscard]] const double* number() const { return std::get_if<double>(&content_); }
  /// A line of a file: numbers in their shortest form, "true" or "false", texts as they are, nothing as "".
  [[nodiscard]] std::string text() const;
  /// The value of that name.  @throws std::out_of_range if there is none, std::bad_variant_access without names.
  [[nodiscard]] const Value& at(const std::string& name) const;
  /// The value of that name, or none.
  [[nodiscard]] const Value* find(const std::string& name) const;
  /// The value of that name, made where there is none; nothing becomes an empty group of fields.
  Value& operator[](const std::string& name);
  /// Adds to a list; nothing becomes an empty one.
  void push_back(Value value);

 private:
  struct WholeNumber {
    long long number;
  };
  Value(WholeNumber whole);  // NOLINT: beside the others, where Field is complete

  Content content_;
};

struct Field {
  std::string name;
  Value value;
};

/// Nothing in place of an empty text.
[[nodiscard]] Value text_or_nothing(const std::string& text);

}  // namespace clatter::validation
