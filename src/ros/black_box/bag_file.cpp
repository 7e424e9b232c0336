#include "ros/black_box/bag_file.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <boost/make_shared.hpp>
#include <map>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uintmax_t kOverhead = 128;           // record and index of a message [bytes]
constexpr std::uintmax_t kConnections = 4U << 20U;  // their headers, with the definitions of the messages [bytes]

using Connection = boost::shared_ptr<ros::M_string>;

// rosbag replaces the topic by the name in the bag.
Connection withOriginalTopic(const Connection& header) {
  const auto copy = boost::make_shared<ros::M_string>(*header);
  const auto topic = copy->find("topic");
  if (topic != copy->end()) copy->emplace("original_topic", topic->second);
  return copy;
}

void write(const std::filesystem::path& file, const HeardMessages& messages) {
  rosbag::Bag bag(file.string(), rosbag::bagmode::Write);
  std::map<Connection, Connection> headers;
  for (const auto& message : messages) {
    const HeardMessage& heard = message.content;
    Connection& header = headers[heard.connection];
    if (!header && heard.connection) header = withOriginalTopic(heard.connection);
    bag.write(heard.topic, toMsg(message.received), heard.message, header);
  }
  bag.close();
}

// What rosbag does not notice while it writes would be missing here.
void check(const std::filesystem::path& file, std::size_t count) {
  const rosbag::Bag bag(file.string());
  const std::size_t readable = rosbag::View(bag).size();
  if (readable == count) return;
  throw sweep_guard_core::DeviceError("only " + std::to_string(readable) + " of " + std::to_string(count) +
                                      " messages can be read");
}

}  // namespace

std::uintmax_t bagSize(const HeardMessages& messages) {
  std::uintmax_t size = kConnections;
  for (const auto& message : messages) size += message.content.message->size() + kOverhead;
  return size;
}

void writeBag(const std::filesystem::path& file, const HeardMessages& messages) {
  try {
    write(file, messages);
    check(file, messages.size());
  } catch (const std::exception& error) {
    throw sweep_guard_core::DeviceError(file.string() + ": cannot be written: " + error.what());
  }
}

}  // namespace sweep_guard_ros
