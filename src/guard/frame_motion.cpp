#include "sweep_guard/guard/frame_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kMaxBeyond = std::chrono::milliseconds(250);
constexpr Duration kGoesOn = std::chrono::seconds(2);              // a frame that nobody predicts; then it rests
constexpr Duration kVelocityTime = std::chrono::milliseconds(20);  // stamps that are nearer make noise of rounding
constexpr Duration kKept = std::chrono::milliseconds(100);         // of what velocity() needs
constexpr size_t kMaxKept = 8192;                                  // as SampleBuffer

// The pose P that the prediction begins at may lie between two measured ones, A and C. On the way to it, the frame is within the
// bound of Motion(A, C), which is within its arc of the chord from A; that chord ends within the bound of P, and is within the
// arc of Motion(A, P) of it.
double boundOfFirst(const FrameMotion& motion, double radius) {
  const auto is_before = [](const FramePose& pose, Time limit) { return pose.stamp < limit; };
  const auto next = std::lower_bound(motion.measured.begin(), motion.measured.end(), motion.predicted_from, is_before);
  if (next == motion.measured.end()) return 0.0;
  if (next->stamp == motion.predicted_from || next == motion.measured.begin()) return next->deviation_bound;
  const auto arc = [&](const Eigen::Isometry3d& X_WM) {
    return chordError(radius, Motion{std::prev(next)->X_WM, X_WM}.angle());
  };
  return 2.0 * next->deviation_bound + arc(next->X_WM) + arc(motion.predicted.front().X_WM);
}

// The bounds hold for points within a radius.
std::vector<PredictedFrame> knotsOf(const FrameMotion& motion, double radius) {
  std::vector<PredictedFrame> knots;
  for (const FramePose& pose : motion.measured) {
    if (motion.predicted.empty() || pose.stamp < motion.predicted_from)
      knots.push_back({pose.stamp - motion.predicted_from, pose.X_WM, Matrix6d::Zero(), pose.deviation_bound});
  }
  const size_t measured = knots.size();
  knots.insert(knots.end(), motion.predicted.begin(), motion.predicted.end());
  if (knots.size() > measured) knots[measured].deviation_bound = boundOfFirst(motion, radius);
  return knots;
}

// After the last knot it goes on as between the last two; the error grows with the time.
PredictedFrame beyond(const std::vector<PredictedFrame>& knots, Duration ahead) {
  const PredictedFrame& last = knots.back();
  const PredictedFrame& before = knots[knots.size() - 2];
  const double step = toSeconds(last.ahead - before.ahead);
  const double share = step > 0.0 ? toSeconds(ahead - last.ahead) / step : 0.0;
  const Eigen::AngleAxisd turn(before.X_WM.linear().transpose() * last.X_WM.linear());
  PredictedFrame knot = last;
  knot.ahead = ahead;
  knot.X_WM.linear() = last.X_WM.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis());
  knot.X_WM.translation() += share * (last.X_WM.translation() - before.X_WM.translation());
  const double end = toSeconds(last.ahead);
  if (end > 0.0) knot.covariance *= std::pow(toSeconds(ahead) / end, 2);
  return knot;
}

// Where the frame was placed anew too shortly before, it goes on as before, turned with it.
Vector6d velocityAt(size_t newest, const std::vector<FramePose>& measured) {
  const FramePose& to = measured[newest];
  size_t from = newest;
  while (from > 0 && !measured[from].anew && to.stamp - measured[from].stamp < kVelocityTime) --from;
  const FramePose& begin = measured[from];
  const Duration span = to.stamp - begin.stamp;
  Vector6d velocity = Vector6d::Zero();
  if (begin.anew && from > 0 && span < kVelocityTime) {
    const Eigen::Matrix3d turned = begin.X_WM.linear() * measured[from - 1].X_WM.linear().transpose();
    const Vector6d before = velocityAt(from - 1, measured);
    velocity << turned * before.head<3>(), turned * before.tail<3>();
  } else if (span > Duration::zero()) {
    const Eigen::AngleAxisd turn(to.X_WM.linear() * begin.X_WM.linear().transpose());
    velocity << (to.X_WM.translation() - begin.X_WM.translation()) / toSeconds(span),
        turn.angle() / toSeconds(span) * turn.axis();
  }
  return velocity;
}

// A frame that nobody predicts. Its error is that of a speed that is unknown by as much as it is.
PredictedFrame wentOn(const FrameMotion& motion, Duration ahead) {
  const FramePose& newest = motion.measured.back();
  const double seconds = toSeconds(std::min(motion.predicted_from + ahead - newest.stamp, kGoesOn));
  const Vector6d way = seconds * motion.velocity();
  PredictedFrame knot{ahead, newest.X_WM};
  const Eigen::Vector3d turn = way.tail<3>();
  if (!turn.isZero(0.0)) knot.X_WM.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * newest.X_WM.linear();
  knot.X_WM.translation() += way.head<3>();
  knot.covariance.diagonal() << Eigen::Vector3d::Constant(way.head<3>().squaredNorm() / 3.0),
      Eigen::Vector3d::Constant(turn.squaredNorm() / 3.0);
  return knot;
}

