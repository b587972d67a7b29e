# SPDX-License-Identifier: Apache-2.0
# Configures, builds and runs the consumers against what InstallPackage.cmake installed, by every route: find_package() for the
# shared and the static library, with materials, and for the job system alone; pkg-config for each of the three.
#   cmake -D WORK=<scratch folder> -D COMPILER=<g++|clang++> -D LIBDIR=<lib> -P RunConsumer.cmake
cmake_minimum_required(VERSION 3.25)
set(work ${WORK}/${COMPILER})

function(run_step)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "'${command}' ended with ${status}:\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(build source prefix)
    set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
    run_step(${CMAKE_COMMAND} -S ${source} -B ${source}/build -G Ninja -D CMAKE_BUILD_TYPE=Release
        -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
    run_step(${CMAKE_COMMAND} --build ${source}/build)
endfunction()

# A copy: programs outside of this tree, whose files may be changed below.
file(REMOVE_RECURSE ${work})
file(COPY ${CMAKE_CURRENT_LIST_DIR}/ DESTINATION ${work})
build(${work} ${WORK}/all)
build(${work}/jobs ${WORK}/jobs)
set(ENV{LD_LIBRARY_PATH} ${WORK}/all/${LIBDIR}) # pkg-config sets no RPATH
foreach(program build/c_program build/c_program_pkgconfig build/shared build/static build/scene build/aovs build/point_cloud
        build/pkgconfig_filament_core build/pkgconfig_filament_core_static
        jobs/build/jobs jobs/build/jobs_pkgconfig)
    run_step(${work}/${program})
    message(STATUS "${program}: ${output}")
endforeach()

# A change of an included file compiles the material and its programs again, and nothing else.
run_step(${CMAKE_COMMAND} --build ${work}/build)
if(NOT output MATCHES "no work to do")
    message(FATAL_ERROR "the second build of the consumer did something:\n${output}")
endif()
file(APPEND ${work}/stone.glsl "// changed\n")
run_step(${CMAKE_COMMAND} --build ${work}/build)
if(NOT output MATCHES "Compiling material stone" OR output MATCHES "main.cpp.o" OR NOT output MATCHES "Linking CXX executable shared")
    message(FATAL_ERROR "after a change of stone.glsl the consumer was built like this:\n${output}")
endif()
