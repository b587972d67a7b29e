// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialPictures.h"

#include "base/Result.h"
#include "base/math/Math.h"
#include "toolkit/showcase/Textures.h"

#include <cmath>
#include <functional>

namespace filament_core::tools {
namespace {

constexpr uint32_t kSize = 128;
constexpr Sampler kTrilinear{ .magFilter = Filter::Linear,
                              .minFilter = Filter::Linear,
                              .mipFilter = MipFilter::Linear,
                              .wrapU = WrapMode::Repeat,
                              .wrapV = WrapMode::Repeat };
constexpr Sampler kBilinear{ .magFilter = Filter::Linear,
                             .minFilter = Filter::Linear,
                             .mipFilter = MipFilter::None,
                             .wrapU = WrapMode::ClampToEdge,
                             .wrapV = WrapMode::ClampToEdge };

std::byte code(float value) { return std::byte{ static_cast<uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255 + 0.5f) }; }

/// `texel(uv)` in [0, 1]^4; row 0 at the top, v = 0 there.
template <class Texel>
std::vector<std::byte> paint(uint32_t size, Texel const& texel) {
    std::vector<std::byte> pixels;
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const float4 value = texel((float2(x, y) + 0.5f) / static_cast<float>(size));
            for (int c = 0; c < 4; ++c) pixels.push_back(code(value[c]));
        }
    }
    return pixels;
}

MaterialPicture upload(Engine& engine, TextureDesc desc, std::span<const std::byte> pixels, Sampler const& sampler) {
    desc.pixels = pixels;
    return { engine.own(engine.create(desc)), sampler };
}

MaterialPicture flat(Engine& engine, std::string const& name, uint32_t size, std::span<const std::byte> pixels,
                     bool isColor) {
    return upload(engine,
                  { .format = isColor ? Format::RGBA8Srgb : Format::RGBA8,
                    .width = size,
                    .height = size,
                    .generateMips = true,
                    .name = name },
                  pixels, kTrilinear);
}

/// Rolling hills that tile: height in [0, 1].
float hills(float2 uv) { return 0.5f + 0.25f * (std::cos(2 * kPi * 4 * uv.x) + std::cos(2 * kPi * 4 * uv.y)); }

float4 hillNormal(float2 uv) {
    constexpr float kDepth = 0.06f, kStep = 1.0f / 512;
    const float across = hills(uv + float2(kStep, 0)) - hills(uv - float2(kStep, 0));
    const float down = hills(uv + float2(0, kStep)) - hills(uv - float2(0, kStep));
    const float3 n = glm::normalize(float3(-across * kDepth, down * kDepth, 2 * kStep)); // +y is up, v down
    return float4(n * 0.5f + 0.5f, 1);
}

float4 swirl(float2 uv) {
    const float2 d = float2(uv.x, 1 - uv.y) - 0.5f;
    const float length = std::max(glm::length(d), 1e-3f);
    return { 0.5f - 0.5f * d.y / length, 0.5f + 0.5f * d.x / length, 0.5f, 1 };
}

using Painter = float4 (*)(float2);
struct Painted {
    std::string_view name;
    Painter texel;
};
constexpr Painted kPainted[] = {
    { "waves/height", [](float2 uv) { return float4(float3(hills(uv)), 1); } },
    { "waves/normal", hillNormal },
    { "waves/occlusion", [](float2 uv) { return float4(float3(0.15f + 0.85f * hills(uv)), 1); } },
    { "swirl/direction", swirl },
    { "wedge/thickness", [](float2 uv) { return float4(float3(uv.x), 1); } },
};

struct Set {
    std::string_view name;
    showcase::TextureSet (*make)(uint32_t size);
};
constexpr Set kSets[] = {
    { "brick", showcase::brickTextures },        { "wood", showcase::woodTextures },
    { "terrazzo", showcase::terrazzoTextures },  { "checker", showcase::checkerTextures },
    { "dimple", showcase::dimpleTextures },      { "lattice", showcase::latticeTextures },
    { "glass", showcase::stainedGlassTextures }, { "lava", showcase::lavaTextures },
    { "brushed", showcase::brushedTextures },
};

showcase::Picture const* pictureOf(showcase::TextureSet const& set, std::string_view kind) {
    if (kind == "color") return &set.color;
    if (kind == "normal") return &set.normal;
    if (kind == "surface") return &set.surface;
    return kind == "emission" ? &set.emission : nullptr;
}

MaterialPicture gradientCube(Engine& engine, std::string const& name) {
    constexpr uint32_t kSide = 16;
    std::vector<std::byte> pixels;
    for (int face = 0; face < 6; ++face) {
        const float3 tint(face % 2 ? 0.2f : 0.9f, face / 2 % 2 ? 0.8f : 0.3f, face / 4 ? 0.9f : 0.4f);
        const auto own = paint(kSide, [&](float2 uv) { return float4(tint * (0.4f + 0.6f * uv.y), 1); });
        pixels.insert(pixels.end(), own.begin(), own.end());
    }
    return upload(engine, { .kind = TextureKind::Cube, .width = kSide, .height = kSide, .layers = 6, .name = name },
                  pixels, kBilinear);
}