std::optional<PredictedFrame> knotAt(const FrameMotion& motion, const std::vector<PredictedFrame>& knots, Time time) {
  const Duration ahead = time - motion.predicted_from;
  const auto is_before = [](const PredictedFrame& knot, Duration limit) { return knot.ahead < limit; };
  const auto next = std::lower_bound(knots.begin(), knots.end(), ahead, is_before);
  if (next == knots.end()) {
    if (motion.goes_on) return wentOn(motion, ahead);
    const bool known = motion.predicted.size() > 1 && ahead - knots.back().ahead <= kMaxBeyond;
    return known ? std::optional(beyond(knots, ahead)) : std::nullopt;
  }
  if (next->ahead == ahead) return *next;
  if (next == knots.begin()) return std::nullopt;
  const PredictedFrame& before = *std::prev(next);
  const double share = toSeconds(ahead - before.ahead) / toSeconds(next->ahead - before.ahead);
  return PredictedFrame{ahead, Motion{before.X_WM, next->X_WM}.at(share),
                        (1.0 - share) * before.covariance + share * next->covariance, next->deviation_bound};
}

// Of the points within a radius, from a Motion from the first knot to the last.
double deviationBound(const std::vector<PredictedFrame>& knots, double radius) {
  double deviation = 0.0;
  for (const PredictedFrame& knot : knots)
    deviation = std::max(deviation, &knot == &knots.front() ? 0.0 : knot.deviation_bound);
  if (knots.size() == 2) return deviation;
  Path path;
  for (const PredictedFrame& knot : knots) {
    const double turn = path.empty() ? 0.0 : Motion{path.back().X_MT, knot.X_WM}.angle();
    path.push_back({knot.ahead - knots.front().ahead, knot.X_WM, chordError(radius, turn)});
  }
  return deviation + mergedMotion(path, 0, path.size() - 1, radius).deviation_bound;
}

bool isEarlier(const FramePose& pose, Time time) { return pose.stamp < time; }

void insert(const FramePose& pose, std::vector<FramePose>& measured) {
  const auto place = std::lower_bound(measured.begin(), measured.end(), pose.stamp, isEarlier);
  if (place == measured.end() || place->stamp != pose.stamp) measured.insert(place, pose);
}

// Poses that other ones replace for every later pose of the tool.
void forgetBefore(Time pose, std::vector<FramePose>& measured) {
  const Time from = std::min(pose, measured.back().stamp - kKept);
  const auto is_needed = [&](const FramePose& one) { return one.stamp > from; };
  const auto needed = std::find_if(measured.begin(), measured.end(), is_needed);
  const auto kept =
      std::min<std::ptrdiff_t>(needed - measured.begin() - 1, static_cast<std::ptrdiff_t>(measured.size()) - 2);
  if (kept > 0) measured.erase(measured.begin(), measured.begin() + kept);
}

// The frame goes straight past them.
void passOver(size_t count, std::vector<FramePose>& measured) {
  if (count == 0) return;
  const auto end = measured.begin() + 1 + static_cast<std::ptrdiff_t>(count);
  end->left_out = true;
  end->anew = std::any_of(measured.begin() + 1, end + 1, [](const FramePose& pose) { return pose.anew; });
  measured.erase(measured.begin() + 1, end);
}

bool beginsWith(const std::string& name, const std::string& beginning) {
  return name.compare(0, beginning.size(), beginning) == 0;
}

}  // namespace

std::optional<PredictedFrame> FrameMotion::at(Time time) const {
  auto knot = knotAt(*this, knotsOf(*this, 0.0), time);
  if (knot) knot->deviation_bound = 0.0;
  return knot;
}

Vector6d FrameMotion::velocity() const { return velocityAt(measured.size() - 1, measured); }

std::optional<std::vector<PredictedFrame>> framePath(const FrameMotion& motion, Time begin, const PredictedPath& path,
                                                     double radius) {
  const std::vector<PredictedFrame> knots = knotsOf(motion, radius);
  std::optional<PredictedFrame> from = knotAt(motion, knots, begin);
  if (!from) return std::nullopt;
  std::vector<PredictedFrame> frame;
  frame.push_back({Duration::zero(), from->X_WM, from->covariance});
  for (const PredictedPose& pose : path) {
    const auto to = knotAt(motion, knots, begin + pose.ahead);
    if (!to) return std::nullopt;
    std::vector<PredictedFrame> between{*from};
    for (const PredictedFrame& knot : knots) {
      if (from->ahead < knot.ahead && knot.ahead < to->ahead) between.push_back(knot);
    }
    between.push_back(*to);
    frame.push_back({pose.ahead, to->X_WM, to->covariance, deviationBound(between, radius)});
    from = to;
  }
  return frame;
}

