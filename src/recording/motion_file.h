#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// Reads a recorded motion: a text file with one pose `stamp tx ty tz qx qy qz qw` per line (s, m, quaternion of any
/// length), empty lines and lines that begin with `#` skipped. Decimal points whatever the locale. Stamps are those of
/// the file, rounded to nanoseconds; equal ones are kept, as recorders that cut their digits write them.
/// @returns the poses in the order of the file, at least one, their rotations orthonormal
/// @throws sweep_guard_core::InvalidInput with file and line if the file cannot be read or is larger than 256 MiB, a line is
/// not eight
///     finite numbers, a quaternion is zero, a stamp is earlier than the one before, or there is no pose at all
std::vector<sweep_guard_core::StampedPose> readMotionFile(const std::string& path);

}  // namespace sweep_guard_recording
