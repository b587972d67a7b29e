// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/MaterialLayers.h"

#include "shaders/lib/LibCppDouble.h"

#include <cmath>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

/// KHR_materials_ior, KHR_materials_specular.
void weighReflectance(MaterialPoint const& point, double3 baseColor, SurfaceSample& surface) {
    assets::MaterialData const& material = point.material();
    if (material.ior == 1.5f && !material.specular.isUsed()) return;
    const double4 maps = point.fetchColorAndScalar(material.specular.maps);
    const double weight = lib::saturate(material.specular.factor * maps.w);
    const double f0 = lib::f0FromIor(double(material.ior));
    // The weight must not darken twice: f90 is that of the bare interface, multiplied by the weight.
    surface.f90 =
            f90Of(glm::mix(double3(f0), baseColor, surface.metallic)) * lib::f90FromSpecular(weight, surface.metallic);
    surface.f0 = lib::f0FromSpecular(baseColor, surface.metallic, f0, double3(material.specular.color) * double3(maps),
                                     weight);
}

/// The base without its metallic share.
MixtureSample mixtureOf(MaterialPoint const& point, double3 baseColor, double transmitted) {
    assets::MaterialData const& material = point.material();
    MixtureSample mixture{ .color = baseColor, .dielectricF0 = double3(lib::f0FromIor(double(material.ior))) };
    mixture.dielectricF90 = f90Of(mixture.dielectricF0);
    mixture.transmitted = transmitted;
    if (!material.specular.isUsed()) return mixture;
    const double4 maps = point.fetchColorAndScalar(material.specular.maps);
    const double weight = lib::saturate(material.specular.factor * maps.w);
    const double3 tint = double3(material.specular.color) * double3(maps);
    mixture.dielectricF0 = lib::f0FromSpecular(baseColor, 0.0, mixture.dielectricF0.x, tint, weight);
    mixture.dielectricF90 *= lib::f90FromSpecular(weight, 0.0);
    return mixture;
}

/// KHR_materials_iridescence.
void addFilm(MaterialPoint const& point, SurfaceSample& surface) {
    assets::IridescenceData const& data = point.material().iridescence;
    if (!data.isUsed()) return;
    const double2 maps = point.fetchScalars(data.maps);
    surface.film = { .strength = lib::saturate(data.factor * maps.x),
                     .ior = std::max(double(data.ior), 1.0),
                     .thickness = data.maps.hasSecond ? glm::mix(double(data.thicknessMinNanometers),
                                                                 double(data.thicknessMaxNanometers), maps.y)
                                                      : double(data.thicknessMaxNanometers),
                     .outsideIor = glm::mix(1.0, lib::kCoatIor, surface.coat.strength) };
}

/// KHR_materials_anisotropy: rougher along its direction, unchanged across it.
void addAnisotropy(MaterialPoint const& point, double roughness, SurfaceSample& surface) {
    assets::AnisotropyData const& data = point.material().anisotropy;
    if (!data.isUsed()) return;
    const double2 turn(std::cos(data.rotationRadians), std::sin(data.rotationRadians));
    double2 direction = turn;
    double strength = data.strength;
    if (has(data.map)) {
        const double4 texel = point.fetch(data.map);
        const double2 authored = double2(texel) * 2.0 - 1.0;
        direction = { authored.x * turn.x - authored.y * turn.y, authored.x * turn.y + authored.y * turn.x };
        direction = point.vectorOfVertex(data.map, direction);
        strength *= texel.z;
    }
    if (!(strength > 0)) return;
    const double across = lib::sq(roughness);
    const double sum = glm::mix(across, 1.0, lib::sq(strength)) + across;
    surface.anisotropy = 1 - 2 * across / sum;
    surface.perceptualRoughness = lib::clampPerceptualRoughness(std::sqrt(0.5 * sum));
    const double alpha = lib::alphaFromPerceptual(surface.perceptualRoughness);
    surface.stretchedAlpha = lib::anisotropicAlpha(alpha, surface.anisotropy, lib::kMinAlpha);
    surface.tangent = point.toWorld({ direction.x, direction.y, 0 });
}

/// KHR_materials_clearcoat: the base is that of a surface in air.
void addClearCoat(MaterialPoint const& point, SurfaceSample& surface) {
    assets::ClearCoatData const& data = point.material().clearCoat;
    if (!data.isUsed()) return;
    const double2 maps = point.fetchScalars(data.maps);
    surface.coat = { .strength = data.factor * maps.x,
                     .perceptualRoughness = lib::clampPerceptualRoughness(data.roughness * maps.y),
                     .normal = point.mappedNormal(data.normal, data.normalScale),
                     .bareF0 = surface.f0 };
}

