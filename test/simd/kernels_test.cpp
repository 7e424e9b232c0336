#include "sweep_guard/simd/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "scenes.h"

namespace sweep_guard_core::simd {
namespace {

constexpr size_t kFloats = 3 * kBlock;

// Memory for boxes, and its arrays.
struct Boxes {
  explicit Boxes(size_t count) : stride(padded(count)), sides(6 * stride) {}

  template <typename Number>
  BoxArrays<Number> arrays() {
    const auto side = [&](size_t i) { return sides.data() + i * stride; };
    return {{side(0), side(1), side(2)}, {side(3), side(4), side(5)}};
  }

  size_t stride;
  std::vector<float> sides;
};

float randomFloat(Random& random) { return static_cast<float>(random.uniform(-1.0, 1.0)); }

Boxes randomBoxes(Random& random, size_t count) {
  Boxes boxes(count);
  for (size_t i = 0; i < 3 * boxes.stride; ++i) {
    boxes.sides[i] = randomFloat(random);
    boxes.sides[i + 3 * boxes.stride] = boxes.sides[i] + 0.3F * std::abs(randomFloat(random));
  }
  return boxes;
}

std::vector<float> randomBlocks(Random& random, size_t blocks) {
  std::vector<float> vertices(blocks * kFloats + kPadding);
  for (float& coordinate : vertices) coordinate = randomFloat(random);
  return vertices;
}

Planes randomPlanes(Random& random, size_t count) {
  Planes planes;
  planes.count = count;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d normal = random.direction();
    for (size_t axis = 0; axis < 3; ++axis) {
      planes.normal[axis][i] = static_cast<float>(normal[static_cast<Eigen::Index>(axis)]);
    }
    planes.outside[i] = randomFloat(random);
    planes.inside[i] = planes.outside[i] - 1e-4F;
  }
  return planes;
}

Extremes nothing() {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

// The distance of a point beyond a plane's `outside`, in double, and the bound on the float error.
double beyond(const Planes& planes, size_t plane, const float* p) {
  double sum = -static_cast<double>(planes.outside[plane]);
  for (size_t axis = 0; axis < 3; ++axis) sum += static_cast<double>(planes.normal[axis][plane]) * p[axis];
  return sum;
}
constexpr double kRounding = 1e-6;

class KernelsTest : public testing::TestWithParam<Kernels> {};

TEST_P(KernelsTest, BoundsEveryBlockAndAll) {
  Random random(1);
  for (const size_t blocks : {1U, 2U, 15U, 16U, 17U, 50U}) {
    const std::vector<float> vertices = randomBlocks(random, blocks);
    Boxes boxes(blocks);
    Extremes extremes = nothing();
    ASSERT_TRUE(GetParam().bound(vertices.data(), blocks, boxes.arrays<float>(), extremes));
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto range = [&](size_t first, size_t count) {
        std::pair<float, float> ends(1e9F, -1e9F);
        for (size_t i = first * kBlock; i < (first + count) * kBlock; ++i) {
          ends.first = std::min(ends.first, vertices[3 * i + axis]);
          ends.second = std::max(ends.second, vertices[3 * i + axis]);
        }
        return ends;
      };
      for (size_t block = 0; block < blocks; ++block) {
        EXPECT_EQ(boxes.arrays<float>().lower[axis][block], range(block, 1).first);
        EXPECT_EQ(boxes.arrays<float>().upper[axis][block], range(block, 1).second);
      }
      EXPECT_EQ(extremes.lower[axis], range(0, blocks).first);
      EXPECT_EQ(extremes.upper[axis], range(0, blocks).second);
    }
  }
}

TEST_P(KernelsTest, WidensTheGivenExtremes) {
  Random random(2);
  const std::vector<float> vertices = randomBlocks(random, 1);
  Boxes boxes(1);
  Extremes extremes{{-2.0F, 0.0F, -3.0F}, {0.0F, 4.0F, 5.0F}};
  GetParam().bound(vertices.data(), 1, boxes.arrays<float>(), extremes);
  EXPECT_EQ(extremes.lower[0], -2.0F);
  EXPECT_EQ(extremes.lower[1], boxes.arrays<float>().lower[1][0]);
  EXPECT_EQ(extremes.lower[2], -3.0F);
  EXPECT_EQ(extremes.upper[0], boxes.arrays<float>().upper[0][0]);
  EXPECT_EQ(extremes.upper[1], 4.0F);
  EXPECT_EQ(extremes.upper[2], 5.0F);
}

TEST_P(KernelsTest, ReportsEveryCoordinateThatIsNotFinite) {
  Random random(3);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    for (size_t at = 0; at < 2 * kFloats; ++at) {
      std::vector<float> vertices = randomBlocks(random, 2);
      vertices[at] = bad;
      Boxes boxes(2);
      Extremes extremes = nothing();
      EXPECT_FALSE(GetParam().bound(vertices.data(), 2, boxes.arrays<float>(), extremes)) << at;
    }
  }
}

