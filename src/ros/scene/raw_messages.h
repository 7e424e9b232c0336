#pragma once

#include <ros/node_handle.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

namespace sweep_guard_ros {

/// A message of any type, as it came.
struct RawMessage {
  std::vector<std::uint8_t> bytes;
  boost::shared_ptr<ros::M_string> header;  ///< of the connection: type, md5sum, message_definition, callerid
  ros::Time received;
};

/// Takes the messages of a topic, whatever their type.
class RawMessages : public ros::SubscriptionCallbackHelper {
 public:
  using Callback = std::function<void(const RawMessage&)>;

  /// @param max_size  of a message [bytes]; of a longer one only the header is passed on
  RawMessages(Callback callback, size_t max_size) : callback_(std::move(callback)), max_size_(max_size) {}

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& message) override {
    const auto raw = boost::make_shared<RawMessage>();
    raw->header = message.connection_header;
    raw->received = ros::Time::now();
    if (message.length <= max_size_) raw->bytes.assign(message.buffer, message.buffer + message.length);
    return raw;
  }
  void call(ros::SubscriptionCallbackHelperCallParams& call) override {
    callback_(*boost::static_pointer_cast<const RawMessage>(call.event.getConstMessage()));
  }
  const std::type_info& getTypeInfo() override { return typeid(RawMessage); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  const Callback callback_;
  const size_t max_size_;
};

/// Subscribes to a topic of any type.
inline ros::Subscriber subscribeRaw(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_length,
                                    size_t max_size, RawMessages::Callback callback) {
  ros::SubscribeOptions options(topic, queue_length, "*", "*");
  options.helper = boost::make_shared<RawMessages>(std::move(callback), max_size);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

}  // namespace sweep_guard_ros
