// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/CheckAsset.h"

#include "base/math/Half.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/image/ChannelTransfer.h"
#include "shaders/lib/LibCpp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::tools {
namespace {

using assets::kNone;
using assets::MaterialData;
using assets::TextureRef;

/// The first level of a map, read at the nearest texel. Without an image: 1.
class MapReader {
public:
    MapReader(assets::ModelData const& model, TextureRef const& map) : mMap(map) {
        if (map.image != kNone) mImage = &model.images[map.image];
    }

    uint2 size() const { return mImage ? uint2(mImage->width, mImage->height) : uint2(1); }

    float4 at(float2 uv) const {
        if (!mImage) return float4(1.0f);
        const float3 placed = mMap.uvTransform * float3(uv, 1);
        const uint32_t x = texelOf(placed.x, mMap.sampler.wrapU, mImage->width);
        const uint32_t y = texelOf(placed.y, mMap.sampler.wrapV, mImage->height);
        return texel(size_t{ y } * mImage->width + x);
    }

private:
    static uint32_t texelOf(float coordinate, WrapMode wrap, uint32_t size) {
        const double whole = std::floor(static_cast<double>(coordinate));
        double inside = coordinate - whole;
        if (wrap == WrapMode::ClampToEdge) inside = std::clamp<double>(coordinate, 0, 1);
        if (wrap == WrapMode::MirroredRepeat && std::fmod(whole, 2) != 0) inside = 1 - inside;
        if (!(inside >= 0)) return 0; // NaN of coordinates that are infinite
        return std::min(static_cast<uint32_t>(inside * size), size - 1);
    }

    float4 texel(size_t index) const {
        float4 value(0.0f);
        if (mImage->format == backend::Format::RGBA16F) {
            std::array<uint16_t, 4> halves{};
            std::memcpy(halves.data(), &mImage->data[index * sizeof halves], sizeof halves);
            for (int c = 0; c < 4; ++c) value[c] = floatFromHalf(halves[static_cast<size_t>(c)]);
            return value;
        }
        const bool isColor = mImage->format == backend::Format::RGBA8Srgb;
        for (int c = 0; c < 4; ++c) {
            const auto code = std::to_integer<uint8_t>(mImage->data[index * 4 + static_cast<size_t>(c)]);
            value[c] = isColor && c < 3 ? static_cast<float>(assets::colorTransfer().linearFromCode[code]) / 65535.0f
                                        : static_cast<float>(code) / 255.0f;
        }
        return value;
    }

    TextureRef const& mMap;
    assets::Image const* mImage = nullptr;
};

/// Of dielectrics: KHR_materials_ior and the factors of KHR_materials_specular.
float f0Of(MaterialData const& material) {
    float f0 = shader::lib::f0FromIor(material.ior);
    if (!material.specular.isUsed()) return f0;
    float3 const& color = material.specular.color;
    return f0 * material.specular.factor * std::max({ color.x, color.y, color.z });
}

bool isInvisible(MaterialData const& material, float alpha) {
    if (material.alphaMode == assets::AlphaMode::Mask) return alpha < material.alphaCutoff;
    return material.alphaMode == assets::AlphaMode::Blend && alpha <= 0;
}

std::string lineOf(std::string const& name, uint64_t texels, uint64_t broken, PlausibilityRule rule) {
    const double percent = 100.0 * static_cast<double>(broken) / static_cast<double>(texels);
    const std::string share = percent < 0.1 ? "less than 0.1" : fmt::format("{:.1f}", percent);
    return fmt::format("{}: {} % of its texels: {}: {}\n", name, share, toString(rule), meaningOf(rule));
}

} // namespace

bool AssetFindings::isPlausible() const {
    return std::ranges::all_of(materials, [](MaterialFindings const& each) { return each.broken[0] == each.texels; });
}

MaterialFindings checkMaterial(assets::ModelData const& model, uint32_t index) {
    MaterialData const& material = model.materials[index];
    MaterialFindings findings{ .name = material.name.empty() ? fmt::format("material {}", index)
                                                             : fmt::format("material '{}'", material.name) };
    findings.isChecked = !material.unlit && !material.specularGlossiness;
    if (!findings.isChecked) return findings;
    const MapReader color(model, material.baseColor), surface(model, material.metallicRoughness),
            emission(model, material.emissive);
    const uint2 size = glm::max(glm::max(color.size(), surface.size()), emission.size());
    const float f0 = f0Of(material);
    const float3 emitted = material.emissiveFactor * material.emissiveStrength;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const float2 uv = (float2(float(x), float(y)) + 0.5f) / float2(float(size.x), float(size.y));
            const float4 base = color.at(uv) * material.baseColorFactor;
            if (isInvisible(material, base.w)) continue;
            const float metallic = surface.at(uv).z * material.metallicFactor;
            const float rule =
                    shader::lib::implausibleRule(float3(base), metallic, f0, float3(emission.at(uv)) * emitted);
            ++findings.broken[static_cast<size_t>(rule)];
            ++findings.texels;
        }
    }
    return findings;
}

Result<AssetFindings> checkAsset(std::filesystem::path const& model, assets::FilesFrom files) {
    if (model.empty() || (model.extension() != ".gltf" && model.extension() != ".glb"))
        return fail(ErrorCode::InvalidArgument, "--check-asset: '{}' is not a .gltf or .glb; name the model to check",
                    model.string());
    jobs::JobSystem jobs;
    Result<assets::ModelData> loaded = assets::loadGltf(model, jobs, { .files = files });
    if (!loaded) return loaded.error();
    AssetFindings findings{ .file = model.filename().string(),
                            .materials = {},
                            .warnings = std::move(loaded->warnings) };
    for (uint32_t i = 0; i < loaded->materials.size(); ++i) findings.materials.push_back(checkMaterial(*loaded, i));
    return findings;
}

std::string textOf(AssetFindings const& findings) {
    std::string text;
    size_t implausible = 0, unchecked = 0;
    for (MaterialFindings const& each : findings.materials) {
        if (!each.isChecked) text += each.name + ": not checked: it is unlit, or has specular colour and glossiness\n";
        unchecked += each.isChecked ? 0 : 1;
        implausible += each.broken[0] == each.texels ? 0 : 1;
        for (size_t rule = 1; rule < kPlausibilityRules; ++rule) {
            if (each.broken[rule] > 0)
                text += lineOf(each.name, each.texels, each.broken[rule], static_cast<PlausibilityRule>(rule));
        }
    }
    return text + fmt::format("{}: {} materials: {} with values that no real material has, {} not checked\n",
                              findings.file, findings.materials.size(), implausible, unchecked);
}

} // namespace filament_core::tools
