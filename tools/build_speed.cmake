# SPDX-License-Identifier: MIT
# What makes building cheaper and changes nothing of what is built: docs/BUILDING.md. Included before any target is made.
option(THREEFOLD_CCACHE "Take objects from ccache where it is installed" ON)
option(THREEFOLD_PRECOMPILED "Precompile the heavy headers of other libraries" ON)
option(THREEFOLD_UNITY "Compile the sources of a folder together: least time in all, most after one change" OFF)

if(THREEFOLD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(CCACHE_PROGRAM ccache)
  if(CCACHE_PROGRAM)
    # Without these, ccache takes no object that was compiled with a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE_PROGRAM})
  endif()
endif()
if(THREEFOLD_PRECOMPILED AND CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    add_compile_options(-fpch-preprocess)
  elseif(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  endif()
endif()

# One unit a folder: names in an unnamed namespace need be unique within it only. The largest folder is parted in
# two. A source that speaks a language of its own (one-letter names, operators) stays alone.
function(threefold_unity target)
  if(NOT THREEFOLD_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(source MATCHES "/exact_pixel\\.cpp$")
      continue()
    endif()
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${source})
    get_filename_component(group ${path} DIRECTORY)
    if(path MATCHES "/claims/claim_")
      string(APPEND group "_claim")
    endif()
    string(MAKE_C_IDENTIFIER "${group}" group)
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Headers that nearly every source reads, with their share of a source's front end. With whole folders in a unit they are
# read seldom enough. What is exported or installed does not carry them.
set(threefold_common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
    <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
    <fmt/format.h> <glm/common.hpp> <glm/geometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp>)
function(threefold_precompiled target)
  if(NOT THREEFOLD_PRECOMPILED OR THREEFOLD_UNITY)
    return()
  elseif(target STREQUAL threefold_scenes)
    target_precompile_headers(${target} PRIVATE ${threefold_common_headers})
  else()
    target_precompile_headers(${target} REUSE_FROM threefold_scenes)
  endif()
endfunction()
function(threefold_precompiled_tests target)
  if(NOT THREEFOLD_PRECOMPILED)
    return()
  elseif(target STREQUAL threefold_tests)
    target_precompile_headers(${target} PRIVATE ${threefold_common_headers} <random> <sstream> <gmock/gmock.h>
      <gtest/gtest.h> <nlohmann/json.hpp> <rapidcheck/gtest.h>)
  else()
    target_precompile_headers(${target} REUSE_FROM threefold_tests)
  endif()
endfunction()
