// SPDX-License-Identifier: Apache-2.0
/// SampleTable: the expected effect of each file in samples/materials.
#pragma once

#include "toolkit/materials/MaterialFile.h"

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace filament_core::samples {

/// Effect of the property on the mean of the image.
enum class Effect : uint8_t { Differs, Brighter, Darker };

struct Sample {
    std::string name;
    tools::TextEdit without; ///< removes the property; empty: it has no visible effect yet
    Effect effect = Effect::Differs;
    uint8_t samplesOfAPixel = 1;
    bool hasLamp = true; ///< in addition to sun and sky
};

inline std::ostream& operator<<(std::ostream& out, Sample const& sample) { return out << sample.name; }

std::vector<Sample> samples();

/// Names of chapter 4.2 and the values of which each is a property of its own.
inline constexpr const char* kPropertiesOfTheGuide[] = {
    "name :",
    "featureLevel :",
    "shadingModel : lit",
    "shadingModel : unlit",
    "parameters :",
    "precision :",
    "format : float",
    "format : int",
    "shadingModel : cloth",
    "shadingModel : subsurface",
    "refractionMode : cubemap",
    "refractionMode : screenspace",
    "refractionType : solid",
    "refractionType : thin",
    "customSurfaceShading :",
    "instanced :",
    "interpolation :",
    "transparency : twoPassesOneSide",
    "transparency : twoPassesTwoSides",
    "reflections :",
    "shadowMultiplier :",
    "transparentShadow :",
    "constants :",
    "variantFilter :",
    "flipUV :",
    "quality :",
    "vertexDomainDeviceJittered :",
    "requires :",
    "uv1",
    "custom0",
    "variables :",
    "vertexDomain : world",
    "vertexDomain : view",
    "vertexDomain : device",
    "blending : transparent",
    "blending : fade",
    "blending : add",
    "blending : masked",
    "blending : multiply",
    "blending : screen",
    "blending : custom",
    "blendFunction :",
    "postLightingBlending :",
    "maskThreshold :",
    "culling : front",
    "colorWrite :",
    "depthWrite :",
    "depthCulling :",
    "doubleSided :",
    "alphaToCoverage :",
    "multiBounceAmbientOcclusion :",
    "specularAmbientOcclusion : simple",
    "specularAmbientOcclusion : bentNormals",
    "shadingModel : specularGlossiness",
    "clearCoatIorChange :",
    "specularAntiAliasing :",
    "specularAntiAliasingVariance :",
    "specularAntiAliasingThreshold :",
};

} // namespace filament_core::samples
