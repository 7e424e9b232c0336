#include "ros/camera/camera_input.h"

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ros/camera/depth_topic.h"
#include "ros/camera/pinhole.h"
#include "ros/input/checked_header.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Time;
using sweep_guard_core::Workpiece;

constexpr size_t kMaxWaiting = 16;            // images, see Worker: each counts as a byte
constexpr std::uint32_t kQueued = 100;        // messages; taken from roscpp's queue at once
constexpr size_t kMaxImageSize = 33U << 20U;  // [bytes]; Grid::kMaxPixels take 32 MiB
constexpr size_t kMaxInfoSize = 1U << 16U;    // [bytes]
constexpr size_t kLeastPoints = 7;            // of the tool in the picture
constexpr double kLeastFound = 0.5;
constexpr sweep_guard_core::Duration kPatience = std::chrono::seconds(5);
constexpr sweep_guard_core::Duration kInfoPatience = std::chrono::seconds(1);
constexpr size_t kRemembered = 64;  // images: snapshots that none of them needed are given back

bool isSame(const sweep_guard_core::Pinhole& a, const sweep_guard_core::Pinhole& b) {
  return std::tie(a.fx, a.fy, a.cx, a.cy) == std::tie(b.fx, b.fy, b.cx, b.cy);
}

void requireSight(const std::vector<float>& depths) {
  const auto is_nothing = [](float depth) { return std::isnan(depth); };
  if (std::all_of(depths.begin(), depths.end(), is_nothing))
    throw InvalidInput("it has no depth in any pixel: is the camera covered?");
}

}  // namespace

CameraInput::CameraInput(const ros::NodeHandle& node, const CameraParameters& camera,
                         const CameraInputDependencies& dependencies)
    : camera_(camera),
      dependencies_(dependencies),
      topic_(node.resolveName(camera.depth)),
      info_topic_(node.resolveName(infoTopicOf(topic_))),
      points_(dependencies.private_node, camera.id, dependencies.parameters),
      self_(dependencies.parameters, dependencies.frames, dependencies.poses),
      worker_(kMaxWaiting),
      images_(isCompressedDepth(topic_) ? subscribe<sensor_msgs::CompressedImage>(node)
                                        : subscribe<sensor_msgs::Image>(node)),
      infos_(subscribeBounded<sensor_msgs::CameraInfo>(
          node, {info_topic_, 1, kMaxInfoSize},
          [this](const ros::MessageEvent<const sensor_msgs::CameraInfo>& event) {
            const sweep_guard_core::Lock lock(info_mutex_);
            info_ = event.getConstMessage();
          },
          [this](const std::string& reason) { refuse(reason, std::chrono::steady_clock::now()); })) {}

template <typename Msg>
BoundedSubscriber CameraInput::subscribe(ros::NodeHandle node) {
  const auto take_later = [this](const ros::MessageEvent<const Msg>& event) {
    const auto& msg = event.getConstMessage();
    const SteadyTime received = std::chrono::steady_clock::now();
    record_.received({fromMsg(msg->header.stamp), received});
    worker_.push({[this, msg, received] { take(*msg, received); }, [this, received] { drop(received); }, 1});
  };
  return subscribeBounded<Msg>(node, {topic_, kQueued, kMaxImageSize}, take_later,
                               [this](const std::string& reason) { refuse(reason, std::chrono::steady_clock::now()); });
}

void CameraInput::start(Supervisor& supervisor) {
  worker_.start(supervisor, {"camera", sweep_guard_core::Stage::kReceive, /*watched=*/false});
}

std::optional<CameraInput::Shares> CameraInput::shares() const {
  const sweep_guard_core::Lock lock(shares_mutex_);
  return shares_;
}

void CameraInput::keepShares(const sweep_guard_core::Timestamps& image) {
  const auto share = [](size_t part, size_t all) { return static_cast<double>(part) / static_cast<double>(all); };
  Shares shares{share(surface_->seen(), depths_.size()),
                share(surface_->self(), depths_.size()),
                share(surface_->hidden(), depths_.size()),
                self_.unplaced().size(),
                std::nullopt,
                surface_->rests(),
                false,
                sweep_guard_core::toSeconds(now().stamp - image.stamp)};
  const auto [points, found] = surface_->compare(depths_, self_.toolPoints(), camera_.self_padding);
  if (points >= kLeastPoints) shares.tool_found = share(found, points);
  if (!shares.tool_found || *shares.tool_found >= kLeastFound) misplaced_since_.reset();
  if (shares.tool_found && *shares.tool_found < kLeastFound && !misplaced_since_) misplaced_since_ = image.received;
  shares.misplaced = misplaced_since_ && image.received - *misplaced_since_ >= kPatience;
  const sweep_guard_core::Lock lock(shares_mutex_);
  shares_ = shares;
}

