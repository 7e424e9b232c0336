#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Keeps how old the transforms of frames that move become: `frames` of the inputs. A frame is as old as it can be just before
/// its next transform comes.
class LateFrames {
 public:
  /// @param inputs  must outlive this
  explicit LateFrames(WarningInputs& inputs) : inputs_(inputs) {}

  /// Adds the newest transform of a frame. An older one restarts the measurement: time went back.
  /// @param stamp         of the transform
  /// @param pose_timeout  as lateAge()
  void add(const std::string& name, Time stamp, const Instant& now, Duration pose_timeout);
  void keepOnly(const std::set<std::string>& names);  ///< forgets the others

 private:
  WarningInputs::Frame& find(const std::string& name, const Timestamps& newest);

  WarningInputs& inputs_;
  std::map<std::string, std::vector<Duration>> intervals_;  // between the newest transforms of a frame
};

/// Returns how old a frame is that is late, or was last while it was late; empty: it is not late. It is if it is older than
/// `pose_timeout` and one period of its transforms, of which at most `pose_timeout` counts, or was so within the last second.
std::optional<Duration> lateAge(const WarningInputs::Frame& frame, const Instant& now, Duration pose_timeout);

}  // namespace sweep_guard_core
