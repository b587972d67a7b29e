// SPDX-License-Identifier: Apache-2.0
/// ShadingKey: the choices of <filament_core/Quality.h> that select a program, packed; and what they specialise it
/// with.
///   Bits    one field a specialisation constant of ShaderInterface.h. 0: all defaults, the program as it was compiled.
///   Thread  pure functions. Memory: none. Fails: never.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/scene/SceneData.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament_core/Quality.h>

#include <array>
#include <cstdint>

namespace filament_core::passes {

using ShadingKey = uint64_t;

/// Which kinds of light there are in a view.
struct ShadedLights {
    bool hasAreas = false;
    bool hasProfiles = false;
    uint8_t imageTerms = 0;         ///< shader::LightImageTerms
    bool hasColoredShadows = false; ///< some shadow map has three channels
    bool hasAreaShadows = false;    ///< some is read in the shape of its light
    bool hasContactShadows = false;
    uint8_t probeTerms = 0; ///< shader::ProbeTerms
};

/// What shading reads of the scene colour, and what lies between it and the camera.
struct ShadedScreen {
    bool hasOcclusion = false, hasBentNormals = false;
    bool hasRefraction = false, hasReflections = false;
    bool showsLevels = false; ///< of the refracted scene colour, instead of it
    bool showsHits = false;   ///< how far mirrored rays go, instead of what they hit
    uint8_t fogTerms = 0;     ///< shader::FogTerms
    bool hasMipBias = false;  ///< Effect::MipBias
};

/// `light`: how the environment of the scene is stored, which selects programs as well.
ShadingKey shadingKey(Quality const& quality, scene::EnvironmentStorage const& light = {}, ShadedLights lights = {},
                      ShadedScreen screen = {});
/// Of variants that leave depth in shadow maps: whether what transmits light does so there.
ShadingKey depthShadingKey(bool coloredShadows);
/// Of variants that leave the depth of a view which is shaded with `key`: holes are cut where they are seen.
ShadingKey depthOfViewKey(ShadingKey key);

/// For what leaves no depth: ambient occlusion is that of the surfaces behind it.
ShadingKey withoutOcclusion(ShadingKey key);
/// For objects with a shader::IrradianceField.
ShadingKey withField(ShadingKey key);
/// For objects that are not refractive, and for those drawn before the copy.
ShadingKey withoutRefraction(ShadingKey key);
/// For what does not mirror the scene colour.
ShadingKey withoutReflections(ShadingKey key);
/// For order-independent transparency.
ShadingKey withTransparency(ShadingKey key, shader::TransparencyTerm term);
/// What decides the kinds of textures that are bound: of programs that contain the code of light and need none.
ShadingKey ofBoundTextures(ShadingKey key);
/// For what has no textures.
ShadingKey withoutMipBias(ShadingKey key);
/// The choices of materials that are not lit.
ShadingKey ofUnlit(ShadingKey key);
/// The choices of light that reaches any point, lit surface or not.
ShadingKey ofLights(ShadingKey key);
/// Without the choices that only variants with kVariantPunctual have.
ShadingKey withoutLightList(ShadingKey key);
/// Without the choices that only shadows have.
ShadingKey withoutShadows(ShadingKey key);
ShadowFilter shadowFilterOf(ShadingKey key);

/// Values for shader::kQualityConstants, in their order.
std::array<backend::ConstantValue, shader::kQualityConstants.size()> shadingConstants(ShadingKey key);

} // namespace filament_core::passes
