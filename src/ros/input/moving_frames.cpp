#include "ros/input/moving_frames.h"

#include <algorithm>
#include <chrono>

#include "common/heartbeat.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Time;

constexpr size_t kMaxWanted = 8192;  // as many poses of the tool wait

}  // namespace

MovingFrames::Poses MovingFrames::locate(const std::set<std::string>& frames, Time stamp) {
  const sweep_guard_core::Lock lock(mutex_);
  Poses X_WM;
  std::set<std::string> moving;
  for (const std::string& frame : frames) {
    sweep_guard_core::beat();
    if (dependencies_.frame_motions.expects(frame)) continue;
    try {
      const NewestPose newest = dependencies_.frames.newestPose(fixed_frame_, frame);
      if (newest.stamp == Time()) {
        X_WM[frame] = newest.X;
        continue;
      }
      follow(frame, newest);
      samples_.clear();
      if (stamp < newest.stamp && followed_[frame].anew_from < stamp) sampleAt(frame, stamp);
      dependencies_.frame_motions.add(frame, samples_);
      moving.insert(frame);
    } catch (const FrameError& error) {
      report(frame, error);
    }
  }
  keepOnly(moving);
  if (moving.empty()) return X_WM;
  wanted_.push_back(stamp);
  forgetWanted();
  return X_WM;
}

MovingFrames::Poses MovingFrames::resting(const std::set<std::string>& frames) const {
  Poses X_WM;
  for (const std::string& frame : frames) {
    try {
      const NewestPose newest = dependencies_.frames.newestPose(fixed_frame_, frame);
      if (newest.stamp == Time()) X_WM[frame] = newest.X;
    } catch (const FrameError&) {  // the next pose reports it
    }
  }
  return X_WM;
}

void MovingFrames::sample() {
  const sweep_guard_core::Lock lock(mutex_);
  bool moved = false;
  for (const auto& [frame, followed] : followed_) moved = follow(frame) || moved;
  if (!moved) return;
  forgetWanted();
  dependencies_.queue.framesMoved();
}

std::set<std::string> MovingFrames::applyStaticChanges(Time from) {
  const sweep_guard_core::Lock lock(mutex_);
  std::set<std::string> anew;
  if (!dependencies_.frames.applyStaticChanges()) return anew;
  for (auto& [frame, followed] : followed_) {
    if (placeAnew(frame, followed, from)) anew.insert(frame);
  }
  return anew;
}

bool MovingFrames::follow(const std::string& frame) {
  try {
    return follow(frame, dependencies_.frames.newestPose(fixed_frame_, frame));
  } catch (const FrameError&) {
    return false;  // the next pose reports it
  }
}

// Returns whether it is known further.
bool MovingFrames::follow(const std::string& frame, const NewestPose& newest) {
  const auto [known, is_new] = followed_.emplace(frame, Followed{newest, Time()});
  Followed& followed = known->second;
  samples_.clear();
  if (!is_new && newest.stamp < followed.newest.stamp) {  // time went back
    std::set<std::string> others;
    for (const auto& [other, state] : followed_) {
      if (other != frame) others.insert(other);
    }
    dependencies_.frame_motions.keepOnly(others);
    wanted_.clear();
    followed.anew_from = Time();
  } else if (!is_new) {
    if (newest.stamp == followed.newest.stamp) return false;
    const Time known_to = std::max(followed.newest.stamp, followed.anew_from);
    for (const Time stamp : wanted_) {
      if (known_to < stamp && stamp < newest.stamp) sampleAt(frame, stamp);
    }
  }
  followed.newest = newest;
  if (followed.anew_from < newest.stamp) samples_.push_back({newest.stamp, newest.X});
  dependencies_.frame_motions.add(frame, samples_);
  dependencies_.monitor.frameHeard(frame, newest.stamp, now());
  return true;
}

// Where it is not known yet, it went on in its old place, and goes on from there in its new one.
bool MovingFrames::placeAnew(const std::string& frame, Followed& followed, Time from) {
  const auto motion = dependencies_.frame_motions.find(frame);
  if (!motion) return false;
  from = std::max(from, motion->measured.front().stamp);
  samples_.clear();
  try {
    const Eigen::Isometry3d X = dependencies_.frames.lookup(fixed_frame_, frame, followed.newest.stamp);
    if (X.matrix() == followed.newest.X.matrix()) return false;
    const Eigen::Isometry3d moved_W = X * followed.newest.X.inverse();
    followed.newest.X = X;
    if (from < followed.newest.stamp) sampleAt(frame, from);
    const auto X_old = motion->at(from);
    if (samples_.empty() && X_old) samples_.push_back({from, moved_W * X_old->X_WM});
    for (const sweep_guard_core::FramePose& pose : motion->measured) {
      if (from < pose.stamp) sampleAt(frame, pose.stamp);
    }
  } catch (const FrameError&) {
    return false;  // the next pose reports it
  }
  if (samples_.empty()) return false;
  followed.anew_from = from;
  dependencies_.frame_motions.placeAnew(frame, samples_);
  return true;
}

// tf may have forgotten it, or not know it yet: then the frame moves straight past it.
void MovingFrames::sampleAt(const std::string& frame, Time stamp) {
  if (const auto X = dependencies_.frames.find(fixed_frame_, frame, stamp)) samples_.push_back({stamp, *X});
}

void MovingFrames::keepOnly(const std::set<std::string>& moving) {
  const auto is_one = [&](const auto& followed) { return moving.count(followed.first) != 0; };
  if (moving.size() == followed_.size() && std::all_of(followed_.begin(), followed_.end(), is_one)) return;
  for (auto followed = followed_.begin(); followed != followed_.end();)
    followed = is_one(*followed) ? std::next(followed) : followed_.erase(followed);
  dependencies_.frame_motions.keepOnly(moving);
  dependencies_.monitor.setMovingFrames(moving);
}

void MovingFrames::report(const std::string& frame, const FrameError& error) {
  const std::string message = "workpieces in '" + frame + "' not swept: " + error.what();
  dependencies_.record.error(message, /*refused=*/false);
  dependencies_.monitor.fault(sweep_guard_core::kTfFail, error.what());
  log_.error(frame, message);
}

void MovingFrames::forgetWanted() {
  Time known_until = Time::max();
  for (const auto& [frame, followed] : followed_) known_until = std::min(known_until, followed.newest.stamp);
  while (!wanted_.empty() && wanted_.front() <= known_until) wanted_.pop_front();
  while (wanted_.size() > kMaxWanted) wanted_.pop_front();
}

}  // namespace sweep_guard_ros
