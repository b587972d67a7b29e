// SPDX-License-Identifier: Apache-2.0
/// Materials that are part of the library, for programs without .mat files. docs/built-in-materials.md shows them.
///   Names      lit, unlit, litTextured, unlitTextured, litVertexColors, vertexColors, shadowCatcher,
///              litShadowCatcher, wireframe, points.
///   Parameters linear colours without alpha; an instance starts with the values in brackets.
///                baseColor           float3  [1 1 1]  all but shadowCatcher; times the texture or the colour of the
///                                    vertex
///                baseColorMap        sampler2d        *Textured: sRGB, in a texture of RGBA8Srgb; its alpha is not
///                                    used
///                metallic            float   [0]      lit*, not litShadowCatcher: [0, 1]
///                roughness           float   [0.5]    lit*: perceptual, [0, 1]
///                reflectance         float   [0.5]    lit*: of what is not metal, [0, 1]; 0.5 reflects 4 %
///                emissive            float3  [0 0 0]  lit*, not litShadowCatcher: cd/m^2
///                shadowColor         float3  [0]      shadowCatcher: of the display, 1 is white
///                strength            float   [0.6]    shadowCatcher: what a full shadow hides, [0, 1]
///                lineWidth           float   [1]      wireframe: pixels, [0, 1024]
///                depthBias           float   [4]      wireframe: lines hide their surface up to this slope: 4 is 76
///                                    degrees
///                pointPixels         float   [4]      points: the least diameter, pixels, [0, 1024]
///                pointMeters         float   [0]      points: the diameter in the world, metres, [0, 1e6]
///                disc                bool    [true]   points: round; false: square
///              Without a map its texel is white. All are opaque but catchers of shadows, with their back culled
///              except for wireframe; what any instance can change (Engine::setCulling(), setDoubleSided(),
///              setStencil(), ...) these can, too.
///   Vertices   position; lit*: tangents; *Textured: uv0, (0, 0) is the lower left corner of the image; *ertexColors:
///              color; wireframe: what makeWireframe() and makeLineQuads() return; points: what makePointQuads()
///              returns. A Mesh has all but the last two.
///   Catchers   show a photograph of the ground behind them, with shadows. shadowCatcher: of the brightest sun, for
///              little; litShadowCatcher: of all lights and of occlusion, by the share of the light that they take from
///              a ground of its baseColor, roughness and reflectance; with screenSpaceReflections it mirrors what
///              stands on it. Colours are premultiplied by alpha: images can be composited.
///   Unlit      baseColor is what the target shows: neither lights nor the camera's exposure count.
///   Thread     the app thread of the engine.
#pragma once

#include <filament_core/Engine.h>

#include <span>
#include <string_view>

namespace filament_core {

struct BuiltInMaterial {
    std::string_view name, summary; ///< of one line
};

/// All of them, in the order above.
std::span<const BuiltInMaterial> builtInMaterials();

/// A material of the caller: destroy it like any other. Its bits are those of the engine's own arithmetic
/// (EngineOptions::exactShaders). Fails: NotFound with the nearest name and all names; OutOfMemory.
Result<Material> createBuiltInMaterial(Engine& engine, std::string_view name);

} // namespace filament_core
