// How much of their predicted paths a camera sees, in rendered sessions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <sstream>

#include "camera/camera_guard.h"
#include "camera/rendered_scene.h"
#include "data_path.h"
#include "scenes.h"
#include "sweep_guard/monitor/warning.h"
#include "sweep_guard/motion/motion_guard.h"

namespace sweep_guard_core {
namespace {

constexpr double kShank = 0.15;  // length of the bit of a drill [m]
constexpr double kBit = 0.005;   // its radius
constexpr double kBody = 0.03;   // radius of the body behind it
constexpr double kBodyLength = 0.2;
constexpr double kHold = 0.5;  // of a warning, after its end [s]

Tool drill() {
  return Tool({{"bit", ConvexShape::cylinder(kBit, kShank)},
               {"body", ConvexShape::cylinder(kBody, kBodyLength).placed(placedAt(0.0, 0.0, -kShank))}});
}

std::vector<Solid> drillAt(const Eigen::Isometry3d& X_WT) {
  return {cylinderAt(X_WT, kBit, kShank),
          cylinderAt(X_WT * Eigen::Translation3d(0.0, 0.0, -kShank), kBody, kBodyLength)};
}

// Held from above, leaning towards the camera.
Eigen::Isometry3d heldAt(const Eigen::Vector3d& tip_W) {
  Eigen::Isometry3d X_WT = placedAt(tip_W);
  X_WT.rotate(Eigen::AngleAxisd(-0.5, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(0.75 * M_PI, Eigen::Vector3d::UnitY()));
  return X_WT;
}

Eigen::Isometry3d lookingAt(const Eigen::Vector3d& p_W, const Eigen::Vector3d& along_W, double distance) {
  const Eigen::Vector3d z = along_W.normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d X_WC = placedAt(p_W - distance * z);
  X_WC.linear() << x, z.cross(x), z;
  return X_WC;
}

CameraSetup setupOf(const Eigen::Isometry3d& X_WC) {
  return {RenderedScene::kCamera, 640, 480, X_WC, {0.2, 1.5, {0.005, 0.003}}, 0.03};
}

Solid tableTop() { return boxOf({-5.0, -5.0, -1.0}, {5.0, 5.0, 0.0}); }

std::vector<StampedPose> posesIn(const std::filesystem::path& path) {
  std::vector<StampedPose> poses;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream numbers(line);
    double stamp;
    Eigen::Vector3d p;
    Eigen::Quaterniond q;
    if (!(numbers >> stamp >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w())) continue;
    if (!poses.empty() && Time(fromSeconds(stamp)) <= poses.back().stamp) continue;
    poses.push_back({Time(fromSeconds(stamp)), Eigen::Isometry3d(Eigen::Translation3d(p) * q.normalized())});
  }
  return poses;
}

// A recorded hand, made so small that it stays within 0.3 m, above the table.
class Hand {
 public:
  Hand(std::vector<StampedPose> poses, double begin) : poses_(std::move(poses)), begin_(begin) {
    Eigen::AlignedBox3d box;
    for (const StampedPose& pose : poses_) box.extend(pose.X_WT.translation());
    scale_ = std::min(1.0, 0.3 / box.sizes().maxCoeff());
    center_ = box.center() - Eigen::Vector3d(0.0, 0.0, 0.08 / scale_ + 0.5 * box.sizes().z());
  }

  double seconds() const { return toSeconds(poses_.back().stamp - poses_.front().stamp) - begin_; }

  Eigen::Isometry3d at(double seconds) const {
    const Time stamp = poses_.front().stamp + fromSeconds(begin_ + seconds);
    const auto is_later = [](const Time& time, const StampedPose& pose) { return time < pose.stamp; };
    const auto next = std::upper_bound(poses_.begin() + 1, poses_.end() - 1, stamp, is_later);
    const StampedPose& before = *(next - 1);
    const double share = std::clamp(toSeconds(stamp - before.stamp) / toSeconds(next->stamp - before.stamp), 0.0, 1.0);
    const Eigen::Vector3d tip = (1.0 - share) * before.X_WT.translation() + share * next->X_WT.translation();
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(before.X_WT.linear()).slerp(share, Eigen::Quaterniond(next->X_WT.linear()));
    return heldAt(scale_ * (tip - center_)) * (Eigen::Quaterniond(poses_.front().X_WT.linear()).inverse() * turned);
  }

