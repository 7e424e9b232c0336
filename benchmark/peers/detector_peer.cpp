#include "peers/detector_peer.h"

#include <algorithm>

#include "hull.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::Detector;
using sweep_guard_core::Submesh;
using sweep_guard_core::SweptVolume;
using sweep_guard_core::TriangleMesh;

TriangleMesh meshOf(const Surface& surface) {
  std::vector<Eigen::Vector3d> vertices_M;
  for (size_t i = 0; i < surface.positions_M.size(); i += 3) {
    vertices_M.emplace_back(Eigen::Map<const Eigen::Vector3f>(&surface.positions_M[i]).cast<double>());
  }
  return TriangleMesh(vertices_M, {surface.triangles.begin(), surface.triangles.end()});
}

class DetectorPeer : public Peer {
 public:
  struct Options {
    bool computes_volumes = false;  ///< in the time of the query
    bool uses_submesh = true;       ///< several queries share the submesh around all of them
  };

  DetectorPeer(Surface& surface, std::unique_ptr<Detector> detector, const Options& options)
      : surface_(surface), mesh_M_(meshOf(surface)), detector_(std::move(detector)), options_(options) {}

  void prepare(const std::vector<Polytope>& volumes_M) override {
    Peer::prepare(volumes_M);
    inflation_ = 0.0;
  }

  void update() override { mesh_M_.deform(surface_.positions_M); }

  void queryAll(std::vector<TriangleIds>& ids) override {
    if (ids.size() <= 1 || !options_.uses_submesh) return Peer::queryAll(ids);
    const Eigen::AlignedBox3d box_M = boxAroundAll();
    const Submesh submesh = finder_.find(mesh_M_, box_M);
    for (size_t volume = 0; volume < ids.size(); ++volume) detect(submesh, volume, ids[volume]);
  }

  void query(size_t volume, TriangleIds& ids) override { detect(mesh_M_, volume, ids); }

  double inflation() const override { return inflation_; }

 private:
  void detect(const Submesh& submesh, size_t volume, TriangleIds& ids) {
    const sweep_guard_core::Detection& detection = detector_->detect(submesh, sweptVolumeOf((*volumes_M_)[volume]));
    ids.assign(detection.triangles.begin(), detection.triangles.end());
    inflation_ = std::max(inflation_, detection.inflation);
  }

  Eigen::AlignedBox3d boxAroundAll() const {
    Eigen::AlignedBox3d box_M;
    for (const Polytope& volume_M : *volumes_M_) {
      const sweep_guard_core::OrientedBox& box = volume_M.swept_M->box;
      const Eigen::Vector3d half_M = box.X_MB.linear().cwiseAbs() * box.half_extents;
      box_M.extend(box.X_MB.translation() - half_M);
      box_M.extend(box.X_MB.translation() + half_M);
    }
    return box_M;
  }

  const SweptVolume& sweptVolumeOf(const Polytope& volume_M) {
    if (!options_.computes_volumes) return *volume_M.swept_M;
    swept_M_ = sweptVolume(tool_, *volume_M.motion_M, sweep_guard_core::VolumeKind::kObbPlanes);
    return swept_M_;
  }

  Surface& surface_;
  TriangleMesh mesh_M_;
  std::unique_ptr<Detector> detector_;
  sweep_guard_core::SubmeshFinder finder_;
  double inflation_ = 0.0;
  Options options_;
  sweep_guard_core::ConvexShape tool_ = drill();
  SweptVolume swept_M_;
};

}  // namespace

std::unique_ptr<Peer> makeDetectorPeer(const std::string& name, Surface& surface) {
  return std::make_unique<DetectorPeer>(surface, sweep_guard_core::makeDetector(name), DetectorPeer::Options{});
}

std::unique_ptr<Peer> makeDetectorPeerWithSetUp(const std::string& name, Surface& surface) {
  return std::make_unique<DetectorPeer>(surface, sweep_guard_core::makeDetector(name),
                                        DetectorPeer::Options{/*computes_volumes=*/true});
}

std::unique_ptr<Peer> makePlainSelectPeer(Surface& surface) {
  auto detector = sweep_guard_core::makeDetector("select", {/*cull=*/false, "osmesa", /*triangles_per_name=*/1});
  return std::make_unique<DetectorPeer>(surface, std::move(detector),
                                        DetectorPeer::Options{/*computes_volumes=*/false, /*uses_submesh=*/false});
}

}  // namespace sweep_guard_benchmark
