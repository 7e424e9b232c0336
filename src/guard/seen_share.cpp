#include "guard/seen_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr size_t kPoints = 64;
// Powers of the solution of x^4 + x^3 = 1: their multiples are spread evenly in three dimensions.
constexpr std::array<double, 3> kSpread = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

// Of a sequence that is spread evenly over [0, 1).
double spread(size_t i, size_t dimension) {
  const double value = static_cast<double>(i) * kSpread.at(dimension);
  return value - std::floor(value);
}

// Between the middle of a piece and its surface.
Eigen::Vector3d pointWithin(const ConvexShape& shape_T, size_t i) {
  const double z = 1.0 - 2.0 * spread(i, 0);
  const double angle = 2.0 * M_PI * spread(i, 1);
  const double across = std::sqrt(1.0 - z * z);
  const Eigen::Vector3d direction(across * std::cos(angle), across * std::sin(angle), z);
  const Eigen::Vector3d& mean = shape_T.moments_T().mean;
  return mean + std::cbrt(spread(i, 2)) * (shape_T.supportPoint(direction) - mean);
}

bool holds(const Tool& tool, const Eigen::Vector3d& p_T) {
  const auto& pieces = tool.pieces();
  return tool.bounds_T().contains(p_T) && std::any_of(pieces.begin(), pieces.end(), [&](const ConvexPiece& piece) {
           return piece.shape_T.depthOf(p_T).depth >= 0.0;
         });
}

}  // namespace

std::vector<Eigen::Vector3d> pointsWithin(const Tool& tool) {
  std::vector<Eigen::Vector3d> points;
  for (size_t i = 0; i < kPoints; ++i)
    points.push_back(pointWithin(tool.pieces()[i * tool.pieces().size() / kPoints].shape_T, i));
  return points;
}

bool SeenShare::begin(const Workpieces& workpieces, const PoseWithFrames& pose) {
  cameras_.clear();
  share_ = 1.0;
  bool any = false;
  for (const auto& workpiece : workpieces) {
    any = any || workpiece->of_camera;
    const auto X_WF = pose.X_WM.find(workpiece->frame);
    if (!workpiece->free_space || X_WF == pose.X_WM.end()) continue;
    cameras_.push_back({X_WF->second.inverse(), workpiece->free_space.get()});
  }
  return any;
}

// Between two poses a point goes straight: what it leaves out is less than the error of the prediction.
void SeenShare::add(const Tool& body, const std::vector<Eigen::Vector3d>& points_B, const Eigen::Isometry3d& X_WB,
                    const PredictedPath& path) {
  const Eigen::Isometry3d X_BW = X_WB.inverse();
  for (size_t step = 0; step < path.size(); ++step) {
    const Eigen::Isometry3d& from = step == 0 ? X_WB : path[step - 1].X_WT;
    size_t places = 0;
    size_t seen = 0;
    for (size_t i = 0; i < points_B.size(); ++i) {
      const double time = spread(i + step, 0);
      const Eigen::Vector3d p_W = (1.0 - time) * (from * points_B[i]) + time * (path[step].X_WT * points_B[i]);
      if (holds(body, X_BW * p_W)) continue;
      ++places;
      seen += isSeen(p_W) ? 1 : 0;
    }
    if (4 * places >= points_B.size())
      share_ = std::min(share_, static_cast<double>(seen) / static_cast<double>(places));
  }
}

bool SeenShare::isSeen(const Eigen::Vector3d& p_W) const {
  return std::any_of(cameras_.begin(), cameras_.end(),
                     [&](const Camera& camera) { return camera.space->contains(camera.X_FW * p_W); });
}

}  // namespace sweep_guard_core
