# What the tests of the core otherwise have from catkin.
enable_testing()
find_package(GTest REQUIRED NO_MODULE)
add_custom_target(tests)

function(catkin_add_gtest target)
  add_executable(${target} EXCLUDE_FROM_ALL ${ARGN})
  target_link_libraries(${target} GTest::gtest)
  add_dependencies(tests ${target})
  add_test(NAME _ctest_${PROJECT_NAME}_gtest_${target} COMMAND ${target})
endfunction()
