# sweep_guard_label(TEST LABEL...) - unit: runs anywhere, in seconds; ros: starts a master; slow: begins before others of
# its kind; search: draws as many cases as SWEEP_GUARD_SCENES and SWEEP_GUARD_CASES say; nightly: not in
# scripts/test
function(sweep_guard_label test)
  # Tests that only compute begin first: beside them, those with a master would wait for a processor.
  set(cost 60)
  if(ros IN_LIST ARGN)
    set(cost 0)
  endif()
  if(slow IN_LIST ARGN)
    math(EXPR cost "${cost} + 30")
  endif()
  set_tests_properties(${test} PROPERTIES LABELS "${ARGN}" COST ${cost})
endfunction()

# The main program, and the headers that are precompiled for the tests.
set(test_headers
  <Eigen/Geometry> <algorithm> <cmath> <functional> <gtest/gtest.h> <map> <memory> <optional> <set> <string> <variant> <vector>)
add_library(sweep_guard_test_main STATIC EXCLUDE_FROM_ALL main.cpp)
sweep_guard_target(sweep_guard_test_main)
sweep_guard_optimize(sweep_guard_test_main -O1)
target_link_libraries(sweep_guard_test_main GTest::gtest Eigen3::Eigen)
target_precompile_headers(sweep_guard_test_main PRIVATE ${test_headers})

if(NOT SWEEP_GUARD_CORE_ONLY)
  # With the main program, for those that have none of their own.
  add_library(sweep_guard_probe STATIC EXCLUDE_FROM_ALL
    ros/child_process.cpp ros/guard_probe.cpp ros/guard_process.cpp ros/main.cpp)
  set_source_files_properties(ros/main.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  sweep_guard_ros_target(sweep_guard_probe)
  target_link_libraries(sweep_guard_probe sweep_guard_ros GTest::gtest)
  sweep_guard_optimize(sweep_guard_probe -O1)
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

# sweep_guard_deal(TARGET) - for a unity build: at most eight sources of a folder are compiled as one, in at most 1.5 GB of memory
function(sweep_guard_deal target)
  if(NOT SWEEP_GUARD_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    list(LENGTH dealt_${folder} count)
    list(APPEND dealt_${folder} ${source})
    math(EXPR group "${count} / 8")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
endfunction()

# sweep_guard_gtest(TARGET SOURCE...) - a test program of the core. catkin links it to Google Test without a keyword, so
# this has to as well.
function(sweep_guard_gtest target)
  catkin_add_gtest(${target} ${ARGN})
  sweep_guard_deal(${target})
  sweep_guard_target(${target})
  sweep_guard_optimize(${target} -O1)
  target_precompile_headers(${target} REUSE_FROM sweep_guard_test_main)
  target_link_libraries(${target} sweep_guard_test_main sweep_guard_scenes Threads::Threads)
  sweep_guard_label(_ctest_${PROJECT_NAME}_gtest_${target} unit)
endfunction()

# sweep_guard_share_probe_headers(TARGET) - and the level of optimization that goes with them
function(sweep_guard_share_probe_headers target)
  sweep_guard_optimize(${target} -O1)
  target_precompile_headers(${target} REUSE_FROM sweep_guard_probe)
endfunction()

# sweep_guard_ros_gtest(TARGET SOURCE...) - a test program that uses ROS and needs no master
function(sweep_guard_ros_gtest target)
  catkin_add_gtest(${target} ${ARGN})
  sweep_guard_deal(${target})
  sweep_guard_ros_target(${target})
  sweep_guard_share_probe_headers(${target})
  target_link_libraries(${target} sweep_guard_test_main sweep_guard_scenes sweep_guard_ros)
  sweep_guard_label(_ctest_${PROJECT_NAME}_gtest_${target} unit)
endfunction()

# sweep_guard_rostest_program(NAME [SOURCE...]) - NAME.test with a program of its own, NAME_test.cpp
function(sweep_guard_rostest_program name)
  add_rostest_gtest(${name}_test ${name}.test ${name}_test.cpp ${ARGN})
  sweep_guard_ros_target(${name}_test)
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/test)
  sweep_guard_share_probe_headers(${name}_test)
  target_link_libraries(${name}_test sweep_guard_probe)
  sweep_guard_label_rostest(${name} ros)
endfunction()

# sweep_guard_rostest_in(PROGRAM NAME [SOURCE...]) - NAME.test, which names the files of its tests to a program that has those of
# others, too: NAME_test and the sources
function(sweep_guard_rostest_in program name)
  file(READ ${name}.test launch)
  foreach(source ${name}_test.cpp ${ARGN})
    target_sources(${program} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    get_filename_component(file ${source} NAME_WE)
    if(file MATCHES "_test$" AND NOT launch MATCHES "${program}\" args=\"([^\"]* )?(--gtest_filter|${file}[ \"])")
      message(FATAL_ERROR "${name}.test does not name ${file}: nothing would run its tests")
    endif()
  endforeach()
  add_rostest(${name}.test DEPENDENCIES ${program})
  sweep_guard_label_rostest(${name} ros)
endfunction()

# sweep_guard_rostest(NAME [SOURCE...]) - in ros_test: what fifty programs would read is read seven times
function(sweep_guard_rostest name)
  sweep_guard_rostest_in(ros_test ${name} ${ARGN})
endfunction()

# sweep_guard_label_rostest(NAME LABEL...) - of NAME.test in the folder of the caller
function(sweep_guard_label_rostest name)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE / _ folder ${folder})
  sweep_guard_label(_ctest_${PROJECT_NAME}_rostest_${folder}_${name}.test ${ARGN})
endfunction()
