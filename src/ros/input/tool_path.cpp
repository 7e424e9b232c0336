#include "ros/input/tool_path.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::PoseWithFrames;
using sweep_guard_core::Time;

constexpr sweep_guard_core::Duration kBeforeChange = std::chrono::nanoseconds(1);  // of place, a pose was where it was

// Moves the tool with all that belongs to it by a motion of the fixed frame.
void moveTool(const Eigen::Isometry3d& motion_W, PoseWithFrames& pose) {
  pose.X_WT = motion_W * pose.X_WT;
  for (sweep_guard_core::BodyPose& body : pose.bodies) body.X_WB = motion_W * body.X_WB;
  pose.state.X_WR = motion_W * pose.state.X_WR;
}

std::set<std::string> movedFrames(const MovingFrames::Poses& before, const MovingFrames::Poses& now) {
  std::set<std::string> moved;
  for (const auto& [frame, X_WM] : now) {
    const auto known = before.find(frame);
    if (known != before.end() && known->second.matrix() != X_WM.matrix()) moved.insert(frame);
  }
  return moved;
}

}  // namespace

// Nobody knows when static transforms changed: after what had come in before.
void ToolPath::note(Time stamp, std::uint64_t static_changes) {
  if (static_changes > static_changes_ && !changed_after_) changed_after_ = newest_stamp_.value_or(Time());
  static_changes_ = std::max(static_changes_, static_changes);
  newest_stamp_ = std::max(newest_stamp_.value_or(stamp), stamp);
}

std::optional<Time> ToolPath::place(std::vector<PoseWithFrames>& poses, const std::string& frame,
                                    const Checkpoint& checkpoint, std::vector<sweep_guard_core::QueuedPose>& placed) {
  useWorkpieceFrames();
  const Time stamp = poses.back().stamp;
  const bool changed = changed_after_ && *changed_after_ < stamp;
  const bool twice = changed && placed_.X_WF;
  const Checkpoint before = placed_.checkpoint;
  path_.clear();
  placed.clear();
  if (twice) path_.push_back(placed_);
  for (PoseWithFrames& pose : poses) {
    placeFrames(pose, frame, checkpoint);
    if (changed) path_.push_back(placed_);
    if (twice) pose.stamp = std::min(pose.stamp, stamp - kBeforeChange);
    if (!changed || twice) placed.push_back({std::move(pose), twice ? before : checkpoint});
  }
  if (!changed) return std::nullopt;
  changed_after_.reset();
  anew_ = twice ? path_.size() - 1 : 0;
  return repeat_at_ = stamp;
}

Time ToolPath::endAtNewest(std::uint64_t static_changes) {
  static_changes_ = static_changes;
  changed_after_.reset();
  path_.clear();
  if (!placed_.X_WF) return newest_stamp_.value_or(Time());
  path_.push_back(placed_);
  path_.back().pose.received = std::chrono::steady_clock::now();
  anew_ = 1;
  return repeat_at_ = placed_.pose.stamp + kBeforeChange;
}

// What is placed anew does not move on the path, but for the tool.
void ToolPath::repeat(std::set<std::string> frames, const Checkpoint& checkpoint,
                      std::vector<sweep_guard_core::QueuedPose>& placed) {
  placed.clear();
  if (path_.empty()) return;
  sweep_guard_core::PlacedAnew placed_anew;
  placed_anew.frames = std::move(frames);
  placed_anew.tool = movePath();
  const MovingFrames::Poses X_WM = moving_frames_.resting(*workpiece_frames_);
  placed_anew.frames.merge(movedFrames(path_.front().pose.X_WM, X_WM));
  const sweep_guard_core::SteadyTime received = path_.back().pose.received;
  for (size_t i = 0; i < path_.size(); ++i) {
    PoseWithFrames& pose = path_[i].pose;
    if (anew_ > 0) pose.stamp = repeat_at_;
    pose.received = received;
    pose.X_WM = X_WM;
    pose.jump.clear();
    if (i < anew_) pose.anew = placed_anew;
    placed_anew.goes_on = true;
    placed.push_back({pose, checkpoint});
  }
  placed_ = path_.back();
  placed_.pose.anew.reset();
  placed_.X_WF = frames_.find(fixed_frame_, placed_.frame, repeat_at_);
}

void ToolPath::clear() {
  placed_.X_WF.reset();
  newest_stamp_.reset();
}

void ToolPath::useWorkpieceFrames() {
  const auto frames = workpieces_.frames();
  if (frames == workpiece_frames_) return;
  workpiece_frames_ = frames;
  frames_.use("workpieces", fixed_frame_, *frames);
}

void ToolPath::placeFrames(PoseWithFrames& pose, const std::string& frame, const Checkpoint& checkpoint) {
  if (placed_.X_WF) pose.stamp = std::max(pose.stamp, placed_.pose.stamp);  // after a change that was applied late
  pose.X_WM = moving_frames_.locate(*workpiece_frames_, pose.stamp);
  placed_.X_WF = frames_.find(fixed_frame_, frame, pose.stamp);
  placed_.frame = frame;
  placed_.checkpoint = checkpoint;
  placed_.pose = pose;
}

// Returns whether the tool is elsewhere on the path. A pose that tf has forgotten moves as the one after it.
bool ToolPath::movePath() {
  bool moved = false;
  Eigen::Isometry3d motion_W = Eigen::Isometry3d::Identity();
  for (auto placed = path_.rbegin(); placed != path_.rend(); ++placed) {
    const auto X_WF = frames_.find(fixed_frame_, placed->frame, placed->pose.stamp);
    if (X_WF && placed->X_WF) {
      const bool rests = X_WF->matrix() == placed->X_WF->matrix();
      motion_W = rests ? Eigen::Isometry3d::Identity() : *X_WF * placed->X_WF->inverse();
      moved = moved || !rests;
    }
    moveTool(motion_W, placed->pose);
    if (placed->X_WF) placed->X_WF = motion_W * *placed->X_WF;
  }
  return moved;
}

}  // namespace sweep_guard_ros