FrameMotionStore::FrameMotionStore() : motions_(std::make_shared<const FrameMotions>()) {}

void FrameMotionStore::expect(const std::string& beginning, const std::set<std::string>& frames) {
  const Lock lock(mutex_);
  for (auto frame = frames_.begin(); frame != frames_.end();)
    frame = beginsWith(*frame, beginning) ? frames_.erase(frame) : std::next(frame);
  frames_.insert(frames.begin(), frames.end());
  FrameMotions left;
  for (const auto& [frame, motion] : *motions_) {
    if (frames_.count(frame) != 0 || added_.count(frame) != 0) left.emplace(frame, motion);
  }
  motions_ = std::make_shared<const FrameMotions>(std::move(left));
}

void FrameMotionStore::set(const FrameMotions& motions) {
  const Lock lock(mutex_);
  FrameMotions next = *motions_;
  for (const auto& [frame, motion] : motions) {
    if (frames_.count(frame) != 0) next[frame] = motion;
  }
  motions_ = std::make_shared<const FrameMotions>(std::move(next));
}

void FrameMotionStore::add(const std::string& frame, const std::vector<FramePose>& poses) {
  if (poses.empty()) return;
  const Lock lock(mutex_);
  FrameMotion motion = motionOf(frame);
  for (const FramePose& pose : poses) insert(pose, motion.measured);
  const auto needed_from = needed_from_.find(frame);
  if (needed_from != needed_from_.end()) sweep_guard_core::forgetBefore(needed_from->second, motion.measured);
  passOver(std::max(motion.measured.size(), kMaxKept) - kMaxKept, motion.measured);
  replace(frame, std::move(motion));
}

void FrameMotionStore::placeAnew(const std::string& frame, std::vector<FramePose> placed) {
  const Lock lock(mutex_);
  FrameMotion motion = motionOf(frame);
  auto& measured = motion.measured;
  const Time last = placed.front().stamp - Duration(1);  // that it is in its old place
  const auto before = measured.empty() ? std::nullopt : motion.at(last);
  measured.erase(std::lower_bound(measured.begin(), measured.end(), last, isEarlier), measured.end());
  if (before) measured.push_back({last, before->X_WM});
  placed.front().anew = before.has_value();
  measured.insert(measured.end(), placed.begin(), placed.end());
  replace(frame, std::move(motion));
}

FrameMotion FrameMotionStore::motionOf(const std::string& frame) const {
  const auto known = motions_->find(frame);
  FrameMotion motion;
  if (known != motions_->end()) motion = *known->second;
  motion.goes_on = true;
  return motion;
}

void FrameMotionStore::replace(const std::string& frame, FrameMotion motion) {
  FrameMotions next = *motions_;
  next[frame] = std::make_shared<const FrameMotion>(std::move(motion));
  motions_ = std::make_shared<const FrameMotions>(std::move(next));
  added_.insert(frame);
}

void FrameMotionStore::keepOnly(const std::set<std::string>& frames) {
  const Lock lock(mutex_);
  FrameMotions left = *motions_;
  for (auto frame = added_.begin(); frame != added_.end();) {
    if (frames.count(*frame) == 0) {
      left.erase(*frame);
      needed_from_.erase(*frame);
    }
    frame = frames.count(*frame) == 0 ? added_.erase(frame) : std::next(frame);
  }
  if (left.size() != motions_->size()) motions_ = std::make_shared<const FrameMotions>(std::move(left));
}

void FrameMotionStore::forgetBefore(Time pose, const FrameMotions& known) {
  const Lock lock(mutex_);
  for (const auto& [frame, motion] : known) {
    if (added_.count(frame) != 0) needed_from_[frame] = std::min(pose, motion->measured.back().stamp);
  }
}

std::shared_ptr<const FrameMotions> FrameMotionStore::get() const {
  const Lock lock(mutex_);
  return motions_;
}

bool FrameMotionStore::expects(const std::string& frame) const {
  const Lock lock(mutex_);
  return frames_.count(frame) != 0;
}

std::shared_ptr<const FrameMotion> FrameMotionStore::find(const std::string& frame) const {
  const auto motions = get();
  const auto found = motions->find(frame);
  return found == motions->end() ? nullptr : found->second;
}

std::optional<Eigen::Isometry3d> FrameMotionStore::at(const std::string& frame, Time time) const {
  const auto motion = find(frame);
  const auto pose = motion ? motion->at(time) : std::nullopt;
  return pose ? std::optional(pose->X_WM) : std::nullopt;
}

std::optional<Eigen::Isometry3d> FrameMotionStore::newest(const std::string& frame) const {
  const auto motion = find(frame);
  return motion ? std::optional(motion->measured.back().X_WM) : std::nullopt;
}

}  // namespace sweep_guard_core
