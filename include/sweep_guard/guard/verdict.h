#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard {

/// What the operator is told. The order is that of the message, not of urgency: unknown is never weaker than clear.
enum class Level : std::uint8_t { kUnknown = 0, kClear = 1, kConsidered = 2, kReflex = 3, kContact = 4 };

/// Why a level is not clear, or what is degraded. Bits of a set.
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
};

/// When an input was made and when it came in.
struct Seen {
  Time stamp;
  SteadyTime received;
};

/// Age on the clock on which it is larger.
Duration age(const Seen& seen, const Instant& now);

/// @param timeout  Duration::max(): never
bool stale(const Seen& seen, const Instant& now, Duration timeout);

/// Everything a verdict rests on.
struct Evidence {
  struct Object {
    std::string id;
    Seen seen;
    bool swept = false;  ///< at the newest pose, in this revision
  };
  struct Contact {
    std::string id;
    std::vector<std::uint32_t> triangles;  ///< ascending, each once
    SteadyTime found;
    bool lasting = false;  ///< the newest sweep has met it
  };

  std::optional<Seen> pose;  ///< newest pose that has been swept
  std::vector<Object> objects;
  std::optional<Contact> contact;        ///< newest contact
  Time covered_until;                    ///< every workpiece has been swept up to here; epoch: never
  std::map<Reason, std::string> faults;  ///< in force, each with its story
};

struct VerdictLimits {
  Duration pose_timeout;  ///< a pose older than this is stale; > 0
  Duration mesh_timeout;  ///< a workpiece older than this is stale; Duration::max(): never
  Duration hold_time;     ///< a contact is shown for so long after the tool has left; >= 0
};

/// The level and why.
struct Verdict {
  Level level = Level::kUnknown;
  std::uint32_t reasons = 0;             ///< bits of Reason
  std::string text;                      ///< level and reasons in words
  std::string mesh_id;                   ///< object of the contact
  std::vector<std::uint32_t> triangles;  ///< of the contact
  Time pose_stamp;                       ///< of the newest pose swept to; epoch: none
  Time covered_until;                    ///< every workpiece has been swept up to here; epoch: never
};

/// Contact before unknown before clear. Clear takes a fresh pose, a workpiece, every workpiece fresh and swept at that
/// pose, and no fault: whatever is missing is unknown, not clear. Reasons are named whatever the level. Ages are the
/// larger of both clocks.
Verdict assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits);

/// `UNKNOWN`, `CLEAR`, ...
const char* nameOf(Level level);

}  // namespace sweep_guard
