#include "motion/block_boxes.h"

#include <algorithm>

namespace sweep_guard_core {

void BlockBoxes::assign(const VertexBlocks& blocks) {
  boxes_ = blocks.arrays();
  together_.clear();
  for (size_t first = 0; first < blocks.count(); first += kBlocksTogether) {
    const size_t count = std::min<size_t>(kBlocksTogether, blocks.count() - first);
    Eigen::AlignedBox3f box;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      box.min()[i] = *std::min_element(boxes_.lower[axis] + first, boxes_.lower[axis] + first + count);
      box.max()[i] = *std::max_element(boxes_.upper[axis] + first, boxes_.upper[axis] + first + count);
    }
    together_.push_back(box);
  }
}

Eigen::AlignedBox3f BlockBoxes::block(size_t index) const {
  const auto& [lower, upper] = boxes_;
  return {Eigen::Vector3f(lower[0][index], lower[1][index], lower[2][index]),
          Eigen::Vector3f(upper[0][index], upper[1][index], upper[2][index])};
}

Eigen::AlignedBox3f BlockBoxes::of(const Cluster& cluster) const {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t index : cluster.blocks) box.extend(block(index));
  return box;
}

Eigen::AlignedBox3f BlockBoxes::of(const ClusterGroup& group) const {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t index : group.block_groups) box.extend(together_[index]);
  return box;
}

Eigen::AlignedBox3f BlockBoxes::of(const MeshOrder& /*mesh*/) const {
  Eigen::AlignedBox3f box;
  for (const Eigen::AlignedBox3f& each : together_) box.extend(each);
  return box;
}

}  // namespace sweep_guard_core
