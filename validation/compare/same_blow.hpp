// SPDX-License-Identifier: GPL-3.0-or-later
// Whether impact n of the continuous model is the blow that impact n of the discrete model is.
#pragma once

#include <string>
#include <vector>

#include "numeric/simulate.hpp"
#include "validation/compare/discrete_side.hpp"

namespace clatter::validation {

/// Whether both models touch down with the same end, or in space with the same corners.
/// @param place   of the continuous model's contact, body frame from the centre of mass [m]
[[nodiscard]] bool same_contact(const SequenceImpact& discrete, numeric::ContactEnd end, const numeric::Vector3& place,
                                const numeric::Body& body);

/// What reports call the contact of the continuous model.
[[nodiscard]] std::string contact_name(const DiscreteSide& side, numeric::ContactEnd end, const numeric::Vector3& place,
                                       const numeric::Body& body);

/// In words, that the models touch down with contacts of these names.
[[nodiscard]] std::string contacts_differ(const DiscreteSide& side, const std::string& discrete,
                                          const std::string& continuous);

/// Why a contact of the continuous model is another blow than the discrete impact: something else touches before it has
/// ended, or another end or corner strikes; empty: it is the same.
[[nodiscard]] std::string other_blow(const DiscreteSide& side, const SequenceImpact& discrete,
                                     const numeric::ImpactRecord& record, const numeric::Body& body);

/// The first impact in which the models strike another blow.  From it on those of one number have nothing to do with
/// each other.
struct PartedBlows {
  int from = 0;        ///< its number, from 1; 0: there is none among the impacts that both models have
  std::string reason;  ///< as other_blow() says it

  /// Whether impact n can stand beside that of the other model.
  [[nodiscard]] bool are_one(int n) const { return from == 0 || n < from; }
};
[[nodiscard]] PartedBlows parted_blows(const DiscreteSide& side, const std::vector<numeric::ImpactRecord>& records,
                                       const numeric::Body& body);

}  // namespace clatter::validation
