// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Version.h>

#define FILAMENT_TEXT_OF(number) #number
#define FILAMENT_DOTTED(major, minor, patch)                                                                           \
    FILAMENT_TEXT_OF(major) "." FILAMENT_TEXT_OF(minor) "." FILAMENT_TEXT_OF(patch)

namespace filament_core {

Version version() { return kHeaderVersion; }

const char* versionText() {
    return FILAMENT_DOTTED(FILAMENT_CORE_VERSION_MAJOR, FILAMENT_CORE_VERSION_MINOR, FILAMENT_CORE_VERSION_PATCH);
}

} // namespace filament_core
