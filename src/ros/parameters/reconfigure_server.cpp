#include "ros/parameters/reconfigure_server.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/console.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "ros/parameters/parameter_changes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;

const std::string kRoot = "Default";  // name that clients expect

std::string typeOf(const ParameterValue& value) {
  static const std::vector<std::string> types = {"bool", "int", "double", "str"};
  return types[value.index()];
}

template <typename Parameter, typename Value>
void append(std::vector<Parameter>& list, const std::string& key, const Value& value) {
  list.emplace_back();
  list.back().name = key;
  list.back().value = value;
}

void append(Config& config, const std::string& key, const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) append(config.bools, key, *flag);
  if (const auto* integer = std::get_if<int>(&value)) append(config.ints, key, *integer);
  if (const auto* number = std::get_if<double>(&value)) append(config.doubles, key, *number);
  if (const auto* text = std::get_if<std::string>(&value)) append(config.strs, key, *text);
}

// Converts a bound to the type of the value; a text has no bounds.
ParameterValue limit(const ParameterInfo& info, double bound) {
  if (std::holds_alternative<bool>(info.value)) return bound > 0.5;
  if (std::holds_alternative<int>(info.value)) return static_cast<int>(bound);
  if (std::holds_alternative<double>(info.value)) return bound;
  return std::string();
}

// Writes the Python expression that clients evaluate.
std::string enumeration(const std::vector<std::string>& choices) {
  if (choices.empty()) return "";
  std::ostringstream list;
  for (const std::string& choice : choices) {
    list << "{'name': '" << choice << "', 'value': '" << choice
         << "', 'type': 'str', 'description': '', 'ctype': 'std::string', 'cconsttype': 'const char * const', "
            "'srcfile': '', 'srcline': 0}, ";
  }
  return "{'enum': [" + list.str() + "], 'enum_description': ''}";
}

std::string groupOf(const std::string& key) {
  const size_t slash = key.find('/');
  return slash == std::string::npos ? kRoot : key.substr(0, slash);
}

// A key's group is its part before the slash. Groups are in the order of reading.
std::vector<dynamic_reconfigure::Group> groups(const std::vector<ParameterInfo>& changeable) {
  std::vector<dynamic_reconfigure::Group> groups(1);
  groups[0].name = kRoot;
  for (const ParameterInfo& info : changeable) {
    const auto same = [name = groupOf(info.key)](const auto& group) { return group.name == name; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) {
      group = groups.emplace(group);
      group->name = groupOf(info.key);
      group->id = static_cast<int>(groups.size()) - 1;
    }
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = info.key;
    parameter.type = typeOf(info.value);
    parameter.description = info.effect + " (" + info.wanted + ")";
    parameter.edit_method = enumeration(info.choices);
    group->parameters.push_back(parameter);
  }
  return groups;
}

std::vector<ParameterInfo> changeable(const Parameters& parameters) {
  std::vector<ParameterInfo> changeable;
  for (const ParameterInfo& info : parameters.described) {
    if (info.live) changeable.push_back(info);
  }
  return changeable;
}

void appendGroups(Config& config, const std::vector<ParameterInfo>& changeable) {
  for (const dynamic_reconfigure::Group& group : groups(changeable)) {
    config.groups.emplace_back();
    config.groups.back().name = group.name;
    config.groups.back().state = true;
    config.groups.back().id = group.id;
    config.groups.back().parent = group.parent;
  }
}

Config values(const Parameters& parameters) {
  Config config;
  const std::vector<ParameterInfo> infos = changeable(parameters);
  for (const ParameterInfo& info : infos) append(config, info.key, info.value);
  appendGroups(config, infos);
  return config;
}

ConfigDescription description(const Parameters& parameters) {
  ConfigDescription description;
  const std::vector<ParameterInfo> infos = changeable(parameters);
  for (const ParameterInfo& info : infos) {
    append(description.min, info.key, limit(info, info.lowest));
    append(description.max, info.key, limit(info, info.highest));
    append(description.dflt, info.key, info.fallback);
  }
  description.groups = groups(infos);
  for (Config* config : {&description.min, &description.max, &description.dflt}) appendGroups(*config, infos);
  return description;
}

std::map<std::string, ParameterValue> requested(const Config& request) {
  std::map<std::string, ParameterValue> changes;
  for (const auto& flag : request.bools) changes[flag.name] = flag.value != 0;
  for (const auto& integer : request.ints) changes[integer.name] = integer.value;
  for (const auto& number : request.doubles) changes[number.name] = number.value;
  for (const auto& text : request.strs) changes[text.name] = text.value;
  return changes;
}

}  // namespace

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& private_node, ServiceThreads& threads, MasterThread& master,
                                     const LiveParameters& parameters, Apply apply)
    : private_node_(private_node),
      parameters_(parameters),
      apply_(std::move(apply)),
      writer_(private_node, master),
      descriptions_(private_node_.advertise<ConfigDescription>("parameter_descriptions", 1, /*latch=*/true)),
      values_(private_node_.advertise<Config>("parameter_updates", 1, /*latch=*/true)),
      calls_(threads.lasting, threads.refusals),
      server_(calls_.advertise<Event>(
          private_node, "set_parameters", parameters.initial().max_message_size,
          [this](Event& event) { return onSet(event); },
          [](const std::string& reason, auto& /*response*/) -> bool {
            throw sweep_guard_core::InvalidInput(reason);
          })) {
  descriptions_.publish(description(parameters_.initial()));
  publishValues();
}

ReconfigureServer::History ReconfigureServer::history() const {
  const sweep_guard_core::Lock lock(mutex_);
  return history_;
}

// roscpp logs the exception and sends it to the caller.
bool ReconfigureServer::onSet(Event& event) {
  const std::string caller = sweep_guard_core::printable(event.getCallerName());
  try {
    change(event.getRequest().config, caller);
  } catch (const std::exception& error) {
    const sweep_guard_core::Lock lock(mutex_);
    history_.last_refusal = std::string(error.what()) + " (requested by " + caller + ")";
    publishValues();  // clients that show the request see the current values again
    throw;
  }
  event.getResponse().config = values(*parameters_.get());
  publishValues();
  return true;
}

void ReconfigureServer::change(const Config& request, const std::string& caller) {
  const std::shared_ptr<const Parameters> before = parameters_.get();
  const auto next = std::make_shared<const Parameters>(changeParameters(private_node_, *before, requested(request)));
  const std::vector<ParameterChange> changes = differences(*before, *next);
  if (changes.empty()) return;
  apply_(next);
  std::string text;
  std::map<std::string, ParameterValue> values;
  for (const ParameterChange& change : changes) {
    values[change.key] = change.after;
    text += (text.empty() ? "" : ", ") + change.key + " from " + shown(change.before) + " to " + shown(change.after);
  }
  ROS_INFO("%s changed %s", caller.c_str(), text.c_str());
  {
    const sweep_guard_core::Lock lock(mutex_);
    history_.last_change = text + " (by " + caller + ")";
  }
  if (writer_.write(values)) return;
  throw sweep_guard_core::Error("applied: " + text +
                                ". The parameter server does not answer, and has the old values until it does");
}

void ReconfigureServer::publishValues() { values_.publish(values(*parameters_.get())); }

}  // namespace sweep_guard_ros
