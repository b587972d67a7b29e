// SPDX-License-Identifier: Apache-2.0
/// Version: which release of filament_core this is; CMake reads the numbers here.
///   Compare the headers that a program was compiled with (kHeaderVersion) with the library that it runs with
///   (version()). While the major number is 0, releases with another minor number may break programs, and the library's
///   file has another name; a patch breaks nothing.
///   Thread  any.   Fails: never.
#pragma once

#include <compare>
#include <cstdint>

#define FILAMENT_CORE_VERSION_MAJOR 0
#define FILAMENT_CORE_VERSION_MINOR 1
#define FILAMENT_CORE_VERSION_PATCH 0

/// For #if: `FILAMENT_CORE_VERSION >= FILAMENT_CORE_MAKE_VERSION(0, 2, 0)`. Each number is below 1000.
#define FILAMENT_CORE_MAKE_VERSION(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))
#define FILAMENT_CORE_VERSION                                                                                          \
    FILAMENT_CORE_MAKE_VERSION(FILAMENT_CORE_VERSION_MAJOR, FILAMENT_CORE_VERSION_MINOR, FILAMENT_CORE_VERSION_PATCH)

namespace filament_core {

struct Version {
    uint32_t majorNumber = 0;
    uint32_t minorNumber = 0;
    uint32_t patchNumber = 0;
    friend auto operator<=>(Version const&, Version const&) = default;
};

/// That of the headers.
inline constexpr Version kHeaderVersion{ FILAMENT_CORE_VERSION_MAJOR, FILAMENT_CORE_VERSION_MINOR,
                                         FILAMENT_CORE_VERSION_PATCH };

/// That of the library.
Version version();

/// The library's as text: "0.1.0".
const char* versionText();

} // namespace filament_core
