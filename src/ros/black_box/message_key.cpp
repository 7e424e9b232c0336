#include "ros/black_box/message_key.h"

#include <ros/serialization.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>
#include <optional>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr std::size_t kStampedHeader = 12;  // sequence number and stamp [bytes]
constexpr std::size_t kNoPositions = 8;     // the rest of MeshVertices without any [bytes]

std::optional<std::string> nextText(Wire& message) {
  std::uint32_t length = 0;
  if (message.size < sizeof(length)) return std::nullopt;
  std::memcpy(&length, message.bytes, sizeof(length));
  if (message.size - sizeof(length) < length) return std::nullopt;
  std::string text(reinterpret_cast<const char*>(message.bytes) + sizeof(length), length);
  message.bytes += sizeof(length) + length;
  message.size -= sizeof(length) + length;
  return text;
}

// DeformableMesh and MeshVertices begin with the header and the id. The rest is left in the message.
std::optional<std::string> nextWorkpiece(Wire& message) {
  if (message.size < kStampedHeader) return std::nullopt;
  message.bytes += kStampedHeader;
  message.size -= kStampedHeader;
  if (!nextText(message)) return std::nullopt;
  return nextText(message);
}

std::string childFramesIn(Wire message) {
  checkLengths<tf2_msgs::TFMessage>(message);
  tf2_msgs::TFMessage transforms;
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(message.bytes),
                                     static_cast<std::uint32_t>(message.size));
  ros::serialization::deserialize(stream, transforms);
  std::string frames;
  for (const auto& transform : transforms.transforms) frames += ' ' + transform.child_frame_id;
  return frames;
}

std::string meshKey(const std::string& id, const char* rest) { return "workpiece " + id + rest; }

}  // namespace

std::string messageKey(const RecordedTopic& topic, const std::string& publisher, Wire message) {
  switch (topic.kept) {
    case KeptMessages::kNone:
      return {};
    case KeptMessages::kNewest:
      return topic.recorded + ' ' + publisher;
    case KeptMessages::kEachMesh:
    case KeptMessages::kEachVertices: {
      const bool has_vertices = topic.kept == KeptMessages::kEachVertices;
      const auto id = nextWorkpiece(message);
      if (!id || (has_vertices && message.size == kNoPositions)) return {};
      return meshKey(*id, has_vertices ? "\nvertices" : "");
    }
    case KeptMessages::kEachTransform:
      try {
        return topic.recorded + ' ' + publisher + childFramesIn(message);
      } catch (const sweep_guard_core::InvalidInput&) {
        return {};
      }
  }
  return {};
}

}  // namespace sweep_guard_ros