TEST_P(KernelsTest, FindsThePlanesThatAWholeBoxIsBeyond) {
  Random random(4);
  int set = 0;
  int clear = 0;
  for (const size_t count : {1U, 16U, 40U, 130U}) {
    Boxes boxes = randomBoxes(random, count);
    const Planes planes = randomPlanes(random, 12);
    std::vector<std::uint16_t> bits(boxes.stride);
    GetParam().classifyBoxes(boxes.arrays<const float>(), count, planes, bits.data());
    for (size_t box = 0; box < count; ++box) {
      for (size_t plane = 0; plane < planes.count; ++plane) {
        double nearest = 1e9;
        for (int corner = 0; corner < 8; ++corner) {
          float p[3];
          for (size_t axis = 0; axis < 3; ++axis) {
            const auto& side = (corner >> axis & 1) != 0 ? boxes.arrays<float>().upper : boxes.arrays<float>().lower;
            p[axis] = side[axis][box];
          }
          nearest = std::min(nearest, beyond(planes, plane, p));
        }
        const bool told = (bits[box] >> plane & 1) != 0;
        if (std::abs(nearest) > kRounding) {
          EXPECT_EQ(told, nearest > 0.0) << "box " << box << ", plane " << plane;
        }
        (told ? set : clear) += 1;
      }
    }
  }
  EXPECT_GT(set, 100);
  EXPECT_GT(clear, 100);
}

PerPlane randomInverses(Random& random) {
  PerPlane inverse;
  for (float& one : inverse) one = static_cast<float>(random.logUniform(1.0, 100.0));
  return inverse;
}

TEST_P(KernelsTest, ScoresABoxByTheCornerNearestToEachPlane) {
  Random random(8);
  for (const size_t count : {1U, 16U, 40U, 130U}) {
    Boxes boxes = randomBoxes(random, count);
    const Planes planes = randomPlanes(random, 12);
    const PerPlane inverse = randomInverses(random);
    std::vector<float> scores(boxes.stride);
    GetParam().scoreBoxes(boxes.arrays<const float>(), count, planes, inverse, scores.data());
    for (size_t box = 0; box < count; ++box) {
      double most = -1e9;
      for (size_t plane = 0; plane < planes.count; ++plane) {
        float nearest[3];
        for (size_t axis = 0; axis < 3; ++axis) {
          const bool upper = planes.normal[axis][plane] < 0.0F;
          nearest[axis] = (upper ? boxes.arrays<float>().upper : boxes.arrays<float>().lower)[axis][box];
        }
        most = std::max(most, beyond(planes, plane, nearest) * inverse[plane]);
      }
      EXPECT_NEAR(scores[box], most, 100.0 * kRounding) << box;
    }
  }
}

TEST_P(KernelsTest, MeasuresTheDistanceFromTheNearestBox) {
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    const size_t count = kPadding * static_cast<size_t>(1 + random.below(5));
    Boxes boxes(count);
    double least = 1e9;
    std::array<float, 3> point{};
    for (float& coordinate : point) coordinate = static_cast<float>(random.uniform(-3.0, 3.0));
    for (size_t box = 0; box < count; ++box) {
      double squared = 0.0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double lower = random.uniform(-3.0, 2.0);
        const double upper = lower + random.uniform(0.0, 1.0);
        boxes.arrays<float>().lower[axis][box] = static_cast<float>(lower);
        boxes.arrays<float>().upper[axis][box] = static_cast<float>(upper);
        const double apart = std::max({lower - point[axis], point[axis] - upper, 0.0});
        squared += apart * apart;
      }
      least = std::min(least, squared);
    }
    EXPECT_NEAR(GetParam().nearestBox(boxes.arrays<const float>(), count, point), least, 100.0 * kRounding) << trial;
  }
}

