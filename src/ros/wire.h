#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>
#include <sweep_guard/Attach.h>
#include <sweep_guard/CheckSweep.h>
#include <sweep_guard/CheckTrajectory.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/Predict.h>
#include <sweep_guard/Proximity.h>
#include <sweep_guard/SetIntent.h>
#include <sweep_guard/ToolBalls.h>
#include <sweep_guard/ToolBodies.h>
#include <sweep_guard/ToolSurface.h>
#include <sweep_guard/Warning.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <cstdint>

namespace sweep_guard_ros {

/// A serialized message.
struct Wire {
  const std::uint8_t* bytes;
  size_t size;
};

/// Checks that each length in a serialized message fits the bytes that follow. roscpp reserves memory for a length
/// before it checks that, and multiplies lengths in 32 bits.
/// @tparam Msg  one of the messages below
/// @throws sweep_guard_core::InvalidInput if a length exceeds the message, or if bytes are left over
template <typename Msg>
void checkLengths(Wire wire);

template <>
void checkLengths<geometry_msgs::PoseStamped>(Wire wire);
template <>
void checkLengths<sensor_msgs::JointState>(Wire wire);
template <>
void checkLengths<tf2_msgs::TFMessage>(Wire wire);
template <>
void checkLengths<sweep_guard::DeformableMesh>(Wire wire);
template <>
void checkLengths<sweep_guard::MeshVertices>(Wire wire);
template <>
void checkLengths<geometry_msgs::Twist>(Wire wire);
template <>
void checkLengths<geometry_msgs::TwistStamped>(Wire wire);
template <>
void checkLengths<geometry_msgs::WrenchStamped>(Wire wire);
template <>
void checkLengths<sweep_guard::Proximity>(Wire wire);
template <>
void checkLengths<sweep_guard::ToolBalls>(Wire wire);
template <>
void checkLengths<sweep_guard::ToolBodies>(Wire wire);
template <>
void checkLengths<sweep_guard::ToolSurface>(Wire wire);
template <>
void checkLengths<sweep_guard::Warning>(Wire wire);
template <>
void checkLengths<sweep_guard::CheckSweepRequest>(Wire wire);
template <>
void checkLengths<sweep_guard::CheckTrajectoryRequest>(Wire wire);
template <>
void checkLengths<sweep_guard::PredictRequest>(Wire wire);
template <>
void checkLengths<sweep_guard::AcknowledgeRequest>(Wire wire);
template <>
void checkLengths<sweep_guard::AttachRequest>(Wire wire);
template <>
void checkLengths<std_srvs::SetBoolRequest>(Wire wire);
template <>
void checkLengths<std_srvs::TriggerRequest>(Wire wire);
template <>
void checkLengths<sweep_guard::Intend>(Wire wire);
template <>
void checkLengths<sweep_guard::SetIntentRequest>(Wire wire);
template <>
void checkLengths<dynamic_reconfigure::ReconfigureRequest>(Wire wire);

}  // namespace sweep_guard_ros
