// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Aov.h>

namespace filament_core {

std::span<const std::string_view> channelsOf(Aov aov) {
    static constexpr std::array<std::string_view, 1> kDepth{ "Z" }, kValue{ "Y" };
    static constexpr std::array<std::string_view, 2> kCoordinates{ "U", "V" }, kPlane{ "X", "Y" };
    static constexpr std::array<std::string_view, 3> kAxes{ "X", "Y", "Z" }, kColors{ "R", "G", "B" };
    switch (aov) {
    case Aov::None:
        return {};
    case Aov::Depth:
        return kDepth;
    case Aov::Position:
    case Aov::Normal:
    case Aov::GeometricNormal:
    case Aov::Tangent:
        return kAxes;
    case Aov::TextureCoordinates:
        return kCoordinates;
    case Aov::BaseColor:
    case Aov::Emissive:
        return kColors;
    case Aov::Roughness:
    case Aov::Metallic:
    case Aov::Occlusion:
    case Aov::ObjectId:
    case Aov::MaterialId:
    case Aov::MaterialInstanceId:
    case Aov::TriangleId:
    case Aov::Coverage:
        return kValue;
    case Aov::Motion:
        return kPlane;
    }
    return {};
}

} // namespace filament_core
