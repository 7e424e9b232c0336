#include "rviz/tip_path.h"

#include <algorithm>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard_core::toSeconds;
using sweep_guard_core::Trail;

constexpr float kWidth = 0.002F;  // [m]
constexpr std::uint32_t kMaxPoints = 1200;

void begin(rviz::BillboardLine& line) {
  line.clear();
  line.setMaxPointsPerLine(kMaxPoints);
  line.setLineWidth(kWidth);
  line.setColor(1.0F, 1.0F, 1.0F, 0.5F);  // transparent: otherwise the alpha of the points has no effect
}

Ogre::ColourValue decay(Ogre::ColourValue color, float share) {
  color.a *= share;
  return color;
}

}  // namespace

TipPath::TipPath(Ogre::SceneManager& scene, Ogre::SceneNode& node)
    : measured_(&scene, &node), predicted_(&scene, &node) {}

void TipPath::clear() {
  trail_.clear();
  measured_.clear();
  predicted_.clear();
}

void TipPath::add(ros::Time stamp, const geometry_msgs::Pose& pose) {
  trail_.add(sweep_guard_core::Time(std::chrono::nanoseconds(stamp.toNSec())),
             {pose.position.x, pose.position.y, pose.position.z});
}

void TipPath::show(const std::vector<geometry_msgs::Pose>& predicted, const ElementStyle& element) {
  begin(measured_);
  begin(predicted_);
  if (!element.shown || trail_.points().size() < 2) return;
  const Trail::Point& newest = trail_.points().back();
  const double span = std::max(1e-3, toSeconds(newest.stamp - trail_.points().front().stamp));
  for (const Trail::Point& past : trail_.points()) {
    const double age = toSeconds(newest.stamp - past.stamp);
    measured_.addPoint(toOgre(past.value), decay(element.color, static_cast<float>(1.0 - age / span)));
  }
  if (predicted.empty() || predicted.size() + 1 > kMaxPoints) return;
  predicted_.addPoint(toOgre(newest.value), element.color);
  for (const geometry_msgs::Pose& pose : predicted) {
    predicted_.addPoint(toOgre(pose.position), decay(element.color, 0.6F));
  }
}

}  // namespace sweep_guard_rviz
