# SPDX-License-Identifier: Apache-2.0
# Debian packages, one for each installed component (Install.cmake): scripts/package makes them.
set(FILAMENT_PACKAGE_CONTACT "" CACHE STRING "Maintainer of the packages, 'Name <address>'; scripts/package takes yours")
set(soname_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME filament-core)
set(CPACK_PACKAGE_CONTACT "${FILAMENT_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${FILAMENT_COMPONENTS})
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/DebianFiles.cmake)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON) # of the package that has a library
set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# filament_package(COMPONENT NAME SECTION [DEPENDS ...] ... SUMMARY text TEXT text)
macro(filament_package component name section)
    cmake_parse_arguments(ARG "SHLIBDEPS" "SUMMARY;TEXT" "DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
    string(TOUPPER ${component} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ${ARG_SHLIBDEPS})
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${ARG_SUMMARY}\n${ARG_TEXT}")
    foreach(relation DEPENDS RECOMMENDS SUGGESTS)
        list(JOIN ARG_${relation} ", " CPACK_DEBIAN_${upper}_PACKAGE_${relation})
    endforeach()
endmacro()

# Lines of descriptions have at most 79 characters.
set(about "filament_core draws glTF models and scenes that programs make, with physically
based materials and lights. The same frame has the same bits on Vulkan and on
OpenGL ES. It needs no window and no graphics card.")
set(drivers "libvulkan1, mesa-vulkan-drivers | vulkan-icd, libegl1, libgles2, libgl1-mesa-dri") # opened at run time
filament_package(runtime libfilament-core${soname_version} libs SHLIBDEPS RECOMMENDS "${drivers}"
    SUMMARY "Physically based renderer for Vulkan and OpenGL ES - library" TEXT "${about}")
file(WRITE ${CMAKE_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_BINARY_DIR}/package/triggers)
filament_package(development libfilament-core-dev libdevel
    DEPENDS "libfilament-core${soname_version} ${same_version}" "libfilament-jobsystem-dev ${same_version}" libglm-dev
    RECOMMENDS "filament-core-tools ${same_version}"
    SUGGESTS libfilament-core-doc libavif-dev libdraco-dev libjpeg62-turbo-dev libmeshoptimizer-dev libpng-dev
        libwebp-dev libzstd-dev spirv-tools zlib1g-dev
    SUMMARY "Physically based renderer for Vulkan and OpenGL ES - development"
    TEXT "${about}
.
Headers and archives. Programs that link the archive also need the suggested
packages.")
filament_package(jobsystem libfilament-jobsystem-dev libdevel DEPENDS libc6-dev libfmt-dev libhwloc-dev
    SUMMARY "Work-stealing job system - development"
    TEXT "Runs small pieces of work on all cores: fork-join groups, continuations,
parallel loops, and long work on separate threads. It knows nothing about
graphics.")
filament_package(tools filament-core-tools graphics SHLIBDEPS RECOMMENDS "${drivers}"
    SUMMARY "Physically based renderer for Vulkan and OpenGL ES - programs"
    TEXT "${about}
.
Compiles materials (matc, matinfo), bakes environments (cmgen) and light (filament-bake), draws models
(filament-render), shows them in a window (filament-view), draws for other
programs over HTTP (filament-server), draws saved frames again
(filament-replay), traces the true picture of models (filament-reference), and
compares pictures (imgdiff).")
if(FILAMENT_PYTHON)
    math(EXPR next_minor "${Python_VERSION_MINOR} + 1") # the extension is of one version of Python
    filament_package(python python3-filament-core python SHLIBDEPS RECOMMENDS "${drivers}" SUGGESTS python3-matplotlib
        DEPENDS "python3 (>= 3.${Python_VERSION_MINOR})" "python3 (<< 3.${next_minor})" "python3-numpy (>= 1:1.22)"
        SUMMARY "Physically based renderer for Vulkan and OpenGL ES - Python 3"
        TEXT "${about}
.
The module filament_core: pictures as NumPy arrays, comparisons of pictures
with FLIP, and the reports of the conformance and accuracy programs.")
    # what dh_python3 writes: byte code is made when the package is installed, and does not outlive it
    file(WRITE ${CMAKE_BINARY_DIR}/package/python/postinst
        "#!/bin/sh\nset -e\nif command -v py3compile >/dev/null 2>&1; then\n\tpy3compile -p python3-filament-core\nfi\n")
    file(WRITE ${CMAKE_BINARY_DIR}/package/python/prerm
        "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null 2>&1; then\n\tpy3clean -p python3-filament-core\nfi\n")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
        ${CMAKE_BINARY_DIR}/package/python/postinst ${CMAKE_BINARY_DIR}/package/python/prerm)
endif()
filament_package(docs libfilament-core-doc doc
    SUMMARY "Physically based renderer for Vulkan and OpenGL ES - documents"
    TEXT "${about}
.
Documentation and samples.")
set(CPACK_DEBIAN_DOCS_PACKAGE_ARCHITECTURE all)
include(CPack)
