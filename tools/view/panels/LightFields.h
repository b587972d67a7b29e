// SPDX-License-Identifier: Apache-2.0
/// LightFields: the fields of a light of any kind as rows, and lights of a Document that are added, copied and removed.
///   Thread  any; values. Pointers are valid while the light lives and keeps its kind.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Camera.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace filament_core::view {

enum class LightFieldKind : uint8_t {
    Number,
    Switch,
    Color,
    Place,     ///< metres
    Direction, ///< any length but zero
    Channels,
};

struct LightField {
    std::string_view name{}; ///< "intensity, cd"
    LightFieldKind kind = LightFieldKind::Number;
    std::variant<float*, double3*, float3*, bool*, LightChannels*> value{};
    float least = 0, most = 0;  ///< of a number
    bool isLogarithmic = false; ///< of a number that spans decades
};

/// In the order of the members. Profiles, which are files, are not among them.
std::vector<LightField> lightFields(LightDesc& light);

/// "sun", "point", "spot", "rectangle", "disc", "tube"; the index of LightDesc.
std::string_view lightKindName(size_t kind);
inline constexpr size_t kLightKinds = std::variant_size_v<LightDesc>;

/// A new light of this kind one metre before the camera, shining where the camera looks; its name is not taken yet.
DocumentLight& addLight(Document& document, size_t kind, Camera const& camera);
void removeLight(Document& document, size_t light);
DocumentLight& copyLight(Document& document, size_t light);
/// Another kind of light in its place, with what both kinds have: place, direction, colour, range, shadows, channels.
LightDesc withKind(LightDesc const& light, size_t kind);

} // namespace filament_core::view
