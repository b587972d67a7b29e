# SPDX-License-Identifier: Apache-2.0
# What InstallPackage.cmake installed is gone after uninstalling, and nothing else is.
#   cmake -D WORK=<scratch folder> -D COMPONENTS=<list> -D UNINSTALL=<Uninstall.cmake> -P UninstallPackage.cmake
cmake_minimum_required(VERSION 3.25)
file(WRITE ${WORK}/all/include/filament_core/mine.h "// not installed by us\n")
foreach(component IN LISTS COMPONENTS)
    execute_process(COMMAND ${CMAKE_COMMAND} -D MANIFEST=${WORK}/all/${component}.manifest -P ${UNINSTALL}
        COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB_RECURSE left LIST_DIRECTORIES false ${WORK}/all/*)
if(NOT left STREQUAL "${WORK}/all/include/filament_core/mine.h")
    message(FATAL_ERROR "left after uninstalling, besides the file of someone else: ${left}")
endif()
if(EXISTS ${WORK}/all/include/filament_jobsystem OR EXISTS ${WORK}/all/share/doc/filament_core)
    message(FATAL_ERROR "empty folders of ours are left in ${WORK}/all")
endif()
file(REMOVE_RECURSE ${WORK}/all ${WORK}/jobs)
