#pragma once

// OGRE 1.9, that of Ubuntu's rviz of Noetic and ROS-O, has a header for each dimension.
#if __has_include(<OgreVector.h>)
#include <OgreVector.h>
#else
#include <OgreVector3.h>
#endif
