#pragma once

#include <memory>
#include <string>

#include "peers/peer.h"

namespace sweep_guard_benchmark {

/// The detector of this name behind the interface of the peers.
std::unique_ptr<Peer> makeDetectorPeer(const std::string& name, Surface& surface);

/// The same, which also sets up the volume of each query, in the time that is taken.
std::unique_ptr<Peer> makeWholeDetectorPeer(const std::string& name, Surface& surface);

/// OpenGL's selection as [P] has it: every triangle drawn, each with a name of its own.
std::unique_ptr<Peer> makePlainSelectPeer(Surface& surface);

}  // namespace sweep_guard_benchmark
