# SPDX-License-Identifier: Apache-2.0
# What users get, by component:  cmake --install build/release --component NAME --prefix PREFIX
#   runtime      the shared library: what programs need to run
#   development  headers, archives, CMake and pkg-config files
#   jobsystem    the job system alone, usable without the others
#   tools        matc, matinfo, cmgen, filament-bake, imgdiff, filament-render, filament-view, filament-replay, filament-reference,
#                filament-server
#   python       the Python module, in the folder of Debian's packages (FILAMENT_PYTHON)
#   docs         licence, documentation, samples
# The target `uninstall` removes what this build folder installed last.
include(CMakePackageConfigHelpers)
set(FILAMENT_COMPONENTS development jobsystem tools docs)
if(BUILD_SHARED_LIBS)
    list(PREPEND FILAMENT_COMPONENTS runtime)
endif()
if(FILAMENT_PYTHON)
    list(APPEND FILAMENT_COMPONENTS python)
endif()
set(FILAMENT_TOOLS matc matinfo cmgen filament-bake imgdiff filament-render filament-view filament-replay filament-reference
    filament-server)
set(FILAMENT_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/filament_core)
set(templates ${CMAKE_SOURCE_DIR}/cmake)
set(generated ${CMAKE_BINARY_DIR}/package)

# ---- libraries
if(BUILD_SHARED_LIBS)
    install(TARGETS filament_core EXPORT filament_coreTargets
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
    install(EXPORT filament_coreTargets NAMESPACE filament_core:: DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT development)
endif()
install(TARGETS filament_core_static EXPORT filament_coreStaticTargets ARCHIVE COMPONENT development)
install(EXPORT filament_coreStaticTargets NAMESPACE filament_core:: DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT development)
install(TARGETS filament_jobsystem EXPORT filament_coreJobsystemTargets ARCHIVE COMPONENT jobsystem)
install(EXPORT filament_coreJobsystemTargets NAMESPACE filament_core:: DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT jobsystem)

# ---- headers. Those of the job system include each other as this tree's files do; they are in a folder of their own.
foreach(folder IN LISTS FILAMENT_PUBLIC_INCLUDES)
    install(DIRECTORY ${folder}/filament_core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h")
endforeach()
set(jobsystem_headers AffinityPolicy.h Atomics.h Cancellation.h Completion.h Job.h JobSystem.h JobSystem.inl JobTrace.h ParkingLot.h)
list(TRANSFORM jobsystem_headers PREPEND ${CMAKE_SOURCE_DIR}/jobsystem/)
set(jobsystem_include ${CMAKE_INSTALL_INCLUDEDIR}/filament_jobsystem)
install(FILES ${jobsystem_headers} DESTINATION ${jobsystem_include}/jobsystem COMPONENT jobsystem)
install(FILES ${CMAKE_SOURCE_DIR}/base/Assert.h DESTINATION ${jobsystem_include}/base COMPONENT jobsystem)
install(FILES ${CMAKE_SOURCE_DIR}/base/include/filament_core/Result.h ${CMAKE_SOURCE_DIR}/base/include/filament_core/Version.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/filament_core COMPONENT jobsystem)

# ---- find_package(): each of the two components can do without the other
configure_package_config_file(${templates}/filament_coreConfig.cmake.in ${generated}/filament_coreConfig.cmake
    INSTALL_DESTINATION ${FILAMENT_PACKAGE_DIR})
write_basic_package_version_file(${generated}/filament_coreConfigVersion.cmake COMPATIBILITY SameMinorVersion)
foreach(component development jobsystem)
    install(FILES ${generated}/filament_coreConfig.cmake ${generated}/filament_coreConfigVersion.cmake
        DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT ${component})
endforeach()
install(FILES ${templates}/filament_coreMaterials.cmake DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT development)

# ---- pkg-config: paths relative to the file, so that the prefix may be moved
cmake_path(SET pkgconfig_dir ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${pkgconfig_dir} OUTPUT_VARIABLE PC_PREFIX)
function(filament_pkgconfig component name)
    cmake_parse_arguments(ARG "" "DESCRIPTION;REQUIRES;LIBS;CFLAGS" "" ${ARGN})
    configure_file(${templates}/package.pc.in ${generated}/${name}.pc @ONLY)
    install(FILES ${generated}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()
set(static_requires "glm filament_jobsystem draco libpng libjpeg libavif libwebp zlib libzstd SPIRV-Tools")
set(static_libs "-lfilament_core_static -lmeshoptimizer -ldl") # meshoptimizer has no file for pkg-config
filament_pkgconfig(jobsystem filament_jobsystem DESCRIPTION "A work-stealing job system" REQUIRES "fmt hwloc"
    LIBS "-lfilament_jobsystem -pthread" CFLAGS "-I\${includedir}/filament_jobsystem")
filament_pkgconfig(development filament_core_static DESCRIPTION "${PROJECT_DESCRIPTION} (static)"
    REQUIRES "${static_requires}" LIBS "${static_libs}")
if(BUILD_SHARED_LIBS)
    filament_pkgconfig(development filament_core DESCRIPTION "${PROJECT_DESCRIPTION}" REQUIRES glm LIBS -lfilament_core)
    filament_pkgconfig(development filament_core_c DESCRIPTION "${PROJECT_DESCRIPTION} (C interface)" LIBS -lfilament_core_c)
else()
    filament_pkgconfig(development filament_core DESCRIPTION "${PROJECT_DESCRIPTION}" REQUIRES filament_core_static LIBS "")
endif()

# ---- tools
install(TARGETS ${FILAMENT_TOOLS} EXPORT filament_coreToolsTargets RUNTIME COMPONENT tools)
install(EXPORT filament_coreToolsTargets NAMESPACE filament_core:: DESTINATION ${FILAMENT_PACKAGE_DIR} COMPONENT tools)

# ---- the Python module: below the prefix where Debian's Python looks
if(FILAMENT_PYTHON)
    set(FILAMENT_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING "Where the Python module is installed")
    install(TARGETS python_module LIBRARY DESTINATION ${FILAMENT_PYTHON_INSTALL_DIR}/filament_core COMPONENT python)
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/filament_core DESTINATION ${FILAMENT_PYTHON_INSTALL_DIR} COMPONENT python
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

# ---- documents
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs ${CMAKE_SOURCE_DIR}/samples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs
    PATTERN "site" EXCLUDE # builds the site from a checkout
    PATTERN "accuracy.html" EXCLUDE) # made from its data, below
install(CODE "execute_process(COMMAND ${FILAMENT_PLOT_PYTHON} ${CMAKE_SOURCE_DIR}/tools/plot/plot.py accuracy-page
    ${CMAKE_SOURCE_DIR}/docs/accuracy -o ${CMAKE_BINARY_DIR}/accuracy.html COMMAND_ERROR_IS_FATAL ANY)" COMPONENT docs)
install(FILES ${CMAKE_BINARY_DIR}/accuracy.html DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT docs)

add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -D BUILD=${CMAKE_BINARY_DIR} -P ${templates}/Uninstall.cmake VERBATIM
    COMMENT "Removing what was installed")
