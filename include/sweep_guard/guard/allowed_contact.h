#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/mutex.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// A link of the tool and a workpiece that may touch, wherever and however deep.
struct AllowedPair {
  static constexpr const char* kAny = "*";

  std::string link;     ///< of a ConvexPiece; kAny: every link
  std::string mesh_id;  ///< of a Workpiece; kAny: every workpiece

  bool concerns(const std::string& id) const { return mesh_id == kAny || mesh_id == id; }
  bool holds(const std::string& tool_link) const { return link == kAny || link == tool_link; }
  bool operator==(const AllowedPair& other) const { return link == other.link && mesh_id == other.mesh_id; }
};

using AllowedPairs = std::vector<AllowedPair>;

/// Returns the pair in words: "link 'finger' with 'payload'".
std::string describe(const AllowedPair& pair);

/// Remembers which allowed pairs have ever had a workpiece: an id that never comes may be misspelled. Any thread.
class AllowedMatches {
 public:
  explicit AllowedMatches(const AllowedPairs& pairs);

  void follow(const Workpieces& newest);  ///< takes the workpieces that are there

  const AllowedPairs& pairs() const { return pairs_; }
  std::vector<bool> matched() const;  ///< of each pair: a workpiece of it was there, or any will do

 private:
  const AllowedPairs pairs_;
  mutable Mutex mutex_;
  std::vector<bool> matched_ SWEEP_GUARD_GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_core
