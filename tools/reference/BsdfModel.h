// SPDX-License-Identifier: Apache-2.0
/// BsdfModel: which formula stands for each term of the standard material. The defaults are the engine's; one changed
/// value isolates one term, so that its error can be measured. Visibility, Fresnel and diffuse are the engine's own
/// choices (<filament/Quality.h>), here for all light.
#pragma once

#include <filament/Quality.h>

#include <cstdint>

namespace filament::reference {

/// What the specular lobe loses by reflecting once only.
enum class EnergyTerm : uint8_t {
    Compensated, ///< the engine's factor energyCompensation(), from exact directional albedos
    SingleScatter,
};

/// Whether the diffuse lobe gets only what the specular lobe leaves, by its albedos towards viewer and light
/// (Coupling.h).
enum class CouplingTerm : uint8_t {
    Engine, ///< of suns and punctual lights what it leaves in both directions, of other light what towards the viewer
    AmbientOnly, ///< Quality::diffuseCoupling off: all of suns and punctual lights
    Always,      ///< in both directions of all light: one surface, reciprocal
    Never,
};

/// What sends the light: the engine does not treat both alike (CouplingTerm::Engine, occlusion maps).
enum class LightSource : uint8_t {
    Ambient, ///< the environment and other surfaces
    Direct,  ///< suns and punctual lights
};

/// Which lobes reflect. The two alone add up to both.
enum class LobeChoice : uint8_t { Both, Diffuse, Specular };

/// How the specular lobe gathers the environment. SplitSum, with Integrator::Unoccluded only.
enum class SpecularLight : uint8_t {
    Integral,
    SplitSum, ///< the engine's: pre-filtered as seen along the normal, times the lobe's albedo (Prefiltered.h)
};

/// How the diffuse lobe gathers the environment. Harmonics, with Integrator::Unoccluded and a Lambert lobe only.
enum class DiffuseLight : uint8_t {
    Integral,
    Harmonics, ///< the engine's: three bands (Prefiltered.h)
};

/// What a clear coat does to the light that it does not reflect.
enum class CoatTerm : uint8_t {
    Engine, ///< the lobes below, in the directions of the light outside, times what passes in and out (CoatLayer.h)
    Exact,  ///< the two interfaces: directions bend, and what the coat reflects inside comes back
};

/// How much light a sheen takes from the layer below it.
enum class SheenTerm : uint8_t {
    Engine, ///< KHR_materials_sheen's albedo scaling: of lights the lesser of both directions', else the viewer's
    Exact,  ///< so that a white base under a white sheen reflects all light, in both directions alike
};

/// How often the base colour of a solid counts for light that enters and leaves.
enum class SolidTint : uint8_t {
    EachInterface, ///< KHR_materials_volume: a coloured foil around the volume, which light passes twice
    Once,          ///< the engine: on the way in
};

struct BsdfModel {
    SpecularVisibility visibility = SpecularVisibility::Correlated;
    FresnelTerm fresnel = FresnelTerm::Schlick;
    DiffuseTerm diffuse = DiffuseTerm::Lambert;
    EnergyTerm energy = EnergyTerm::Compensated;
    CouplingTerm coupling = CouplingTerm::Engine;
    LobeChoice lobes = LobeChoice::Both;
    SpecularLight specularLight = SpecularLight::Integral;
    uint32_t splitSumLevels = 0; ///< >= 2: only so many roughnesses are pre-filtered, others are mixed from two
    DiffuseLight diffuseLight = DiffuseLight::Integral;
    CoatTerm coat = CoatTerm::Engine;
    SheenTerm sheen = SheenTerm::Engine;
    SolidTint solidTint = SolidTint::EachInterface;
    friend bool operator==(BsdfModel const&, BsdfModel const&) = default;
};

} // namespace filament::reference
