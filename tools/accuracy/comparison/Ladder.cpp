// SPDX-License-Identifier: Apache-2.0
// Size: allRungs() is a table that lists one rung after the other.
#include "tools/accuracy/comparison/Ladder.h"

#include <filament_core/Quality.h>

#include <fmt/core.h>

#include <algorithm>

namespace filament_core::accuracy {
namespace {

using reference::BsdfModel;
using reference::CoatTerm;
using reference::CouplingTerm;
using reference::EnergyTerm;
using reference::Integrator;
using reference::SheenTerm;
using reference::SolidTint;
using reference::SpecularLight;

constexpr uint32_t kSupersampling = 8;
constexpr uint32_t kLevels = 6; // of a cube of 512 texels a face: assets::specularLevelCount()

/// Scene files draw none of their own accord.
std::vector<std::string> defaultShadows() { return { fmt::format("shadows={}", toString(Quality{}.shadows)) }; }

/// What is left is the size of a texel and the noise of the filter.
std::vector<std::string> finestShadows() {
    return { "shadows=pcss", "shadowMapSize=4096", "shadowAtlasMegabytes=256" };
}

/// The largest tables: their remaining error is below that of half floats.
std::vector<std::string> finestTables() {
    std::vector<std::string> set = finestShadows();
    set.insert(set.end(), { "environment.faceSize=512", "environment.samples=1024", "dfgTableSize=256" });
    return set;
}

std::vector<Rung> allRungs() {
    return {
        { .set = defaultShadows(),
          .name = "oneSample",
          .title = "One sample per pixel",
          .approximate = "the centre of a pixel, textures through mip levels",
          .exact = "64 samples per pixel" },
        { .supersampling = kSupersampling,
          .set = defaultShadows(),
          .name = "shadowMaps",
          .title = "Filter and texels of shadow maps",
          .approximate = "2048 texels a side for a sun, filtered over 4 x 4 of them",
          .exact = "4096 texels, filtered as wide as the penumbra",
          .needs = Needs::Lights },
        { .supersampling = kSupersampling,
          .set = finestShadows(),
          .name = "tables",
          .title = "Resolution of look-up tables",
          .approximate =
                  "environment of 256 texels per face, each integrating 512 pieces of the sky; albedo table with 64 "
                  "texels per side",
          .exact = "512 texels, 1024 pieces; 256 texels",
          .needs = Needs::Environment },
        { .supersampling = kSupersampling,
          .set = finestTables(),
          .name = kUnexplained,
          .title = "Unexplained",
          .approximate = "the engine: fp32 shaders, half floats, texels, a rasteriser",
          .exact = "the same formulas in double precision, rays" },
        { .kind = RungKind::Reference,
          .integrator = Integrator::Unoccluded,
          .bsdf = { .specularLight = SpecularLight::SplitSum, .splitSumLevels = kLevels },
          .name = "levels",
          .title = "Roughness between levels",
          .approximate = "a mix of the two nearest of six pre-filtered roughnesses",
          .exact = "the environment pre-filtered for every roughness",
          .needs = Needs::Environment },
        { .kind = RungKind::Reference,
          .integrator = Integrator::Unoccluded,
          .bsdf = { .specularLight = SpecularLight::SplitSum },
          .name = "splitSum",
          .title = "Split sum",
          .approximate = "the environment filtered by the lobe as seen along the normal, times the lobe's albedo",
          .exact = "the integral of environment and lobe",
          .needs = Needs::Environment },
        { .kind = RungKind::Reference,
          .integrator = Integrator::Unoccluded,
          .name = "occlusion",
          .title = "Missing ambient occlusion",
          .approximate = "nothing blocks the light of the environment but the material's occlusion map",
          .exact = "rays find what blocks it",
          .needs = Needs::NoRefraction },
        { .kind = RungKind::Reference,
          .integrator = Integrator::Unoccluded,
          .name = "refraction",
          .title = "One look-up for the background",
          .approximate = "a solid is a ball that touches the point, filled with a colour; nothing blocks light",
          .exact = "rays are refracted where they enter and where they leave, and absorbed between",
          .needs = Needs::Refraction },
        { .kind = RungKind::Reference,
          .maxBounces = 1,
          .bsdf = { .solidTint = SolidTint::Once },
          .name = "solidTint",
          .title = "Base colour of solids",
          .approximate = "light takes on the base colour once, where it enters: color * exp(-absorption * distance)",
          .exact = "at each interface, as KHR_materials_volume specifies",
          .needs = Needs::Solid },
        { .kind = RungKind::Reference,
          .maxBounces = 1,
          .name = "interreflection",
          .title = "Missing inter-reflection",
          .approximate = "light that was reflected once",
          .exact = "every bounce" },
        { .kind = RungKind::Reference,
          .name = "coupling",
          .title = "Coupling of the lobes",
          .approximate = "for light from the sky and indirect light, the diffuse lobe gets what the specular lobe "
                         "leaves towards the view",
          .exact = "what it leaves towards view and light, as for suns and lamps" },
        { .kind = RungKind::Reference,
          .bsdf = { .coupling = CouplingTerm::Always },
          .name = "sheen",
          .title = "Sheen's single-lobe energy",
          .approximate = "the base keeps what the sheen does not send to the viewer; for lights, the smaller share of "
                         "view and light",
          .exact = "as much as makes white on white reflect all light, reciprocally",
          .needs = Needs::Sheen },
        { .kind = RungKind::Reference,
          .bsdf = { .coupling = CouplingTerm::Always, .sheen = SheenTerm::Exact },
          .name = "coat",
          .title = "Clear coat's attenuation",
          .approximate = "the transmission in times the transmission out, without refraction or internal reflection",
          .exact = "two interfaces: refraction, Fresnel's equations, the series of reflections between them",
          .needs = Needs::Coat },
        { .kind = RungKind::Reference,
          .bsdf = { .coupling = CouplingTerm::Always, .coat = CoatTerm::Exact, .sheen = SheenTerm::Exact },
          .name = "schlick",
          .title = "Schlick's Fresnel term",
          .approximate = "Schlick's fit",
          .exact = "Fresnel's equations" },
        { .kind = RungKind::Reference,
          .bsdf = { .fresnel = FresnelTerm::Exact,
                    .coupling = CouplingTerm::Always,
                    .coat = CoatTerm::Exact,
                    .sheen = SheenTerm::Exact } },
    };
}

bool isMet(Needs needs, LadderScene const& scene) {
    switch (needs) {
    case Needs::Nothing:
        break;
    case Needs::Environment:
        return scene.hasEnvironment;
    case Needs::Lights:
        return scene.hasLights;
    case Needs::Coat:
        return scene.material.coat;
    case Needs::Sheen:
        return scene.material.sheen;
    case Needs::Refraction:
        return scene.material.refraction;
    case Needs::NoRefraction:
        return !scene.material.refraction;
    case Needs::Solid:
        return scene.material.solid;
    }
    return true;
}

} // namespace

std::vector<Rung> ladder(LadderScene const& scene) {
    std::vector<Rung> rungs = allRungs();
    std::erase_if(rungs, [&](Rung const& rung) { return !isMet(rung.needs, scene); });
    return rungs;
}

std::span<const Alternative> alternatives() {
    static const Alternative kAll[] = {
        { .bsdf = { .fresnel = FresnelTerm::Exact,
                    .energy = EnergyTerm::SingleScatter,
                    .coupling = CouplingTerm::Always },
          .name = "energyCompensation",
          .title = "Energy compensation",
          .text = "the factor that restores what microfacets lose with a single bounce: the change without it "
                  "bounds its error" },
    };
    return kAll;
}

} // namespace filament_core::accuracy
