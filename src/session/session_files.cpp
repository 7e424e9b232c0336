#include "session/session_files.h"

#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "recording/bag.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_session {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::Time;
using sweep_guard_ros::fromMsg;

namespace {

std::unique_ptr<const rosbag::Bag> open(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InvalidInput("no such file; give bag:=FILE");
  if (!std::filesystem::is_regular_file(path)) throw InvalidInput("not a regular file; give bag:=FILE");
  if (!sweep_guard_recording::isBag(path)) throw InvalidInput("not a rosbag, or not readable; give bag:=FILE");
  return std::make_unique<const rosbag::Bag>(path);
}

template <typename Work>
auto withoutExceptionsOfRosbag(Work work) {
  try {
    return work();
  } catch (const InvalidInput&) {
    throw;
  } catch (const rosbag::BagUnindexedException&) {
    throw InvalidInput("the bag has no index, its recorder did not end; run rosbag reindex on it");
  } catch (const std::exception& error) {  // of rosbag or ROS, or no memory for the size in a broken header
    throw InvalidInput(std::string("the bag is broken: ") + error.what());
  }
}

std::unique_ptr<const rosbag::Bag> openNamed(const std::string& path) {
  try {
    return withoutExceptionsOfRosbag([&path] { return open(path); });
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

auto topicsQuery(const std::vector<std::string>& topics) {
  std::set<std::string> names;
  std::transform(topics.begin(), topics.end(), std::inserter(names, names.end()), absoluteName);
  return [names](const rosbag::ConnectionInfo* connection) { return names.count(absoluteName(connection->topic)) > 0; };
}

}  // namespace

std::string absoluteName(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : '/' + topic;
}

std::vector<std::string> bagFiles(const std::string& list, const std::string& folder) {
  const auto in_folder = [&folder](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
  if (std::error_code error; std::filesystem::exists(in_folder(list), error)) return {in_folder(list)};
  std::vector<std::string> files;
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ':');) files.push_back(in_folder(name));
  return files;
}

SessionFiles::SessionFiles(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths) bags_.push_back(openNamed(path));
  rosbag::View all;
  for (const auto& bag : bags_) all.addQuery(*bag);
  if (all.size() == 0) {
    throw InvalidInput(name() + ": the bag is empty; record the session again, until rosbag record ends");
  }
  begin_ = all.getBeginTime();
  end_ = all.getEndTime();
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    types_[absoluteName(connection->topic)].insert({connection->datatype, connection->md5sum});
}

std::string SessionFiles::name() const {
  return paths_.front() + (paths_.size() > 1 ? " and " + std::to_string(paths_.size() - 1) + " more" : "");
}

Time SessionFiles::begin() const { return fromMsg(begin_); }
Time SessionFiles::end() const { return fromMsg(end_); }

std::size_t SessionFiles::count(const std::string& topic) const {
  std::size_t count = 0;
  for (const auto& bag : bags_) count += rosbag::View(*bag, topicsQuery({topic})).size();
  return count;
}

void SessionFiles::forEach(const std::vector<std::string>& topics, Time from, Time to, const Read& read) const {
  withoutExceptionsOfRosbag([&] {
    rosbag::View view;
    for (const auto& bag : bags_) {
      view.addQuery(*bag, topicsQuery(topics), sweep_guard_ros::toMsg(from), sweep_guard_ros::toMsg(to));
    }
    for (const rosbag::MessageInstance& message : view) read(message);
  });
}

}  // namespace sweep_guard_session
