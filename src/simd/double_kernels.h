#pragma once

#include "simd/lanes.h"
#include "sweep_guard/simd/kernels.h"

/// The loops in double precision: over linear functions, prisms and directions.
namespace sweep_guard_core::simd {
namespace {

static_assert(kFunctions % kDoubles == 0 && kBatch % kDoubles == 0);

std::size_t largest(const LinearFunctions& functions, const std::array<double, 3>& point) {
  const auto value = [&](std::size_t i) {
    return dot(point[0], point[1], point[2], load(functions.x + i), load(functions.y + i), load(functions.z + i)) +
           load(functions.w + i);
  };
  Double most = value(0);
  Double first = {};  // of the register that holds it; lanes of double, as they are selected by a mask of doubles
  Double index = {};
  for (std::size_t i = kDoubles; i < functions.count; i += kDoubles) {
    index += static_cast<double>(kDoubles);
    const Double next = value(i);
    first = next <= most ? first : index;
    most = max(next, most);
  }
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < kDoubles; ++lane) {
    if (most[lane] > most[best]) best = lane;
  }
  return static_cast<std::size_t>(first[best]) + best;
}

struct Vector {
  Double x;
  Double y;
  Double z;
};

[[gnu::always_inline]] inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Vector operator*(const Double& scale, const Vector& a) {
  return {scale * a.x, scale * a.y, scale * a.z};
}
[[gnu::always_inline]] inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[gnu::always_inline]] inline Vector load(const std::array<std::array<double, kPrisms>, 3>& axes, std::size_t first) {
  return {load(&axes[0][first]), load(&axes[1][first]), load(&axes[2][first])};
}

double sumOf(const Double& lanes) {
  double sum = 0.0;
  for (std::size_t lane = 0; lane < kDoubles; ++lane) sum += lanes[lane];
  return sum;
}

void addTo(std::array<double, 3>& sums, const Vector& lanes) {
  sums[0] += sumOf(lanes.x);
  sums[1] += sumOf(lanes.y);
  sums[2] += sumOf(lanes.z);
}

// Triangle and floor are linear, so products of two positions or heights have exact integrals.
void addPrisms(const PrismBatch& prisms, PrismSums& sums) {
  Double volume = {};
  Vector volume_moment = {};
  Vector area = {};
  Vector area_moment[3] = {};
  Double lane;
  for (std::size_t i = 0; i < kDoubles; ++i) lane[i] = static_cast<double>(i);
  for (std::size_t first = 0; first < prisms.count; first += kDoubles) {
    const Vector a = load(prisms.corner[0], first);
    const Vector b = load(prisms.corner[1], first);
    const Vector c = load(prisms.corner[2], first);
    const Vector heights = load(prisms.height, first);
    const Double half = lane < static_cast<double>(prisms.count - first) ? broadcast(0.5) : Double{};
    const Vector normal = half * cross(b - a, c - a);
    const Vector center = broadcast(1.0 / 3.0) * (a + b + c);
    area = area + normal;
    area_moment[0] = area_moment[0] + center.x * normal;
    area_moment[1] = area_moment[1] + center.y * normal;
    area_moment[2] = area_moment[2] + center.z * normal;
    const auto middle = [](const Vector& p, const Double& height) -> Vector { return {p.x, p.y, p.z - 0.5 * height}; };
    const Vector middle_a = middle(a, heights.x);
    const Vector middle_b = middle(b, heights.y);
    const Vector middle_c = middle(c, heights.z);
    const Double height = heights.x + heights.y + heights.z;
    const Vector products = heights.x * middle_a + heights.y * middle_b + heights.z * middle_c;
    volume += normal.z * height * (1.0 / 3.0);
    volume_moment = volume_moment + (normal.z * (1.0 / 12.0)) * (height * (middle_a + middle_b + middle_c) + products);
  }
  sums.volume += sumOf(volume);
  addTo(sums.volume_moment, volume_moment);
  addTo(sums.area, area);
  for (std::size_t axis = 0; axis < 3; ++axis) addTo(sums.area_moment[axis], area_moment[axis]);
}

void separate(const TriangleBatch& triangles, const Directions& directions, BatchGaps& gaps) {
  for (std::size_t first = 0; first < kBatch; first += kDoubles) {
    Double most = broadcast(-__builtin_inf());
    Double best = {};
    for (std::size_t i = 0; i < directions.count; ++i) {
      const auto along = [&](std::size_t corner) {
        const auto& position = triangles.position[corner];
        return dot(directions.normal[0][i], directions.normal[1][i], directions.normal[2][i], load(&position[0][first]),
                   load(&position[1][first]), load(&position[2][first]));
      };
      Double reach = along(0);
      for (std::size_t corner = 1; corner < triangles.corners; ++corner) reach = max(reach, along(corner));
      const Double gap = directions.least[i] - reach;
      best = gap <= most ? best : broadcast(static_cast<double>(i));
      most = max(gap, most);
    }
    store(most, &gaps.gap[first]);
    store(best, &gaps.direction[first]);
  }
}

}  // namespace
}  // namespace sweep_guard_core::simd
