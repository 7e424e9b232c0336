# An overrun of the stack or of a buffer whose size is known ends the process. A sanitizer has its own checks.
if(SWEEP_GUARD_SANITIZE)
  set(protection -fsanitize=${SWEEP_GUARD_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  set(link_protection -fsanitize=${SWEEP_GUARD_SANITIZE})
  if(SWEEP_GUARD_SANITIZE MATCHES thread)
    list(APPEND protection -DBOOST_ASIO_DISABLE_FENCED_BLOCK)  # the sanitizer knows no fences, which asio has besides its locks
  endif()
else()
  set(protection -fstack-protector-strong -fstack-clash-protection $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
  set(link_protection -Wl,-z,relro,-z,now,--no-undefined)
endif()

# The same results on every processor: multiplications and additions are rounded, also those of Eigen, which would fuse them
# where a processor is said to have that.
set(rounding -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  list(APPEND rounding -U__ARM_FEATURE_FMA)
endif()

# sweep_guard_rooms_if(OPTION FOLDER...) - adds the folders if the option is on
macro(sweep_guard_rooms_if option)
  if(${option})
    foreach(room ${ARGN})
      add_subdirectory(${room})
    endforeach()
  endif()
endmacro()

# sweep_guard_unite(TARGET) - compiles the sources of each folder as one, if SWEEP_GUARD_UNITY is on. A source that has the
# property SKIP_UNITY_BUILD_INCLUSION or a UNITY_GROUP of its own keeps it
function(sweep_guard_unite target)
  if(NOT SWEEP_GUARD_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # its heap is not swept below 512 MB: less time, up to a quarter more memory
    target_compile_options(${target} PRIVATE "SHELL:--param ggc-min-heapsize=524288")
  endif()
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/test")  # a local name may be that of another test's constant
    target_compile_options(${target} PRIVATE -Wno-shadow)
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE)
    get_source_file_property(group ${source} TARGET_DIRECTORY ${target} UNITY_GROUP)
    if(NOT group)
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
      string(MAKE_C_IDENTIFIER ${folder} group)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# Settings of every target of ours: the headers of other packages are system headers, so that warnings in them are not errors.
function(sweep_guard_target target)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual $<$<BOOL:${SWEEP_GUARD_WERROR}>:-Werror>)
  target_compile_options(${target} PRIVATE ${rounding} ${protection})
  target_link_options(${target} PRIVATE ${link_protection})
  sweep_guard_unite(${target})
endfunction()

# sweep_guard_optimize(TARGET LEVEL) - less than -O3, where no loop is hot: it takes less time to compile
function(sweep_guard_optimize target level)
  if(NOT SWEEP_GUARD_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:${level}>)
  endif()
endfunction()

function(sweep_guard_ros_target target)
  sweep_guard_target(${target})
  sweep_guard_optimize(${target} -O2)
  target_link_libraries(${target} sweep_guard_catkin)  # no keyword: catkin links its tests without
  add_dependencies(${target} ${${PROJECT_NAME}_EXPORTED_TARGETS})
endfunction()

# sweep_guard_public_library(LIBRARY) - one that other packages link: its name has the version, because any release may change it
function(sweep_guard_public_library library)
  set_target_properties(${library} PROPERTIES VERSION "${sweep_guard_VERSION}" SOVERSION "${sweep_guard_VERSION}")
endfunction()

# sweep_guard_precompile(LIBRARY HEADER...) - also for the targets that share them: no macro is its own
function(sweep_guard_precompile library)
  set_target_properties(${library} PROPERTIES DEFINE_SYMBOL "")
  target_precompile_headers(${library} PRIVATE ${ARGN})
endfunction()

# sweep_guard_share_headers(TARGET LIBRARY) - takes the headers that the library has precompiled, and its options with them
function(sweep_guard_share_headers target library)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL SHARED_LIBRARY)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${library})
endfunction()
