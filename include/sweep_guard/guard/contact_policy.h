#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/intention.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

class IntendedTriangles;

/// Says which contact of one body of the tool with one workpiece is no warning:
///
///     allowed, wherever and however deep:                          allows(piece)
///     intended, on triangles of an Intention and up to its depth:  trianglesIntendedFor(piece, ...).contains(triangle, ...)
///
/// All other contact is warned of. A measured sweep tests allowed and intended contact, too, and reports each apart.
/// Predictions and planes leave out allowed pieces. Predictions leave out intended triangles as well; a plane stands for
/// such a triangle from its intendedDepth() on. An attached workpiece is a link of the tool, and not tested against it.
class ContactPolicy {
 public:
  /// Allows and intends no contact.
  ContactPolicy() = default;
  /// @param tool        must outlive this
  /// @param allowed     null: no pair is
  /// @param intentions  where contact is meant; must outlive this; null: nowhere
  ContactPolicy(const Tool& tool, const Workpiece& workpiece, const AllowedPairs* allowed,
                const Intentions* intentions = nullptr);

  /// Returns whether the piece may touch the workpiece.
  bool allows(size_t piece) const { return !allowed_.empty() && allowed_[piece]; }
  bool allowsAll() const;  ///< whether every piece of the tool may

  bool intendsAny() const { return !intentions_.empty(); }  ///< whether any contact with the workpiece is intended
  /// Returns which triangles the link of a piece is meant to touch during a motion.
  /// @param sub_motions_M  of one motion; at least one
  /// @param margin         the tool is grown by this [m], >= 0
  IntendedTriangles trianglesIntendedFor(size_t piece, const std::vector<Motion>& sub_motions_M, double margin) const;
  /// Returns how far the link of a piece may reach behind a triangle [m]; 0: the link is not meant to touch it.
  double intendedDepth(size_t piece, std::uint32_t triangle) const;
  /// Returns the regions of the workpiece that the link of a piece is meant to touch.
  std::vector<const Intention*> intentionsFor(size_t piece) const;

 private:
  void allow(const AllowedPairs& pairs, const std::string& id);

  const Tool* tool_ = nullptr;
  std::vector<bool> allowed_;                 // of each piece; empty: none
  std::vector<const Intention*> intentions_;  // of any link
};

inline const ContactPolicy kForbidAllContact;

}  // namespace sweep_guard_core
