// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/EffectMaterialCache.h"

#include <algorithm>

namespace filament_core::engine {

scene::Material const& EffectMaterialCache::get(std::string_view name,
                                                std::span<const passes::EffectConstant> constants,
                                                passes::FullScreenInterface const& given) {
    const auto isSame = [](MaterialConstant const& a, passes::EffectConstant const& b) {
        return a.name == b.name && a.value == b.value;
    };
    const auto found = std::ranges::find_if(mEntries, [&](Entry const& entry) {
        return entry.name == name && std::ranges::equal(entry.constants, constants, isSame);
    });
    if (found != mEntries.end()) return *found->material;
    std::vector<MaterialConstant> owned;
    for (passes::EffectConstant const& constant : constants) {
        owned.push_back({ std::string(constant.name), constant.value });
    }
    scene::Material const& material = mEngine.fullScreenMaterial(name, owned, given);
    mEntries.push_back({ std::string(name), std::move(owned), &material });
    return material;
}

} // namespace filament_core::engine
