#include "geometry/patches.h"

#include <utility>

namespace sweep_guard_core {

Patches::Patches(const EdgeGroups& edges, const std::vector<bool>& left_out)
    : parents_(left_out.size()), patches_(left_out.size()) {
  for (std::uint32_t i = 0; i < parents_.size(); ++i) parents_[i] = i << 1U;
  edges.forEach([&](const EdgeGroups::Group& group) {
    if (group.size() != 2 || !unite(group.first[0], group.first[1])) irregular_.push_back(group);
  });
  for (std::uint32_t i = 0; i < parents_.size(); ++i) {
    if (!left_out[i]) patches_[i] = root(i) == i ? count_++ : patches_[root(i)];
  }
}

// Leaves every triangle on the path as a child of the root. A parent comes before its children.
std::uint32_t Patches::root(std::uint32_t triangle) {
  std::uint32_t above = parents_[triangle];
  if (above >> 1U == triangle || parents_[above >> 1U] >> 1U == above >> 1U) return above >> 1U;
  std::uint32_t turned = 0;
  std::uint32_t root = triangle;
  for (; parents_[root] >> 1U != root; root = parents_[root] >> 1U) turned ^= parents_[root] & 1U;
  while (parents_[triangle] >> 1U != root) {
    above = std::exchange(parents_[triangle], root << 1U | turned);
    turned ^= above & 1U;
    triangle = above >> 1U;
  }
  return root;
}

// Returns whether both pass their edge in opposite directions, once turned.
bool Patches::unite(const HalfEdge& a, const HalfEdge& b) {
  std::uint32_t low = root(a.triangle());
  std::uint32_t high = root(b.triangle());
  const bool against = direction(a) != direction(b);
  if (low == high) return against;
  if (low > high) std::swap(low, high);
  parents_[high] = low << 1U | (against ? 0U : 1U);
  return true;
}

}  // namespace sweep_guard_core
