#pragma once

#include <cstdint>

namespace sweep_guard_core {

/// Names a reason for a level other than CLEAR, or a degraded state. Bits of a set; msg/Warning.msg has the same
/// numbers. The limits are those of WarningLimits.
enum Reason : std::uint32_t {
  kNoPose = 1U << 0,           ///< no tool pose has been swept yet
  kPoseStale = 1U << 1,        ///< the newest swept pose is older than `pose_timeout`
  kPoseInvalid = 1U << 2,      ///< a pose was refused: NaN, out of range, no stamp, no unit quaternion, or unreadable
  kOutOfOrder = 1U << 3,       ///< a pose was refused: its stamp is older than the previous pose's
  kFutureStamp = 1U << 4,      ///< a pose was refused: its stamp lies in the future
  kNoMesh = 1U << 5,           ///< no workpiece has arrived, or not each required one
  kMeshStale = 1U << 6,        ///< a workpiece is older than `mesh_timeout`
  kMeshInvalid = 1U << 7,      ///< a mesh or vertices were refused, or belong to no workpiece
  kTfFail = 1U << 8,           ///< a transform is missing or not rigid, or those of a frame that moves are late
  kTimeJump = 1U << 9,         ///< time jumped, or a static transform that counts changed, and no pose was swept since
  kDetectorFault = 1U << 10,   ///< the detector or a thread of the guard failed
  kNotSwept = 1U << 11,        ///< a workpiece was not swept at the newest pose, or not with all its updates
  kNotCovered = 1U << 12,      ///< not every workpiece is tested up to now + `considered`
  kOverload = 1U << 13,        ///< poses that had waited for more than `overload` were swept at once
  kDisabled = 1U << 14,        ///< the guard is disabled, or shuts down
  kMultiPublisher = 1U << 15,  ///< several nodes publish tool poses, or a frame, which is not allowed
  kPoseLoss = 1U << 16,        ///< poses were sent and did not arrive
  kPosesUnswept = 1U << 17,    ///< a pose was left out, or waits longer than both `overload` and the newest prediction
  kMeshDropped = 1U << 18,     ///< an update of a workpiece was dropped unread
  kWorkerHung = 1U << 19,      ///< a thread of the guard has work and makes no progress
  kSelftest = 1U << 20,        ///< the detector failed its test at the start, and was not exchanged for one that passes
  kCrosscheck = 1U << 21,      ///< two detectors disagreed about a sweep
  kInsideUntested = 1U << 22,  ///< the surface of a workpiece has a border, and the sender does not say that it is open
  kJump = 1U << 23,  ///< the tool, a workpiece or a joint moved faster than the limits: what was met may come from that
  kNotSeen = 1U << 24,  ///< of where the tool is going, cameras have seen less than `min_seen` to be free
};

/// Reasons that report a degraded state and do not change the level. Any other reason makes a warning that would be
/// CLEAR UNKNOWN.
constexpr std::uint32_t kDegraded = kOverload | kPoseLoss | kInsideUntested | kJump;

/// Reasons with which the tool may go on. Any other sets the flag `reflex` of msg/Warning.msg.
constexpr std::uint32_t kNotStopping = kDegraded | kNotSeen;

/// Reasons with which the guard may not know every surface, or not where it is.
constexpr std::uint32_t kSurfacesMissing = kNoMesh | kMeshInvalid | kTfFail | kTimeJump | kDetectorFault | kNotSwept;

}  // namespace sweep_guard_core
