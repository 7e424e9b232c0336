#pragma once

#include <cstdint>

#include "ros/camera/depth_image.h"
#include "ros/connection/wire.h"

namespace sweep_guard_ros {

/// Returns the size that the header of a PNG of 16-bit gray gives, as programs write depth images. Allocates nothing.
/// @throws sweep_guard_core::InvalidInput if this is no PNG, one of color or of another depth, interlaced, or if its
///     bytes cannot hold its pixels
ImageSize sizeOfGrayPng(Wire png);

/// Reads the pixels of a PNG that has such a size, row by row. Passes over chunks that say how to show them (gamma).
/// libpng allocates some 60 kB for the time of the call.
/// @param[out] pixels  room for two bytes of each pixel; they are in the order of this processor
/// @throws sweep_guard_core::InvalidInput in words of libpng if the PNG is cut off or damaged
void readGrayPng(Wire png, std::uint8_t* pixels);

}  // namespace sweep_guard_ros
