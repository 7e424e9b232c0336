#include "recording/bag_topic.h"

#include <rosbag/view.h>

#include <cstddef>
#include <set>

#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;

namespace {

std::string joinNames(const std::set<std::string>& topics) {
  std::string list;
  for (const std::string& topic : topics) list += (list.empty() ? "" : ", ") + topic;
  return list;
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string chooseTopic(const rosbag::Bag& bag, const std::string& requested, const TopicChoice& choice) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag, rosbag::TypeQuery(choice.types)).getConnections()) {
    topics.insert(connection->topic);
  }
  if (topics.empty()) throw InvalidInput("no " + choice.what + " in the bag; record one of them");
  if (!requested.empty() && topics.count(requested) == 0) {
    throw InvalidInput("no " + choice.what + " on " + requested + "; there are: " + joinNames(topics));
  }
  if (requested.empty() && topics.size() != 1) {
    throw InvalidInput("choose one topic (" + choice.how + "); there are: " + joinNames(topics));
  }
  return requested.empty() ? *topics.begin() : requested;
}

void openBag(const std::string& path, const std::function<void(const rosbag::Bag&)>& read) {
  try {
    read(rosbag::Bag(path));
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  } catch (const rosbag::BagUnindexedException&) {
    throw InvalidInput(path + ": the bag has no index; run rosbag reindex on it");
  } catch (const std::exception& error) {  // of rosbag or ROS, or no memory for the size in a broken header
    throw InvalidInput(path + ": the bag is broken: " + firstLine(error.what()));
  }
}

void forEachMessage(const rosbag::Bag& bag, const std::string& topic,
                    const std::function<void(const rosbag::MessageInstance&)>& read) {
  std::size_t count = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    ++count;
    try {
      read(message);
    } catch (const InvalidInput& error) {
      throw InvalidInput(topic + ", message " + std::to_string(count) + ": " + error.what());
    }
  }
  if (count == 0) throw InvalidInput("no message on " + topic);
}

}  // namespace sweep_guard_recording
