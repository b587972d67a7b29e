# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ file with a hash of the program COMPILER: whatever is linked into it, the engine's GLSL and glslang
# among it, changes the hash.
file(SHA256 ${COMPILER} hash)
file(WRITE ${OUTPUT} "// Written by cmake/WriteCompilerIdentity.cmake.
#include \"toolkit/packages/PackageCache.h\"

namespace filament_core::tools {

std::string_view compilerIdentity() { return \"${hash}\"; }

} // namespace filament_core::tools
")
