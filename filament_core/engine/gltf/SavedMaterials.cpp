// SPDX-License-Identifier: Apache-2.0
#include "base/math/Elementary.h"
#include "filament_core/engine/gltf/SaveContext.h"
#include "filament_core/engine/materials/Parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::engine {
namespace {

using assets::GltfMergeMaterial;
using assets::GltfMergeValue;
using assets::kNone;

/// Where a parameter of the engine's glTF materials is in a file. Those of several numbers and others that are not
/// copied have rows of code below.
struct PointerRow {
    std::string_view parameter, pointer;
};
constexpr std::array kPointers{
    PointerRow{ "metallicFactor", "pbrMetallicRoughness/metallicFactor" },
    PointerRow{ "roughnessFactor", "pbrMetallicRoughness/roughnessFactor" },
    PointerRow{ "_maskThreshold", "alphaCutoff" },
    PointerRow{ "normalScale", "normalTexture/scale" },
    PointerRow{ "occlusionStrength", "occlusionTexture/strength" },
    PointerRow{ "bumpFactor", "extensions/EXT_materials_bump/bumpFactor" },
    PointerRow{ "clearCoat", "extensions/KHR_materials_clearcoat/clearcoatFactor" },
    PointerRow{ "clearCoatRoughness", "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor" },
    PointerRow{ "clearCoatNormalScale", "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale" },
    PointerRow{ "sheenColor", "extensions/KHR_materials_sheen/sheenColorFactor" },
    PointerRow{ "sheenRoughness", "extensions/KHR_materials_sheen/sheenRoughnessFactor" },
    PointerRow{ "ior", "extensions/KHR_materials_ior/ior" },
    PointerRow{ "specularColorFactor", "extensions/KHR_materials_specular/specularColorFactor" },
    PointerRow{ "glossinessFactor", "extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor" },
    PointerRow{ "anisotropyStrength", "extensions/KHR_materials_anisotropy/anisotropyStrength" },
    PointerRow{ "iridescence", "extensions/KHR_materials_iridescence/iridescenceFactor" },
    PointerRow{ "iridescenceIor", "extensions/KHR_materials_iridescence/iridescenceIor" },
    PointerRow{ "diffuseTransmission", "extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor" },
    PointerRow{ "diffuseTransmissionColor",
                "extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor" },
    PointerRow{ "transmission", "extensions/KHR_materials_transmission/transmissionFactor" },
    PointerRow{ "dispersion", "extensions/KHR_materials_dispersion/dispersion" },
    PointerRow{ "multiscatterColor", "extensions/KHR_materials_volume_scatter/multiscatterColorFactor" },
    PointerRow{ "scatterAnisotropy", "extensions/KHR_materials_volume_scatter/scatterAnisotropy" },
};
constexpr std::array kMapPointers{
    PointerRow{ "baseColorMap", "pbrMetallicRoughness/baseColorTexture" },
    PointerRow{ "metallicRoughnessMap", "pbrMetallicRoughness/metallicRoughnessTexture" },
    PointerRow{ "normalMap", "normalTexture" },
    PointerRow{ "occlusionMap", "occlusionTexture" },
    PointerRow{ "emissiveMap", "emissiveTexture" },
    PointerRow{ "bumpMap", "extensions/EXT_materials_bump/bumpTexture" },
    PointerRow{ "clearCoatNormalMap", "extensions/KHR_materials_clearcoat/clearcoatNormalTexture" },
    PointerRow{ "anisotropyMap", "extensions/KHR_materials_anisotropy/anisotropyTexture" },
};

template <size_t N>
std::string_view pointerOf(std::array<PointerRow, N> const& rows, std::string_view parameter) {
    const auto found = std::ranges::find(rows, parameter, &PointerRow::parameter);
    return found == rows.end() ? std::string_view() : found->pointer;
}

size_t numbersIn(ParameterType type) {
    switch (type) {
    case ParameterType::Float:
        return 1;
    case ParameterType::Float2:
        return 2;
    case ParameterType::Float3:
        return 3;
    case ParameterType::Float4:
        return 4;
    default:
        return 0;
    }
}

/// Empty for other types, and for what the material does not have.
std::vector<double> valueOf(scene::MaterialInstance const& instance, std::string_view name) {
    shader::Parameter const* const parameter = instance.material->package.findParameter(name);
    if (!parameter || parameter->arraySize > 0) return {};
    std::vector<double> numbers;
    for (size_t i = 0; i < numbersIn(parameter->type); ++i) {
        float number;
        std::memcpy(&number, instance.parameters.data() + parameter->offset + i * sizeof number, sizeof number);
        numbers.push_back(static_cast<double>(number));
    }
    return numbers;
}

/// Whether the block of the instance has another value there.
bool differs(scene::MaterialInstance const& instance, const char* name, ParameterValue const& rest) {
    shader::Parameter const* const parameter = instance.material->package.findParameter(name);
    if (!parameter) return false;
    std::vector<std::byte> block = instance.parameters;
    return writeParameter(*instance.material, *parameter, rest, block).ok() && block != instance.parameters;
}

void addEmission(std::vector<double> const& color, std::vector<GltfMergeValue>& values) {
    const double most = *std::ranges::max_element(color), strength = std::max(most, 1.0);
    std::vector<double> factor = color;
    for (double& number : factor) number = std::clamp(number / strength, 0.0, 1.0);
    values.push_back({ "emissiveFactor", std::move(factor) });
    values.push_back({ "extensions/KHR_materials_emissive_strength/emissiveStrength", { strength } });
}

/// False: no value of glTF is this parameter.
bool addValue(std::string_view name, std::vector<double> const& value, assets::MaterialData const& data, float scale,
              std::vector<GltfMergeValue>& values) {
    const std::string gloss = "extensions/KHR_materials_pbrSpecularGlossiness/";
    if (value.empty()) return false;
    if (const std::string_view pointer = pointerOf(kPointers, name); !pointer.empty()) {
        values.push_back({ std::string(pointer), value });
    } else if (name == "baseColorFactor") {
        values.push_back(
                { data.specularGlossiness ? gloss + "diffuseFactor" : "pbrMetallicRoughness/baseColorFactor", value });
    } else if (name == "specularFactor") {
        values.push_back({ data.specularGlossiness ? gloss + "specularFactor"
                                                   : "extensions/KHR_materials_specular/specularFactor",
                           value });
    } else if (name == "emissiveFactor") {
        addEmission(value, values);
    } else if (name == "anisotropyRotation") {
        values.push_back({ "extensions/KHR_materials_anisotropy/anisotropyRotation",
                           { elementary::atan2(value[1], value[0]) } });
    } else if (name == "iridescenceThickness") {
        const std::string film = "extensions/KHR_materials_iridescence/iridescenceThickness";
        values.push_back({ film + "Minimum", { value[0] } });
        values.push_back({ film + "Maximum", { value[1] } });
    } else if (name == "thickness") {
        values.push_back(
                { "extensions/KHR_materials_volume/thicknessFactor", { value[0] / static_cast<double>(scale) } });
    } else if (name == "absorption") { // of one metre
        std::vector<double> color;
        for (const double number : value) color.push_back(elementary::exp(-number));
        values.push_back({ "extensions/KHR_materials_volume/attenuationDistance", { 1.0 } });
        values.push_back({ "extensions/KHR_materials_volume/attenuationColor", std::move(color) });
    } else {
        return false;
    }
    return true;
}

/// Loaders make levels of every image; a texture without them stays without.
Sampler samplerOf(Engine::Impl& engine, scene::TextureBinding const& binding) {
    Sampler sampler = binding.sampler;
    if (TextureState const* const texture = stateBehind(engine.textures, binding.texture);
        texture && texture->desc.levels == 1)
        sampler.mipFilter = MipFilter::None;
    return sampler;
}

} // namespace

