#include "rviz/tip_path.h"

#include <algorithm>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

constexpr double kKept = 2.0;      // [s]
constexpr double kSpacing = 0.02;  // [s]
constexpr float kWidth = 0.002F;   // [m]
constexpr std::uint32_t kMaxPoints = 1200;

void begin(rviz::BillboardLine& line) {
  line.clear();
  line.setMaxPointsPerLine(kMaxPoints);
  line.setLineWidth(kWidth);
  line.setColor(1.0F, 1.0F, 1.0F, 0.5F);  // transparent: else the alpha of the points has no effect
}

Ogre::ColourValue decay(Ogre::ColourValue color, float share) {
  color.a *= share;
  return color;
}

}  // namespace

TipPath::TipPath(Ogre::SceneManager& scene, Ogre::SceneNode& node)
    : measured_(&scene, &node), expected_(&scene, &node) {}

void TipPath::clear() {
  points_.clear();
  measured_.clear();
  expected_.clear();
}

void TipPath::add(ros::Time stamp, const geometry_msgs::Pose& pose) {
  if (!points_.empty() && stamp < points_.back().stamp) points_.clear();
  while (!points_.empty() && (stamp - points_.front().stamp).toSec() > kKept) points_.pop_front();
  const size_t count = points_.size();
  if (count > 1 && (stamp - points_[count - 2].stamp).toSec() < kSpacing) points_.pop_back();
  points_.push_back({stamp, toOgre(pose.position)});
}

void TipPath::show(const std::vector<geometry_msgs::Pose>& expected, const Part& part) {
  begin(measured_);
  begin(expected_);
  if (!part.shown || points_.size() < 2) return;
  const double span = std::max(1e-3, (points_.back().stamp - points_.front().stamp).toSec());
  for (const Point& point : points_) {
    const double age = (points_.back().stamp - point.stamp).toSec();
    measured_.addPoint(point.position, decay(part.color, static_cast<float>(1.0 - age / span)));
  }
  if (expected.empty() || expected.size() + 1 > kMaxPoints) return;
  expected_.addPoint(points_.back().position, part.color);
  for (const geometry_msgs::Pose& pose : expected) expected_.addPoint(toOgre(pose.position), decay(part.color, 0.6F));
}

}  // namespace sweep_guard_rviz
