#include "peers/peers.h"

namespace sweep_guard_benchmark {

const std::vector<PeerKind>& peerKinds() {
  static const std::vector<PeerKind> kinds = {
      {"scalar", "", makeScalar},
      {"scalar box first", "", makeScalarBoxFirst},
#ifdef SWEEP_GUARD_FCL
      {"FCL AABB", "libfcl-dev", makeFclAabb},
      {"FCL OBBRSS", "libfcl-dev", makeFclObbRss},
#else
      {"FCL AABB", "libfcl-dev", nullptr},  {"FCL OBBRSS", "libfcl-dev", nullptr},
#endif
#ifdef SWEEP_GUARD_BULLET
      {"Bullet", "libbullet-dev", makeBulletCallback},
      {"Bullet contactPairTest", "libbullet-dev", makeBulletContactTest},
#else
      {"Bullet", "libbullet-dev", nullptr}, {"Bullet contactPairTest", "libbullet-dev", nullptr},
#endif
#ifdef SWEEP_GUARD_EMBREE
      {"Embree", "libembree-dev", makeEmbree},
#else
      {"Embree", "libembree-dev", nullptr},
#endif
#ifdef SWEEP_GUARD_CGAL
      {"CGAL", "libcgal-dev", makeCgal},
#else
      {"CGAL", "libcgal-dev", nullptr},
#endif
  };
  return kinds;
}

}  // namespace sweep_guard_benchmark
