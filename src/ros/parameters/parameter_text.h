#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <map>
#include <string>
#include <vector>

#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

/// Returns a number or an integer; NaN if the value is neither.
double toNumber(const XmlRpc::XmlRpcValue& value);
/// Returns the integer that a text says, as entries of split() do; the value itself if it is another.
XmlRpc::XmlRpcValue toInteger(const XmlRpc::XmlRpcValue& value);
/// Splits a list as given on a command line: a, b or [a, b].
XmlRpc::XmlRpcValue split(std::string text);
/// Returns the texts of a group by these names; empty if it is not one of just these.
std::vector<std::string> textsOf(XmlRpc::XmlRpcValue& group, const std::vector<std::string>& names);
/// Returns the values of a group and of the groups within it. The parameter server makes such groups of names with slashes; here
/// they have these names again.
std::map<std::string, XmlRpc::XmlRpcValue> flattened(const XmlRpc::XmlRpcValue& group);

/// Writes a number as YAML 1.1 wants it: it takes 1e-06, 1.0e5 and -.5 for texts, and 1.0e-06 for a number.
std::string yamlNumber(std::string text);
/// Says, for the end of a refusal, how to write a text that is a number, or has one as an entry; "" if it is another value.
std::string noteOnText(const XmlRpc::XmlRpcValue& value);

bool within(double number, const ParameterRange& range);
bool within(const XmlRpc::XmlRpcValue& value, int lowest, int highest);  ///< false if it is no integer

std::string shown(const ParameterRange& range);      ///< without the unit
std::string described(const ParameterRange& range);  ///< with the unit
std::string shown(int lowest, int highest);
std::string listed(const std::vector<std::string>& choices);
std::string bracketed(const std::vector<std::string>& words);
std::string bracketed(const std::vector<int>& integers);
std::string braced(const std::vector<std::string>& entries);
std::string grouped(const std::vector<std::string>& names, const std::vector<std::string>& texts);

}  // namespace sweep_guard_ros
