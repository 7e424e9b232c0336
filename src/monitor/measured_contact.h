#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Takes over what a sweep met other than intended: of several workpieces, the first reported. Without a contact the one
/// before is over, unless its workpiece could not be swept.
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
