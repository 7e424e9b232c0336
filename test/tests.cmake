# sweep_guard_label(TEST LABEL...) - unit: runs anywhere, in seconds; ros: starts a master; slow: takes longer than 10 s
function(sweep_guard_label test)
  set_tests_properties(${test} PROPERTIES LABELS "${ARGN}")
endfunction()

# The main program, and the headers that are precompiled for the tests.
set(test_headers
  <Eigen/Geometry> <algorithm> <cmath> <functional> <gtest/gtest.h> <map> <memory> <optional> <set> <string> <variant> <vector>)
add_library(sweep_guard_test_main STATIC EXCLUDE_FROM_ALL main.cpp)
sweep_guard_target(sweep_guard_test_main)
target_link_libraries(sweep_guard_test_main GTest::gtest Eigen3::Eigen)
target_precompile_headers(sweep_guard_test_main PRIVATE ${test_headers})

if(NOT SWEEP_GUARD_CORE_ONLY)
  add_library(sweep_guard_probe STATIC EXCLUDE_FROM_ALL ros/guard_probe.cpp)
  sweep_guard_ros_target(sweep_guard_probe)
  target_link_libraries(sweep_guard_probe sweep_guard_ros GTest::gtest)
  target_precompile_headers(sweep_guard_probe PRIVATE ${test_headers}
    <geometry_msgs/PoseStamped.h> <ros/ros.h> <std_srvs/SetBool.h> <std_srvs/Trigger.h> <visualization_msgs/MarkerArray.h>)
endif()

# Folders for LD_LIBRARY_PATH, each with an empty file in place of a library: a program that has one cannot load that library.
foreach(library libOSMesa.so.8 libEGL.so.1)
  file(WRITE ${PROJECT_BINARY_DIR}/test/empty/${library}/${library} "")
endforeach()
# sweep_guard_empty_libraries(TARGET) - for a test that includes missing_libraries.h
function(sweep_guard_empty_libraries target)
  target_compile_definitions(${target} PRIVATE SWEEP_GUARD_EMPTY_LIBRARIES="${PROJECT_BINARY_DIR}/test/empty")
endfunction()

# sweep_guard_gtest(TARGET SOURCE...) - a test program of the core. catkin links it to Google Test without a keyword, so
# this has to as well.
function(sweep_guard_gtest target)
  catkin_add_gtest(${target} ${ARGN})
  sweep_guard_target(${target})
  target_precompile_headers(${target} REUSE_FROM sweep_guard_test_main)
  target_link_libraries(${target} sweep_guard_test_main sweep_guard_scenes Threads::Threads)
  sweep_guard_label(_ctest_${PROJECT_NAME}_gtest_${target} unit)
endfunction()

# sweep_guard_ros_gtest(TARGET SOURCE...) - a test program that uses ROS and needs no master
function(sweep_guard_ros_gtest target)
  catkin_add_gtest(${target} ${ARGN})
  sweep_guard_ros_target(${target})
  target_precompile_headers(${target} REUSE_FROM sweep_guard_probe)
  target_link_libraries(${target} sweep_guard_test_main sweep_guard_scenes sweep_guard_ros)
  sweep_guard_label(_ctest_${PROJECT_NAME}_gtest_${target} unit)
endfunction()

# sweep_guard_rostest(NAME [SOURCE...]) - NAME.test with the program that it runs, NAME_test.cpp
function(sweep_guard_rostest name)
  add_rostest_gtest(${name}_test ${name}.test ${name}_test.cpp ${ARGN})
  sweep_guard_ros_target(${name}_test)
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_precompile_headers(${name}_test REUSE_FROM sweep_guard_probe)
  target_link_libraries(${name}_test sweep_guard_ros)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE / _ folder ${folder})
  sweep_guard_label(_ctest_${PROJECT_NAME}_rostest_${folder}_${name}.test ros)
endfunction()
