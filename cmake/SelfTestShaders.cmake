# SPDX-License-Identifier: Apache-2.0
# The shaders of the drivers' self-test: the text is ESSL as it is, and glslang makes SPIR-V of it.
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED)
file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/backend/create/self_test/*)
set(names "")
set(spirv_files "")
set(spirv_names "")
foreach(file IN LISTS files)
    cmake_path(GET file FILENAME name)
    set(spirv ${CMAKE_BINARY_DIR}/generated/self_test/${name}.spv)
    add_custom_command(OUTPUT ${spirv}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/generated/self_test
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V ${file} -o ${spirv}
        DEPENDS ${file}
        COMMENT "Compiling ${name} of the self-test" VERBATIM)
    list(APPEND names ${name})
    list(APPEND spirv_files ${spirv})
    list(APPEND spirv_names ${name}.spv)
endforeach()
filament_embed(filament_self_test DATA SELF_TEST_DATA TABLE SELF_TEST_TABLE FILES ${files} ${spirv_files}
    NAMES ${names} ${spirv_names})
set(self_test_cpp ${CMAKE_BINARY_DIR}/generated/self_test/SelfTestShaders.cpp)
configure_file(${CMAKE_SOURCE_DIR}/backend/create/SelfTestShaders.cpp.in ${self_test_cpp} @ONLY)
target_sources(backend_create PRIVATE ${self_test_cpp})
# alone: a unity build forgets what its sources depend on
set_source_files_properties(${self_test_cpp} PROPERTIES
    OBJECT_DEPENDS "${files};${spirv_files}" SKIP_UNITY_BUILD_INCLUSION ON)