void SavedMaterials::know(CopyOfModel const& copy, uint32_t source) {
    for (Model::Impl::InstanceOrigin const& origin : copy.model->origins) {
        const auto isSame = [&](Model::Impl::AnimatedMaterial const& material) {
            return std::ranges::find(material.instances, origin.instance, &Model::Impl::AnimatedInstance::instance) !=
                   material.instances.end();
        };
        const bool isAnimated = std::ranges::any_of(copy.model->animatedMaterials, isSame);
        for (const MaterialInstance instance : { origin.instance, copy.shown(origin.instance) })
            if (mContext.engine.instances.isLive(instance))
                mOrigins[&mContext.engine.instances.get(instance)] = { source, &origin, isAnimated };
    }
}

Result<SavedMaterial> SavedMaterials::find(scene::MaterialInstance const& instance) {
    if (const auto known = mKnown.find(&instance); known != mKnown.end()) return known->second;
    const auto origin = mOrigins.find(&instance);
    const Result<SavedMaterial> made = origin == mOrigins.end() ? own(instance) : ofFile(instance, origin->second);
    if (made) mKnown[&instance] = *made;
    return made;
}

Result<uint32_t> SavedMaterials::entryOf(scene::MaterialInstance const& instance) {
    const Result<SavedMaterial> saved = find(instance);
    if (!saved) return saved.error();
    if (saved->changed != kNone) return saved->changed;
    const auto next = static_cast<uint32_t>(mContext.merge.materials.size());
    const auto [entry, isNew] = mEntries.try_emplace({ saved->source, saved->material }, next);
    if (isNew) mContext.merge.materials.push_back({ .source = saved->source, .material = saved->material });
    return entry->second;
}