/// KHR_materials_sheen.
void addSheen(MaterialPoint const& point, SurfaceSample& surface) {
    assets::SheenData const& data = point.material().sheen;
    if (!data.isUsed()) return;
    const double4 maps = point.fetchColorAndScalar(data.maps);
    surface.sheen = { .color = lib::saturate(double3(data.color) * double3(maps)),
                      .perceptualRoughness = lib::clampPerceptualRoughness(data.roughness * maps.w) };
}

/// KHR_materials_volume and KHR_materials_dispersion. Converts lengths of the file to lengths in the world.
void addVolume(MaterialPoint const& point, double thickness, TransmissionSample& below) {
    assets::TransmissionData const& data = point.material().transmission;
    below.isThin = false;
    below.thickness = thickness * point.part.sceneFromMesh * point.part.worldFromScene;
    below.dispersion = data.dispersion;
    if (std::isinf(data.attenuationDistanceMeters)) return;
    below.absorption =
            lib::absorptionAtDistance(double3(data.attenuationColor), double(data.attenuationDistanceMeters)) /
            point.part.worldFromScene;
}

/// KHR_materials_transmission takes its share of the diffuse lobe. Returns that share.
double addTransmission(MaterialPoint const& point, SurfaceSample& surface) {
    assets::TransmissionData const& data = point.material().transmission;
    if (!data.isUsed()) return 0;
    const double2 maps = point.fetchScalars(data.maps);
    const double part = data.factor * maps.x;
    surface.transmission.color = surface.diffuse * part;
    surface.transmission.share = part * (1 - surface.metallic);
    surface.transmission.ior = point.material().ior;
    if (data.isSolid()) addVolume(point, data.thicknessMeters * maps.y, surface.transmission);
    surface.diffuse *= 1 - part;
    return part;
}

/// KHR_materials_diffuse_transmission. `transmitted`: the share taken by KHR_materials_transmission.
void addDiffuseTransmission(MaterialPoint const& point, double transmitted, SurfaceSample& surface) {
    assets::DiffuseTransmissionData const& data = point.material().diffuseTransmission;
    if (!data.isUsed()) return;
    const double4 maps = point.fetchColorAndScalar(data.maps);
    const double part = lib::saturate(data.factor * maps.w);
    const double3 albedo = lib::saturate(double3(data.color) * double3(maps)) * (1 - surface.metallic);
    surface.diffuseTransmission.color = albedo * (part * (1 - transmitted));
    surface.diffuse *= 1 - part;
}

/// KHR_materials_volume_scatter: the colour at the point where light enters is that of the medium.
void addMedium(MaterialPoint const& point, SurfaceSample& surface) {
    if (!point.material().scatters()) return;
    assets::TransmissionData const& volume = point.material().transmission;
    assets::VolumeScatterData const& data = point.material().volumeScatter;
    const double3 texel = has(data.map) ? double3(point.fetch(data.map)) : double3(1.0);
    const double3 loss = lib::scatterLoss(lib::saturate(double3(data.color) * texel));
    surface.medium = MediumSample{ .extinction = lib::absorptionAtDistance(double3(volume.attenuationColor),
                                                                           double(volume.attenuationDistanceMeters)) /
                                                 point.part.worldFromScene,
                                   .albedo = 1.0 - loss * loss,
                                   .anisotropy = data.anisotropy };
}

} // namespace

void addLayers(MaterialPoint const& point, double3 baseColor, double roughness, SurfaceSample& surface) {
    // In this order: the coat keeps the f0 found here, the film lies under the coat, and diffuse transmission takes its
    // share of what transmission leaves.
    weighReflectance(point, baseColor, surface);
    addAnisotropy(point, roughness, surface);
    addClearCoat(point, surface);
    addSheen(point, surface);
    addFilm(point, surface);
    const double transmitted = addTransmission(point, surface);
    const bool isMixed = surface.metallic > 0 && surface.metallic < 1;
    if (isMixed || point.material().transmission.isUsed()) surface.mixture = mixtureOf(point, baseColor, transmitted);
    addDiffuseTransmission(point, transmitted, surface);
    addMedium(point, surface);
}

} // namespace filament_core::reference
