#include "geometry/weld.h"

#include <Eigen/Core>
#include <array>
#include <cstring>

namespace sweep_guard_core {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr double kCell = 4.0;  // in distances: few points have neighbors in other cells, and few fit into one

using Position = Eigen::Map<const Eigen::Vector3f>;

Position positionOf(const std::vector<float>& positions, std::uint32_t vertex) {
  return Position(&positions[3 * size_t{vertex}]);
}

// The finalizer of [Steele 2014], which spreads each bit over all.
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 30U) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ bits >> 27U) * 0x94d049bb133111ebU;
  return bits ^ bits >> 31U;
}

template <typename Integers>
std::uint64_t hashOf(const Integers& integers) {
  std::uint64_t hash = 0;
  for (const auto integer : integers) hash = mixed(hash ^ static_cast<std::uint64_t>(integer));
  return hash;
}

std::uint64_t hashOf(const Position& p) {
  std::array<std::uint32_t, 3> bits{};
  const Eigen::Vector3f without_negative_zero = p.array() + 0.0F;
  std::memcpy(bits.data(), without_negative_zero.data(), sizeof bits);
  return hashOf(bits);
}

// Holds vertices by their positions. It grows with the number of different ones: a small table stays in the processor's cache.
class PositionTable {
 public:
  explicit PositionTable(const std::vector<float>& positions) : positions_(positions), slots_(1024, kNone) {}

  // Returns the first vertex at the position of a vertex.
  std::uint32_t firstAt(std::uint32_t vertex) {
    std::uint32_t& slot = slotOf(vertex);
    if (slot != kNone) return slot;
    slot = vertex;
    if (2 * ++count_ > slots_.size()) grow();
    return vertex;
  }

 private:
  std::uint32_t& slotOf(std::uint32_t vertex) {
    const Position p = positionOf(positions_, vertex);
    const size_t mask = slots_.size() - 1;
    size_t slot = hashOf(p) & mask;
    while (slots_[slot] != kNone && positionOf(positions_, slots_[slot]) != p) slot = (slot + 1) & mask;
    return slots_[slot];
  }

  void grow() {
    std::vector<std::uint32_t> before(4 * slots_.size(), kNone);
    before.swap(slots_);
    for (const std::uint32_t vertex : before) {
      if (vertex != kNone) slotOf(vertex) = vertex;
    }
  }

  const std::vector<float>& positions_;
  std::vector<std::uint32_t> slots_;  // a power of two
  size_t count_ = 0;
};

// Keeps the points that stand for others, by cells of a grid.
class Places {
 public:
  Places(const std::vector<float>& positions, double distance) : positions_(positions), distance_(distance) {}

  std::uint32_t standsFor(std::uint32_t vertex) {
    const Eigen::Vector3d p = positionOf(positions_, vertex).cast<double>();
    const Cell low = cellOf(p.array() - distance_);
    const Cell high = cellOf(p.array() + distance_);
    std::uint32_t nearest = kNone;
    for (auto x = low[0]; x <= high[0]; ++x) {
      for (auto y = low[1]; y <= high[1]; ++y) {
        for (auto z = low[2]; z <= high[2]; ++z) nearest = std::min(nearest, firstNear(p, {x, y, z}));
      }
    }
    if (nearest != kNone) return nearest;
    cells_.emplace(hashOf(cellOf(p)), vertex);
    return vertex;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cellOf(const Eigen::Array3d& p) const {
    const Eigen::Array3d cell = (p / (kCell * distance_)).floor();
    return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
            static_cast<std::int64_t>(cell.z())};
  }

  std::uint32_t firstNear(const Eigen::Vector3d& p, const Cell& cell) const {
    std::uint32_t first = kNone;
    const auto [begin, end] = cells_.equal_range(hashOf(cell));
    for (auto entry = begin; entry != end; ++entry) {
      const double squared = (positionOf(positions_, entry->second).cast<double>() - p).squaredNorm();
      if (squared <= distance_ * distance_) first = std::min(first, entry->second);
    }
    return first;
  }

  const std::vector<float>& positions_;
  double distance_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

}  // namespace

std::vector<std::uint32_t> firstAtPositions(const std::vector<float>& positions) {
  std::vector<std::uint32_t> first(positions.size() / 3);
  PositionTable table(positions);
  for (std::uint32_t vertex = 0; vertex < first.size(); ++vertex) first[vertex] = table.firstAt(vertex);
  return first;
}

bool weldNear(const std::vector<float>& positions, const std::vector<std::uint32_t>& vertices, double distance,
              std::vector<std::uint32_t>& first) {
  if (distance <= 0.0) return false;
  Places places(positions, distance);
  bool any = false;
  for (const std::uint32_t vertex : vertices) {
    first[vertex] = places.standsFor(vertex);
    any = any || first[vertex] != vertex;
  }
  for (std::uint32_t& one : first) one = first[one];
  return any;
}

}  // namespace sweep_guard_core
