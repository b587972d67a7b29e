// SPDX-License-Identifier: Apache-2.0
/// EffectMaterials: where a pass gets the engine's full-screen materials from, by the name of the file in shaders/post.
///   In      the name, the values of all constants that the pass sets, always in the same order, and what the pass
///           gives the material, which is checked when the material is made.
///   Out     the material. It lives as long as the engine.
///   Thread  the app thread, while passes are declared.
///   Memory  made at the first use. Finding one that was made allocates nothing.
///   Fails   std::bad_alloc. A material that is unknown or does not fit its pass is a defect of the engine and asserts.
#pragma once

#include "filament_core/passes/FullScreenInterface.h"
#include "filament_core/scene/Materials.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

namespace filament_core::passes {

struct EffectConstant {
    std::string_view name;
    std::variant<bool, int32_t, float> value;
};

class EffectMaterials {
public:
    virtual scene::Material const& get(std::string_view name, std::span<const EffectConstant> constants,
                                       FullScreenInterface const& given) = 0;

protected:
    ~EffectMaterials() = default;
};

} // namespace filament_core::passes
