#include <BulletCollision/btBulletCollisionCommon.h>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

static_assert(sizeof(btScalar) == sizeof(float), "Bullet reads the positions where they are");

const btVector3 kMaxDistance(0.4F, 0.4F, 0.4F);  // around the hull; Bullet adds 1 m and divides by 65533 [m]

btVector3 toBullet(const Point& p) {
  return {static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2])};
}

std::vector<int> indicesOf(const Surface& surface) {
  std::vector<int> indices;
  for (const auto& triangle : surface.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  return indices;
}

// Not btBvhTriangleMeshShape::refitTree(): it also visits every triangle six times.
class BulletPeer : public Peer {
 public:
  void update() override { shape_.getOptimizedBvh()->refit(&mesh_, -kMaxDistance, kMaxDistance); }

 protected:
  explicit BulletPeer(Surface& surface)
      : indices_(indicesOf(surface)),
        mesh_(static_cast<int>(surface.triangles.size()), indices_.data(), 3 * sizeof(int),
              static_cast<int>(surface.positions_M.size() / 3), surface.positions_M.data(), 3 * sizeof(float)),
        shape_(&mesh_, /*useQuantizedAabbCompression=*/true, -kMaxDistance, kMaxDistance) {}

  std::vector<int> indices_;
  btTriangleIndexVertexArray mesh_;
  btBvhTriangleMeshShape shape_;
};

class BulletCallback : public BulletPeer, private btTriangleCallback {
 public:
  explicit BulletCallback(Surface& surface) : BulletPeer(surface) {}

  void query(size_t volume, TriangleIds& ids) override {
    volume_M_ = &(*volumes_M_)[volume];
    ids_ = &ids;
    shape_.processAllTriangles(this, toBullet(volume_M_->lower_M), toBullet(volume_M_->upper_M));
  }

 private:
  void processTriangle(btVector3* corners, int /*part*/, int triangle) override {
    if (meets(*volume_M_, corners[0], corners[1], corners[2])) ids_->push_back(static_cast<std::uint32_t>(triangle));
  }

  const Polytope* volume_M_ = nullptr;
  TriangleIds* ids_ = nullptr;
};

class Contacts : public btCollisionWorld::ContactResultCallback {
 public:
  explicit Contacts(TriangleIds& ids) : ids_(ids) {}

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int index,
                           const btCollisionObjectWrapper*, int, int other_index) override {
    const bool first_is_mesh = first->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE ||
                               first->getCollisionObject()->getCollisionShape()->isConcave();
    if (point.getDistance() <= 0) ids_.push_back(static_cast<std::uint32_t>(first_is_mesh ? index : other_index));
    return 0;
  }

 private:
  TriangleIds& ids_;
};

class BulletContactTest : public BulletPeer {
 public:
  explicit BulletContactTest(Surface& surface)
      : BulletPeer(surface), dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &configuration_) {
    shape_.setMargin(0);
    workpiece_.setCollisionShape(&shape_);
  }

  void prepare(const std::vector<Polytope>& volumes_M) override {
    hulls_.clear();
    for (const Polytope& volume_M : volumes_M) {
      hulls_.push_back(std::make_unique<btConvexHullShape>());
      for (const Point& corner : volume_M.corners_M) hulls_.back()->addPoint(toBullet(corner), false);
      hulls_.back()->recalcLocalAabb();
      hulls_.back()->setMargin(0);
    }
  }

  void query(size_t volume, TriangleIds& ids) override {
    Contacts contacts(ids);
    tool_.setCollisionShape(hulls_[volume].get());
    world_.contactPairTest(&workpiece_, &tool_, contacts);
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btCollisionWorld world_;
  btCollisionObject workpiece_;
  btCollisionObject tool_;
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
};

}  // namespace

std::unique_ptr<Peer> makeBulletCallback(Surface& surface) { return std::make_unique<BulletCallback>(surface); }

std::unique_ptr<Peer> makeBulletContactTest(Surface& surface) { return std::make_unique<BulletContactTest>(surface); }

}  // namespace sweep_guard_benchmark