template <typename Msg>
void CameraInput::take(const Msg& msg, SteadyTime received) {
  if (awaitsInfo(received)) return;
  try {
    checkHeader(msg.header);
    const Time stamp = fromMsg(msg.header.stamp);
    prepare(readDepths(msg, depths_));
    requireSight(depths_);
    const Eigen::Isometry3d X_WC = locate(msg.header.frame_id, stamp);
    surface_->take(depths_, X_WC, secondsSince(stamp), self_.at(stamp, camera_.self_padding));
    newest_ = stamp;
    ++number_;
    auto image = unusedImage();
    image->mesh_M.deform(surface_->places_F(), surface_->before_F(), surface_->existing());
    image->stamp = stamp;
    image->received = received;
    image->updates = number_;
    image->free_space = surface_->freeSpace();
    if (!dependencies_.show(image)) drop(received);
  } catch (const std::exception& error) {  // invalid, no transform, or out of memory
    return refuse(error.what(), received);
  }
  keepShares({*newest_, received});
  points_.publish(*surface_, depths_, *newest_);
}

sensor_msgs::CameraInfo::ConstPtr CameraInput::info() const {
  const sweep_guard_core::Lock lock(info_mutex_);
  return info_;
}

std::string CameraInput::missingInfo() const {
  return "no camera_info has come on " + info_topic_ + ": publish it beside the images";
}

// The two topics connect separately: the first images may come before the camera_info.
bool CameraInput::awaitsInfo(SteadyTime received) {
  if (!first_received_) first_received_ = received;
  if (received - *first_received_ >= kInfoPatience || info()) return false;
  record_.lacks(missingInfo());
  return true;
}

// Begins anew with a camera of another size or calibration, and after another tool, in whose place the surroundings were seen.
void CameraInput::prepare(const ImageSize& size) {
  const auto newest_info = info();
  if (!newest_info) throw InvalidInput(missingInfo());
  const sweep_guard_core::Pinhole pinhole = pinholeOf(*newest_info, size, isNamedRectified(topic_));
  const auto bodies = dependencies_.parameters.get()->bodies;
  const bool same_size = empty_ && size.width == size_.width && size.height == size_.height;
  if (same_size && surface_ && isSame(pinhole, pinhole_) && bodies == bodies_) return;
  bodies_ = bodies;
  const sweep_guard_core::Grid grid(size.width, size.height);
  surface_.emplace(grid, pinhole, camera_.options);
  pinhole_ = pinhole;
  if (same_size) return;
  empty_.emplace(grid);
  const double* const padding = dependencies_.parameters.initial().paddings.of(camera_.id);
  empty_->pad(padding == nullptr ? 0.0 : *padding);
  images_shown_ = {};
  size_ = size;
}

double CameraInput::secondsSince(Time stamp) const {
  return newest_ ? std::max(0.0, sweep_guard_core::toSeconds(stamp - *newest_)) : 0.0;
}

Eigen::Isometry3d CameraInput::locate(const std::string& frame, Time stamp) {
  const auto parameters = dependencies_.parameters.get();
  if (frame != frame_) dependencies_.frames.use(frameUserOf(camera_.id), parameters->fixed_frame, {frame});
  frame_ = frame;
  return dependencies_.frames.lookup(parameters->fixed_frame, frame, stamp, parameters->limits.pose_timeout);
}

std::shared_ptr<Workpiece> CameraInput::unusedImage() {
  auto image = images_shown_.take([](const Workpiece& /*any*/) { return true; });
  if (!image)
    image = images_shown_.add({camera_.id, 0, {}, {}, dependencies_.parameters.initial().fixed_frame, *empty_});
  image->of_camera = true;
  images_shown_.forgetUnneeded(kRemembered);
  return image;
}

void CameraInput::refuse(const std::string& why, SteadyTime received) {
  const std::string message = "camera '" + camera_.id + "': image refused: " + why;
  record_.error(message, /*refused=*/true);
  dependencies_.monitor.meshRefused(camera_.id, message, received);
  log_.error(camera_.id, message);
}

void CameraInput::drop(SteadyTime received) {
  ++dropped_;
  record_.error("an image was dropped: too many wait", /*refused=*/true);
  dependencies_.monitor.updateDropped(camera_.id, received);
}

}  // namespace sweep_guard_ros
