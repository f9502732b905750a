// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/value.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "validation/output/number.hpp"

namespace clatter::validation {

Value::Value() : content_(nullptr) {}
Value::Value(std::nullptr_t) : content_(nullptr) {}
Value::Value(bool truth) : content_(truth) {}
Value::Value(double number) : content_(nullptr) {
  if (std::isfinite(number)) content_ = number + 0.0;  // no −0
}
Value::Value(WholeNumber whole) : content_(whole.number) {}
Value::Value(const char* text) : content_(std::string(text)) {}
Value::Value(std::string text) : content_(std::move(text)) {}
Value::Value(List list) : content_(std::move(list)) {}
Value::Value(Fields fields) : content_(std::move(fields)) {}
Value::Value(const std::vector<std::string>& texts) : content_(List(texts.begin(), texts.end())) {}
Value::~Value() = default;
Value::Value(const Value& other) = default;
Value::Value(Value&& other) noexcept = default;
Value& Value::operator=(const Value& other) = default;
Value& Value::operator=(Value&& other) noexcept = default;

std::string Value::text() const {
  if (const auto* text = std::get_if<std::string>(&content_)) return *text;
  if (const auto* truth = std::get_if<bool>(&content_)) return *truth ? "true" : "false";
  if (const auto* whole = std::get_if<long long>(&content_)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&content_)) return shortest(*number);
  return "";
}

const Value* Value::find(const std::string& name) const {
  for (const Field& field : std::get<Fields>(content_)) {
    if (field.name == name) return &field.value;
  }
  return nullptr;
}

const Value& Value::at(const std::string& name) const {
  if (const Value* value = find(name)) return *value;
  throw std::out_of_range("no value of the name " + name);
}

Value& Value::operator[](const std::string& name) {
  if (is_nothing()) content_ = Fields{};
  if (const Value* value = find(name)) return const_cast<Value&>(*value);
  return std::get<Fields>(content_).emplace_back(Field{name, Value()}).value;
}

void Value::push_back(Value value) {
  if (is_nothing()) content_ = List{};
  std::get<List>(content_).push_back(std::move(value));
}

Value text_or_nothing(const std::string& text) { return text.empty() ? Value() : Value(text); }

}  // namespace clatter::validation
