#include "ros/black_box/bag_file.h"

#include <fcntl.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <unistd.h>

#include <boost/make_shared.hpp>
#include <map>
#include <memory>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr std::uintmax_t kOverhead = 128;           // record and index of a message [bytes]
constexpr std::uintmax_t kConnections = 4U << 20U;  // their headers, with the definitions of the messages [bytes]

using Connection = boost::shared_ptr<ros::M_string>;

// rosbag replaces the topic by the name in the bag, and reads the type from here.
Connection headerOf(const HeardMessage& heard) {
  auto header = boost::make_shared<ros::M_string>(heard.connection ? *heard.connection : ros::M_string());
  const auto topic = header->find("topic");
  if (topic != header->end()) header->emplace("original_topic", topic->second);
  header->emplace("type", heard.message->getDataType());
  header->emplace("md5sum", heard.message->getMD5Sum());
  header->emplace("message_definition", heard.message->getMessageDefinition());
  return header;
}

void writeMessages(rosbag::Bag& bag, const HeardMessages& messages) {
  std::map<Connection, Connection> headers;
  for (const auto& message : messages) {
    const HeardMessage& heard = message.content;
    Connection& header = headers[heard.connection];
    if (!header) header = headerOf(heard);
    bag.write(heard.topic, toMsg(message.received), heard.message, header);
  }
  bag.close();
}

// Lets what is still written to a file of this process go nowhere.
void divert(const std::filesystem::path& file) {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  std::error_code error;
  for (const auto& descriptor : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    std::error_code gone;
    if (!std::filesystem::equivalent(descriptor, file, gone)) continue;
    dup2(nowhere, std::stoi(descriptor.path().filename()));
  }
  close(nowhere);
}

// The destructor of a bag writes the rest: on a full disk it would throw, and end the process.
void write(const std::filesystem::path& file, const HeardMessages& messages) {
  auto bag = std::make_unique<rosbag::Bag>(file.string(), rosbag::bagmode::Write);
  try {
    writeMessages(*bag, messages);
  } catch (...) {
    divert(file);
    try {
      bag->close();
    } catch (const std::exception&) {
      bag.release();  // NOLINT(bugprone-unused-return-value): a leak, but no end
    }
    throw;
  }
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
