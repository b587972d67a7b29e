// SPDX-License-Identifier: Apache-2.0
/// BsdfModel: the formula for each term of the standard material. The defaults are the engine's; changing one value
/// isolates one term, so that its error can be measured. Visibility, Fresnel and diffuse are the engine's own choices
/// (<filament_core/Quality.h>), applied to all light here.
#pragma once

#include <filament_core/Quality.h>

#include <cstdint>

namespace filament_core::reference {

/// What replaces the energy that the specular lobe loses with a single bounce.
enum class EnergyTerm : uint8_t {
    Compensated, ///< the engine's factor energyCompensation(), from exact directional albedos
    SingleScatter,
};

/// Whether the diffuse lobe receives only the light that the specular lobe leaves, by its albedos towards viewer and
/// light (Coupling.h).
enum class CouplingTerm : uint8_t {
    Engine,      ///< suns and punctual lights: the share left in both directions; other light: that towards the viewer
    AmbientOnly, ///< Quality::diffuseCoupling off: suns and punctual lights in full
    Always,      ///< the share left in both directions, for all light: one surface, reciprocal
    Never,
};

/// The source of the light: the engine treats the two differently (CouplingTerm::Engine, occlusion maps).
enum class LightSource : uint8_t {
    Ambient, ///< the environment and other surfaces
    Direct,  ///< suns and punctual lights
};

/// Which lobes reflect. Each alone adds up to both.
enum class LobeChoice : uint8_t { Both, Diffuse, Specular };

/// How the specular lobe integrates the environment. SplitSum only with Integrator::Unoccluded.
enum class SpecularLight : uint8_t {
    Integral,
    SplitSum, ///< as in the engine: pre-filtered for a view along the normal, times the lobe's albedo (Prefiltered.h)
};

/// How the diffuse lobe integrates the environment. Harmonics only with Integrator::Unoccluded and a Lambert lobe.
enum class DiffuseLight : uint8_t {
    Integral,
    Harmonics, ///< as in the engine: three bands (Prefiltered.h)
};

/// What a clear coat does with the light that it does not reflect.
enum class CoatTerm : uint8_t {
    Engine, ///< the lobes below, for the directions outside, times the transmission in and out (CoatLayer.h)
    Exact,  ///< both interfaces: directions bend, and light that the coat reflects inside returns
};

/// How much light a sheen removes from the layer below it.
enum class SheenTerm : uint8_t {
    Engine, ///< KHR_materials_sheen's albedo scaling: of lights the lesser of both directions', else the viewer's
    Exact,  ///< a white base under a white sheen reflects all light, and the result is reciprocal
};

/// How often the base colour of a solid is applied to light that enters and leaves.
enum class SolidTint : uint8_t {
    EachInterface, ///< KHR_materials_volume: a coloured foil around the volume, which light crosses twice
    Once,          ///< as in the engine: on the way in
};

struct BsdfModel {
    SpecularVisibility visibility = SpecularVisibility::Correlated;
    FresnelTerm fresnel = FresnelTerm::Schlick;
    DiffuseTerm diffuse = DiffuseTerm::Lambert;
    EnergyTerm energy = EnergyTerm::Compensated;
    CouplingTerm coupling = CouplingTerm::Engine;
    LobeChoice lobes = LobeChoice::Both;
    SpecularLight specularLight = SpecularLight::Integral;
    AnisotropicLookUps grainLookUps = AnisotropicLookUps::Five; ///< of SplitSum
    uint32_t splitSumLevels = 0; ///< >= 2: number of pre-filtered roughnesses; others are interpolated from two
    DiffuseLight diffuseLight = DiffuseLight::Integral;
    CoatTerm coat = CoatTerm::Engine;
    SheenTerm sheen = SheenTerm::Engine;
    SolidTint solidTint = SolidTint::EachInterface;
    friend bool operator==(BsdfModel const&, BsdfModel const&) = default;
};

} // namespace filament_core::reference
