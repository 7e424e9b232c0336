#include "ros/wire.h"

#include <cstring>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kLength = 4;  // [bytes]
constexpr size_t kStamp = 8;   // or a duration
constexpr size_t kPose = 7 * sizeof(double);
constexpr size_t kTwist = 6 * sizeof(double);
constexpr size_t kBall = 4 * sizeof(double);
constexpr size_t kPlane = 8 * sizeof(double);  // without names and indices

// Walks over the fields of a message in their order.
class WireReader {
 public:
  explicit WireReader(Wire wire) : wire_(wire) {}

  void skip(size_t bytes) {
    if (bytes > wire_.size) throw sweep_guard_core::InvalidInput("message is cut off");
    wire_ = {wire_.bytes + bytes, wire_.size - bytes};
  }

  // @param element  smallest size of an element [bytes]
  size_t length(size_t element) {
    std::uint32_t count = 0;
    const std::uint8_t* const bytes = wire_.bytes;
    skip(kLength);
    std::memcpy(&count, bytes, kLength);
    if (count > wire_.size / element) {
      throw sweep_guard_core::InvalidInput("message announces " + std::to_string(count) + " elements and holds " +
                                           std::to_string(wire_.size) + " bytes");
    }
    return count;
  }

  void array(size_t element) { skip(length(element) * element); }
  void text() { array(1); }
  void header() {
    skip(kLength + kStamp);
    text();
  }

  template <typename Read>
  void each(size_t smallest, const Read& read) {
    for (size_t left = length(smallest); left > 0; --left) read();
  }

  void end() const {
    if (wire_.size > 0) throw sweep_guard_core::InvalidInput("message is too long for its type");
  }

 private:
  Wire wire_;
};

constexpr size_t kIntend = 4 * kLength + kBall + sizeof(double) + kStamp;

void readIntend(WireReader& read) {
  read.text();
  read.array(sizeof(std::uint32_t));
  read.text();
  read.skip(kBall + sizeof(double));
  read.each(kLength, [&] { read.text(); });
  read.skip(kStamp);
}

// Of a path that is to be tested: workpieces, volume, detector, margin, narrow phase.
void readSelection(WireReader& read) {
  read.each(kLength, [&] { read.text(); });
  read.text();
  read.text();
  read.skip(sizeof(double) + 1);
}

}  // namespace

template <>
void checkLengths<geometry_msgs::PoseStamped>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.skip(kPose);
  read.end();
}

template <>
void checkLengths<sensor_msgs::JointState>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.each(kLength, [&] { read.text(); });
  for (int quantity = 0; quantity < 3; ++quantity) read.array(sizeof(double));
  read.end();
}

template <>
void checkLengths<tf2_msgs::TFMessage>(Wire wire) {
  WireReader read(wire);
  read.each(3 * kLength + kStamp + kPose, [&] {
    read.header();
    read.text();
    read.skip(kPose);
  });
  read.end();
}

template <>
void checkLengths<sweep_guard::DeformableMesh>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(sizeof(sweep_guard::DeformableMesh::revision));
  read.array(3 * sizeof(std::uint32_t));
  read.array(3 * sizeof(double));
  read.end();
}

template <>
void checkLengths<sweep_guard::MeshVertices>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(sizeof(sweep_guard::MeshVertices::revision));
  read.array(sizeof(float));
  read.end();
}

template <>
void checkLengths<geometry_msgs::Twist>(Wire wire) {
  WireReader read(wire);
  read.skip(kTwist);
  read.end();
}

template <>
void checkLengths<geometry_msgs::TwistStamped>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.skip(kTwist);
  read.end();
}

// A wrench is as long as a twist.
template <>
void checkLengths<geometry_msgs::WrenchStamped>(Wire wire) {
  checkLengths<geometry_msgs::TwistStamped>(wire);
}

template <>
void checkLengths<sweep_guard::Proximity>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(kPose + sizeof(sweep_guard::Proximity::tool_revision) + kStamp + 1);
  read.each(2 * kLength + 2 * sizeof(std::uint32_t) + kPlane, [&] {
    read.text();
    read.skip(sizeof(sweep_guard::SeparatingPlane::piece));
    read.text();
    read.skip(sizeof(sweep_guard::SeparatingPlane::triangle) + kPlane);
  });
  read.skip(2 * sizeof(double));
  read.end();
}