 private:
  std::vector<StampedPose> poses_;
  double begin_;  // [s]
  double scale_;
  Eigen::Vector3d center_;
};

constexpr double kShortFrom = 30.0;  // of a recording, where only a part of it is played [s]

// Returns the shares of the path that the camera sees, each the least of the time for which a warning is shown.
std::vector<double> seenOverTheShoulder(const Hand& hand, double seconds) {
  const Eigen::Isometry3d X_WC = lookingAt(Eigen::Vector3d::Zero(), {0.55, 0.3, -0.78}, 0.9);
  RenderedScene scene(
      X_WC, {tableTop(), boxOf({0.08, -0.15, 0.0}, {0.16, -0.05, 0.06}), sphereAt({0.1, 0.12, 0.04}, 0.05)}, {}, 1);
  CameraGuard guard(drill(), setupOf(X_WC));
  std::deque<std::pair<double, double>> newest;  // time [s], share
  std::vector<double> least;
  const auto see = [&](double at) -> const std::vector<float>& { return scene.image(drillAt(hand.at(at))); };
  const auto note = [&](const SweepReport& /*report*/, double at, double /*image*/) {
    const auto seen = at < 2.0 ? std::nullopt : guard.seen();
    if (!seen) return;
    newest.emplace_back(at, *seen);
    while (at - newest.front().first > kHold) newest.pop_front();
    const auto is_less = [](const auto& one, const auto& other) { return one.second < other.second; };
    least.push_back(std::min_element(newest.begin(), newest.end(), is_less)->second);
  };
  guard.run(
      seconds, [&](double at) { return hand.at(at); }, see, note);
  return least;
}

// Of whole recordings: WarningLimits::min_seen is the largest that holds.
TEST(RecordedHandsTest, OverTheShoulderAreNotSeenForAtMostFivePercentOfTheTime) {
  const bool whole = sceneCount(100, 0.0) >= 100;
  double smallest = 1.0;
  for (const char* name :
       {"handheld_vicon", "handheld_camera_fr2_desk", "handheld_rig_room1", "handheld_stylus_15hz", "robot_arm"}) {
    const auto path = dataPath(std::string("motion/") + name + ".txt");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << missing(path);
    const Hand hand(posesIn(path), whole ? 0.0 : kShortFrom);
    const double seconds = whole ? hand.seconds() : 8.0;
    std::vector<double> shares = seenOverTheShoulder(hand, seconds);
    ASSERT_GT(shares.size(), 200U) << name;
    std::sort(shares.begin(), shares.end());
    smallest = std::min(smallest, shares[shares.size() / 20]);
    RecordProperty(name, std::to_string(shares[shares.size() / 20]));
    EXPECT_GE(shares[shares.size() / 20], WarningLimits{}.min_seen) << name;
  }
  EXPECT_LT(smallest, whole ? 1.3 * WarningLimits{}.min_seen : 1.0);
}

Instant afterMs(int ms) {
  return {Time(std::chrono::milliseconds(100'000 + ms)), SteadyTime(std::chrono::milliseconds(100'000 + ms))};
}
Timestamps receivedAfterMs(int ms) { return {afterMs(ms).stamp, afterMs(ms).steady}; }

// A drill that goes on straight, as fast as a motion guard lets it, to something that the camera does not see.
struct HiddenThing {
  Eigen::Isometry3d X_WC;
  std::vector<Solid> shown;
  Eigen::Vector3d from_W;
  Eigen::Vector3d to_W;  // the tip touches it there
  double speed;          // commanded [m/s]
};

// A board stands across the view. The drill comes from one of its sides, to where it is hidden as a whole.
HiddenThing behindABoard(Random& random) {
  const double half_width = random.uniform(0.2, 0.3);
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double tip = random.uniform(0.02, 0.05);
  const double behind = random.uniform(0.35, 0.4);
  return {lookingAt({0.0, 0.0, 0.2}, {1.0, 0.0, -0.1}, 0.9),
          {tableTop(), boxOf({0.0, -half_width, 0.0}, {0.02, half_width, random.uniform(0.5, 0.6)})},
          {behind, side * 0.55, tip},
          {behind, random.uniform(-0.8 * half_width, 0.8 * half_width - 0.1), tip},
          random.uniform(0.1, 0.5)};
}

// The drill leaves the picture at one of its sides.
HiddenThing beyondThePicture(Random& random) {
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double height = random.uniform(0.05, 0.1);
  const double outside = random.uniform(0.75, 0.9);
  return {lookingAt({0.0, 0.0, 0.0}, {0.55, 0.0, -0.78}, 0.9),
          {tableTop()},
          {0.0, side * 0.1, height},
          {0.0, side * outside, height},
          random.uniform(0.1, 0.5)};
}

class HiddenThingTest : public testing::Test {
 protected:
  // Returns the speed with which the drill arrives; empty: NOT_SEEN was never said before.
  std::optional<double> arrive(const HiddenThing& hidden) {
    RenderedScene scene(hidden.X_WC, hidden.shown, {}, 1);
    CameraGuard guard(drill(), setupOf(hidden.X_WC));
    MotionGuard motion_guard({});
    const Eigen::Vector3d ahead = (hidden.to_W - hidden.from_W).normalized();
    const double distance = (hidden.to_W - hidden.from_W).norm();
    double way = 0.0;
    double speed = 0.0;
    std::optional<int> unseen;  // when it was last said
    for (int i = 0; way < distance; ++i) {
      Eigen::Isometry3d X_WT = heldAt(hidden.from_W + way * ahead);
      guard.run(
          0.01, [&](double /*at*/) { return X_WT; },
          [&](double /*at*/) -> const std::vector<float>& { return scene.image(drillAt(X_WT)); },
          [](const SweepReport& /*report*/, double /*at*/, double /*image*/) {});
      if (guard.seen().value_or(1.0) < WarningLimits{}.min_seen) unseen = i;
      const bool not_seen = unseen && 0.01 * (i - *unseen) <= kHold;
      const Instant now = afterMs(10 * i);
      const double sent = motion_guard
                              .guard(inputsAt(10 * i, X_WT, not_seen),
                                     {{hidden.speed * ahead, Eigen::Vector3d::Zero()},
                                      Eigen::Vector3d::Zero(),
                                      receivedAfterMs(10 * i),
                                      std::chrono::milliseconds(10),
                                      {}},
                                     now)
                              .sent_speed;
      const double change = 0.01 * MotionGuardOptions{}.deceleration;
      speed = std::clamp(sent, speed - change, speed + change);
      way += 0.01 * speed;
      if (i > 6000) throw std::runtime_error("it does not arrive");
    }
    return unseen ? std::optional(speed) : std::nullopt;
  }

