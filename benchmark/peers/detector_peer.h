#pragma once

#include <memory>
#include <string>

#include "peers/peer.h"

namespace sweep_guard_benchmark {

/// Wraps the detector of this name.
std::unique_ptr<Peer> makeDetectorPeer(const std::string& name, Surface& surface);

/// Wraps the detector of this name; the time of a query includes that of computing its volume.
std::unique_ptr<Peer> makeDetectorPeerWithSetUp(const std::string& name, Surface& surface);

/// Wraps OpenGL's selection as in [P]: every triangle is drawn under a name of its own.
std::unique_ptr<Peer> makePlainSelectPeer(Surface& surface);

}  // namespace sweep_guard_benchmark
