#pragma once

#include <ros/node_handle.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <typeinfo>
#include <utility>

#include "ros/connection/wire.h"

namespace sweep_guard_ros {

/// A message of any type, as it came. Valid while the callback runs; the header may be kept by a copy of its pointer.
struct RawMessage {
  Wire bytes;
  const boost::shared_ptr<ros::M_string>& header;  ///< of the connection: type, md5sum, message_definition, callerid
};

/// Takes the messages of a topic, whatever their type, where roscpp has received them: if a copy is needed, it is the only one.
class RawMessages : public ros::SubscriptionCallbackHelper {
 public:
  using Callback = std::function<void(const RawMessage&)>;

  explicit RawMessages(Callback callback) : callback_(std::move(callback)) {}

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& message) override {
    callback_({{message.buffer, message.length}, message.connection_header});
    return {};  // nothing is left to call
  }
  void call(ros::SubscriptionCallbackHelperCallParams& /*never*/) override {}
  const std::type_info& getTypeInfo() override { return typeid(RawMessage); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  const Callback callback_;
};

/// Subscribes to a topic of any type.
inline ros::Subscriber subscribeRaw(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_length,
                                    RawMessages::Callback callback) {
  ros::SubscribeOptions options(topic, queue_length, "*", "*");
  options.helper = boost::make_shared<RawMessages>(std::move(callback));
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

}  // namespace sweep_guard_ros