  // All that the guard knows is far away.
  static MotionInputs inputsAt(int ms, const Eigen::Isometry3d& X_WT, bool not_seen) {
    PlaneSet planes{receivedAfterMs(ms), afterMs(ms + 150).stamp, true, 1, {}, {}};
    planes.X_WT = X_WT;
    const auto level = not_seen ? WarningLevel::kUnknown : WarningLevel::kClear;
    return {std::make_shared<const PlaneSet>(planes),
            std::make_shared<const ToolBalls>(ToolBalls{1, {{{Eigen::Vector3d::Zero(), 0.001}}}}),
            MotionInputs::ToolPose{X_WT, receivedAfterMs(ms)},
            MotionInputs::GuardWarning{level, not_seen ? std::uint32_t{kNotSeen} : 0U, afterMs(ms).steady}};
  }
};

TEST_F(HiddenThingTest, IsReachedSlowlyAndAfterItWasSaidThatNothingIsSeenThere) {
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(sceneCount(100, 2.0)); ++seed) {
    Random random(seed);
    const auto speed = arrive(seed % 2 == 0 ? behindABoard(random) : beyondThePicture(random));
    ASSERT_TRUE(speed) << seed;
    EXPECT_LE(*speed, 0.0501) << seed;
  }
}

}  // namespace
}  // namespace sweep_guard_core
