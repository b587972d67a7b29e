// SPDX-License-Identifier: Apache-2.0
#include "backend/api/Driver.h"

namespace filament_core::backend {

const char* toString(BackendType type) {
    switch (type) {
    case BackendType::Null:
        return "null";
    case BackendType::Vulkan:
        return "Vulkan";
    case BackendType::Gles:
        return "OpenGL ES";
    }
    return "unknown";
}

} // namespace filament_core::backend
