# SPDX-License-Identifier: Apache-2.0
# filament_add_materials(TARGET FILES stone.mat ... [OPTIONS ...])
#   Compiles materials with matc and puts them into a target. For stone.mat, `#include <materials/stone.h>` declares
#   materials::stone(), the bytes of the package: `engine.create(MaterialDesc{ .package = materials::stone() })`.
#   The package itself is <binary folder>/<TARGET>_materials/stone.fmat. It is compiled again when stone.mat or a file that it
#   includes changes (Ninja and Makefiles).
#   FILES    relative to the current source folder; names must differ
#   OPTIONS  more options for matc, such as --api vulkan; `matc --help` lists them
#   FILAMENT_MATC  a variable: the matc to use instead of the installed one, as when cross-compiling
cmake_minimum_required(VERSION 3.25)

function(filament_add_materials target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "FILES;OPTIONS")
    if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_FILES)
        message(FATAL_ERROR "filament_add_materials: write filament_add_materials(${target} FILES a.mat b.mat [OPTIONS ...])")
    endif()
    if(NOT TARGET ${target})
        message(FATAL_ERROR "filament_add_materials: there is no target '${target}': add it first")
    endif()
    if(FILAMENT_MATC)
        set(matc ${FILAMENT_MATC})
    elseif(TARGET filament_core::matc)
        set(matc filament_core::matc)
    else()
        message(FATAL_ERROR "filament_add_materials: there is no matc: install filament_core's component 'tools' "
            "(filament-core-tools of Debian), or set FILAMENT_MATC to the program")
    endif()
    foreach(file IN LISTS ARG_FILES)
        filament_add_material_(${target} "${matc}" ${file} "${ARG_OPTIONS}")
    endforeach()
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${target}_materials)
    target_compile_features(${target} PRIVATE cxx_std_20)
endfunction()

function(filament_add_material_ target matc file options)
    cmake_path(ABSOLUTE_PATH file NORMALIZE OUTPUT_VARIABLE source)
    if(NOT EXISTS ${source})
        message(FATAL_ERROR "filament_add_materials: there is no ${source}")
    endif()
    cmake_path(GET file STEM LAST_ONLY name)
    string(MAKE_C_IDENTIFIER ${name} function)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_materials)
    set(package ${folder}/${name}.fmat)
    get_property(known TARGET ${target} PROPERTY filament_materials)
    if(function IN_LIST known)
        message(FATAL_ERROR "filament_add_materials: '${target}' already has a material '${function}': rename ${source}")
    endif()
    set_property(TARGET ${target} APPEND PROPERTY filament_materials ${function})

    add_custom_command(OUTPUT ${package}
        COMMAND ${matc} --api all -MD -MF ${package}.d ${options} -o ${package} ${source}
        DEPENDS ${matc} ${source} DEPFILE ${package}.d
        COMMENT "Compiling material ${name}" VERBATIM)
    file(CONFIGURE OUTPUT ${folder}/materials/${name}.h @ONLY CONTENT [[
// Written by filament_add_materials().
#pragma once

#include <cstddef>
#include <span>

namespace materials {

/// The package of @name@.mat, for MaterialDesc::package. Lives as long as the program.
std::span<const std::byte> @function@();

} // namespace materials
]])
    file(CONFIGURE OUTPUT ${folder}/${name}.cpp @ONLY CONTENT [=[
// Written by filament_add_materials().
#include "materials/@name@.h"

asm(".pushsection .rodata\n.balign 16\n"
    ".hidden materials_@function@_begin, materials_@function@_end\n"
    ".global materials_@function@_begin, materials_@function@_end\n"
    "materials_@function@_begin: .incbin \"@package@\"\nmaterials_@function@_end: .byte 0\n.popsection\n");
extern "C" [[gnu::visibility("hidden")]] const std::byte materials_@function@_begin[], materials_@function@_end[];

std::span<const std::byte> materials::@function@() {
    return { materials_@function@_begin, materials_@function@_end };
}
]=])
    set_source_files_properties(${folder}/${name}.cpp PROPERTIES
        OBJECT_DEPENDS ${package} SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${folder}/${name}.cpp)
endfunction()
