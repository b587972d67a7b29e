// SPDX-License-Identifier: Apache-2.0
/// SamplerBudget: how many textures a fragment stage can sample, and how they are divided.
///   Every device has 16: the minimum of GL_MAX_TEXTURE_IMAGE_UNITS in OpenGL ES 3.1 and of
///   maxPerStageDescriptorSamplers in Vulkan. Vulkan counts the textures of a program's layout, read or not.
///
///     material            its own   of the engine, with every effect on
///     lit                    9        7
///     lit, screen space      8        8   screen-space reflections or refraction
///     unlit                 12        4
///     without fog           +1       -1
///     featureLevel 3        24        as above; what usedIf leaves of them fits the device, or the engine rejects it
///
///   The engine's textures are in the Pass group; the View group has none. kEngineTextures is the only list of them:
///   bind group layouts, the rules of the material compiler and the tests are derived from it. A new effect gives its
///   row a binding and adds a line to interface.glsl.
///   What keeps the numbers small: the tables of area lights become layers of the split-sum table's texture, and a
///   material removes the textures that it does not use (usedIf, shaders/package/RemoveUnusedTextures.h).
///   Beyond the budget: the compiler rejects the material at the line of the texture. The engine rejects a material
///   that the device cannot draw, and names the material, its textures and the limit.
#pragma once

#include "shaders/interface/ShaderInterface.h"

#include <array>
#include <cstdint>

namespace filament_core::shader {

inline constexpr uint32_t kSamplersOfEveryDevice = 16;

/// What the Pass group of a material holds besides PassUniforms.
enum class PassKind : uint8_t {
    Lit,       ///< surfaces under lights: the textures of the environment
    LitScreen, ///< with screen-space reflections or refraction
    Unlit,     ///< surfaces that light does not reach, the sky among them
    Picture,   ///< the domain postprocess
};
inline constexpr size_t kPassKinds = 4;
inline constexpr size_t kSurfaceKinds = 3; ///< all but the last: what draws the surfaces of a scene
constexpr bool isLitKind(PassKind kind) { return kind == PassKind::Lit || kind == PassKind::LitScreen; }

/// Who reads a texture of the engine; a set.
enum PassReaders : uint8_t {
    kReadByLit = 1,
    kReadByUnlit = 2,
    kReadByScreenSpace = 4, ///< by lit materials with screen-space reflections or refraction
    kReadForFog = 8,        ///< but not by materials compiled without fog
};

struct EngineTexture {
    const char* name;
    uint8_t readers; ///< PassReaders
    uint8_t binding; ///< PassBinding
};

// clang-format off
inline constexpr std::array kEngineTextures{
    EngineTexture{ "shadow maps",       kReadByLit | kReadByUnlit,               kBindingShadowMaps },
    EngineTexture{ "environment",       kReadByLit,                              kBindingSpecular },
    EngineTexture{ "lighting tables",   kReadByLit,                              kBindingDfg },
    EngineTexture{ "irradiance",        kReadByLit,                              kBindingIrradiance },
    EngineTexture{ "ambient occlusion", kReadByLit | kReadByUnlit,               kBindingOcclusion }, // or peeled depth
    EngineTexture{ "depth",             kReadByLit | kReadByUnlit,               kBindingSceneDepth },
    EngineTexture{ "fog",               kReadByLit | kReadByUnlit | kReadForFog, kBindingFog },
    EngineTexture{ "picture behind",    kReadByScreenSpace,                      kBindingPicture },
};
// clang-format on

constexpr bool isReadBy(EngineTexture const& texture, PassKind kind) {
    if (kind == PassKind::Picture) return false;
    if (kind == PassKind::LitScreen && (texture.readers & kReadByScreenSpace) != 0) return true;
    return (texture.readers & (isLitKind(kind) ? kReadByLit : kReadByUnlit)) != 0;
}

/// With every effect on.
constexpr uint32_t samplersOfEngine(PassKind kind, bool hasFog = true) {
    uint32_t count = 0;
    for (EngineTexture const& texture : kEngineTextures) {
        const bool isFogOnly = (texture.readers & kReadForFog) != 0;
        count += isReadBy(texture, kind) && (hasFog || !isFogOnly);
    }
    return count;
}

/// What is left for a material that every device can draw.
constexpr uint32_t samplersOfMaterial(PassKind kind, bool hasFog = true) {
    return kSamplersOfEveryDevice - samplersOfEngine(kind, hasFog);
}

static_assert(samplersOfMaterial(PassKind::Lit) == 9 && samplersOfMaterial(PassKind::LitScreen) == 8 &&
                      samplersOfMaterial(PassKind::Lit, false) == 10 && samplersOfMaterial(PassKind::Unlit) >= 12 &&
                      samplersOfMaterial(PassKind::Unlit, false) >= 13,
              "chapter 7 of the materials guide promises authors as many");

} // namespace filament_core::shader