TEST_P(KernelsTest, ScoresABlockByItsLeastVertex) {
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<float> vertices = randomBlocks(random, 1);
    const Planes planes = randomPlanes(random, 1 + static_cast<size_t>(random.below(static_cast<int>(kMaxPlanes))));
    const PerPlane inverse = randomInverses(random);
    double least = 1e9;
    for (size_t i = 0; i < kBlock; ++i) {
      double most = -1e9;
      for (size_t plane = 0; plane < planes.count; ++plane)
        most = std::max(most, beyond(planes, plane, &vertices[3 * i]) * inverse[plane]);
      least = std::min(least, most);
    }
    EXPECT_NEAR(GetParam().scoreBlock(vertices.data(), planes, inverse), least, 100.0 * kRounding) << trial;
  }
}

TEST_P(KernelsTest, FindsThePlanesThatAVertexIsBeyondAndVerticesInsideOfAll) {
  Random random(5);
  int inside_all = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<float> vertices = randomBlocks(random, 1);
    const Planes planes = randomPlanes(random, 1 + static_cast<size_t>(random.below(static_cast<int>(kMaxPlanes))));
    std::vector<std::uint16_t> bits(kBlock);
    GetParam().classifyBlock(vertices.data(), planes, bits.data());
    for (size_t i = 0; i < kBlock; ++i) {
      bool inside = true;
      for (size_t plane = 0; plane < planes.count; ++plane) {
        const double out = beyond(planes, plane, &vertices[3 * i]);
        if (std::abs(out) > kRounding) {
          EXPECT_EQ((bits[i] >> plane & 1) != 0, out > 0.0);
        }
        inside = inside && out < -1e-4 - kRounding;
      }
      if ((bits[i] & kInsideAll) != 0) {
        EXPECT_EQ(bits[i], kInsideAll);
      }
      if (inside) {
        EXPECT_EQ(bits[i], kInsideAll);
      }
      inside_all += (bits[i] & kInsideAll) != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(inside_all, 100);
}

TEST_P(KernelsTest, FindsTrianglesWhollyBeyondAPlaneAndWithACornerInside) {
  Random random(6);
  int left = 0;
  int met = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::array<std::array<std::uint16_t, kBlock>, kClusterBlocks> bits{};
    for (auto& block : bits) {
      for (std::uint16_t& vertex : block) {
        vertex = random.below(8) == 0 ? kInsideAll : static_cast<std::uint16_t>(random.below(8) << random.below(3));
      }
    }
    ClusterCorners corners{};
    for (auto& of_all : corners) {
      for (std::uint8_t& place : of_all) place = static_cast<std::uint8_t>(random.below(kClusterBlocks * kBlock));
    }
    const TriangleBits found =
        GetParam().classifyTriangles(corners, {bits[0].data(), bits[1].data(), bits[2].data(), bits[3].data()});
    for (size_t i = 0; i < kCluster; ++i) {
      const auto corner = [&](size_t k) { return bits[corners[k][i] / kBlock][corners[k][i] % kBlock]; };
      const bool beyond = (corner(0) & corner(1) & corner(2) & (kInsideAll - 1)) != 0;
      const bool inside = ((corner(0) | corner(1) | corner(2)) & kInsideAll) != 0;
      EXPECT_EQ((found.not_beyond >> i & 1) != 0, !beyond);
      EXPECT_EQ((found.corner_inside >> i & 1) != 0, inside);
      left += beyond ? 0 : 1;
      met += inside ? 1 : 0;
    }
  }
  EXPECT_GT(left, 1000);
  EXPECT_LT(left, 12000);
  EXPECT_GT(met, 1000);
}

TEST_P(KernelsTest, FindsTheLargestOfManyLinearFunctions) {
  Random random(7);
  for (const size_t count : {8U, 16U, 24U, 200U}) {
    std::vector<double> x(count), y(count), z(count), w(count);
    for (auto* const values : {&x, &y, &z, &w}) {
      for (double& value : *values) value = random.uniform(-1.0, 1.0);
    }
    for (int trial = 0; trial < 200; ++trial) {
      const std::array<double, 3> p = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
      const size_t found = GetParam().largest({x.data(), y.data(), z.data(), w.data(), count}, p);
      ASSERT_LT(found, count);
      const auto value = [&](size_t i) { return x[i] * p[0] + y[i] * p[1] + z[i] * p[2] + w[i]; };
      for (size_t i = 0; i < count; ++i) EXPECT_LE(value(i), value(found) + 1e-15) << i << " of " << count;
    }
  }
}

