// SPDX-License-Identifier: Apache-2.0
/// EffectMaterialCache: the full-screen materials that a renderer's passes have used (passes/EffectMaterials.h).
///   In      names of shaders/post and constants.   Out: materials of the engine, which renderers share.
///   Thread  the app thread.   Memory: an entry for each material and set of constants.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/passes/EffectMaterials.h"

#include <vector>

namespace filament_core::engine {

class EffectMaterialCache final : public passes::EffectMaterials {
public:
    explicit EffectMaterialCache(Engine::Impl& engine) : mEngine(engine) {}

    scene::Material const& get(std::string_view name, std::span<const passes::EffectConstant> constants,
                               passes::FullScreenInterface const& given) override;

private:
    struct Entry {
        std::string name;
        std::vector<MaterialConstant> constants;
        scene::Material const* material;
    };

    Engine::Impl& mEngine;
    std::vector<Entry> mEntries;
};

} // namespace filament_core::engine