MaterialPicture stripeLayers(Engine& engine, std::string const& name) {
    constexpr uint32_t kSide = 32, kLayers = 3;
    std::vector<std::byte> pixels;
    for (uint32_t layer = 0; layer < kLayers; ++layer) {
        const auto own = paint(kSide, [&](float2 uv) {
            const float at = layer == 0 ? uv.x : layer == 1 ? uv.y : uv.x + uv.y;
            float4 color(0.08f, 0.08f, 0.08f, 1);
            if (std::fmod(at * 4, 1.0f) < 0.5f) color[static_cast<int>(layer)] = 0.9f;
            return color;
        });
        pixels.insert(pixels.end(), own.begin(), own.end());
    }
    return upload(
            engine,
            { .kind = TextureKind::Texture2DArray, .width = kSide, .height = kSide, .layers = kLayers, .name = name },
            pixels, kBilinear);
}

/// In [0, 1), without a table and of integers only: the same on every machine.
float noiseAt(uint3 cell) {
    uint32_t bits = cell.x * 0x8DA6B343u ^ cell.y * 0xD8163841u ^ cell.z * 0xCB1AB31Fu;
    bits = (bits ^ bits >> 15) * 0x2C1B3C6Du;
    bits = (bits ^ bits >> 12) * 0x297A2D39u;
    return static_cast<float>((bits ^ bits >> 15) >> 8) / 16'777'216.0f;
}

/// Value noise: `cells` along each axis, which repeat.
float noise(float3 at, uint32_t cells) {
    const float3 scaled = at * static_cast<float>(cells), floor = glm::floor(scaled);
    const float3 t = (scaled - floor) * (scaled - floor) * (3.0f - 2.0f * (scaled - floor));
    float sum = 0;
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const uint3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const float3 weight = glm::mix(1.0f - t, t, float3(step));
        sum += weight.x * weight.y * weight.z * noiseAt((uint3(floor) + step) % cells);
    }
    return sum;
}

/// Marble: dark veins where a slanted wave, bent by noise, turns; smoother there.
MaterialPicture veinsVolume(Engine& engine, std::string const& name) {
    constexpr uint32_t kSide = 32;
    std::vector<std::byte> pixels;
    for (uint32_t z = 0; z < kSide; ++z) {
        const auto slice = paint(kSide, [&](float2 uv) {
            const float3 at(uv, (static_cast<float>(z) + 0.5f) / kSide);
            const float wave = at.x + at.y + at.z + 0.5f * noise(at, 4) + 0.25f * noise(at, 8);
            const float vein = std::abs(2 * (2 * wave - std::floor(2 * wave)) - 1); // 0 in the middle of a vein
            const float stone = glm::clamp(vein * 3, 0.0f, 1.0f);
            return float4(glm::mix(float3(0.12f, 0.10f, 0.14f), float3(0.85f, 0.80f, 0.72f), stone),
                          0.2f + 0.4f * stone);
        });
        pixels.insert(pixels.end(), slice.begin(), slice.end());
    }
    return upload(engine,
                  { .kind = TextureKind::Texture3D, .width = kSide, .height = kSide, .layers = kSide, .name = name },
                  pixels, { .magFilter = Filter::Linear, .minFilter = Filter::Linear, .mipFilter = MipFilter::None });
}

/// 0 to 63 along u.
MaterialPicture wholeNumbers(Engine& engine, std::string const& name, Format format) {
    std::vector<std::byte> pixels;
    for (uint32_t x = 0; x < 64; ++x) pixels.push_back(static_cast<std::byte>(x));
    return upload(engine, { .format = format, .width = 64, .name = name }, pixels, kUnfilteredSampler);
}

} // namespace

Result<MaterialPicture> makeMaterialPicture(Engine& engine, std::string const& name) {
    for (Painted const& painted : kPainted) {
        if (painted.name == name) return flat(engine, name, kSize, paint(kSize, painted.texel), false);
    }
    const size_t slash = name.find('/');
    const std::string kind = slash == std::string::npos ? "" : name.substr(slash + 1);
    for (Set const& set : kSets) {
        if (set.name != std::string_view(name).substr(0, slash)) continue;
        const showcase::TextureSet made = set.make(kSize);
        showcase::Picture const* picture = pictureOf(made, kind);
        if (!picture || picture->size == 0) break;
        return flat(engine, name, picture->size, picture->pixels, kind == "color" || kind == "emission");
    }
    if (name == "gradient/cube") return gradientCube(engine, name);
    if (name == "stripes/layers") return stripeLayers(engine, name);
    if (name == "veins/volume") return veinsVolume(engine, name);
    if (name == "numbers/int") return wholeNumbers(engine, name, Format::R8I);
    if (name == "numbers/uint") return wholeNumbers(engine, name, Format::R8UI);
    return fail(ErrorCode::NotFound,
                "there is no picture '{}': brick, wood, terrazzo, checker, dimple, lattice, glass, lava or brushed and "
                "/color, /normal, /surface or /emission; waves/height, waves/normal, waves/occlusion, swirl/direction, "
                "wedge/thickness, gradient/cube, stripes/layers, veins/volume, numbers/int, numbers/uint",
                name);
}

} // namespace filament_core::tools
