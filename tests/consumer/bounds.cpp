// SPDX-License-Identifier: Apache-2.0
// The bounds of an empty scene, for the pkg-config routes: what they must get right is flags and libraries.
#include <filament_core/Engine.h>
#include <filament_core/Scene.h>
#include <filament_core/Version.h>

#include <cstdio>

int main() {
    using namespace filament_core;
    Result<Engine> engine = Engine::create({ .backend = Backend::Null });
    if (!engine) return std::fprintf(stderr, "%s\n", engine.error().message.c_str()), 1;
    const Scene scene(*engine);
    std::printf("bounds: filament_core %s, %u lights\n", versionText(), scene.lightCount());
    return version() == kHeaderVersion && scene.lightCount() == 0 ? 0 : 1;
}
