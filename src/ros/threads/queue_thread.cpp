#include "ros/threads/queue_thread.h"

#include <ros/init.h>

#include <boost/make_shared.hpp>
#include <utility>

namespace sweep_guard_ros {
namespace {

const ros::WallDuration kWait(0.1);  // between two looks at the state of ROS

class Posted : public ros::CallbackInterface {
 public:
  explicit Posted(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  const std::function<void()> work_;
};

}  // namespace

class QueueThread::Work : public ros::CallbackInterface {
 public:
  Work(const QueueThread& thread, ros::CallbackInterfacePtr callback)
      : thread_(thread), callback_(std::move(callback)) {}

  CallResult call() override {
    CallResult result = Invalid;
    thread_.top_->run([&] { result = callback_->call(); });
    return result;
  }
  bool ready() override { return callback_->ready(); }

 private:
  const QueueThread& thread_;
  const ros::CallbackInterfacePtr callback_;
};

void QueueThread::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  CallbackQueue::addCallback(boost::make_shared<Work>(*this, callback), owner);
}

void QueueThread::stop() {
  stopping_ = true;
  disable();
  if (thread_.joinable()) thread_.join();
}

ros::NodeHandle QueueThread::on(ros::NodeHandle node) {
  node.setCallbackQueue(this);
  return node;
}

void QueueThread::post(std::function<void()> work) {
  addCallback(boost::make_shared<Posted>(std::move(work)), /*owner=*/0);
}

void QueueThread::start(Supervisor& supervisor, const ThreadTraits& traits) {
  top_ = &supervisor.add(traits);
  thread_ = std::thread([this] { run(); });
}

void QueueThread::run() {
  id_ = std::this_thread::get_id();
  top_->enter();
  while (!stopping_ && !ros::isShuttingDown()) top_->attempt([this] { callOne(kWait); });
}

}  // namespace sweep_guard_ros
