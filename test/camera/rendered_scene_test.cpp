#include "camera/rendered_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera/camera_guard.h"

namespace sweep_guard_core {
namespace {

constexpr double kRadius = 0.005;  // of the tool [m]
constexpr double kLength = 0.15;
constexpr double kRim = kRadius * M_SQRT1_2;  // is lower than the tip by this, as the tool is held

Eigen::Isometry3d cameraAt(double distance) {
  const Eigen::Vector3d z(0.5, 0.0, -std::sqrt(0.75));  // 60 degrees down
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << -Eigen::Vector3d::UnitY(), z.cross(-Eigen::Vector3d::UnitY()), z;
  X_WC.translation() = -distance * z;
  return X_WC;
}

// As a camera that was calibrated badly: by 5 mm and 1 degree.
Eigen::Isometry3d misplaced(const Eigen::Isometry3d& X_WC, std::uint64_t seed) {
  Random random(seed);
  return X_WC * Eigen::Translation3d(0.005 * random.direction()) * Eigen::AngleAxisd(M_PI / 180.0, random.direction());
}

// Held from above at 45 degrees.
Eigen::Isometry3d toolAt(const Eigen::Vector3d& tip_W, double azimuth) {
  Eigen::Isometry3d X_WT = placedAt(tip_W);
  X_WT.rotate(Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()));
  X_WT.rotate(Eigen::AngleAxisd(0.75 * M_PI, Eigen::Vector3d::UnitY()));
  return X_WT;
}

// A table with a box and a ball.
std::vector<Solid> things() {
  return {boxOf({-5.0, -5.0, -1.0}, {5.0, 5.0, 0.0}), boxOf({0.08, -0.15, 0.0}, {0.16, -0.05, 0.06}),
          sphereAt({0.1, 0.12, 0.04}, 0.05)};
}

// Twenty to a hundred millimeters above the highest of them.
Eigen::Isometry3d wandering(double seconds) {
  const Eigen::Vector3d tip(0.17 * std::sin(0.31 * seconds), 0.2 * std::sin(0.23 * seconds + 1.0),
                            0.09 + 0.06 + kRim - 0.04 * std::cos(0.4 * seconds));
  return toolAt(tip, 0.13 * seconds);
}

// Ten minutes at full size [s].
double wanderingTime() { return sceneCount(600, 0.7); }
// A minute at full size [s]; no less than the tool takes to come down from where it does not hide the table.
double hoveringTime() { return std::max<double>(2.5, sceneCount(60, 1.0)); }

class RenderedSceneTest : public testing::Test {
 protected:
  void run(
      double seconds, const CameraSetup& setup, const CameraGuard::Pose& pose_W,
      const std::function<std::vector<Solid>(double)>& others = [](double) { return std::vector<Solid>(); }) {
    guard_.emplace(Tool::cylinder(kRadius, kLength), setup);
    const auto see = [&](double at) -> const std::vector<float>& {
      std::vector<Solid> moving = others(at);
      moving.push_back(cylinderAt(pose_W(at), kRadius, kLength));
      return scene_.image(moving);
    };
    guard_->run(seconds, pose_W, see, [this](const SweepReport& report, double at, double /*image*/) {
      if (report.contact()) contacts_.push_back(at);
    });
  }
  CameraSetup setup(double self_padding) const {
    return {RenderedScene::kCamera, 640, 480, X_WC_, {0.2, 1.5, {0.005, 0.003}}, self_padding};
  }

  const Eigen::Isometry3d X_WC_ = cameraAt(0.8);
  RenderedScene scene_{X_WC_, things(), {}, 1};
  std::optional<CameraGuard> guard_;
  std::vector<double> contacts_;  // times [s]
};

TEST_F(RenderedSceneTest, TheToolIsNoContactWithItselfThoughTheCameraIsMisplaced) {
  CameraSetup misplaced_setup = setup(0.03);
  misplaced_setup.X_WC = misplaced(X_WC_, 106);
  run(wanderingTime(), misplaced_setup, wandering);
  EXPECT_EQ(contacts_, std::vector<double>());
  EXPECT_EQ(guard_->agreeingImages(), guard_->comparedImages());
  EXPECT_GT(guard_->comparedImages(), 50U);
}

TEST_F(RenderedSceneTest, TheToolIsNoContactWithItselfThoughTheMarginIsLargerThanThePadding) {
  run(wanderingTime(), setup(0.005), wandering);
  EXPECT_EQ(contacts_, std::vector<double>());
}

// Its margin and noise make the table higher by some 9 mm.
TEST_F(RenderedSceneTest, ATipThatHoversIsClearAndItsTouchIsFound) {
  for (const double self_padding : {0.005, 0.03}) {
    contacts_.clear();
    const double touch = hoveringTime();
    run(touch + 0.5, setup(self_padding), [&](double seconds) {
      const double descent = std::max(0.02, 0.1 - 0.1 * seconds);
      const double height = std::clamp(0.04 * (touch - seconds), -0.003, descent);
      return toolAt({0.0, 0.0, height + kRim}, 1.57);
    });
    ASSERT_FALSE(contacts_.empty()) << self_padding;
    EXPECT_GT(contacts_.front(), touch - 0.012 / 0.04) << self_padding;
    EXPECT_LE(contacts_.front(), touch + 0.001) << self_padding;
    EXPECT_GT(contacts_.back(), touch + 0.48) << self_padding;
  }
}

// A hand of 80 mm waits beside the tool until it leaves at 2 m/s.
class HandTest : public RenderedSceneTest {
 protected:
  void runWithHand(double seconds, double leaves) {
    const auto pose = [](double at) { return toolAt({0.0, -std::clamp(0.1 * (at - 1.0), 0.0, 0.07), 0.15}, 0.0); };
    run(seconds, setup(0.03), pose, [=](double at) {
      const double y = at < 0.3 ? -0.8 : -0.1 - kRadius - 2.0 * std::max(0.0, at - leaves);
      return std::vector<Solid>{boxOf({-0.04, y - 0.04, 0.11}, {0.04, y + 0.04, 0.19})};
    });
    ASSERT_FALSE(contacts_.empty());
  }
};

TEST_F(HandTest, AHandThatTheToolMovesIntoIsMetWithinOneImage) {
  const double touch = 1.0 + 0.06 / 0.1;
  runWithHand(2.0, 10.0);
  EXPECT_GT(contacts_.front(), touch - 0.1);
  EXPECT_LT(contacts_.front(), touch + 0.034);
}

TEST_F(HandTest, AHandThatLeavesIsNoContactFiftyMillisecondsAfterAnImageWithoutItThoughTheToolHidesIt) {
  runWithHand(3.0, 2.0);
  EXPECT_GT(contacts_.back(), 1.95);
  EXPECT_LT(contacts_.back(), 2.0 + 1.0 / 30.0 + 0.05);
}

}  // namespace
}  // namespace sweep_guard_core