Result<SavedMaterial> SavedMaterials::ofFile(scene::MaterialInstance const& instance, Origin const& origin) {
    Model::Impl::InstanceOrigin const& rest = *origin.origin;
    const SavedMaterial unchanged{ .source = origin.source, .material = rest.material };
    if (origin.isAnimated) return unchanged; // its parameters are those of the last pose
    assets::GltfDocument const& document = mContext.sources[origin.source].document;
    const assets::MaterialData data =
            rest.material == kNone ? assets::MaterialData{} : document.materials[rest.material].values;
    GltfMergeMaterial changed{ .source = origin.source, .material = rest.material };
    GltfParameters parameters;
    readParameters(data, rest.vertices, rest.scale, parameters);
    for (auto const& [name, value] : parameters) {
        if (!differs(instance, name, value)) continue;
        if (!addValue(name, valueOf(instance, name), data, rest.scale, changed.values))
            mContext.warn("material '{}': its parameter '{}' was changed, and is not written: glTF has none like it",
                          instance.name, name);
    }
    const bool bothSides = instance.raster.cullingDisabled || instance.raster.culling == Culling::None;
    if (bothSides && !data.doubleSided) changed.values.push_back({ "doubleSided", { 1 }, true });
    size_t map = 0;
    for (shader::Parameter const& parameter : instance.material->package.parameters) {
        if (!shader::isTexture(parameter.type)) continue;
        const size_t at = map++;
        if (at >= rest.textures.size() || instance.textures[at].texture == rest.textures[at]) continue;
        const std::string_view pointer = pointerOf(kMapPointers, parameter.name);
        Result<std::optional<uint32_t>> image = imageOf(instance.textures[at], instance.name + "." + parameter.name);
        if (!image) return image.error();
        if (pointer.empty())
            mContext.warn(
                    "material '{}': its map '{}' was changed, and is not written: it shares a texture with another "
                    "map; give the file itself that image",
                    instance.name, parameter.name);
        else if (*image)
            changed.textures.emplace_back(
                    pointer, assets::TextureRef{ .image = **image,
                                                 .sampler = samplerOf(mContext.engine, instance.textures[at]) });
    }
    if (changed.values.empty() && changed.textures.empty()) return unchanged;
    mContext.merge.materials.push_back(std::move(changed));
    return SavedMaterial{ .changed = static_cast<uint32_t>(mContext.merge.materials.size() - 1) };
}

