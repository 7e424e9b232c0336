#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/outlook.h"

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
  kNotCovered = 1U << 12,
  kOverload = 1U << 13,
  kDisabled = 1U << 14,
};

/// Reasons that tell of something degraded, and leave the level as it is.
constexpr std::uint32_t kDegraded = kOverload;

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
    bool lasting = false;                  ///< the newest sweep has met it
    bool inside = false;                   ///< the tool is inside of it
    std::optional<size_t> tool_part = {};  ///< that touched first, where the fine phase knows
  };
  /// A contact that the newest prediction of its workpiece expects. In force until that prediction ends.
  struct Expectation {
    ExpectedContact contact;
    Seen pose;         ///< that the prediction began at
    Duration reach{};  ///< how far after that pose it ends
  };
  /// A warning that is no longer in force.
  struct Alarm {
    ExpectedContact contact;
    SteadyTime ended;  ///< when it was in force last
  };

  /// Poses that had to wait, and were swept all at once.
  struct Backlog {
    Duration span{};  ///< from the first to the last of them
    SteadyTime found;
  };

  std::optional<Seen> pose;  ///< newest pose that has been swept
  std::vector<Object> objects;
  std::optional<Contact> contact;  ///< newest contact
  std::optional<Expectation> expected;
  std::optional<Alarm> reflex;      ///< newest that has ended
  std::optional<Alarm> considered;  ///< newest that has ended
  Time covered_until;               ///< no workpiece is left untested up to here, measured or predicted; epoch: never
  std::optional<Backlog> overload;  ///< newest that was too long
  std::map<Reason, std::string> faults;  ///< in force, each with its story
  std::optional<std::string> disabled;   ///< who asked for it, if the guard is disabled: nothing else counts then
};

struct VerdictLimits {
  Duration pose_timeout;  ///< a pose older than this is stale; > 0
  Duration mesh_timeout;  ///< a workpiece older than this is stale; Duration::max(): never
  Duration hold_time;     ///< a contact or a warning is shown for so long after it is over; >= 0
  Duration reflex = std::chrono::milliseconds(100);       ///< end of the reflex interval, > 0
  Duration considered = std::chrono::milliseconds(1000);  ///< end of the considered interval, > reflex
  Duration tick = std::chrono::milliseconds(15);          ///< until the verdict is asked for again at the latest; >= 0
  Duration overload = std::chrono::milliseconds(20);      ///< a longer backlog of poses is told of; >= 0
  double min_probability = 0.1;                           ///< of a contact that is warned of, in (0, 1]
};

/// The level and why.
struct Verdict {
  Level level = Level::kUnknown;
  std::uint32_t reasons = 0;  ///< bits of Reason
  std::string text;           ///< level and reasons in words
  std::string mesh_id;        ///< object of the contact or of the collision expected
  /// Index of the part of the tool: in contact the one that touched first, where the fine phase knows; before, the one
  /// that is expected to, or likeliest to.
  std::optional<size_t> tool_part;
  std::vector<std::uint32_t> triangles;  ///< of the contact, or those that the predicted path meets
  /// Until the predicted path meets that workpiece, >= 0; empty: it does not, though a collision may be probable, or
  /// the level is held for another workpiece's.
  std::optional<Duration> time_to_collision;
  double probability = 0.0;  ///< of that collision, in [0, 1]; 0 without
  Time pose_stamp;           ///< of the newest pose swept to; epoch: none
  Time covered_until;        ///< no workpiece is left untested up to here; epoch: never

  void clear();  ///< as new; keeps its buffers
};

/// Contact before reflex before considered before unknown before clear. A warning is due as soon as the collision
/// expected would come within its interval before the verdict is asked for again; it is held for its hold time. Clear
/// takes a fresh pose, a workpiece, every workpiece fresh, swept at that pose and tested up to the end of the
/// considered interval, and no fault: whatever is missing is unknown, not clear. Reasons are named whatever the level;
/// an overload alone, which costs exactness but leaves nothing unswept, does not change it.
/// A guard that is disabled is unknown for that reason alone. Ages are the larger of both clocks.
/// @param[out] verdict  what was in it is replaced
void assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict);
Verdict assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits);

/// The warning that a collision asks for: kReflex, kConsidered, or kClear for none.
/// @param left  until it comes
Level warningOf(Duration left, const VerdictLimits& limits);

/// The warning that an expectation alone asks for now, or at the end of its prediction if that is over: kReflex,
/// kConsidered, or kClear for none.
Level warningOf(const Evidence::Expectation& expectation, const Instant& now, const VerdictLimits& limits);

/// How long the prediction of an expectation has been over; 0 if it is not.
Duration overSince(const Evidence::Expectation& expectation, const Instant& now);

/// `UNKNOWN`, `CLEAR`, ...
const char* nameOf(Level level);

}  // namespace sweep_guard
