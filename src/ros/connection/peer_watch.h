#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "ros/connection/publisher_links.h"
#include "ros/threads/master_thread.h"

namespace sweep_guard_ros {

/// Connects the inputs of a node anew to publishers that were out of reach. Without this, they stay silent after a broken link
/// is whole again, for up to as long as it was broken: so long TCP waits until it sends again. Also connects a publisher anew
/// that answers while a connection to it stays down: roscpp tries again after up to 20 s, and never if the connection broke
/// while it was made. Looks only while an input may be silent.
class PeerWatch {
 public:
  /// @param thread               looks and connects; must be stopped first
  /// @param input_may_be_silent  called in that thread
  PeerWatch(MasterThread& thread, std::function<bool()> input_may_be_silent);
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

 private:
  void checkOrLog();
  void check();
  bool staysDown(const std::string& publisher, const PublishersOfTopics& down);
  void connectAnew(const std::string& publisher, const PublishersOfTopics& topics);
  void connectPending();

  const std::function<bool()> input_may_be_silent_;
  const XmlRpcCall& call_;
  std::set<std::string> out_of_reach_;
  std::map<std::string, int> looks_down_;  // by publisher: at how many looks a connection to it has been down
  PublishersOfTopics pending_;             // by topic: disconnected, and to be connected again
};

}  // namespace sweep_guard_ros
