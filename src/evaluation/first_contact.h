#pragma once

#include <optional>

#include "evaluation/recorded_motion.h"
#include "evaluation/sheet.h"

namespace sweep_guard_evaluation {

/// A sheet as near as this is touched [m].
constexpr double kContactTolerance = 1e-6;

/// When the recorded motion first brings the tool into contact with a sheet: the truth that warnings are compared with.
/// Conservative advancement: as far as the tool is clear of the sheet it may move unseen, for no point of it goes
/// farther than its origin goes and its turn takes the farthest point. So no contact is missed, and the one found is
/// early by no more than the tool needs for sqrt(2) * kContactTolerance.
/// @param from, to  within the recording
/// @returns empty: none
std::optional<sweep_guard::Time> firstContact(const RecordedMotion& motion, const sweep_guard::ConvexShape& tool,
                                              const Sheet& sheet, sweep_guard::Time from, sweep_guard::Time to);

}  // namespace sweep_guard_evaluation
