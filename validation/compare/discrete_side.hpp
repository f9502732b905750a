// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model's part of a comparison, planar or in space: one form for both.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/motion_numbers.hpp"

namespace clatter::validation {

// How far the two models must differ on a ground of finite stiffness, from what the discrete model leaves out.

/// Sizes of the deviations of one impact's numbers; the sum over this impact and those before it, whose deviations
/// are carried along by the motion between them.
struct PredictedSize {
  MotionNumbers gravity{};      ///< g T added to the approach: gravity acts during the contact, for T
  MotionNumbers turning{};      ///< the body turns by |Ω| T/2 until the middle of the contact
  MotionNumbers indentation{};  ///< the contact point lies up to v T/π inside the corner
  MotionNumbers delay{};        ///< half the duration of each contact before
  MotionNumbers tipping{};      ///< of a face whose friction tips the body on an even bed; on any stiffness
  [[nodiscard]] MotionNumbers total() const;
};

/// One entry per row of `sequence`, as far as `contact_times` (the duration T of each contact [s]) and the rows go.
/// Each effect is put into the state before each impact in turn and carried on by the discrete model; where that leads
/// to another sequence of contacts, the sizes from there on are infinite.
[[nodiscard]] std::vector<PredictedSize> predicted_sizes(const analytic::Drop& drop, const analytic::Sequence& sequence,
                                                         const std::vector<double>& contact_times);

/// As predicted_sizes in the plane: gravity for T, a turn by |Ω| T/2 about the axis of Ω before or after, whichever is
/// faster, the corner v T/(2π) further inside along each of the body's axes, half the duration of each contact before.
/// The body has no rims.
[[nodiscard]] std::vector<PredictedSize> predicted_sizes(const analytic::space::Drop& drop,
                                                         const analytic::space::Sequence& sequence,
                                                         const std::vector<double>& contact_times);

/// The drop that begins with this row: the state before it, turned or mirrored so that the inclination lies in
/// [0°, 90°].  Speeds of tangential and angular motion may change sign with that.
[[nodiscard]] analytic::Drop drop_at(const analytic::Drop& drop, const analytic::ImpactRow& row);

/// The same in space: the state before it as it is.
[[nodiscard]] analytic::space::Drop drop_at(const analytic::space::Drop& drop, const analytic::space::ImpactRow& row);

/// One impact.
struct SequenceImpact {
  MotionNumbers numbers{}, errors{};
  std::string end{};  ///< which end strikes in the plane; in space the corner
  /// In space: of the corner that strikes, or the mean of several, body frame from the centre of mass [m].
  std::optional<numeric::Vector3> place{};
  double amplification = 0;
  bool predictable = true;    ///< errors of the start have not grown too far
  bool is_group = false;      ///< in space: several corners land at once
  bool sticks = false;        ///< ends in stick
  bool nearly_stops = false;  ///< in space: slip comes within a thousandth of the contact's speed of stopping
  bool jams = false;          ///< friction is beyond Painlevé's limit
  /// Why the rebound is not that of an ever stiffer ground: several corners at once; empty: it is, up to `tipping`.
  std::string open{};
  std::string follows_open{};  ///< the same for an impact that only comes after such a one
  bool is_face = false;        ///< in space: a level face lands with all of its area
  MotionNumbers tipping{};     ///< of such a face: face_tipping
};

/// A corner of a body in space and what reports call it.
struct NamedCorner {
  numeric::Vector3 place = numeric::Vector3::Zero();  ///< body frame, from the centre of mass [m]
  std::string name;
};

struct DiscreteSide {
  bool in_space = false;
  std::vector<NamedCorner> corners{};  ///< in space
  ComparedQuantities quantities{};     ///< those that the comparison shows
  std::vector<SequenceImpact> impacts{};
  MotionNumbers scales{};
  analytic::Outcome outcome = analytic::Outcome::no_further_impact;
  std::string message{};  ///< why the sequence ended
  /// Sizes of the deviations to expect at the scene's own stiffness, for the durations of the contacts [s].
  std::function<std::vector<PredictedSize>(const std::vector<double>&)> predict{};
};

/// The sequence of the drop of a scene with that body: in space also where a face lands that slides in the plane, since
/// only a face in space has its width, over which the ground presses and rubs.
/// @throws analytic::OutsideModelError if the first impact leaves the model.
[[nodiscard]] DiscreteSide discrete_side(const Scene& scene, DiscreteBody& body);

// Whether impact n of the continuous model is the blow that impact n of the discrete model is.

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
