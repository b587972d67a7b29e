// SPDX-License-Identifier: Apache-2.0
/// GltfFuzzBody: loads arbitrary bytes as glTF; one body for the fuzzer (tests/fuzz/GltfFuzz.cpp) and the mutation
/// test. A file may be rejected, with one line of text, or give a model that keeps every promise of ModelData.h.
#pragma once

#include "filament_core/assets/gltf/GltfLoader.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

namespace filament_core::assets::test {

inline const char* brokenPromise(ModelData const& model, Image const& image) {
    if (image.width == 0 || image.height == 0 || image.data.size() != image.levelOffset(image.levels))
        return "image size";
    const uint32_t full = backend::fullMipCount(image.width, image.height);
    const auto isLight = [&](MaterialData const& material) {
        const uint32_t index = material.light.map.image;
        return index < model.images.size() && &model.images[index] == &image;
    };
    if (image.levels > full || (image.levels != full && std::ranges::none_of(model.materials, isLight)))
        return "mip chain";
    return model.images.empty() ? "image list" : nullptr;
}

inline std::vector<TextureRef> texturesOf(MaterialData const& m) {
    std::vector<TextureRef> textures{ m.baseColor,
                                      m.metallicRoughness,
                                      m.normal,
                                      m.occlusion,
                                      m.bump.map,
                                      m.emissive,
                                      m.clearCoat.maps.texture,
                                      m.clearCoat.normal,
                                      m.sheen.maps.texture,
                                      m.specular.maps.texture,
                                      m.anisotropy.map,
                                      m.iridescence.maps.texture,
                                      m.transmission.maps.texture,
                                      m.diffuseTransmission.maps.texture,
                                      m.volumeScatter.map };
    if (m.specularGlossiness) textures.push_back(m.specularGlossiness->map);
    return textures;
}

inline std::vector<float> unitFactorsOf(MaterialData const& m) {
    return { m.metallicFactor,
             m.roughnessFactor,
             m.clearCoat.factor,
             m.clearCoat.roughness,
             m.sheen.color.x,
             m.sheen.roughness,
             m.specular.factor,
             m.anisotropy.strength,
             m.iridescence.factor,
             m.transmission.factor,
             m.transmission.attenuationColor.z,
             m.diffuseTransmission.factor,
             m.volumeScatter.color.y };
}

inline const char* brokenPromise(ModelData const& model, MaterialData const& m) {
    for (TextureRef const& texture : texturesOf(m)) {
        if (texture.image != kNone && texture.image >= model.images.size()) return "image index";
        if (texture.uvSet > 3) return "uv set";
    }
    for (TexturePair const& pair : { m.clearCoat.maps, m.sheen.maps, m.specular.maps, m.iridescence.maps,
                                     m.transmission.maps, m.diffuseTransmission.maps }) {
        if ((pair.hasFirst || pair.hasSecond) != (pair.texture.image != kNone)) return "texture pair";
    }
    for (const float factor : unitFactorsOf(m)) {
        if (!(factor >= 0 && factor <= 1)) return "factor";
    }
    if (!(std::abs(m.bump.factor) <= 65504)) return "height of bumps";
    if (!(m.ior >= 1 && m.ior <= kOpaqueIor)) return "index of refraction";
    if (!(m.transmission.attenuationDistanceMeters > 0 && m.transmission.dispersion <= 100)) return "volume";
    if (!(std::abs(m.volumeScatter.anisotropy) <= kMaxScatterAnisotropy)) return "anisotropy of scattering";
    if (m.unlit && m.specularGlossiness) return "shading model";
    return std::isfinite(m.emissiveStrength) && m.emissiveStrength >= 0 ? nullptr : "emissive strength";
}

inline const char* brokenPromise(scene::SplatData const& splats) {
    const size_t perSplat = size_t{ splats.degree + 1 } * (splats.degree + 1);
    if (splats.count() == 0 || splats.degree > 3) return "splats";
    if (splats.covariances.size() != splats.count() || splats.opacities.size() != splats.count() ||
        splats.harmonics.size() != splats.count() * perSplat)
        return "lists of splats";
    for (const float opacity : splats.opacities)
        if (!(opacity >= 0 && opacity <= 1)) return "opacity";
    for (scene::Covariance const& c : splats.covariances)
        if (!std::isfinite(c.xx + c.yy + c.zz + c.xy + c.xz + c.yz)) return "covariance";
    return nullptr;
}

inline const char* brokenPromise(ModelData const& model, PrimitiveData const& p) {
    if (p.splats) return brokenPromise(*p.splats);
    const size_t indexBytes = p.indexFormat == backend::IndexFormat::UInt16 ? 2 : 4;
    if (p.vertexCount == 0 || p.indexCount == 0) return "empty primitive";
    if (p.vertices.size() != size_t{ p.vertexCount } * p.layout.buffers[0].stride) return "vertex bytes";
    if (p.indices.size() != p.indexCount * indexBytes) return "index bytes";
    if (p.layout.buffers[0].stride % 4 != 0) return "stride";
    for (uint32_t i = 0; i < p.layout.attributeCount; ++i) {
        const uint8_t location = p.layout.attributes[i].location;
        const bool isJoints = location == shader::kAttributeJoints || location == shader::kAttributeJoints1;
        if (backend::vertexFormatInfo(p.layout.attributes[i].format).integer != isJoints) return "integer attribute";
    }
    for (size_t i = 0; i < p.indexCount; ++i) {
        uint32_t index = 0; // little-endian: two bytes are the low half
        std::memcpy(&index, &p.indices[i * indexBytes], indexBytes);
        if (index >= p.vertexCount) return "vertex index";
    }
    if (p.topology == backend::PrimitiveType::Triangles && (p.indexCount % 3 != 0 || !p.hasNormals)) return "triangles";
    if (p.material != kNone && p.material >= model.materials.size()) return "material index";
    for (VariantMaterial const& variant : p.variants) {
        if (variant.variant >= model.variants.size() || variant.material >= model.materials.size()) return "variant";
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(p.boundsMin[axis]) || !(p.boundsMin[axis] <= p.boundsMax[axis])) return "bounds";
        if (!(p.restBounds.min[axis] <= p.restBounds.max[axis])) return "bounds at rest";
    }
    for (MorphTargetData const& target : p.morphTargets) {
        for (auto const* list : { &target.positions, &target.normals, &target.tangents }) {
            if (!list->empty() && list->size() != p.vertexCount) return "morph target";
        }
    }
    return nullptr;
}

