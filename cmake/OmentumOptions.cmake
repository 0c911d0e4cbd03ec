# How every target is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# g++ 12 warns of std::string's own insides (-Warray-bounds) where they come from a precompiled header.
set(OMENTUM_WARNINGS -Wall -Wextra -Wpedantic $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_COMPILE_OPTIONS_PIE -fPIC)  # programs as libraries, so that they share precompiled headers
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # what ccache asks for where headers are precompiled
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

option(OMENTUM_NATIVE "compile the numeric kernels for this machine's vector unit" ON)
set(OMENTUM_SANITIZE "" CACHE STRING "address (with undefined), fuzzer (of clang) or thread; empty for none")

if(OMENTUM_SANITIZE STREQUAL "address")
  # What a null, misplaced or wrapped pointer does is seen by the address sanitizer too; to compile these five checks takes
  # longer than half of all the rest in tests, a third in libraries, and to run them a quarter.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(OMENTUM_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
elseif(OMENTUM_SANITIZE STREQUAL "fuzzer")  # clang's; programs of tests/fuzz/ are linked with libFuzzer besides
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(OMENTUM_SANITIZE)
  message(FATAL_ERROR "OMENTUM_SANITIZE is '${OMENTUM_SANITIZE}'; expected address, fuzzer, thread or nothing")
endif()

# omentum_precompiled(NAME headers...): parses the headers once for all targets that say REUSE_FROM NAME: parsing is
# half of what compiling costs. Every source includes what it uses all the same; lint compiles without NAME.
function(omentum_precompiled name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_compile_options(${name} PRIVATE ${OMENTUM_WARNINGS})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
set(OMENTUM_COMMON_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <filesystem> <fstream> <functional>
  <iostream> <map> <memory> <mutex> <optional> <span> <sstream> <stdexcept> <string> <thread> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry>)
omentum_precompiled(omentum_precompiled_common ${OMENTUM_COMMON_HEADERS})
target_link_libraries(omentum_precompiled_common PRIVATE Eigen3::Eigen)
set(OMENTUM_PRECOMPILED omentum_precompiled_common)  # for the folder's libraries and programs

# Whoever builds everything once saves a third of it; who works on a source waits for the seven beside it.
option(OMENTUM_UNITY "compile sources eight at a time" "$ENV{OMENTUM_UNITY}")

# omentum_unity(TARGET): with OMENTUM_UNITY TARGET's sources are compiled eight at a time: headers are read and templates
# instantiated once for them. Their unnamed namespaces must not name two things alike. What is defined once for a whole
# program, or compiled in its own way, stays alone.
function(omentum_unity target)
  if(OMENTUM_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    set_source_files_properties(
      ${PROJECT_SOURCE_DIR}/transport/fast/asan_options.cpp ${PROJECT_SOURCE_DIR}/tests/support/heap_count.cpp PROPERTIES
      SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# omentum_library(NAME sources...): a library target omentum_NAME, alias Omentum::NAME.
function(omentum_library name)
  add_library(omentum_${name} STATIC ${ARGN})
  add_library(Omentum::${name} ALIAS omentum_${name})
  set_target_properties(omentum_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(omentum_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/omentum>)
  target_compile_features(omentum_${name} PUBLIC cxx_std_20)
  target_compile_options(omentum_${name} PRIVATE ${OMENTUM_WARNINGS})
  target_precompile_headers(omentum_${name} REUSE_FROM ${OMENTUM_PRECOMPILED})
  # what a program takes of a library would drag along what stands beside it, and the libraries that this needs
  if(OMENTUM_SANITIZE MATCHES "^(address|fuzzer)$")
    omentum_unity(omentum_${name})
  endif()
endfunction()

# omentum_native(sources...): files that hold nothing but numeric kernels on raw pointers. Only
# they are compiled for this machine's vector unit, so that no inline function of a library leaks out
# compiled for another instruction set than the rest.
function(omentum_native)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  if(OMENTUM_NATIVE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-O3;-march=native;-mprefer-vector-width=512")
  endif()
endfunction()

# omentum_executable(NAME sources...): a program in bin/.
function(omentum_executable name)
  add_executable(${name} ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_options(${name} PRIVATE ${OMENTUM_WARNINGS})
  target_precompile_headers(${name} REUSE_FROM ${OMENTUM_PRECOMPILED})
endfunction()
