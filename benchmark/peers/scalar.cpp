#include <algorithm>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

constexpr float kRounding = 1e-6F;  // several times that of float32 at 1 m [m]

struct Plane {
  float x, y, z, offset;
};

template <bool kBoxFirst>
class Scalar : public Peer {
 public:
  explicit Scalar(Surface& surface) : surface_(surface) {}

  void update() override {}

  void query(size_t volume, TriangleIds& ids) override {
    const Polytope& volume_M = (*volumes_M_)[volume];
    take(volume_M);
    const auto at = [first = surface_.vertex(0)](size_t vertex) { return first + 3 * vertex; };
    const size_t count = surface_.triangles.size();
    for (size_t i = 0; i < count; ++i) {
      const auto& triangle = surface_.triangles[i];
      const float* const a = at(triangle[0]);
      const float* const b = at(triangle[1]);
      const float* const c = at(triangle[2]);
      if ((kBoxFirst && besideBox(a, b, c)) || beyondAPlane(a, b, c)) continue;
      if (meets(volume_M, a, b, c)) ids.push_back(static_cast<std::uint32_t>(i));
    }
  }

 private:
  void take(const Polytope& volume_M) {
    planes_.clear();
    for (const Polytope::Plane& plane : volume_M.planes_M) {
      const auto in = [](double value) { return static_cast<float>(value); };
      planes_.push_back(
          {in(plane.normal_M[0]), in(plane.normal_M[1]), in(plane.normal_M[2]), in(plane.offset) + kRounding});
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      lower_[axis] = static_cast<float>(volume_M.lower_M[axis]) - kRounding;
      upper_[axis] = static_cast<float>(volume_M.upper_M[axis]) + kRounding;
    }
  }

  bool besideBox(const float* a, const float* b, const float* c) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (std::min({a[axis], b[axis], c[axis]}) > upper_[axis]) return true;
      if (std::max({a[axis], b[axis], c[axis]}) < lower_[axis]) return true;
    }
    return false;
  }

  bool beyondAPlane(const float* a, const float* b, const float* c) const {
    for (const Plane& plane : planes_) {
      const auto beyond = [&](const float* p) {
        return plane.x * p[0] + plane.y * p[1] + plane.z * p[2] > plane.offset;
      };
      if (beyond(a) && beyond(b) && beyond(c)) return true;
    }
    return false;
  }

  Surface& surface_;
  std::vector<Plane> planes_;
  std::array<float, 3> lower_;
  std::array<float, 3> upper_;
};

}  // namespace

std::unique_ptr<Peer> makeScalar(Surface& surface) { return std::make_unique<Scalar<false>>(surface); }

std::unique_ptr<Peer> makeScalarBoxFirst(Surface& surface) { return std::make_unique<Scalar<true>>(surface); }

}  // namespace sweep_guard_benchmark
