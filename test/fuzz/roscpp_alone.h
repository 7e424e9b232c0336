#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>
#include <ros/subscription_callback_helper.h>

#include <map>
#include <string>

namespace sweep_guard_fuzz {

/// Starts roscpp once, without a master: a program that links this file asks its own parameter server, and what it subscribes
/// to and advertises as a service is only noted here. ROS time stands still at 1000 s; nothing is logged.
void startRoscpp();

/// The parameters of the server, by resolved name. A value may be a group.
std::map<std::string, XmlRpc::XmlRpcValue>& serverParameters();

struct Service {
  ros::ServiceCallbackHelperPtr helper;
  ros::CallbackQueueInterface* queue;
};

/// By resolved name.
std::map<std::string, Service>& services();
std::map<std::string, ros::SubscriptionCallbackHelperPtr>& subscriptions();

}  // namespace sweep_guard_fuzz
