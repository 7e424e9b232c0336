#include "peers/detector_peer.h"

#include <algorithm>

#include "hull.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/select_detector.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard::Detector;
using sweep_guard::SweptVolume;
using sweep_guard::TriangleMesh;

TriangleMesh meshOf(const Surface& surface) {
  std::vector<Eigen::Vector3d> vertices_M;
  for (size_t i = 0; i < surface.positions_M.size(); i += 3) {
    vertices_M.emplace_back(Eigen::Map<const Eigen::Vector3f>(&surface.positions_M[i]).cast<double>());
  }
  return TriangleMesh(vertices_M, {surface.triangles.begin(), surface.triangles.end()});
}

class DetectorPeer : public Peer {
 public:
  DetectorPeer(Surface& surface, std::unique_ptr<Detector> detector, bool sets_up = false)
      : surface_(surface), mesh_M_(meshOf(surface)), detector_(std::move(detector)), sets_up_(sets_up) {}

  void prepare(const std::vector<Polytope>& volumes_M) override {
    volumes_M_ = &volumes_M;
    inflation_ = 0.0;
  }

  void update() override { mesh_M_ = mesh_M_.deformed(surface_.positions_M); }

  void query(size_t volume, TriangleIds& ids) override {
    const sweep_guard::Detection& detection = detector_->detect(mesh_M_, sweptVolumeOf((*volumes_M_)[volume]));
    ids.assign(detection.triangles.begin(), detection.triangles.end());
    inflation_ = std::max(inflation_, detection.inflation);
  }

  double inflation() const override { return inflation_; }

 private:
  const SweptVolume& sweptVolumeOf(const Polytope& volume_M) {
    if (!sets_up_) return *volume_M.swept_M;
    swept_M_ = sweptVolume(tool_, *volume_M.motion_M, sweep_guard::VolumeKind::kObbPlanes);
    return swept_M_;
  }

  Surface& surface_;
  TriangleMesh mesh_M_;
  std::unique_ptr<Detector> detector_;
  const std::vector<Polytope>* volumes_M_ = nullptr;
  double inflation_ = 0.0;
  bool sets_up_;
  sweep_guard::ConvexShape tool_ = drill();
  SweptVolume swept_M_;
};

}  // namespace

std::unique_ptr<Peer> makeDetectorPeer(const std::string& name, Surface& surface) {
  return std::make_unique<DetectorPeer>(surface, sweep_guard::makeDetector(name));
}

std::unique_ptr<Peer> makeWholeDetectorPeer(const std::string& name, Surface& surface) {
  return std::make_unique<DetectorPeer>(surface, sweep_guard::makeDetector(name), /*sets_up=*/true);
}

std::unique_ptr<Peer> makePlainSelectPeer(Surface& surface) {
  const sweep_guard::SelectDetector::Options papers{/*cull=*/false, /*block=*/1};
  return std::make_unique<DetectorPeer>(surface, std::make_unique<sweep_guard::SelectDetector>(papers));
}

}  // namespace sweep_guard_benchmark
