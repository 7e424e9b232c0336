#include <embree3/rtcore.h>

#include <algorithm>
#include <stdexcept>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;

// A scene of boxes, because rtcCollide() takes nothing else. Only a scene of low quality has a tree per geometry that
// can be refitted.
Scene sceneOf(const Device& device, size_t boxes, RTCBoundsFunction bounds, void* data) {
  Scene scene(rtcNewScene(device.get()));
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes));
  rtcSetGeometryUserData(geometry, data);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  rtcAttachGeometryByID(scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return scene;
}

class Embree : public Peer {
 public:
  explicit Embree(Surface& surface) : surface_(surface), device_(rtcNewDevice("threads=1")) {
    if (!device_) throw std::runtime_error("Embree gives no device");
    scene_ = sceneOf(device_, surface.triangles.size(), boundTriangle, this);
  }

  void prepare(const std::vector<Polytope>& volumes_M) override {
    Peer::prepare(volumes_M);
    volumes_scene_ = sceneOf(device_, volumes_M.size(), boundVolume, this);
  }

  void update() override {
    rtcCommitGeometry(rtcGetGeometry(scene_.get(), 0));
    rtcCommitScene(scene_.get());
  }

  void queryAll(std::vector<TriangleIds>& ids) override {
    ids_ = ids.data();
    rtcCollide(scene_.get(), volumes_scene_.get(), take, this);
  }

 private:
  static void boundTriangle(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const Embree*>(arguments->geometryUserPtr);
    const auto& triangle = self->surface_.triangles[arguments->primID];
    const float* const a = self->surface_.vertex(triangle[0]);
    const float* const b = self->surface_.vertex(triangle[1]);
    const float* const c = self->surface_.vertex(triangle[2]);
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = std::min({a[0], b[0], c[0]});
    bounds.lower_y = std::min({a[1], b[1], c[1]});
    bounds.lower_z = std::min({a[2], b[2], c[2]});
    bounds.upper_x = std::max({a[0], b[0], c[0]});
    bounds.upper_y = std::max({a[1], b[1], c[1]});
    bounds.upper_z = std::max({a[2], b[2], c[2]});
  }

  static void boundVolume(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const Embree*>(arguments->geometryUserPtr);
    const Polytope& volume_M = (*self->volumes_M_)[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = static_cast<float>(volume_M.lower_M[0]) - kRounding;
    bounds.lower_y = static_cast<float>(volume_M.lower_M[1]) - kRounding;
    bounds.lower_z = static_cast<float>(volume_M.lower_M[2]) - kRounding;
    bounds.upper_x = static_cast<float>(volume_M.upper_M[0]) + kRounding;
    bounds.upper_y = static_cast<float>(volume_M.upper_M[1]) + kRounding;
    bounds.upper_z = static_cast<float>(volume_M.upper_M[2]) + kRounding;
  }

  static void take(void* data, RTCCollision* collisions, unsigned count) {
    auto* const self = static_cast<Embree*>(data);
    for (unsigned i = 0; i < count; ++i) {
      const auto& [a, b, c] = self->surface_.triangles[collisions[i].primID0];
      const unsigned volume = collisions[i].primID1;
      const Polytope& volume_M = (*self->volumes_M_)[volume];
      if (meets(volume_M, self->surface_.vertex(a), self->surface_.vertex(b), self->surface_.vertex(c))) {
        self->ids_[volume].push_back(collisions[i].primID0);
      }
    }
  }

  static constexpr float kRounding = 1e-6F;  // [m]

  Surface& surface_;
  Device device_;
  Scene scene_;
  Scene volumes_scene_;
  TriangleIds* ids_ = nullptr;  // of each volume
};

}  // namespace

std::unique_ptr<Peer> makeEmbree(Surface& surface) { return std::make_unique<Embree>(surface); }

}  // namespace sweep_guard_benchmark
