#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_shape_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

using Shape = fcl::Convex<double>;
using Solver = fcl::detail::GJKSolver_libccd<double>;

std::unique_ptr<Shape> shapeOf(const Polytope& volume_M) {
  auto corners = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Point& corner : volume_M.corners_M) corners->emplace_back(corner[0], corner[1], corner[2]);
  auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& face : volume_M.faces) {
    faces->push_back(static_cast<int>(face.size()));
    faces->insert(faces->end(), face.begin(), face.end());
  }
  auto shape = std::make_unique<Shape>(corners, static_cast<int>(volume_M.faces.size()), faces);
  shape->computeLocalAABB();
  return shape;
}

template <typename Box>
class FclPeer : public Peer {
 public:
  explicit FclPeer(const Surface& surface) : surface_(surface) {
    request_.num_max_contacts = surface.triangles.size();
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles) triangles.emplace_back(a, b, c);
    model_.beginModel();
    std::vector<fcl::Vector3d> vertices;
    forEachVertex([&](const fcl::Vector3d& p) { vertices.push_back(p); });
    model_.addSubModel(vertices, triangles);
    model_.endModel();
  }

  void prepare(const std::vector<Polytope>& volumes_M) override {
    shapes_.clear();
    for (const Polytope& volume_M : volumes_M) shapes_.push_back(shapeOf(volume_M));
  }

  // Not beginUpdateModel(): its boxes also contain the previous positions.
  void update() override {
    model_.beginReplaceModel();
    forEachVertex([&](const fcl::Vector3d& p) { model_.replaceVertex(p); });
    model_.endReplaceModel(/*refit=*/true, /*bottomup=*/true);
  }

 protected:
  static void add(const fcl::CollisionResultd& result, TriangleIds& ids) {
    for (size_t i = 0; i < result.numContacts(); ++i) {
      ids.push_back(static_cast<std::uint32_t>(result.getContact(i).b1));
    }
  }

  fcl::BVHModel<Box> model_;
  fcl::CollisionRequestd request_;
  std::vector<std::unique_ptr<Shape>> shapes_;

 private:
  template <typename Function>
  void forEachVertex(const Function& function) const {
    const std::vector<float>& positions = surface_.positions_M;
    for (size_t i = 0; i < positions.size(); i += 3) function({positions[i], positions[i + 1], positions[i + 2]});
  }

  const Surface& surface_;
};

class FclAabb : public FclPeer<fcl::AABB<double>> {
 public:
  using FclPeer::FclPeer;

  // fcl::collide() would copy the model.
  void query(size_t volume, TriangleIds& ids) override {
    fcl::Transform3d identity = fcl::Transform3d::Identity();
    fcl::CollisionResultd result;
    fcl::detail::MeshShapeCollisionTraversalNode<fcl::AABB<double>, Shape, Solver> node;
    fcl::detail::initialize(node, model_, identity, *shapes_[volume], identity, &solver_, request_, result);
    fcl::detail::collide(&node);
    add(result, ids);
  }

 private:
  Solver solver_;
};

class FclObbRss : public FclPeer<fcl::OBBRSS<double>> {
 public:
  using FclPeer::FclPeer;

  void query(size_t volume, TriangleIds& ids) override {
    const fcl::Transform3d identity = fcl::Transform3d::Identity();
    fcl::CollisionResultd result;
    fcl::collide(&model_, identity, shapes_[volume].get(), identity, request_, result);
    add(result, ids);
  }
};

}  // namespace

std::unique_ptr<Peer> makeFclAabb(Surface& surface) { return std::make_unique<FclAabb>(surface); }

std::unique_ptr<Peer> makeFclObbRss(Surface& surface) { return std::make_unique<FclObbRss>(surface); }

}  // namespace sweep_guard_benchmark
