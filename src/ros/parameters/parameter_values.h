#pragma once

#include <XmlRpcValue.h>

#include <string>
#include <vector>

#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

double toNumber(const XmlRpc::XmlRpcValue& value);  ///< NaN if it is none
bool within(double number, const ParameterRange& range);
bool within(const XmlRpc::XmlRpcValue& value, int lowest, int highest);  ///< false if it is no integer
/// Returns an integer given as text, as an entry of a list that is given as text; any other value as it is.
XmlRpc::XmlRpcValue toInteger(const XmlRpc::XmlRpcValue& value);
/// Splits a list as given on a command line: a, b or [a, b].
XmlRpc::XmlRpcValue split(std::string text);
/// Returns the texts of a group by these names; empty if the group has others, or one of them is no text or empty.
std::vector<std::string> textsOf(XmlRpc::XmlRpcValue& group, const std::vector<std::string>& names);

std::string shown(const ParameterRange& range);
std::string withUnit(const ParameterRange& range);  ///< as shown(), after the unit
std::string shown(int lowest, int highest);
std::string listed(const std::vector<std::string>& choices);                                        ///< x, y
std::string bracketed(const std::vector<std::string>& words);                                       ///< [x, y]
std::string bracketed(const std::vector<int>& integers);                                            ///< [1, 2]
std::string grouped(const std::vector<std::string>& names, const std::vector<std::string>& texts);  ///< {a: x, b: y}

}  // namespace sweep_guard_ros
