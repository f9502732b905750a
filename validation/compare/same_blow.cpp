// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/same_blow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/compare/stiff_runs.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {

using numeric::ImpactRecord;
using numeric::Vector3;

bool same_contact(const SequenceImpact& discrete, numeric::ContactEnd end, const Vector3& place,
                  const numeric::Body& body) {
  if (!discrete.place) return discrete.end == end_name(end);
  return is_same_place(body, *discrete.place, place);
}

std::string contact_name(const DiscreteSide& side, numeric::ContactEnd end, const Vector3& place,
                         const numeric::Body& body) {
  if (!side.in_space) return end_name(end);
  for (const SequenceImpact& impact : side.impacts) {
    if (same_contact(impact, end, place, body)) return impact.end;
  }
  for (const NamedCorner& corner : side.corners) {
    if (is_same_place(body, corner.place, place)) return corner.name;
  }
  return "several";
}

std::string contacts_differ(const DiscreteSide& side, const std::string& discrete, const std::string& continuous) {
  if (!side.in_space) return fmt::format("end {} strikes in one model, end {} in the other", discrete, continuous);
  if (discrete == continuous) return fmt::format("another point of {} strikes in each model", discrete);
  return fmt::format("corner {} strikes in the discrete model, corner {} in the continuous one", discrete, continuous);
}

std::string other_blow(const DiscreteSide& side, const SequenceImpact& discrete, const ImpactRecord& record,
                       const numeric::Body& body) {
  if (record.touches > 1 && discrete.end != "both") return "another place touches before the first contact has ended";
  if (same_contact(discrete, record.end, record.place, body)) return "";
  return contacts_differ(side, discrete.end, contact_name(side, record.end, record.place, body));
}

PartedBlows parted_blows(const DiscreteSide& side, const std::vector<ImpactRecord>& records,
                         const numeric::Body& body) {
  for (std::size_t i = 0; i < std::min(side.impacts.size(), records.size()); ++i) {
    if (side.impacts[i].is_group) continue;  // several corners at once, of which a run may know one
    const std::string reason = other_blow(side, side.impacts[i], records[i], body);
    if (!reason.empty()) return {static_cast<int>(i) + 1, reason};
  }
  return {};
}

}  // namespace clatter::validation
