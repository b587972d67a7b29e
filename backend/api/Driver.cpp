// SPDX-License-Identifier: Apache-2.0
#include "backend/api/Driver.h"

namespace filament_core::backend {

const char* apiName(Backend backend) {
    switch (backend) {
    case Backend::Vulkan:
        return "Vulkan";
    case Backend::Gles:
        return "OpenGL ES";
    case Backend::Null:
        return "null";
    }
    return "unknown";
}

} // namespace filament_core::backend
