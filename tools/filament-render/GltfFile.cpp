// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/GltfFile.h"

#include "toolkit/program/Console.h"

#include <filament_core/SaveGltf.h>

#include <cstdio>

namespace filament_core::tools {

Result<void> saveGltfFile(Options const& options, Backend backend, Scene const& scene, Camera const& camera,
                          std::string const& environment) {
    if (options.saveGltf.empty() || backend != options.backends.front()) return {};
    const GltfSaveOptions how{ .cameras = { { "view", camera } }, .environment = environment };
    const Result<SavedGltf> saved = saveGltf(scene, options.saveGltf, how);
    if (!saved) return saved.error();
    clearProgress();
    for (std::string const& warning : saved->warnings) printWarning(warning);
    std::printf("saved   %s: %llu bytes\n", options.saveGltf.c_str(), static_cast<unsigned long long>(saved->bytes));
    return {};
}

} // namespace filament_core::tools
