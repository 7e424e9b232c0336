#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_session {

/// Returns the name under which the player publishes a topic of a bag: a script may have written it without a slash at its front.
std::string absoluteName(const std::string& topic);

/// What a bag says of messages.
struct MessageType {
  std::string name;
  std::string md5sum;  ///< of its definition
  bool operator<(const MessageType& other) const { return std::tie(name, md5sum) < std::tie(other.name, other.md5sum); }
};

using TopicTypes =
    std::map<std::string, std::set<MessageType>>;  ///< by absolute topic: one has a type for each publisher

/// Returns the files of a list `FILE:FILE:...`; the whole list if there is a file of that name.
/// @param folder  that relative names count from
std::vector<std::string> bagFiles(const std::string& list, const std::string& folder);

/// Reads the bags of one session as if they were one: `rosbag record --split` writes it in parts. Topics are compared by their
/// absolute names.
class SessionFiles {
 public:
  using Read = std::function<void(const rosbag::MessageInstance&)>;

  /// @param paths  at least one
  /// @throws sweep_guard_core::InvalidInput that says what is wrong with which file and what to do: it is missing, not regular, no
  ///     bag, without index, or broken; or all are empty
  explicit SessionFiles(const std::vector<std::string>& paths);

  std::string name() const;              ///< in words: the first file, and how many more
  sweep_guard_core::Time begin() const;  ///< first message
  sweep_guard_core::Time end() const;    ///< last message
  const TopicTypes& types() const { return types_; }
  std::size_t count(const std::string& topic) const;  ///< number of messages

  /// Passes the messages on some topics that were recorded in [from, to] to a function, in the order of recording.
  /// @throws sweep_guard_core::InvalidInput if a file is broken, or if `read` throws one
  void forEach(const std::vector<std::string>& topics, sweep_guard_core::Time from, sweep_guard_core::Time to,
               const Read& read) const;

  /// The same with all messages on these topics.
  void forEach(const std::vector<std::string>& topics, const Read& read) const {
    forEach(topics, begin(), end(), read);
  }

 private:
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<const rosbag::Bag>> bags_;
  TopicTypes types_;
  ros::Time begin_;
  ros::Time end_;
};

}  // namespace sweep_guard_session
