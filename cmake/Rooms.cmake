# SPDX-License-Identifier: Apache-2.0
# A room is a folder: all .cpp files in it form one library of the same name, and its headers are included from the
# repository root, so that every include shows the layer.

# A public header lies in the lowest room that uses it; users see one folder, <filament_core/...>.
set(FILAMENT_PUBLIC_INCLUDES ${CMAKE_SOURCE_DIR}/base/include ${CMAKE_SOURCE_DIR}/shaders/package/include
    ${CMAKE_SOURCE_DIR}/filament_core/include)

add_library(filament_options INTERFACE)
target_compile_options(filament_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    -Wno-missing-field-initializers # descriptions name the fields that they set; the others have defaults
    -ffp-contract=off # the same bits from every compiler
    # gcc 12 sees a temporary's members as uninitialized where a constructor may throw (GCC bug 105562 and similar ones)
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-maybe-uninitialized>)
target_include_directories(filament_options INTERFACE
    ${CMAKE_SOURCE_DIR} ${FILAMENT_PUBLIC_INCLUDES})
target_compile_definitions(filament_options INTERFACE GLM_FORCE_XYZW_ONLY GLM_ENABLE_EXPERIMENTAL)
if(FILAMENT_SANITIZE)
    target_compile_options(filament_options INTERFACE
        -fsanitize=${FILAMENT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(filament_options INTERFACE -fsanitize=${FILAMENT_SANITIZE})
endif()

# ---- precompiled headers: the headers of other projects that most files include, parsed once for all rooms and tools and
# once for all tests. They contain no headers of this project, so an edit rebuilds no more than before. Every file still
# includes what it uses. The compiler accepts a precompiled header only if all options agree: the main files of programs
# (-fPIE) and files with other optimisation options do without.
option(FILAMENT_PCH "Precompile what most files include; OFF shows whether each file includes what it uses" ON)

# ccache caches objects built with a precompiled header only if it is told that macros of date and time do not matter.
foreach(language C CXX)
    if(FILAMENT_PCH AND CMAKE_${language}_COMPILER_LAUNCHER MATCHES "^([^;]*/)?ccache$")
        set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
            ${CMAKE_${language}_COMPILER_LAUNCHER})
    endif()
endforeach()

function(filament_precompile name)
    cmake_parse_arguments(ARG "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
    if(FILAMENT_PCH)
        set(source ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "// a target needs a source\n")
        add_library(${name} OBJECT ${source})
        target_link_libraries(${name} PRIVATE filament_options ${ARG_LINK})
        target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
        target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
    endif()
endfunction()

function(filament_use_precompiled target name)
    if(TARGET ${name})
        target_precompile_headers(${target} REUSE_FROM ${name})
    endif()
endfunction()

set(FILAMENT_PRECOMPILED
    <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <filesystem> <functional> <memory> <mutex> <optional> <span>
    <string> <string_view> <unordered_map> <utility> <variant> <vector> <fmt/format.h> <glm/common.hpp>
    <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/mat4x4.hpp>)
set(FILAMENT_PRECOMPILED_TESTS ${FILAMENT_PRECOMPILED}
    <gmock/gmock.h> <gtest/gtest.h> <chrono> <cstdio> <cstdlib> <fstream> <limits> <map> <numeric> <random> <set> <sstream>
    <thread>)

# ---- unity builds: several files of a target at once halve what it costs to build everything, but an edit then compiles
# eight or sixteen files. Therefore ./run and ./check use them and a preset by itself does not; there, too, each file shows
# whether it includes what it needs. Names in anonymous namespaces are unique in their target.
option(FILAMENT_UNITY "Compile the files of a target in batches: for those who build everything once" OFF)
if(FILAMENT_UNITY)
    # gcc takes a file of a batch for a header, whose classes must not have members of local types. It compiles a batch in a
    # tenth less time if it looks for unused memory from 1 GiB on instead of from 128 MiB.
    target_compile_options(filament_options INTERFACE
        $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage> $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
endif()

# Batches of sixteen save a quarter, where there are enough of them for every core: LARGE, for rooms and test programs.
function(filament_unity target)
    cmake_parse_arguments(ARG "LARGE" "" "" ${ARGN})
    if(FILAMENT_UNITY)
        get_target_property(sources ${target} SOURCES)
        list(LENGTH sources count)
        set(batch 8)
        if(ARG_LARGE AND count GREATER 24)
            set(batch 16)
        endif()
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    endif()
endfunction()

# What runs once or waits for a device: text of options, files of the tools, checks. -O1 compiles in two thirds of the time, and
# gives the same bits. Precompiled headers do not mind, if gcc from 13 on is told what -O2 sets besides.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13 AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    set(FILAMENT_AS_PRECOMPILED -munroll-only-small-loops -mvzeroupper)
endif()
function(filament_cold)
    foreach(target IN LISTS ARGN)
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> "$<$<CONFIG:Release>:${FILAMENT_AS_PRECOMPILED}>")
    endforeach()
endfunction()

# filament_core/scene -> scene, backend/vulkan -> backend_vulkan
function(filament_room_name folder result)
    string(REGEX REPLACE "^filament_core/" "" name ${folder})
    string(REPLACE "/" "_" name ${name})
    set(${result} ${name} PARENT_SCOPE)
endfunction()

# The files of a folder and of its SUBFOLDERS.
function(filament_glob result folder)
    cmake_parse_arguments(ARG "" "" "SUBFOLDERS" ${ARGN})
    set(patterns ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
    foreach(sub IN LISTS ARG_SUBFOLDERS)
        list(APPEND patterns ${CMAKE_SOURCE_DIR}/${folder}/${sub}/*.cpp)
    endforeach()
    file(GLOB sources CONFIGURE_DEPENDS ${patterns})
    set(${result} ${sources} PARENT_SCOPE)
endfunction()

function(filament_room folder)
    cmake_parse_arguments(ARG "" "" "SUBFOLDERS;LINK" ${ARGN})
    filament_room_name(${folder} name)
    filament_glob(sources ${folder} SUBFOLDERS ${ARG_SUBFOLDERS})
    if(sources)
        add_library(${name} STATIC ${sources})
        target_link_libraries(${name} PUBLIC filament_options ${ARG_LINK})
        filament_use_precompiled(${name} precompiled_rooms)
        filament_unity(${name} LARGE)
    else()
        add_library(${name} INTERFACE)
        target_link_libraries(${name} INTERFACE filament_options ${ARG_LINK})
    endif()
endfunction()

# Generates a C++ file with the bytes of FILES between symbols <prefix>_<i> and <prefix>_<i>_end, and returns in the
# variable `result` the lines of a table { "<name>", <prefix>_<i>, <prefix>_<i>_end }. NAMES are parallel to FILES.
function(filament_embed prefix)
    cmake_parse_arguments(ARG "" "DATA;TABLE" "FILES;NAMES" ${ARGN})
    set(data "")
    set(table "")
    set(index 0)
    foreach(file name IN ZIP_LISTS ARG_FILES ARG_NAMES)
        set(symbol ${prefix}_${index})
        string(APPEND data
            "asm(\".pushsection .rodata\\n.balign 16\\n.global ${symbol}, ${symbol}_end\\n.hidden ${symbol}, ${symbol}_end\\n\"\n"
            "    \"${symbol}: .incbin \\\"${file}\\\"\\n${symbol}_end: .byte 0\\n.popsection\\n\");\n"
            "extern \"C\" [[gnu::visibility(\"hidden\")]] const char ${symbol}[], ${symbol}_end[];\n")
        string(APPEND table "    { \"${name}\", ${symbol}, ${symbol}_end },\n")
        math(EXPR index "${index} + 1")
    endforeach()
    set(${ARG_DATA} "${data}" PARENT_SCOPE)
    set(${ARG_TABLE} "${table}" PARENT_SCOPE)
endfunction()

# A program of one folder or one file.
function(filament_program name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE filament_options ${ARG_LINK})
    filament_unity(${name})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endfunction()

# For programs that compile materials: glslang and SPIRV-Tools allocate so much that jemalloc's heap saves them 20 to 30 %
# of their time. Sanitizers bring a heap of their own.
function(filament_fast_heap)
    if(NOT FILAMENT_SANITIZE)
        foreach(program IN LISTS ARGN)
            target_link_libraries(${program} PRIVATE ${JEMALLOC_LIBRARY})
        endforeach()
    endif()
endfunction()

# The code of tests runs once, and most of it waits for a driver or a compiler: optimising it takes longer than it saves.
# OPTIMIZED programs compute for seconds in their own objects. Sanitizers make optimising slower still.
set(FILAMENT_TEST_OPTIONS $<$<CONFIG:Release>:-O0>)
if(FILAMENT_SANITIZE)
    set(FILAMENT_TEST_OPTIONS -O0)
endif()
set(FILAMENT_OPTIMIZED_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

# Mesa's CPU drivers compile a shader when it is first drawn: half the time of a test on a machine that knows none yet, half
# as much without LLVM's optimiser. The stored images are from optimised code, so each of them shows that both give
# the same bits.
set(FILAMENT_DEVICE_ENVIRONMENT GALLIVM_PERF=nopt)

# Kept in the build folder for all tests and later runs: compiled materials (toolkit/packages/PackageCache.h), and the shaders
# of Mesa's drivers.
set(FILAMENT_SHARED_WORK FILAMENT_PACKAGE_CACHE=${CMAKE_BINARY_DIR}/cache/packages
    MESA_SHADER_CACHE_DIR=${CMAKE_BINARY_DIR}/cache)

# One test program per mirrored folder: tests/<folder>/*.cpp. SHARDS n: ctest runs it n times, each with a part of its tests,
# so that no core waits for the longest program; <name>_shards lists them.
function(filament_tests folder)
    cmake_parse_arguments(ARG "GPU;OPTIMIZED" "SHARDS" "SUBFOLDERS;LINK" ${ARGN})
    string(REPLACE "/" "_" name ${folder})
    filament_glob(sources tests/${folder} SUBFOLDERS ${ARG_SUBFOLDERS})
    if(NOT sources)
        return()
    endif()
    filament_program(${name}_tests SOURCES ${sources} LINK ${ARG_LINK} tool_paths GTest::gmock GTest::gtest_main)
    filament_unity(${name}_tests LARGE)
    if(ARG_OPTIMIZED)
        target_compile_options(${name}_tests PRIVATE ${FILAMENT_OPTIMIZED_TEST_OPTIONS})
        filament_use_precompiled(${name}_tests precompiled_optimized_tests)
    else()
        target_compile_options(${name}_tests PRIVATE ${FILAMENT_TEST_OPTIONS})
        filament_use_precompiled(${name}_tests precompiled_tests)
    endif()
    set(label unit)
    set(environment "")
    if(ARG_GPU)
        set(label gpu)
        set(environment ${FILAMENT_DEVICE_ENVIRONMENT})
        if(FILAMENT_SANITIZE MATCHES address)
            target_sources(${name}_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests/KeepLibraries.cpp)
        endif()
    endif()
    if(NOT ARG_SHARDS)
        add_test(NAME ${name} COMMAND ${name}_tests)
        set_tests_properties(${name} PROPERTIES LABELS ${label} ENVIRONMENT "${environment}")
        return()
    endif()
    math(EXPR last "${ARG_SHARDS} - 1")
    set(shards "")
    foreach(shard RANGE ${last})
        list(APPEND shards ${name}_${shard})
        add_test(NAME ${name}_${shard} COMMAND ${name}_tests)
        set_tests_properties(${name}_${shard} PROPERTIES LABELS ${label}
            ENVIRONMENT "${environment};GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
    set(${name}_shards ${shards} PARENT_SCOPE)
endfunction()

# One Google Benchmark program per file: bench/<folder>/<Name>Bench.cpp.
function(filament_bench folder)
    cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
    string(REPLACE "/" "_" name ${folder})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/${folder}/*.cpp)
    if(sources)
        filament_program(${name}_bench SOURCES ${sources} LINK ${ARG_LINK} benchmark::benchmark_main)
    endif()
endfunction()
