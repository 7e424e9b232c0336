#pragma once

#include <vector>

#include "sweep_guard/common/priority_mutex.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Remembers which allowed pairs have ever had a workpiece: an id that never comes may be misspelled. Any thread.
class AllowedMatches {
 public:
  struct Match {
    AllowedPair pair;
    bool has_matched;  ///< a workpiece of the pair was there, or any will do
  };

  explicit AllowedMatches(const AllowedPairs& pairs);

  void follow(const Workpieces& newest);  ///< takes the workpieces that are there

  std::vector<Match> matches() const;  ///< in the order of the pairs

 private:
  mutable PriorityMutex mutex_;
  std::vector<Match> matches_;
};

}  // namespace sweep_guard_core
