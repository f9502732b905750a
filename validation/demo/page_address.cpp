// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/page_address.hpp"

#include "validation/demo/scene_exchange.hpp"

namespace clatter::validation::inline demo {
namespace {

/// A list as flags have it: numbers with commas between.
std::string text_of(const Value& value) {
  const auto* const list = std::get_if<Value::List>(&value.content());
  if (!list) return value.text();
  std::string text;
  for (const Value& part : *list) text += (text.empty() ? "" : ",") + part.text();
  return text;
}

/// In a query "+" means a blank.
std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('+', at)) != std::string::npos;) text.replace(at, 1, "%2B");
  return text;
}

}  // namespace

std::string page_query(const Scene& scene) {
  std::string query = "?given=1";
  for (const Field& argument : scene_arguments(scene).arguments)
    query += "&" + argument.name + "=" + escaped(text_of(argument.value));
  return query;
}

}  // namespace clatter::validation::inline demo