inline const char* brokenPromise(ModelData const& model, LevelsData const& levels) {
    if (levels.nodes.size() < 2 || levels.leastCoverage.size() != levels.nodes.size()) return "levels";
    for (const uint32_t node : levels.nodes) {
        if (node >= model.nodes.size()) return "node of a level";
    }
    double most = 1e30;
    for (const double least : levels.leastCoverage) {
        if (!(least >= 0 && least <= most)) return "coverage of a level";
        most = least;
    }
    return nullptr;
}

inline const char* brokenPromise(ModelData const& model, NodeData const& node) {
    if (node.mesh != kNone && node.mesh >= model.meshes.size()) return "mesh index";
    for (const uint32_t light : { node.light, node.profiledLight }) {
        if (light != kNone && light >= model.lights.size()) return "light index";
    }
    const auto own = static_cast<uint32_t>(&node - model.nodes.data());
    if (node.parent != kNone && node.parent >= own) return "parents before children";
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(node.worldFromNode[column][row])) return "transform";
            if (!std::isfinite(node.parentFromNode[column][row])) return "local transform";
        }
        if (node.parentFromNode[column].w != (column == 3 ? 1 : 0)) return "affine transform";
    }
    return nullptr;
}

inline const char* brokenPromise(ModelData const& model, LightData const& light) {
    if (light.profile != kNone && (light.profile >= model.profiles.size() || light.type != LightType::Point))
        return "light profile";
    const auto isIn = [](float value, float low, float high) { return value >= low && value <= high; };
    constexpr float kMost = std::numeric_limits<float>::max();
    if (!isIn(light.sourceRadiusMeters, 0, kMost) || !isIn(light.angularRadiusDegrees, 0, 20))
        return "radius of a light";
    if (!isIn(light.haloSize, 1, 1000) || !isIn(light.haloFalloff, 0, 10'000)) return "halo of a sun";
    if (!isIn(light.sizeMeters.x, 0, kMost) || !isIn(light.sizeMeters.y, 0, kMost)) return "size of a light";
    if (!isIn(light.luminance, 0, kMost)) return "luminance";
    if (!isIn(std::max({ light.color.x, light.color.y, light.color.z }), 0, kMost)) return "color of a light";
    return std::isfinite(light.intensity) && light.intensity >= 0 ? nullptr : "light intensity";
}

inline const char* brokenPromise(ModelData const&, CameraData const& camera) {
    if (!(camera.verticalFovRadians > 0 && camera.verticalFovRadians < 3.1415927f)) return "field of view";
    if (!(camera.nearMeters >= 0 && camera.aspect >= 0 && std::isfinite(camera.nearMeters + camera.aspect)))
        return "lens";
    if (!camera.isParallel) return camera.nearMeters > 0 ? nullptr : "near plane";
    return camera.farMeters > camera.nearMeters && camera.halfHeightMeters > 0 ? nullptr : "box of a camera";
}

inline const char* brokenPromise(ModelData const& model, SkinData const& skin) {
    if (skin.joints.empty()) return "joint count";
    if (skin.joints.size() != skin.jointFromBind.size()) return "bind matrices";
    return std::ranges::all_of(skin.joints, [&](uint32_t joint) { return joint < model.nodes.size(); }) ? nullptr
                                                                                                        : "joints";
}

inline const char* brokenPromise(ModelData const& model, AnimationData const& animation) {
    std::vector<double> value;
    for (AnimationChannel const& channel : animation.channels) {
        const bool isProperty = channel.path == AnimationPath::Property;
        const size_t targets = isProperty ? model.animatedProperties.size() : model.nodes.size();
        if (channel.node >= targets || channel.sampler >= animation.samplers.size()) return "channel";
        AnimationSampler const& sampler = animation.samplers[channel.sampler];
        if (isProperty && sampler.width != rowOf(model.animatedProperties[channel.node].name).width)
            return "width of a property";
        value.resize(sampler.width);
        if (sampler.times.empty() || !std::isfinite(sampler.times.front()) || !std::isfinite(sampler.times.back()) ||
            !std::ranges::is_sorted(sampler.times))
            return "key times";
        for (const double seconds : { -1.0, 0.0, animation.durationSeconds / 3, animation.durationSeconds, 1e9 })
            sampleAnimation(sampler, seconds, value);
    }
    return std::isfinite(animation.durationSeconds) ? nullptr : "duration";
}

/// Values from far outside of any range keep the promises of what they change.
inline const char* brokenPromise(ModelData const& model, AnimatedProperty const& property) {
    const bool isNowhere = property.object == kNone && property.owner == PropertyOwner::Material;
    const auto isIn = [&](auto const& list) { return property.object < list.size(); };
    for (const float value : { -1e30f, 0.0f, 1e30f }) {
        if (property.owner == PropertyOwner::Node && !isIn(model.nodes)) return "animated node";
        if (property.owner == PropertyOwner::Light) {
            if (!isIn(model.lights)) return "animated light";
            LightData light = model.lights[property.object];
            setValue(light, property.name, float4(value));
            if (brokenPromise(model, light)) return "light while it is animated";
        } else if (property.owner == PropertyOwner::Camera) {
            if (!isIn(model.cameras)) return "animated camera";
            CameraData camera = model.cameras[property.object];
            setValue(camera, property.name, float4(value));
            if (brokenPromise(model, camera)) return "camera while it is animated";
        } else if (property.owner == PropertyOwner::Material && !isNowhere) {
            if (!isIn(model.materials)) return "animated material";
            MaterialData material = model.materials[property.object];
            setValue(material, property.name, property.map, float4(value));
            if (brokenPromise(model, material)) return "material while it is animated";
        }
    }
    return nullptr;
}

inline const char* brokenPromise(ImageBasedLightData const& data) {
    CubeLight const& light = data.light;
    if (light.levels.empty()) return "levels of a light";
    const uint32_t size = light.levels[0].size();
    for (size_t i = 0; i < light.levels.size(); ++i) {
        const uint32_t side = light.levels[i].size();
        if (side == 0 || side != size >> i) return "sizes of a light's levels";
        for (uint32_t at = 0; at < 6 * side * side; ++at) {
            const float3 texel = light.levels[i].radiance(at / (side * side), static_cast<int>(at % side),
                                                          static_cast<int>(at / side % side));
            for (int c = 0; c < 3; ++c) {
                if (!(texel[c] >= 0 && texel[c] <= kMaxRadiance)) return "radiance of a light";
            }
        }
    }
    for (float4 const& c : light.irradianceSh) {
        if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) return "irradiance of a light";
    }
    return std::abs(glm::determinant(light.worldFromCube) + 1) < 1e-4f ? nullptr : "rotation of a light";
}

/// The first promise of ModelData.h that the model breaks; null if it keeps them all.
inline const char* brokenPromise(ModelData const& model) {
    const char* broken = nullptr;
    const auto check = [&](auto const& list) {
        for (auto const& element : list) {
            if (!broken) broken = brokenPromise(model, element);
        }
    };
    check(model.images);
    check(model.materials);
    check(model.nodes);
    check(model.levels);
    check(model.lights);
    check(model.skins);
    check(model.animations);
    check(model.animatedProperties);
    check(model.cameras);
    for (MeshData const& mesh : model.meshes) check(mesh.primitives);
    if (!broken && model.imageBasedLight) broken = brokenPromise(*model.imageBasedLight);
    return broken;
}

/// Returns whether the file was loaded. Ends the process on an error that no file may cause.
inline bool fuzzGltf(std::span<const std::byte> file, std::filesystem::path const& baseDirectory = "no such folder") {
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<ModelData> model = loadGltfFromMemory(file, baseDirectory, jobs);
    const Result<ModelData> kept = loadGltfFromMemory(
            file, baseDirectory, jobs, { .deformation = GltfDeformation::Kept, .levels = GltfLevels::All });
    const char* broken = kept ? brokenPromise(*kept) : nullptr;
    if (!broken && !kept && kept.error().message.empty()) broken = "message";
    if (model && !broken) broken = brokenPromise(*model);
    if (!model && (model.error().message.empty() || model.error().message.find('\n') != std::string::npos))
        broken = "message";
    if (broken) {
        std::fprintf(stderr, "a loaded file broke the promise about: %s\n", broken);
        std::abort();
    }
    return model.ok();
}

} // namespace filament_core::assets::test
