// SPDX-License-Identifier: Apache-2.0
/// Aov: arbitrary output variables. Numbers of the surfaces that a view shows, in the place of its light: for
/// compositing, denoising, machine learning and tests. docs/aovs.md.
///   Target  a render target of RGBA32F, which has View::size; Renderer::renderAovs() makes one. Each pixel has the
///           values of the surface at its centre, from the code of its material: not filtered, whatever View::samples
///           is, except Coverage. Masked surfaces have their holes.
///   Alpha   1 where there is a value; 0.5 where the surface's material has none of this kind (an unlit material has no
///           roughness); 0 where no surface is. The other channels are 0 where there is no value.
///   Layers  transparent surfaces hide those behind them, except from Depth, Position and Motion, which do not see
///           them, and from Coverage, which sees all.
///   Ids     whole numbers from 1 on, exact up to 2^24; objectOf() and its like in RenderAovs.h find what they name.
///   Cost    a frame that draws the surfaces once, without light, shadows, sky or effects. Frames without it: none.
///   Thread  any; plain values.
#pragma once

#include <filament_core/EnumNames.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core {

enum class Aov : uint8_t {
    None,
    Depth,              ///< red: metres along the view, from the camera
    Position,           ///< rgb: metres from the camera, along the axes of the world; Camera has its own in doubles
    Normal,             ///< rgb: of shading, after normal maps, in the world; unit
    GeometricNormal,    ///< rgb: interpolated from the vertices, in the world, towards the camera on both sides; unit
    Tangent,            ///< rgb: the first axis of the tangent frame, in the world; unit. Of materials that use it
    TextureCoordinates, ///< rg: as the material's first ones
    BaseColor,          ///< rgb: linear Rec. 709, [0, 1]; pre-multiplied by alpha where the material blends
    Roughness,          ///< red: perceptual, [0, 1]
    Metallic,           ///< red: [0, 1]
    Occlusion,          ///< red: the material's own, [0, 1]
    Emissive,           ///< rgb: pre-exposed light
    ObjectId,           ///< red: 1 + Renderable::index(); each copy of Scene::addInstances() is an object
    MaterialId,         ///< red: the material's place among those of the scene, from 1 on
    MaterialInstanceId, ///< red: the instance's place among those of the scene, from 1 on: what files call a material
    TriangleId,         ///< red: the triangle's place in the indices that are drawn, or a line's or point's, from 0 on
    Motion,             ///< rg: pixels to the right and down since the renderer's last frame of this; 0 in its first
    Coverage, ///< red: share of the pixel that surfaces cover, [0, 1]: of its View::samples; by alpha if blended
};
template <>
struct EnumNames<Aov> {
    static constexpr std::array<std::string_view, 18> values{ "none",
                                                              "depth",
                                                              "position",
                                                              "normal",
                                                              "geometricNormal",
                                                              "tangent",
                                                              "textureCoordinates",
                                                              "baseColor",
                                                              "roughness",
                                                              "metallic",
                                                              "occlusion",
                                                              "emissive",
                                                              "objectId",
                                                              "materialId",
                                                              "materialInstanceId",
                                                              "triangleId",
                                                              "motion",
                                                              "coverage" };
};
inline constexpr size_t kAovCount = EnumNames<Aov>::values.size();

/// Names of the channels that have values, in the order red, green, blue, as other programs name them in OpenEXR files:
/// "Z", or "R", "G", "B", or "X", "Y", "Z", or "U", "V". Empty for None.
std::span<const std::string_view> channelsOf(Aov aov);

} // namespace filament_core
