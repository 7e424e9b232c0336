#define CGAL_NO_DEPRECATION_WARNINGS  // CGAL 6 has new names for these headers, which CGAL 5 does not know
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <iterator>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

class Cgal : public Peer {
 public:
  explicit Cgal(Surface& surface) : surface_(surface), triangles_(surface.triangles.size()) {}

  void update() override {
    for (size_t i = 0; i < triangles_.size(); ++i) {
      const auto& [a, b, c] = surface_.triangles[i];
      triangles_[i] = {point(a), point(b), point(c)};
    }
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
  }

  void query(size_t volume, TriangleIds& ids) override {
    const Polytope& volume_M = (*volumes_M_)[volume];
    const auto& [lower_x, lower_y, lower_z] = volume_M.lower_M;
    const auto& [upper_x, upper_y, upper_z] = volume_M.upper_M;
    candidates_.clear();
    tree_.all_intersected_primitives(CGAL::Bbox_3(lower_x, lower_y, lower_z, upper_x, upper_y, upper_z),
                                     std::back_inserter(candidates_));
    for (const Triangles::const_iterator candidate : candidates_) {
      const auto i = static_cast<size_t>(candidate - triangles_.cbegin());
      const auto& [a, b, c] = surface_.triangles[i];
      if (meets(volume_M, surface_.vertex(a), surface_.vertex(b), surface_.vertex(c)))
        ids.push_back(static_cast<std::uint32_t>(i));
    }
  }

 private:
  Kernel::Point_3 point(std::uint32_t vertex) const {
    const float* const p = surface_.vertex(vertex);
    return {p[0], p[1], p[2]};
  }

  Surface& surface_;
  Triangles triangles_;
  Tree tree_;
  std::vector<Triangles::const_iterator> candidates_;
};

}  // namespace

std::unique_ptr<Peer> makeCgal(Surface& surface) { return std::make_unique<Cgal>(surface); }

}  // namespace sweep_guard_benchmark
