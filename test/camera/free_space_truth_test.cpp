// What is taken to be free, against rays to the solids of rendered scenes.
#include <gtest/gtest.h>

#include <algorithm>

#include "camera/depth_surface.h"
#include "camera/rendered_scene.h"
#include "guard/body_boxes.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

constexpr double kLong = 0.15;  // of the tool [m]
constexpr double kThick = 0.02;

std::vector<Solid> randomSolids(Random& random) {
  std::vector<Solid> solids = {boxOf({-5.0, -5.0, -1.0}, {5.0, 5.0, 0.0})};
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d center(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.0, 0.2));
    const Eigen::Vector3d half = Eigen::Vector3d(1.0, 1.0, 1.0) * random.uniform(0.015, 0.06);
    solids.push_back(boxOf(center - half, center + half));
    solids.push_back(sphereAt({random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.0, 0.2)},
                              random.uniform(0.015, 0.06)));
  }
  return solids;
}

Eigen::Isometry3d randomView(Random& random) {
  const Eigen::Vector3d z =
      Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.5, -0.3)).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d X_WC = placedAt(-random.uniform(0.5, 1.2) * z);
  X_WC.linear() << x, z.cross(x), z;
  return X_WC;
}

class FreeSpaceTruthTest : public testing::Test {
 protected:
  // Two images: the robot comes before what the first one shows.
  void look(std::uint64_t seed) {
    random_ = Random(seed);
    X_WC_ = randomView(random_);
    solids_ = randomSolids(random_);
    RenderedScene scene(X_WC_, solids_, {}, seed);
    surface_.emplace(Grid(RenderedScene::kWidth, RenderedScene::kHeight), RenderedScene::kCamera,
                     DepthOptions{0.2, 1.5, {0.005, 0.003}});
    surface_->take(scene.image({}), X_WC_);
    const Eigen::Isometry3d X_WT = random_.pose({0.0, 0.0, 0.15});
    const SweptVolume robot = sweptVolume(tool_.whole(), {X_WT, X_WT}, VolumeKind::kObb, 0.03);
    surface_->take(scene.image({cylinderAt(X_WT, kThick, kLong)}), X_WC_, 0.033, {robot});
  }

  // Of a motion: how many of its places are taken to be free, and behind how many of these rays something is met before.
  void follow(const Motion& motion) {
    for (size_t i = 0; i < points_T_.size(); ++i) {
      const double time = static_cast<double>(i) / static_cast<double>(points_T_.size());
      const Eigen::Vector3d p_W =
          (1.0 - time) * (motion.X_MT_start * points_T_[i]) + time * (motion.X_MT_end * points_T_[i]);
      ++places_;
      if (!surface_->freeSpace()->contains(p_W)) continue;
      ++free_;
      const auto stands_before = [&](const Solid& solid) {
        return solid.enteredAt(X_WC_.translation(), p_W - X_WC_.translation()) < 1.0;
      };
      wrong_ += std::any_of(solids_.begin(), solids_.end(), stands_before) ? 1 : 0;
    }
  }

  const Tool tool_ = Tool::cylinder(kThick, kLong);
  const std::vector<Eigen::Vector3d> points_T_ = BodyBoxes(tool_, 64).points_B();
  Random random_{0};
  Eigen::Isometry3d X_WC_;
  std::vector<Solid> solids_;
  std::optional<DepthSurface> surface_;
  size_t places_ = 0;
  size_t free_ = 0;
  size_t wrong_ = 0;
};

TEST_F(FreeSpaceTruthTest, NothingStandsBeforeWhatIsTakenToBeFree) {
  for (int scene = 0; scene < sceneCount(100, 4.0); ++scene) {
    look(static_cast<std::uint64_t>(scene));
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d place(random_.uniform(-0.4, 0.4), random_.uniform(-0.4, 0.4), random_.uniform(-0.1, 0.4));
      const Eigen::Isometry3d from = random_.pose(place);
      follow({from, Eigen::Translation3d(random_.uniform(0.0, 0.2) * random_.direction()) * from});
    }
  }
  RecordProperty("places", std::to_string(places_));
  RecordProperty("free", std::to_string(free_));
  EXPECT_EQ(wrong_, 0U) << "of " << free_;
  EXPECT_GT(free_, places_ / 10);
  EXPECT_LT(free_, places_ * 9 / 10);
}

}  // namespace
}  // namespace sweep_guard_core