TEST_P(KernelsTest, FindsTheDirectionOfTheLargestGapOfEachTriangle) {
  Random random(8);
  for (const size_t corners : {3U, 6U}) {
    for (const size_t count : {size_t{1}, size_t{5}, kMaxDirections}) {
      TriangleBatch triangles;
      triangles.corners = corners;
      for (auto& corner : triangles.position) {
        for (auto& axis : corner) {
          for (double& coordinate : axis) coordinate = random.uniform(-1.0, 1.0);
        }
      }
      Directions directions;
      directions.count = count;
      for (size_t i = 0; i < count; ++i) {
        for (auto& axis : directions.normal) axis[i] = random.uniform(-1.0, 1.0);
        directions.least[i] = random.uniform(-1.0, 1.0);
      }
      BatchGaps gaps;
      GetParam().separate(triangles, directions, gaps);
      for (size_t triangle = 0; triangle < kBatch; ++triangle) {
        const auto gap = [&](size_t i) {
          double reach = -1e9;
          for (size_t corner = 0; corner < corners; ++corner) {
            double along = 0.0;
            for (size_t axis = 0; axis < 3; ++axis) {
              along += directions.normal[axis][i] * triangles.position[corner][axis][triangle];
            }
            reach = std::max(reach, along);
          }
          return directions.least[i] - reach;
        };
        double largest = -1e9;
        for (size_t i = 0; i < count; ++i) largest = std::max(largest, gap(i));
        EXPECT_NEAR(gaps.gap[triangle], largest, 1e-15);
        EXPECT_NEAR(gap(static_cast<size_t>(gaps.direction[triangle])), largest, 1e-15);
      }
    }
  }
}

TEST_P(KernelsTest, FindsNoGapWithoutDirections) {
  BatchGaps gaps;
  GetParam().separate(TriangleBatch{}, Directions{}, gaps);
  for (const double gap : gaps.gap) EXPECT_EQ(gap, -std::numeric_limits<double>::infinity());
}

// A prism is three tetrahedra.
TEST_P(KernelsTest, AddsTheIntegralsOverPrisms) {
  Random random(9);
  for (const size_t count : {size_t{0}, size_t{1}, size_t{5}, size_t{33}, kPrisms}) {
    PrismBatch prisms;
    for (auto& corner : prisms.corner) {
      for (auto& axis : corner) {
        for (double& coordinate : axis) coordinate = random.uniform(-1.0, 1.0);
      }
    }
    for (auto& of_corner : prisms.height) {
      for (double& height : of_corner) height = random.uniform(0.0, 1.0);
    }
    prisms.count = count;
    PrismSums sums;
    sums.volume = 1.0;
    sums.area[2] = 2.0;
    GetParam().addPrisms(prisms, sums);
    double volume = 1.0;
    Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero();
    Eigen::Vector3d area(0.0, 0.0, 2.0);
    Eigen::Matrix3d area_moment = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < count; ++i) {
      const auto top = [&](size_t k) {
        const auto& corner = prisms.corner[k];
        return Eigen::Vector3d(corner[0][i], corner[1][i], corner[2][i]);
      };
      const auto bottom = [&](size_t k) {
        return Eigen::Vector3d(top(k) - prisms.height[k][i] * Eigen::Vector3d::UnitZ());
      };
      const auto addTetrahedron = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                      const Eigen::Vector3d& d) {
        const double of_one = (b - a).cross(c - a).dot(d - a) / 6.0;
        volume += of_one;
        volume_moment += of_one / 4.0 * (a + b + c + d);
      };
      addTetrahedron(bottom(0), bottom(1), bottom(2), top(2));
      addTetrahedron(bottom(0), bottom(1), top(2), top(1));
      addTetrahedron(bottom(0), top(1), top(2), top(0));
      const Eigen::Vector3d normal = 0.5 * (top(1) - top(0)).cross(top(2) - top(0));
      area += normal;
      area_moment += (top(0) + top(1) + top(2)) / 3.0 * normal.transpose();
    }
    EXPECT_NEAR(sums.volume, volume, 1e-13);
    for (int row = 0; row < 3; ++row) {
      const auto axis = static_cast<size_t>(row);
      EXPECT_NEAR(sums.volume_moment[axis], volume_moment[row], 1e-13);
      EXPECT_NEAR(sums.area[axis], area[row], 1e-13);
      for (int column = 0; column < 3; ++column) {
        EXPECT_NEAR(sums.area_moment[axis][static_cast<size_t>(column)], area_moment(row, column), 1e-13);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllSets, KernelsTest, testing::ValuesIn(availableKernels()),
                         [](const auto& test) { return test.param.name; });

TEST(AvailableKernelsTest, EndWithTheBaseline) { EXPECT_STREQ(availableKernels().back().name, "baseline"); }

}  // namespace
}  // namespace sweep_guard_core::simd
