#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "peers/peer.h"

namespace sweep_guard_benchmark {

/// Another way to do the same work.
struct PeerKind {
  std::string name;
  std::string package;                                  ///< of Debian that it needs; empty: none
  std::function<std::unique_ptr<Peer>(Surface&)> make;  ///< empty if the package was missing when this was built
};

/// All there are, the missing ones too.
const std::vector<PeerKind>& peerKinds();

/// Every position is read once, nothing is answered: the limit of a plain loop.
std::unique_ptr<Peer> makeMemoryRead(Surface& surface);

/// The same, and 12 KB ahead are fetched into the cache, as the update of a mesh does: the limit.
std::unique_ptr<Peer> makeMemoryReadAhead(Surface& surface);

/// Every triangle, one after the other, against every plane, until it is beyond one; what is beyond none is clipped.
std::unique_ptr<Peer> makeScalar(Surface& surface);

/// The same, against the box along the axes before.
std::unique_ptr<Peer> makeScalarBoxFirst(Surface& surface);

/// A tree of boxes along the axes: refitted, then traversed by FCL's node for a mesh and a shape.
std::unique_ptr<Peer> makeFclAabb(Surface& surface);

/// A tree of FCL's OBBRSS, refitted, and fcl::collide().
std::unique_ptr<Peer> makeFclObbRss(Surface& surface);

/// Bullet's quantised tree, refitted, its candidates clipped by us.
std::unique_ptr<Peer> makeBulletCallback(Surface& surface);

/// Bullet's quantised tree, refitted, and contactPairTest().
std::unique_ptr<Peer> makeBulletContactTest(Surface& surface);

/// Embree's tree over the boxes of the triangles, refitted, rtcCollide() with the volume's box, the candidates clipped
/// by us.
std::unique_ptr<Peer> makeEmbree(Surface& surface);

/// CGAL's tree, rebuilt, what meets the volume's box clipped by us.
std::unique_ptr<Peer> makeCgal(Surface& surface);

}  // namespace sweep_guard_benchmark
