#pragma once

#include <cstdint>

namespace sweep_guard_core {

/// Names a reason for a level other than CLEAR, or a degraded state. Bits of a set. msg/Warning.msg has the same
/// numbers and explains each of them.
enum Reason : std::uint32_t {
  kNoPose = 1U << 0,
  kPoseStale = 1U << 1,
  kPoseInvalid = 1U << 2,
  kOutOfOrder = 1U << 3,
  kFutureStamp = 1U << 4,
  kNoMesh = 1U << 5,
  kMeshStale = 1U << 6,
  kMeshInvalid = 1U << 7,
  kTfFail = 1U << 8,
  kTimeJump = 1U << 9,
  kDetectorFault = 1U << 10,
  kNotSwept = 1U << 11,
  kNotCovered = 1U << 12,
  kOverload = 1U << 13,
  kDisabled = 1U << 14,
  kMultiPublisher = 1U << 15,
  kPoseLoss = 1U << 16,
  kPosesUnswept = 1U << 17,
  kMeshDropped = 1U << 18,
  kWorkerHung = 1U << 19,
  kSelftest = 1U << 20,
  kCrosscheck = 1U << 21,
};

/// Reasons that report a degraded state and do not change the level. Any other reason makes a warning that would be CLEAR
/// UNKNOWN, and raises `reflex` in the message.
constexpr std::uint32_t kDegraded = kOverload | kPoseLoss;

}  // namespace sweep_guard_core
