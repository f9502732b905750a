#include "validation/cli/swept_column.hpp"

#include <fmt/format.h>

namespace clatter::validation {

Column swept_column(const SceneSweep& sweep) {
  const bool over_angle = sweep.quantity == SceneSweep::Quantity::angle_deg;
  return {"value", over_angle ? "angle" : "μₖ", over_angle ? "°" : ""};
}

Column swept_record_column(const SceneSweep& sweep) { return {sweep.name(), sweep.name(), ""}; }

std::string swept_words(const SceneSweep& sweep) {
  return sweep.quantity == SceneSweep::Quantity::angle_deg ? "contact angle θ" : "friction coefficient μ";
}

Range2 swept_range(double first, double last) {
  return first < last ? Range2{first, last} : Range2{first - 0.5, last + 0.5};
}

void add_interruption(const SceneSweep& sweep, std::size_t done, Table& table) {
  const std::size_t values = sweep.values().size();
  if (done < values) table.notes.push_back(fmt::format("interrupted: {} of {} values", done, values));
}

}  // namespace clatter::validation
