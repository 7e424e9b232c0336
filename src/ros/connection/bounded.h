#pragma once

#include <ros/node_handle.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "ros/connection/own_services.h"
#include "ros/connection/topic_refusals.h"
#include "ros/connection/wire.h"
#include "ros/threads/thread_top.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

/// Throws unless a serialized message is at most this long and its lengths are right.
/// @throws sweep_guard_core::InvalidInput
template <typename Msg>
void checkMessage(Wire wire, size_t max_size) {
  if (wire.size > max_size) {
    throw sweep_guard_core::InvalidInput("message of " + std::to_string(wire.size) + " bytes exceeds the limit of " +
                                         std::to_string(max_size) +
                                         " (of meshes and requests: limits/max_message_size)");
  }
  checkLengths<Msg>(wire);
}

/// How to subscribe so that a message cannot take more memory than it has bytes.
struct BoundedSubscription {
  std::string topic;
  std::uint32_t queue_length;  ///< messages; 0: unbounded
  size_t max_size;             ///< of a message [bytes]
};

template <typename Msg>
class BoundedMessages : public ros::SubscriptionCallbackHelperT<const ros::MessageEvent<const Msg>&> {
 public:
  using Base = ros::SubscriptionCallbackHelperT<const ros::MessageEvent<const Msg>&>;
  using Refused = std::function<void(const std::string&)>;

  /// @param topic    resolved name
  /// @param refused  called with the reason of each refusal, also where another subscription of this process refused the
  ///                 message
  BoundedMessages(const std::string& topic, typename Base::Callback callback, Refused refused, size_t max_size)
      : Base(std::move(callback), kCreate),
        refusals_(TopicRefusals::of(topic)),
        refused_(refusals_->add(std::move(refused))),
        max_size_(max_size) {}

  /// Receives no more reports of refusals.
  void close() { refused_->close(); }

  /// Returns null for a refused message, which roscpp then leaves out.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& message) override {
    try {
      checkMessage<Msg>({message.buffer, message.length}, max_size_);
      return Base::deserialize(message);
    } catch (const std::bad_alloc& error) {
      throw PassesRoscpp{error.what()};
    } catch (const std::exception& error) {
      refusals_->pass(error.what());
    }
    return {};
  }

 private:
  // Base's default; a temporary copies a buffer that is not initialized, and GCC 14 says so.
  inline static const typename Base::CreateFunction kCreate = ros::DefaultMessageCreator<Msg>();

  const std::shared_ptr<TopicRefusals> refusals_;
  const std::shared_ptr<TopicRefusals::Report> refused_;
  const size_t max_size_;
};

/// A subscription that reports refused messages for as long as it lives. roscpp may deserialize later, and in the
/// threads of other subscribers to the same topic.
class BoundedSubscriber : public ros::Subscriber {
 public:
  BoundedSubscriber() = default;
  BoundedSubscriber(const ros::Subscriber& subscriber, std::shared_ptr<void> closing)
      : ros::Subscriber(subscriber), closing_(std::move(closing)) {}

 private:
  std::shared_ptr<void> closing_;
};

/// Subscribes to messages whose lengths are checked before they are read. All subscriptions of a process to a
/// topic receive the same message, which the first of them reads and may refuse, by its own limit.
/// @param refused  called in place of `callback` with the reason. Any thread
template <typename Msg>
BoundedSubscriber subscribeBounded(ros::NodeHandle node, const BoundedSubscription& subscription,
                                   typename BoundedMessages<Msg>::Base::Callback callback,
                                   typename BoundedMessages<Msg>::Refused refused) {
  ros::SubscribeOptions options(subscription.topic, subscription.queue_length, ros::message_traits::md5sum<Msg>(),
                                ros::message_traits::datatype<Msg>());
  const auto helper = boost::make_shared<BoundedMessages<Msg>>(
      node.resolveName(subscription.topic), std::move(callback), std::move(refused), subscription.max_size);
  options.helper = helper;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return {node.subscribe(options), std::shared_ptr<void>(nullptr, [helper](void*) { helper->close(); })};
}

template <typename Spec>
class BoundedCalls : public ros::ServiceCallbackHelperT<Spec> {
 public:
  using Base = ros::ServiceCallbackHelperT<Spec>;
  using Response = typename Spec::ResponseType;
  using Refused = std::function<bool(const std::string&, Response&)>;
  using Admit = std::function<void()>;

  BoundedCalls(typename Base::Callback callback, Refused refused, size_t max_size, Admit admit)
      : Base(std::move(callback)), refused_(std::move(refused)), max_size_(max_size), admit_(std::move(admit)) {}

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    try {
      admit_();
      checkMessage<typename Spec::RequestType>({params.request.buf.get(), params.request.num_bytes}, max_size_);
    } catch (const sweep_guard_core::Error& error) {
      Response response;
      const bool answered = refused_(error.what(), response);
      params.response = ros::serialization::serializeServiceResponse(answered, response);
      return answered;
    }
    return Base::call(params);
  }

 private:
  const Refused refused_;
  const size_t max_size_;
  const Admit admit_;
};

/// Advertises a service whose requests are checked before they are read.
/// @tparam Spec  ros::ServiceSpec or ros::ServiceEvent
/// @param refused  fills the response from the reason; returns whether it is sent
/// @param admit    called before a request is read; throws sweep_guard_core::Error to refuse it
template <typename Spec>
ros::ServiceServer advertiseBounded(ros::NodeHandle node, const std::string& name, size_t max_size,
                                    typename BoundedCalls<Spec>::Base::Callback callback,
                                    typename BoundedCalls<Spec>::Refused refused,
                                    typename BoundedCalls<Spec>::Admit admit) {
  ros::AdvertiseServiceOptions options;
  options.initBySpecType<Spec>(name, callback);
  options.helper =
      boost::make_shared<BoundedCalls<Spec>>(std::move(callback), std::move(refused), max_size, std::move(admit));
  return advertiseOwn(node, options);
}

}  // namespace sweep_guard_ros
