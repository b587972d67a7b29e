// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/AovFiles.h"

#include <filament_core/RenderAovs.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace filament_core::tools {

Result<void> saveAovs(Options const& options, BackendRun const& run) {
    if (run.aovs.empty()) return {};
    std::vector<ExrLayer> layers;
    for (size_t i = 0; i < run.aovs.size(); ++i) layers.push_back(layerOf(options.aovs[i], run.aovs[i]));
    return saveExr(options.out / fmt::format("{}.aovs.exr", fileStem(run.backend)), layers);
}

AovComparison compareAovs(Options const& options, BackendRun const& a, BackendRun const& b) {
    if (a.aovs.empty()) return {};
    std::vector<const char*> different;
    for (size_t i = 0; i < a.aovs.size(); ++i)
        if (a.aovs[i].pixels != b.aovs[i].pixels) different.push_back(toString(options.aovs[i]));
    if (different.empty()) return { true, fmt::format("{} AOVs have the same bits", a.aovs.size()) };
    return { false, fmt::format("AOVs that differ between the APIs: {}", fmt::join(different, ", ")) };
}

} // namespace filament_core::tools