template <>
void checkLengths<sweep_guard::ToolBalls>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(sizeof(sweep_guard::ToolBalls::revision));
  read.each(2 * kLength, [&] {
    read.text();
    read.array(kBall);
  });
  read.end();
}

template <>
void checkLengths<sweep_guard::ToolBodies>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(sizeof(sweep_guard::ToolBodies::revision) + sizeof(sweep_guard::ToolBodies::sequence) + kStamp);
  read.each(kPose + sizeof(double) + 2 * kLength, [&] {
    read.skip(kPose + sizeof(double));
    read.array(kStamp + kPose + sizeof(sweep_guard::PredictedPose::covariance));
    read.array(sizeof(double));
  });
  read.end();
}

template <>
void checkLengths<sweep_guard::ToolSurface>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.text();
  read.skip(sizeof(sweep_guard::ToolSurface::revision));
  read.each(3 * kLength + sizeof(sweep_guard::LinkSurface::body), [&] {
    read.text();
    read.skip(sizeof(sweep_guard::LinkSurface::body));
    read.array(3 * sizeof(std::uint32_t));
    read.array(3 * sizeof(double));
  });
  read.end();
}

template <>
void checkLengths<sweep_guard::Warning>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.text();
  read.skip(5 + kStamp);
  read.text();
  read.text();
  read.array(sizeof(std::uint32_t));
  read.skip(sizeof(sweep_guard::Warning::reasons));
  read.text();
  read.skip(sizeof(sweep_guard::Warning::sequence) + sizeof(sweep_guard::Warning::level_counts) + 2 * kStamp);
  read.text();
  const size_t up_to_run_id = 8 * kLength + 4 * kStamp + 5 + 7 * sizeof(std::uint32_t);  // if all is empty
  read.skip(ros::serialization::serializationLength(sweep_guard::Warning()) - up_to_run_id);
  read.end();
}

template <>
void checkLengths<sweep_guard::CheckSweepRequest>(Wire wire) {
  WireReader read(wire);
  read.each(2 * kLength + kStamp + kPose, [&] {
    read.header();
    read.skip(kPose);
  });
  readSelection(read);
  read.end();
}

template <>
void checkLengths<sweep_guard::CheckTrajectoryRequest>(Wire wire) {
  WireReader read(wire);
  read.header();
  read.each(kLength, [&] { read.text(); });
  read.each(4 * kLength + kStamp, [&] {
    for (int quantity = 0; quantity < 4; ++quantity) read.array(sizeof(double));
    read.skip(kStamp);
  });
  read.header();
  read.skip(kPose);
  readSelection(read);
  read.end();
}

template <>
void checkLengths<sweep_guard::PredictRequest>(Wire wire) {
  WireReader read(wire);
  read.skip(kStamp);
  read.end();
}

template <>
void checkLengths<sweep_guard::AcknowledgeRequest>(Wire wire) {
  WireReader read(wire);
  read.text();
  read.end();
}

template <>
void checkLengths<sweep_guard::AttachRequest>(Wire wire) {
  WireReader read(wire);
  read.text();
  read.text();
  read.skip(1);
  read.end();
}

template <>
void checkLengths<sweep_guard::Intend>(Wire wire) {
  WireReader read(wire);
  readIntend(read);
  read.end();
}

template <>
void checkLengths<sweep_guard::SetIntentRequest>(Wire wire) {
  WireReader read(wire);
  read.each(kIntend, [&] { readIntend(read); });
  read.end();
}

template <>
void checkLengths<std_srvs::SetBoolRequest>(Wire wire) {
  WireReader read(wire);
  read.skip(1);
  read.end();
}

template <>
void checkLengths<std_srvs::TriggerRequest>(Wire wire) {
  WireReader(wire).end();
}

template <>
void checkLengths<dynamic_reconfigure::ReconfigureRequest>(Wire wire) {
  WireReader read(wire);
  const auto named = [&](size_t value) {
    read.each(kLength + value, [&] {
      read.text();
      read.skip(value);
    });
  };
  named(sizeof(std::uint8_t));
  named(sizeof(std::int32_t));
  read.each(2 * kLength, [&] {
    read.text();
    read.text();
  });
  named(sizeof(double));
  named(sizeof(std::uint8_t) + 2 * sizeof(std::int32_t));
  read.end();
}

}  // namespace sweep_guard_ros
