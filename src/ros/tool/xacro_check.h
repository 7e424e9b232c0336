#pragma once

#include <tinyxml2.h>

namespace sweep_guard_ros {

/// A file for xacro is XML with one element <robot>, too. urdfdom passes over elements that xacro would replace, and takes
/// ${name} for a name.
/// @param robot  root element of a robot description
/// @throws sweep_guard_core::InvalidInput if an element or an attribute is named xacro:..., or if an attribute that urdfdom reads
///     has a ${...} or $(...). What xacro writes has neither: a declaration xmlns:xacro and comments may stay.
void requireNoXacro(const tinyxml2::XMLElement& robot);

}  // namespace sweep_guard_ros
