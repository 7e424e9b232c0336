#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "monitor/stand_ins.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Keeps the workpieces, what of them was swept, and what was dropped: `objects` of the inputs.
class SweptWorkpieces {
 public:
  /// @param inputs  must outlive this
  explicit SweptWorkpieces(WarningInputs& inputs) : inputs_(inputs) {}

  /// @param newest  snapshots of all workpieces, ascending by id
  /// @param now     as for updateStandIns()
  void set(const Workpieces& newest, std::optional<SteadyTime> now);
  const Workpieces& newest() const { return newest_; }

  /// Returns whether each of the newest, or triangles that stand in for it, is among these.
  bool allCount(const Workpieces& tested, SteadyTime now) const;

  /// Makes the age of a workpiece begin anew, until restart(). Does nothing if there is no such workpiece.
  void confirm(const std::string& id, const Timestamps& timestamps);

  /// Keeps that an update was dropped until a later one is swept.
  /// @returns false if there is no such workpiece
  bool drop(const std::string& id, SteadyTime received);
  void swept(const SweepReport& report);
  void restart();  ///< nothing is swept, and nothing confirmed

 private:
  WarningInputs::Object* findObject(const std::string& id) const;
  void updateObjects();
  void updateBehind(const SweepReport& report);

  WarningInputs& inputs_;
  Workpieces newest_;
  std::vector<ReplacedTriangles> replaced_;
  Workpieces swept_;                             // at the newest pose
  std::map<std::string, SteadyTime> dropped_;    // by id: when the newest dropped update was received
  std::map<std::string, Timestamps> confirmed_;  // by id: when it was last said to be as it was
};

/// Returns the workpiece of this id; null: there is none.
const Workpiece* findWorkpiece(const Workpieces& workpieces, const std::string& id);

/// Returns whether the workpiece is among these, with its triangles and frame.
bool holds(const Workpieces& workpieces, const Workpiece& workpiece);

/// Updates the contact from a sweep. What is met as intended does not count. Of several workpieces, the first reported
/// counts, and a replaced one only if there is no other. Without a contact the one before is over, unless its workpiece
/// could not be swept.
/// @returns whether the sweep met one
bool updateContact(const SweepReport& report, SteadyTime now, std::optional<WarningInputs::Contact>& contact);

/// Takes over which workpieces a sweep met as intended.
void updateIntended(const SweepReport& report, std::vector<std::string>& ids);

/// Adds triangles that a sweep has missed. A contact with another workpiece stays while it lasts; otherwise they count
/// as a contact that is over. What is added to a contact that lasts is reported until its next sweep.
/// @param triangles  ascending
void addToContact(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now,
                  std::optional<WarningInputs::Contact>& contact);

}  // namespace sweep_guard_core
