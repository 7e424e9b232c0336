#include "sweep_guard/detection/submesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "detection/float_planes.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t kAsked = simd::kInsideAll;  // the bit of no plane; boxes do not use it
constexpr std::uint16_t kAll = std::numeric_limits<std::uint16_t>::max();

constexpr double kDistanceError = 0x1p-20;  // a dozen roundings of 2^-24: point, differences, squares, sums

}  // namespace

bool whollyBeyond(const Submesh& submesh, const simd::Planes& planes) {
  const Eigen::Vector3f lower = submesh.bounds().min().cast<float>();
  const Eigen::Vector3f upper = submesh.bounds().max().cast<float>();
  for (size_t i = 0; i < planes.count; ++i) {
    const Eigen::Vector3f normal(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i]);
    const Eigen::Vector3f nearest = (normal.array() < 0.0F).select(upper, lower);
    if (normal.dot(nearest) > planes.outside[i]) return true;
  }
  return false;
}

void BlockBits::classify(const Submesh& submesh, const simd::Planes& planes) {
  const size_t count = submesh.blocks().size();
  bits_.resize(std::max(bits_.size(), simd::padded(count)));
  kernels_->classifyBoxes(submesh.boxes(), count, planes, bits_.data());
  if (submesh.groups() != nullptr) classifyGroups(count);
}

void BlockBits::classifyGroups(size_t blocks) {
  const size_t whole = blocks / kBlocksTogether;
  group_bits_.resize(std::max(group_bits_.size(), whole + 1));
  const auto common = [&](size_t first, size_t last) {
    unsigned bits = kAll;
    for (size_t i = first; i < last; ++i) bits &= bits_[i];
    return static_cast<std::uint16_t>(bits);
  };
  for (size_t group = 0; group < whole; ++group) {
    group_bits_[group] = common(group * kBlocksTogether, (group + 1) * kBlocksTogether);
  }
  group_bits_[whole] = common(whole * kBlocksTogether, blocks);
}

bool BlockBits::firstAsked(std::uint32_t block) {
  const bool first = (bits_[block] & kAsked) == 0;
  bits_[block] |= kAsked;
  return first;
}

Submesh SubmeshFinder::find(const Submesh& around, const simd::Planes& planes) {
  assert(around.clusters_ != &clusters_);
  blocks_.clear();
  clusters_.clear();
  old_index_.clear();
  if (!whollyBeyond(around, planes)) {
    bits_.classify(around, planes);
    new_index_.assign(around.blocks().size(), kNone);
    bits_.forEachRemaining(around, [&](const Cluster& cluster) { keep(around, cluster); });
  }
  Submesh found = around;
  found.blocks_ = &blocks_;
  found.clusters_ = &clusters_;
  found.groups_ = nullptr;
  gatherBoxes(found);
  return found;
}

Submesh SubmeshFinder::find(const Submesh& around, const Eigen::AlignedBox3d& box_M) {
  return find(around, floatPlanes(around.mesh_M(), box_M));
}

void SubmeshFinder::keep(const Submesh& around, Cluster cluster) {
  for (std::uint32_t& block : cluster.blocks) {
    std::uint32_t& index = new_index_[block];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(blocks_.size());
      blocks_.push_back(around.blocks()[block]);
      old_index_.push_back(block);
    }
    block = index;
  }
  clusters_.push_back(cluster);
}

// Replaces the boxes of the submesh that it was found in.
void SubmeshFinder::gatherBoxes(Submesh& found) {
  const size_t stride = simd::padded(blocks_.size());
  sides_.resize(std::max(sides_.size(), 6 * stride));
  float* to = sides_.data();
  for (auto* sides : {&found.boxes_.lower, &found.boxes_.upper}) {
    for (const float*& side : *sides) {
      std::transform(old_index_.begin(), old_index_.end(), to, [&](std::uint32_t i) { return side[i]; });
      side = to;
      to += stride;
    }
  }
}

void ClusterBoxes::around(const Submesh& submesh) {
  const std::vector<Cluster>& clusters = submesh.clusters();
  origin_M_ = submesh.mesh_M().origin();
  radius_ = submesh.mesh_M().radius();
  count_ = simd::padded(clusters.size());
  sides_.resize(std::max(sides_.size(), 6 * count_));
  for (size_t axis = 0; axis < 3; ++axis) {
    const float* const lower = submesh.boxes().lower[axis];
    const float* const upper = submesh.boxes().upper[axis];
    for (size_t i = 0; i < count_; ++i) {
      const auto& [a, b, c, d] = clusters[std::min(i, clusters.size() - 1)].blocks;
      sides_[axis * count_ + i] = std::min(std::min(lower[a], lower[b]), std::min(lower[c], lower[d]));
      sides_[(3 + axis) * count_ + i] = std::max(std::max(upper[a], upper[b]), std::max(upper[c], upper[d]));
    }
  }
}

double ClusterBoxes::distanceFrom(const Eigen::Vector3d& p_M) const {
  if (count_ == 0) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d p = p_M - origin_M_;
  const auto side = [&](size_t i) { return sides_.data() + i * count_; };
  const simd::BoxArrays<const float> boxes{{side(0), side(1), side(2)}, {side(3), side(4), side(5)}};
  const Eigen::Vector3f rounded = p.cast<float>();
  const double squared = kernels_->nearestBox(boxes, count_, {rounded.x(), rounded.y(), rounded.z()});
  const double doubt = kDistanceError * (radius_ + p.norm()) + 0x1p-48 * origin_M_.norm();
  return std::max(0.0, std::sqrt(squared) - doubt);
}

}  // namespace sweep_guard_core
