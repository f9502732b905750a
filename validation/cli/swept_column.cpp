#include "validation/cli/swept_column.hpp"

#include <fmt/format.h>

namespace clatter::validation {

Column swept_column(const SceneSweep& sweep) {
  const bool over_angle = sweep.quantity == SceneSweep::Quantity::angle_deg;
  return {"value", over_angle ? "angle" : "μₖ", over_angle ? "°" : ""};
}

Column swept_record_column(const SceneSweep& sweep) { return {sweep.name(), sweep.name(), ""}; }

void add_interruption(const SceneSweep& sweep, std::size_t done, Table& table) {
  const std::size_t values = sweep.values().size();
  if (done < values) table.notes.push_back(fmt::format("interrupted: {} of {} values", done, values));
}

}  // namespace clatter::validation
