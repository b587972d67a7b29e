# SPDX-License-Identifier: Apache-2.0
# Debian's packages as targets; scripts/packages.txt is the list that ./run and ./check install.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(Vulkan REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED) # libjpeg-turbo
find_package(ZLIB REQUIRED)
find_package(glslang REQUIRED)
find_package(SPIRV-Tools REQUIRED)
find_package(SPIRV-Tools-opt REQUIRED)
find_package(spirv_cross_core REQUIRED HINTS /usr/share/spirv_cross_core/cmake)
find_package(spirv_cross_glsl REQUIRED HINTS /usr/share/spirv_cross_glsl/cmake)
find_package(nlohmann_json REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWLOC REQUIRED IMPORTED_TARGET hwloc)
pkg_check_modules(AVIF REQUIRED IMPORTED_TARGET libavif)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)

add_library(hwloc ALIAS PkgConfig::HWLOC)

# moodycamel's queue is header-only.
find_path(CONCURRENTQUEUE_INCLUDE concurrentqueue.h PATH_SUFFIXES concurrentqueue/moodycamel concurrentqueue moodycamel REQUIRED)
add_library(concurrentqueue INTERFACE)
target_include_directories(concurrentqueue SYSTEM INTERFACE ${CONCURRENTQUEUE_INCLUDE})

# Vulkan is loaded at run time instead of linked, so that OpenGL ES also runs on a machine without a Vulkan loader.
add_library(volk INTERFACE)
target_include_directories(volk SYSTEM INTERFACE ${Vulkan_INCLUDE_DIRS})
target_compile_definitions(volk INTERFACE VK_NO_PROTOTYPES)
target_link_libraries(volk INTERFACE ${CMAKE_DL_LIBS})

# OpenGL ES likewise: headers only, libEGL.so.1 is opened at run time.
find_path(EGL_INCLUDE EGL/egl.h REQUIRED)
find_path(GLES_INCLUDE GLES3/gl32.h REQUIRED)
add_library(egl INTERFACE)
target_include_directories(egl SYSTEM INTERFACE ${EGL_INCLUDE} ${GLES_INCLUDE})
target_compile_definitions(egl INTERFACE EGL_NO_X11)
target_link_libraries(egl INTERFACE ${CMAKE_DL_LIBS})

# GLSL -> SPIR-V -> optimised -> ESSL
add_library(shader_tools INTERFACE)
target_link_libraries(shader_tools INTERFACE
    glslang::glslang glslang::SPIRV glslang::glslang-default-resource-limits SPIRV-Tools-opt
    spirv-cross-glsl spirv-cross-core)

# Checks packages that are not part of the program.
add_library(spirv_validator INTERFACE)
target_link_libraries(spirv_validator INTERFACE SPIRV-Tools-static)

# Without the definition that its package adds to the compiler's commands of everything that links it.
add_library(meshoptimizer INTERFACE)
target_include_directories(meshoptimizer SYSTEM INTERFACE
    $<TARGET_PROPERTY:meshoptimizer::meshoptimizer,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(meshoptimizer INTERFACE $<LINK_ONLY:meshoptimizer::meshoptimizer>)

add_library(asset_codecs INTERFACE)
target_link_libraries(asset_codecs INTERFACE
    nlohmann_json::nlohmann_json draco::draco meshoptimizer PNG::PNG JPEG::JPEG ZLIB::ZLIB
    PkgConfig::AVIF PkgConfig::WEBP PkgConfig::ZSTD)

# filament-server's HTTP.
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
add_library(cpp_httplib ALIAS PkgConfig::HTTPLIB)

# The reference renderer's ray tracer, version 4 or 3. Its CMake package requires TBB's headers, which are not needed here.
find_path(EMBREE_HEADERS rtcore.h PATH_SUFFIXES embree4 embree3 REQUIRED)
find_library(EMBREE_LIBRARY NAMES embree4 embree3 REQUIRED)
add_library(embree INTERFACE)
target_include_directories(embree SYSTEM INTERFACE ${EMBREE_HEADERS})
target_link_libraries(embree INTERFACE ${EMBREE_LIBRARY})

find_library(JEMALLOC_LIBRARY jemalloc REQUIRED) # filament_fast_heap()
find_package(CLI11 REQUIRED)
if(FILAMENT_BUILD_TESTS)
    find_package(GTest REQUIRED)
endif()
if(FILAMENT_BUILD_BENCHES)
    find_package(benchmark REQUIRED)
    find_package(TBB REQUIRED) # these two: for the comparison in bench/threading
    find_package(OpenMP REQUIRED COMPONENTS CXX)
    # and these two, if they are found; OFF leaves one out
    find_path(EIGEN_THREADS_HEADERS unsupported/Eigen/CXX11/ThreadPool PATH_SUFFIXES eigen3)
    find_path(BOOST_ASIO_HEADERS boost/asio/io_context.hpp)
endif()

# tools/plot runs under Debian's Python, which python3-matplotlib belongs to, even if another one comes first in PATH.
find_program(FILAMENT_PLOT_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(FILAMENT_PLOT_PYTHON python3)
