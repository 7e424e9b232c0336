#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "peers/peer.h"

namespace sweep_guard_benchmark {

/// A peer that compare can run.
struct PeerKind {
  std::string name;
  std::string package;                                  ///< Debian package that it needs; empty: none
  std::function<std::unique_ptr<Peer>(Surface&)> make;  ///< empty if the package was missing at build time
};

/// Returns all peers, including those that are missing.
const std::vector<PeerKind>& peerKinds();

/// Reads every position once and answers nothing: the lower limit of a plain loop.
std::unique_ptr<Peer> makeMemoryRead(Surface& surface);

/// Does the same and prefetches 12 KB, as the update of a mesh does: the lower limit.
std::unique_ptr<Peer> makeMemoryReadAhead(Surface& surface);

/// Tests each triangle against each plane until it lies beyond one; clips it if it lies beyond none.
std::unique_ptr<Peer> makeScalar(Surface& surface);

/// Does the same after a test against the axis-aligned box.
std::unique_ptr<Peer> makeScalarBoxFirst(Surface& surface);

/// Refits a tree of axis-aligned boxes and traverses it with FCL's node for a mesh and a shape.
std::unique_ptr<Peer> makeFclAabb(Surface& surface);

/// Refits a tree of FCL's OBBRSS and calls fcl::collide().
std::unique_ptr<Peer> makeFclObbRss(Surface& surface);

/// Refits Bullet's quantized tree; meets() tests its candidates.
std::unique_ptr<Peer> makeBulletCallback(Surface& surface);

/// Refits Bullet's quantized tree and calls contactPairTest().
std::unique_ptr<Peer> makeBulletContactTest(Surface& surface);

/// Refits Embree's tree over the boxes of the triangles and calls rtcCollide() with the volume's box; meets() tests the
/// candidates.
std::unique_ptr<Peer> makeEmbree(Surface& surface);

/// Rebuilds CGAL's tree; meets() tests the triangles that meet the volume's box.
std::unique_ptr<Peer> makeCgal(Surface& surface);

}  // namespace sweep_guard_benchmark
