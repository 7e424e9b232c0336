#pragma once

#include <sweep_guard/Interaction.h>

#include <string>

namespace sweep_guard_rviz {

/// Returns force, volume and depth in words.
std::string describe(const sweep_guard::ObjectInteraction& object);

/// Returns the same for all workpieces: the whole force, the sum of the volumes and the largest depth; empty: there is no
/// force.
std::string describe(const sweep_guard::Interaction& interaction);

}  // namespace sweep_guard_rviz
