// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfParseMaterial.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/gltf/GltfExtensions.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr std::string_view kIesMimeType = "application/x-ies-lm-63";

/// matrixFrom(UvPlacement) of the numbers of the file, unrounded.
float3x3 textureTransform(std::array<double, 2> offset, double rotation, std::array<double, 2> scale) {
    const double c = elementary::cos(rotation), s = elementary::sin(rotation);
    return { float3(c * scale[0], -s * scale[0], 0), float3(s * scale[1], c * scale[1], 0),
             float3(offset[0], offset[1], 1) };
}

AlphaMode parseAlphaMode(JsonNode const& node) {
    if (!node.exists()) return AlphaMode::Opaque;
    const std::string text = node.text();
    if (text == "MASK") return AlphaMode::Mask;
    if (text == "BLEND") return AlphaMode::Blend;
    if (text != "OPAQUE") node.diagnostics().warn("{}: '{}' is unknown and is drawn opaque", node.path(), text);
    return AlphaMode::Opaque;
}

backend::WrapMode parseWrap(JsonNode const& node) {
    switch (node.integer(10497)) {
    case 33071:
        return backend::WrapMode::ClampToEdge;
    case 33648:
        return backend::WrapMode::MirroredRepeat;
    case 10497:
        return backend::WrapMode::Repeat;
    default:
        node.diagnostics().warn("{}: unknown, repeats", node.path());
        return backend::WrapMode::Repeat;
    }
}

} // namespace

float3x3 matrixFrom(UvPlacement const& placement) {
    const glm::dvec2 offset(placement.offset), scale(placement.scale);
    return textureTransform({ offset.x, offset.y }, static_cast<double>(placement.rotationRadians),
                            { scale.x, scale.y });
}

GltfTextureInfo parseTextureInfo(JsonNode const& node, size_t textureCount) {
    GltfTextureInfo info;
    if (!node.exists()) return info;
    info.texture = node["index"].requiredIndex(textureCount, "textures");
    uint64_t uvSet = node["texCoord"].integer(0);
    if (const JsonNode transform = node.extension("KHR_texture_transform"); transform.exists()) {
        std::array<double, 2> offset{ 0, 0 }, scale{ 1, 1 };
        transform["offset"].numbers(offset);
        transform["scale"].numbers(scale);
        const double rotation = transform["rotation"].number(0);
        info.uvTransform = textureTransform(offset, rotation, scale);
        info.placement = { float2(offset[0], offset[1]), static_cast<float>(rotation), float2(scale[0], scale[1]) };
        info.hasTransform = info.uvTransform != float3x3(1.0f);
        uvSet = transform["texCoord"].integer(uvSet);
    }
    info.uvSet = static_cast<uint32_t>(std::min<uint64_t>(uvSet, kNone - 1)); // GltfUvSets.h chooses among them
    return info;
}

GltfMaterial parseGltfMaterial(JsonNode const& node, size_t textureCount) {
    GltfMaterial material;
    MaterialData& values = material.values;
    values.name = node["name"].label();
    const JsonNode core = node["pbrMetallicRoughness"];
    const auto base = parseFactors<4>(core["baseColorFactor"], 1, 0, 1);
    values.baseColorFactor = { base[0], base[1], base[2], base[3] };
    values.metallicFactor = core["metallicFactor"].numberInRange(1, 0, 1);
    values.roughnessFactor = core["roughnessFactor"].numberInRange(1, 0, 1);
    const auto emissive = parseFactors<3>(node["emissiveFactor"], 0, 0, 1);
    values.emissiveFactor = { emissive[0], emissive[1], emissive[2] };
    values.emissiveStrength =
            node.extension("KHR_materials_emissive_strength")["emissiveStrength"].numberInRange(1, 0, kMaxFloat);
    values.normalScale = node["normalTexture"]["scale"].numberInRange(1, -kMaxFloat, kMaxFloat);
    values.occlusionStrength = node["occlusionTexture"]["strength"].numberInRange(1, 0, 1);
    values.alphaMode = parseAlphaMode(node["alphaMode"]);
    values.alphaCutoff = node["alphaCutoff"].numberInRange(0.5f, 0, kMaxFloat);
    values.doubleSided = node["doubleSided"].boolean(false);
    material.baseColor = parseTextureInfo(core["baseColorTexture"], textureCount);
    material.metallicRoughness = parseTextureInfo(core["metallicRoughnessTexture"], textureCount);
    material.normal = parseTextureInfo(node["normalTexture"], textureCount);
    material.occlusion = parseTextureInfo(node["occlusionTexture"], textureCount);
    material.emissive = parseTextureInfo(node["emissiveTexture"], textureCount);
    parseMaterialExtensions(node, textureCount, material);
    return material;
}

