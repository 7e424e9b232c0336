#pragma once

#include <cmath>

#include "simulation/elastic/bar_model.h"

namespace sweep_guard_simulation {

/// Regular lattice of cubes of side 1 m with bars along their edges and both diagonals of each face. Where one, two or
/// three of four cubes around a bar are missing, so is their share of its stiffness.
class Lattice {
 public:
  Lattice(const std::array<int, 3>& cells, double stiffness) : cells_(cells), structure_(nodes(cells)) {
    for (int z = 0; z <= cells[2]; ++z) {
      for (int y = 0; y <= cells[1]; ++y) {
        for (int x = 0; x <= cells[0]; ++x) addBarsFrom({x, y, z}, stiffness);
      }
    }
  }

  const BarStructure& structure() const { return structure_; }
  BarStructure& structure() { return structure_; }
  std::uint32_t node(const std::array<int, 3>& at) const { return index(cells_, at); }
  double share(Eigen::Index node, int axis) const {  ///< of a node in a face across the axis [m^2]
    double share = 1.0;
    for (int other = 0; other < 3; ++other) {
      const double at = structure_.rest(node, other);
      if (other != axis && (at == 0.0 || at == cells_[static_cast<size_t>(other)])) share /= 2.0;
    }
    return share;
  }

 private:
  static std::uint32_t index(const std::array<int, 3>& cells, const std::array<int, 3>& at) {
    return static_cast<std::uint32_t>((at[2] * (cells[1] + 1) + at[1]) * (cells[0] + 1) + at[0]);
  }
  static Eigen::MatrixX3d nodes(const std::array<int, 3>& cells) {
    Eigen::MatrixX3d nodes((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), 3);
    for (int i = 0; i < nodes.rows(); ++i) {
      const int row = i / (cells[0] + 1);
      const int layer = row / (cells[1] + 1);
      nodes.row(i) << i % (cells[0] + 1), row % (cells[1] + 1), layer;
    }
    return nodes;
  }

  bool there(const std::array<int, 3>& at) const {
    for (size_t i = 0; i < 3; ++i) {
      if (at[i] < 0 || at[i] > cells_[i]) return false;
    }
    return true;
  }

  void addBarsFrom(const std::array<int, 3>& at, double stiffness) {
    for (int dz = 0; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const bool forward = dz > 0 || (dz == 0 && (dy > 0 || (dy == 0 && dx > 0)));
          const std::array<int, 3> to = {at[0] + dx, at[1] + dy, at[2] + dz};
          if (!forward || std::abs(dx) + std::abs(dy) + dz == 3 || !there(to)) continue;
          structure_.bars.push_back({{node(at), node(to)}, stiffness * cubesAround(at, to)});
        }
      }
    }
  }

  double cubesAround(const std::array<int, 3>& from, const std::array<int, 3>& to) const {
    double share = 1.0;
    for (size_t i = 0; i < 3; ++i) {
      if (from[i] == to[i] && (from[i] == 0 || from[i] == cells_[i])) share /= 2.0;
    }
    return share;
  }

  std::array<int, 3> cells_;
  BarStructure structure_;
};

}  // namespace sweep_guard_simulation