/// Nothing, with a warning, for what PNG does not hold.
Result<std::optional<uint32_t>> SavedMaterials::imageOf(scene::TextureBinding const& binding, std::string const& user) {
    TextureState const* const texture = stateBehind(mContext.engine.textures, binding.texture);
    const auto isBytes = [](Format format) { return format == Format::RGBA8 || format == Format::RGBA8Srgb; };
    if (!texture || texture->desc.type != TextureKind::Texture2D || !isBytes(texture->desc.format)) {
        mContext.warn("{}: its texture is not written: only 2D textures of 8 bits become images of the file", user);
        return std::optional<uint32_t>();
    }
    const uint64_t key = binding.texture.index();
    if (const auto known = mImages.find(key); known != mImages.end()) return std::optional(known->second);
    Result<std::vector<std::byte>> pixels = readBack(mContext.engine, *texture);
    if (!pixels) return pixels.error();
    Result<assets::GlbImage> image =
            assets::glbImageFromPixels(texture->name, texture->desc.width, texture->desc.height, *pixels);
    if (!image) return image.error();
    mContext.merge.images.push_back(std::move(*image));
    return std::optional(mImages[key] = static_cast<uint32_t>(mContext.merge.images.size() - 1));
}

/// By the names of the built-in materials' parameters, which other materials may have, too.
Result<SavedMaterial> SavedMaterials::own(scene::MaterialInstance const& instance) {
    scene::Material const& material = *instance.material;
    constexpr std::array kNoSurfaces{ "shadowCatcher", "litShadowCatcher", "wireframe" };
    if (std::ranges::find(kNoSurfaces, material.name) != kNoSurfaces.end()) {
        mContext.warn("renderables of material '{}' are not written: glTF has nothing like it", material.name);
        return SavedMaterial{ .isShown = false };
    }
    constexpr std::array kKnown{ "lit", "unlit", "litTextured", "unlitTextured", "litVertexColors", "vertexColors" };
    if (std::ranges::find(kKnown, material.name) == kKnown.end())
        mContext.warn("material '{}' is the program's own: only its parameters baseColor, metallic, roughness, "
                      "reflectance, emissive and baseColorMap are written; use a built-in material where it must look "
                      "the same",
                      material.name);
    GltfMergeMaterial saved{ .data = { .name = instance.name } };
    assets::MaterialData& data = saved.data;
    data.metallicFactor = 0;
    data.unlit = !material.isLit();
    data.doubleSided = instance.raster.cullingDisabled || instance.raster.culling == Culling::None;
    if (material.isBlended()) data.alphaMode = assets::AlphaMode::Blend;
    if (material.package.blending == shader::Blending::Masked) data.alphaMode = assets::AlphaMode::Mask;
    const auto number = [&](std::string_view name, float& to) {
        if (const std::vector<double> value = valueOf(instance, name); value.size() == 1)
            to = static_cast<float>(std::clamp(value[0], 0.0, 1.0));
    };
    for (const std::string_view name : { "baseColor", "baseColorFactor" })
        if (const std::vector<double> value = valueOf(instance, name); value.size() >= 3)
            for (size_t i = 0; i < value.size(); ++i)
                data.baseColorFactor[static_cast<int>(i)] = static_cast<float>(std::clamp(value[i], 0.0, 1.0));
    number("metallic", data.metallicFactor);
    number("roughness", data.roughnessFactor);
    number("_maskThreshold", data.alphaCutoff);
    float reflectance = 0.5f;
    number("reflectance", reflectance);
    if (reflectance != 0.5f && material.isLit()) { // f0 = 0.16 reflectance^2 = ((n - 1) / (n + 1))^2
        const double root = 0.4 * static_cast<double>(reflectance);
        saved.values.push_back({ "extensions/KHR_materials_ior/ior", { (1 + root) / (1 - root) } });
    }
    if (const std::vector<double> value = valueOf(instance, "emissive");
        value.size() == 3 && value != std::vector<double>(3, 0.0))
        addEmission(value, saved.values);
    size_t map = 0;
    for (shader::Parameter const& parameter : material.package.parameters) {
        if (!shader::isTexture(parameter.type)) continue;
        const size_t at = map++;
        if (parameter.name != "baseColorMap" || !stateBehind(mContext.engine.textures, instance.textures[at].texture))
            continue;
        Result<std::optional<uint32_t>> image = imageOf(instance.textures[at], instance.name + ".baseColorMap");
        if (!image) return image.error();
        if (*image) data.baseColor = { .image = **image, .sampler = samplerOf(mContext.engine, instance.textures[at]) };
    }
    mContext.merge.materials.push_back(std::move(saved));
    return SavedMaterial{ .changed = static_cast<uint32_t>(mContext.merge.materials.size() - 1) };
}

} // namespace filament_core::engine
