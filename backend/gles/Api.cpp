// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Api.h"

#include <string>

namespace filament_core::backend::gles {
namespace {

__eglMustCastToProperFunctionPointerType findSuffixed(Api::Lookup lookup, const char* name) {
    for (const char* suffix : { "", "OES", "EXT", "KHR" }) {
        if (auto* function = lookup((std::string(name) + suffix).c_str())) return function;
    }
    return nullptr;
}

} // namespace

const char* Api::load(Lookup lookup) {
#define X(name)                                                                                                        \
    name = reinterpret_cast<decltype(name)>(lookup("gl" #name));                                                       \
    if (!name) return "gl" #name;
    FILAMENT_GL_CORE_FUNCTIONS(X)
#undef X
#define X(name) name = reinterpret_cast<decltype(name)>(findSuffixed(lookup, "gl" #name));
    FILAMENT_GL_OPTIONAL_FUNCTIONS(X)
#undef X
#define X(name, type) name = reinterpret_cast<type>(findSuffixed(lookup, "gl" #name));
    FILAMENT_GL_EXTENSION_FUNCTIONS(X)
#undef X
    return nullptr;
}

} // namespace filament_core::backend::gles