/// Section 3.8.4: OpenGL's numbers. If filters are missing, the choice is ours: trilinear.
Sampler parseGltfSampler(JsonNode const& node) {
    struct MinFilter {
        uint64_t number;
        Filter filter;
        MipFilter mips;
    };
    static constexpr MinFilter kMinFilters[] = {
        { 9728, Filter::Nearest, MipFilter::None },    { 9729, Filter::Linear, MipFilter::None },
        { 9984, Filter::Nearest, MipFilter::Nearest }, { 9985, Filter::Linear, MipFilter::Nearest },
        { 9986, Filter::Nearest, MipFilter::Linear },  { 9987, Filter::Linear, MipFilter::Linear },
    };
    Sampler sampler;
    sampler.magFilter = node["magFilter"].integer(9729) == 9728 ? Filter::Nearest : Filter::Linear;
    auto const* found = std::ranges::find(kMinFilters, node["minFilter"].integer(9987), &MinFilter::number);
    if (found == std::end(kMinFilters)) {
        node.diagnostics().warn("{}.minFilter: unknown, trilinear is used", node.path());
        --found;
    }
    sampler.minFilter = found->filter;
    sampler.mipFilter = found->mips;
    sampler.wrapU = parseWrap(node["wrapS"]);
    sampler.wrapV = parseWrap(node["wrapT"]);
    return sampler;
}

GltfProfile parseGltfProfile(JsonNode const& node, size_t viewCount) {
    GltfProfile profile{ node["name"].label(), node["uri"].text(), node["bufferView"].index(viewCount, "bufferViews") };
    if (profile.uri.empty() == (profile.view == kNone)) {
        node.diagnostics().refuse(ErrorCode::Corrupt, "{}: needs a uri or a bufferView, and not both", node.path());
    }
    const std::string mime = node["mimeType"].text();
    if ((profile.view != kNone || !mime.empty()) && mime != kIesMimeType) {
        node.diagnostics().refuse(ErrorCode::Unsupported, "{}.mimeType: '{}' must be '{}'", node.path(), mime,
                                  kIesMimeType);
    }
    return profile;
}

std::optional<GltfProfiledLight> parseGltfProfiledLight(JsonNode const& node, size_t profileCount) {
    if (!node.exists()) return std::nullopt;
    const auto color = parseFactors<3>(node["color"], 1, 0, 1);
    return GltfProfiledLight{ .profile = node["light"].requiredIndex(profileCount, "EXT_lights_ies.lights"),
                              .multiplier = node["multiplier"].numberInRange(1, 0, kMaxFloat),
                              .color = { color[0], color[1], color[2] } };
}

void checkExtensions(JsonNode const& root, Diagnostics& diagnostics) {
    std::vector<std::string> required;
    for (JsonNode const& node : root["extensionsRequired"].elements()) {
        required.push_back(node.text());
        if (isSupportedGltfExtension(required.back())) continue;
        diagnostics.refuse(ErrorCode::Unsupported,
                           "extension {} is required by the file but not supported; export the model without it",
                           required.back());
    }
    for (JsonNode const& node : root["extensionsUsed"].elements()) {
        const std::string name = node.text();
        const bool wasNamed = std::find(required.begin(), required.end(), name) != required.end();
        if (!isSupportedGltfExtension(name) && !wasNamed)
            diagnostics.warn("extension {} is not supported and is ignored", name);
    }
}

} // namespace filament_core::assets
