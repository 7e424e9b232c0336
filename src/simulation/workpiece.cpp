#include "simulation/workpiece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "common/number_text.h"
#include "common/xyz.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_simulation {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::Triangle;

namespace {

constexpr double kHeight = 0.44 / 0.6;
constexpr double kWavesAcross = 3.0;

struct Grid {
  int sectors;
  int rings;
  int triangles() const { return 2 * sectors * rings; }
};

Grid gridFor(int triangles) {
  const int square_rings = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 4.0))));
  const auto gridOf = [triangles](int rings) {
    return Grid{std::max(3, static_cast<int>(std::lround(triangles / (2.0 * rings)))), rings};
  };
  Grid best = gridOf(square_rings);
  for (int distance = 1; distance <= square_rings / 3; ++distance) {
    for (const int rings : {square_rings - distance, square_rings + distance}) {
      const Grid grid = gridOf(rings);
      if (std::abs(grid.triangles() - triangles) < std::abs(best.triangles() - triangles)) best = grid;
    }
  }
  return best;
}

// The poles lie on the x axis, so that the top, where the tool comes down, has no fan of thin triangles.
Eigen::Vector3d ellipsoidPoint(double polar, double azimuth) {
  const Eigen::Vector3d direction(std::cos(polar), std::sin(polar) * std::cos(azimuth),
                                  std::sin(polar) * std::sin(azimuth));
  const double dent = 1.0 + 0.04 * std::cos(5.0 * azimuth) * std::sin(3.0 * polar) * std::sin(polar);
  return dent * direction.cwiseProduct(Eigen::Vector3d(1.0, 1.0, kHeight));
}

std::vector<Eigen::Vector3d> gridPoints(const Grid& grid) {
  std::vector<Eigen::Vector3d> points;
  for (int ring = 1; ring <= grid.rings; ++ring) {
    for (int sector = 0; sector < grid.sectors; ++sector) {
      points.push_back(ellipsoidPoint(M_PI * ring / (grid.rings + 1), 2.0 * M_PI * sector / grid.sectors));
    }
  }
  points.push_back(ellipsoidPoint(0.0, 0.0));
  points.push_back(ellipsoidPoint(M_PI, 0.0));
  return points;
}

std::vector<Triangle> gridTriangles(const Grid& grid) {
  const auto vertex = [&grid](int ring, int sector) {
    return static_cast<std::uint32_t>(ring * grid.sectors + sector % grid.sectors);
  };
  const std::uint32_t first_pole = vertex(grid.rings, 0);
  std::vector<Triangle> triangles;
  for (int sector = 0; sector < grid.sectors; ++sector) {
    triangles.push_back({first_pole, vertex(0, sector), vertex(0, sector + 1)});
    for (int ring = 0; ring + 1 < grid.rings; ++ring) {
      triangles.push_back({vertex(ring, sector), vertex(ring + 1, sector), vertex(ring + 1, sector + 1)});
      triangles.push_back({vertex(ring, sector), vertex(ring + 1, sector + 1), vertex(ring, sector + 1)});
    }
    triangles.push_back({vertex(grid.rings - 1, sector), first_pole + 1, vertex(grid.rings - 1, sector + 1)});
  }
  return triangles;
}

void requireSize(const std::string& name, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw InvalidInput(name + " of the workpiece is " + sweep_guard_core::shortText(value) + ", must be in [" +
                     sweep_guard_core::shortText(min) + ", " + sweep_guard_core::shortText(max) + "]");
}

}  // namespace

Workpiece::Workpiece(const std::vector<Eigen::Vector3d>& points, std::vector<Triangle> triangles,
                     const Options& options)
    : triangles_(std::move(triangles)),
      amplitude_(options.amplitude * options.size),
      angular_rate_(2.0 * M_PI / options.period) {
  requireSize("size", options.size, 1e-3, 100.0);
  requireSize("amplitude", options.amplitude, 0.0, 0.05);
  requireSize("period", options.period, 0.01, 1000.0);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) throw InvalidInput("a vertex is not finite");
    box.extend(point);
  }
  const double extent = box.sizes().maxCoeff();
  if (!(extent > 0.0) || !std::isfinite(extent)) throw InvalidInput("the vertices have no finite extent");
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d rest = (point - box.center()) / extent * options.size;
    vertices_.push_back({rest, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 0.0});
  }
}

Workpiece Workpiece::hull(int triangles, const Options& options) {
  requireSize("number of triangles", triangles, 6, 1000000);
  const Grid grid = gridFor(triangles);
  Workpiece workpiece(gridPoints(grid), gridTriangles(grid), options);
  workpiece.makeWaves(options);
  return workpiece;
}

Workpiece Workpiece::fromFile(const std::string& path, const Options& options) {
  sweep_guard_ros::MeshSurface surface = sweep_guard_ros::readMesh(path, /*follow_link=*/true);
  try {
    Workpiece workpiece(surface.vertices, std::move(surface.triangles), options);
    workpiece.makeSway(options);
    return workpiece;
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

void Workpiece::makeWaves(const Options& options) {
  for (Vertex& vertex : vertices_) {
    vertex.along = vertex.rest.normalized();
    vertex.across = Eigen::Vector3d::UnitX() - vertex.along.x() * vertex.along;
    vertex.phase = 2.0 * M_PI * kWavesAcross * vertex.rest.x() / options.size;
  }
}

void Workpiece::makeSway(const Options& options) {
  for (Vertex& vertex : vertices_) vertex.phase = M_PI * vertex.rest.sum() / options.size;
}

std::vector<float> Workpiece::positions(double t) const {
  std::vector<float> positions;
  positions.reserve(3 * vertices_.size());
  for (const Vertex& vertex : vertices_) {
    const double phase = vertex.phase - angular_rate_ * t;
    const Eigen::Vector3d p_M =
        vertex.rest + amplitude_ * (std::cos(phase) * vertex.along + std::sin(phase) * vertex.across);
    for (const double coordinate : sweep_guard_core::xyz(p_M)) positions.push_back(static_cast<float>(coordinate));
  }
  return positions;
}

}  // namespace sweep_guard_simulation
