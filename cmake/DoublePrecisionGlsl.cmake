# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCES="a.glsl;b.glsl" -D TARGET_DIR=DIR -P DoublePrecisionGlsl.cmake
# Copies of the shader library for shaders/lib/LibCppDouble.h: `float` becomes double, literals lose the suffix f, and
# all.inl includes every copy. An unchanged copy keeps its time stamp, so that nothing is recompiled.

function(write_if_different path text)
    if(EXISTS ${path})
        file(READ ${path} old)
    endif()
    if(NOT EXISTS ${path} OR NOT "${old}" STREQUAL "${text}")
        file(WRITE ${path} "${text}")
    endif()
endfunction()

# math.glsl goes before all others (shaders/lib/README.md).
list(SORT SOURCES)
list(FILTER SOURCES EXCLUDE REGEX "/math\\.glsl$")
get_filename_component(first "${CMAKE_CURRENT_LIST_DIR}/../shaders/lib/math.glsl" ABSOLUTE)
list(PREPEND SOURCES ${first})

# The character before a literal, because 0x1e4fu contains none; and the literal, with a point, an exponent or both.
set(before "([^0-9A-Za-z_.])")
set(exponent "[eE][-+]?[0-9]+")
set(literal "([0-9]+\\.[0-9]*(${exponent})?|\\.[0-9]+(${exponent})?|[0-9]+${exponent})f")
set(includes "// Written by DoublePrecisionGlsl.cmake.\n")
foreach(source IN LISTS SOURCES)
    file(READ ${source} text)
    string(REGEX REPLACE "${before}${literal}" "\\1\\2" text "${text}")
    string(REGEX REPLACE "([^0-9A-Za-z_])float([^0-9A-Za-z_])" "\\1double\\2" text "${text}")
    get_filename_component(name ${source} NAME)
    write_if_different(${TARGET_DIR}/${name} "${text}")
    string(APPEND includes "#include \"generated/shaders/lib64/${name}\"\n")
endforeach()
write_if_different(${TARGET_DIR}/all.inl "${includes}")
