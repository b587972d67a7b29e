# SPDX-License-Identifier: Apache-2.0
# Installs a build into prefixes of the consumers: WORK/all has every component, WORK/jobs only the job system. Keeps the
# manifests of earlier installations of that build folder for its target `uninstall`.
#   cmake -D BUILD=<build tree> -D WORK=<scratch folder> -D COMPONENTS=<list> -P InstallPackage.cmake
cmake_minimum_required(VERSION 3.25)

function(install_component component prefix)
    set(manifest ${BUILD}/install_manifest_${component}.txt)
    if(EXISTS ${manifest})
        file(RENAME ${manifest} ${manifest}.kept)
    endif()
    execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${prefix} --strip
        OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
    file(RENAME ${manifest} ${prefix}/${component}.manifest)
    if(EXISTS ${manifest}.kept)
        file(RENAME ${manifest}.kept ${manifest})
    endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/all ${WORK}/jobs)
foreach(component IN LISTS COMPONENTS)
    install_component(${component} ${WORK}/all)
endforeach()
install_component(jobsystem ${WORK}/jobs)
