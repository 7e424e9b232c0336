#include "guard/pose_history.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {
namespace {

constexpr double kPositionRounding = 0x1p-48;  // relative: a dozen roundings of 2^-53, with a margin

// Searches from the newest on, in steps that double: that is where to look, and what is in the processor's cache.
template <typename Key, typename KeyOf>
size_t lastUpToKey(const PoseSample* first, const PoseSample* end, const Key& key, const KeyOf& key_of) {
  const auto is_before = [&](const Key& a, const PoseSample& sample) { return a < key_of(sample); };
  const PoseSample* beyond = end;
  const auto step = [&] { return std::min(std::max<std::ptrdiff_t>(end - beyond, 1), beyond - first); };
  while (beyond != first && is_before(key, *(beyond - step()))) beyond -= step();
  beyond = std::upper_bound(beyond - step(), beyond, key, is_before);
  return static_cast<size_t>(std::max<std::ptrdiff_t>(beyond - first, 1) - 1);
}

double chordErrorBound(const PoseSample& from, const PoseSample& to, double tool_radius) {
  const double tool = angleBound(from.X_WT.linear(), to.X_WT.linear());
  const double frame = angleBound(from.X_WM.linear(), to.X_WM.linear());
  return chordError(RelativeTurn{tool, frame, from.X_WT.translation() - from.X_WM.translation(),
                                 to.X_WT.translation() - to.X_WM.translation()},
                    tool_radius);
}

double roundingOf(const PoseSample& sample) {
  return kPositionRounding * (sample.X_WT.translation().lpNorm<1>() + sample.X_WM.translation().lpNorm<1>());
}

// @param anew  there is no motion from the one to the other
Eigen::Isometry3d between(Time from, const Eigen::Isometry3d& X_from, Time to, const Eigen::Isometry3d& X_to, bool anew,
                          Time time) {
  if (time >= to) return X_to;
  if (time <= from || anew) return X_from;
  return Motion{X_from, X_to}.at(toSeconds(time - from) / toSeconds(to - from));
}

}  // namespace

size_t PoseHistory::lastUpTo(std::uint64_t number) const {
  return lastUpToKey(all_.begin(), all_.end(), number, [](const PoseSample& sample) { return sample.number; });
}

size_t PoseHistory::lastUpTo(Time stamp) const {
  return lastUpToKey(all_.begin(), all_.end(), stamp, [](const PoseSample& sample) { return sample.stamp; });
}

size_t PoseHistory::endOfMotion(size_t first, size_t last) const {
  size_t end = first;
  while (end < last && !(*this)[end + 1].anew) ++end;
  return end;
}

double PoseHistory::share(size_t from, size_t i, Time end) const {
  if (i <= from) return 0.0;
  const double time = toSeconds(end - (*this)[from].stamp);
  return time > 0.0 ? std::min(1.0, toSeconds((*this)[i].stamp - (*this)[from].stamp) / time) : 1.0;
}

void PoseHistory::path_M(size_t first, size_t last, double tool_radius, Path& path_M) const {
  assert(first <= last && last < size());
  path_M.clear();
  for (size_t i = first; i <= last; ++i) {
    const PoseSample& to = (*this)[i];
    const PoseSample& from = (*this)[std::max(i, first + 1) - 1];
    const double turn = chordError({{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}}, tool_radius);
    const double deviation = i == first ? 0.0 : turn + to.deviation_bound;
    path_M.push_back({to.stamp - (*this)[first].stamp, to.X_WM.inverse() * to.X_WT, deviation});
  }
}

PoseBounds PoseHistory::bounds_M(size_t first, size_t last, const Eigen::Vector3d& point_T, double tool_radius) const {
  assert(first <= last && last < size());
  PoseBounds bounds;
  for (size_t i = first; i <= last; ++i) {
    const PoseSample& to = (*this)[i];
    const Eigen::Vector3d point_W = to.X_WT * point_T - to.X_WM.translation();
    bounds.point_M.extend(to.X_WM.linear().transpose() * point_W);
    const double turn = i == first || to.anew ? 0.0 : chordErrorBound((*this)[i - 1], to, tool_radius);
    bounds.deviation = std::max(bounds.deviation, turn + to.deviation_bound + roundingOf(to));
  }
  return bounds;
}

void SparseMotion::add(Time stamp, const BodyPose& pose) {
  if (path_W_.empty()) {
    first_ = stamp;
    deviation_bound_ = 0.0;
    path_W_.push_back({Duration::zero(), pose.X_WB, 0.0});
    return;
  }
  const double turn = Motion{path_W_.back().X_MT, pose.X_WB}.angle();
  path_W_.push_back({stamp - first_, pose.X_WB, chordError(radius_, turn)});
  deviation_bound_ = std::max(deviation_bound_, pose.deviation_bound);
}

BodyPose SparseMotion::take() {
  assert(!path_W_.empty());
  BodyPose newest{path_W_.back().X_MT, deviation_bound_};
  if (path_W_.size() > 2)
    newest.deviation_bound += mergedMotion(path_W_, 0, path_W_.size() - 1, radius_).deviation_bound;
  first_ += path_W_.back().time;
  path_W_.assign(1, {Duration::zero(), newest.X_WB, 0.0});
  deviation_bound_ = 0.0;
  return newest;
}

void JoinedMotion::join(const FrameMotion& frame, std::vector<PoseSample>& samples) {
  samples.clear();
  if (body_.size() == 0 || (!frame_ && !begin(frame, samples))) return;
  const auto is_after = [](Time time, const FramePose& pose) { return time < pose.stamp; };
  auto next = std::upper_bound(frame.measured.begin(), frame.measured.end(), frame_->stamp, is_after);
  while (body_.size() > 1 && (next != frame.measured.end() || body_[1].stamp <= frame_->stamp)) {
    const FramePose to = next != frame.measured.end() ? *next : FramePose{frame_->stamp, frame_->X_WM};
    const Time time = std::min(body_[1].stamp, to.stamp);
    samples.push_back(at(time, to));
    if (body_[1].stamp == time) body_.forgetFirst();
    if (next != frame.measured.end() && next->stamp == time) frame_ = *next++;
  }
}

// Returns false if no time is known of both.
bool JoinedMotion::begin(const FrameMotion& frame, std::vector<PoseSample>& samples) {
  const auto& measured = frame.measured;
  const Time time = std::max(body_[0].stamp, measured.front().stamp);
  if (time > body_.newest().stamp || time > measured.back().stamp) return false;
  while (body_.size() > 1 && body_[1].stamp <= time) body_.forgetFirst();
  size_t i = 0;
  while (i + 1 < measured.size() && measured[i + 1].stamp <= time) ++i;
  frame_ = measured[i];
  samples.push_back(at(time, measured[std::min(i + 1, measured.size() - 1)]));
  return true;
}

PoseSample JoinedMotion::at(Time time, const FramePose& next) const {
  const PoseSample& from = body_[0];
  const PoseSample& to = body_[std::min<size_t>(1, body_.size() - 1)];
  return {0,
          time,
          between(from.stamp, from.X_WT, to.stamp, to.X_WT, to.anew, time),
          between(frame_->stamp, frame_->X_WM, next.stamp, next.X_WM, next.anew, time),
          to.deviation_bound + next.deviation_bound,
          (to.anew && to.stamp == time) || (next.anew && next.stamp == time),
          next.left_out};
}

}  // namespace sweep_guard_core
