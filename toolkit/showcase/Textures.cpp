// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Textures.h"

#include "base/Assert.h"
#include "toolkit/showcase/Noise.h"

#include <filament_core/Color.h>

#include <glm/common.hpp>

#include <cmath>

namespace filament_core::showcase {
namespace {

std::byte code(float value) { return std::byte{ static_cast<uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f) }; }

/// `texel(uv)` gives four values in [0, 1]; uv is the texel's centre.
template <class Texel>
Picture paint(uint32_t size, Texel const& texel) {
    FILAMENT_ASSERT(size >= 8, "pictures have at least 8 x 8 texels");
    Picture picture{ .size = size, .pixels = std::vector<std::byte>(size_t(size) * size * 4) };
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const float4 value = texel((float2(x, y) + 0.5f) / static_cast<float>(size));
            for (int c = 0; c < 4; ++c) picture.pixels[(size_t(y) * size + x) * 4 + c] = code(value[c]);
        }
    }
    return picture;
}

/// From a height in texture widths; `height(uv)` tiles.
template <class Height>
Picture paintNormals(uint32_t size, Height const& height) {
    const float step = 1.0f / static_cast<float>(size);
    return paint(size, [&](float2 uv) {
        const float across = height(uv + float2(step, 0)) - height(uv - float2(step, 0));
        const float down = height(uv + float2(0, step)) - height(uv - float2(0, step));
        const float3 normal = normalize(float3(-across, down, 2 * step)); // +Y of the image is up, v is down
        return float4(normal * 0.5f + 0.5f, 1);
    });
}

float4 surface(float roughness, float metalness) { return { 1, roughness, metalness, 1 }; }

/// From a linear colour to the codes of a colour texture.
float4 encoded(float3 linear, float alpha = 1) { return { color::srgbFromLinear(linear), alpha }; }

struct BrickCell {
    float2 inside;    ///< distance to the nearest border, in texture widths, per axis
    float random = 0; ///< of this brick
};

constexpr int kBrickColumns = 4, kBrickRows = 8;

BrickCell brickAt(float2 uv) {
    const float row = std::floor(uv.y * kBrickRows);
    const float shifted = uv.x * kBrickColumns + (static_cast<int>(row) % 2 ? 0.5f : 0.0f);
    const float column = std::floor(shifted);
    const float2 cell{ shifted - column, uv.y * kBrickRows - row };
    const float2 toBorder = 0.5f - glm::abs(cell - 0.5f);
    const int wrappedColumn = (static_cast<int>(column) + kBrickColumns) % kBrickColumns;
    return { toBorder / float2(kBrickColumns, kBrickRows), cellRandom({ wrappedColumn, static_cast<int>(row) }, 7) };
}

/// 0 in the mortar, 1 on the brick, with worn edges.
float brickMask(float2 uv) {
    const float wear = 0.006f * fractalNoise(uv * 24.0f, { 24, 24 }, 3, 11);
    const float2 inside = brickAt(uv).inside;
    return glm::smoothstep(0.002f, 0.012f, std::min(inside.x, inside.y) - wear);
}

float2 wrapUnit(float2 uv) { return uv - glm::floor(uv); }

} // namespace

TextureSet brickTextures(uint32_t size) {
    TextureSet set;
    set.color = paint(size, [](float2 uv) {
        const float grain = fractalNoise(uv * 32.0f, { 32, 32 }, 4, 3);
        const float3 clay = glm::mix(float3(0.30f, 0.075f, 0.035f), float3(0.48f, 0.16f, 0.075f), brickAt(uv).random);
        const float3 mortar{ 0.50f, 0.47f, 0.42f };
        return encoded(glm::mix(mortar, clay, brickMask(uv)) * (0.65f + 0.7f * grain));
    });
    set.surface = paint(size, [](float2 uv) {
        return surface(glm::mix(0.95f, 0.62f + 0.2f * fractalNoise(uv * 32.0f, { 32, 32 }, 3, 4), brickMask(uv)), 0);
    });
    set.normal = paintNormals(size, [](float2 uv) {
        uv = wrapUnit(uv);
        return 0.010f * brickMask(uv) + 0.004f * fractalNoise(uv * 48.0f, { 48, 48 }, 3, 5);
    });
    return set;
}

TextureSet woodTextures(uint32_t size) {
    // Distance from a wavy axis in growth rings; fibres are noise stretched along v.
    const auto ring = [](float2 uv) {
        const float sway = fractalNoise(uv * float2(3, 2), { 3, 2 }, 3, 21);
        const float phase = 7.0f * std::abs(uv.x - 0.5f) + 2.5f * sway;
        const float tooth = phase - std::floor(phase);
        return tooth * tooth; // slow rise in early wood, sharp end in late wood
    };
    const auto fibre = [](float2 uv) { return fractalNoise(uv * float2(96, 3), { 96, 3 }, 3, 22); };
    TextureSet set;
    set.color = paint(size, [&](float2 uv) {
        const float3 early{ 0.42f, 0.21f, 0.085f }, late{ 0.14f, 0.052f, 0.018f };
        return encoded(glm::mix(early, late, 0.75f * ring(uv)) * (0.75f + 0.5f * fibre(uv)));
    });
    set.surface = paint(size, [&](float2 uv) { return surface(0.32f + 0.25f * fibre(uv) + 0.1f * ring(uv), 0); });
    return set;
}

TextureSet terrazzoTextures(uint32_t size) {
    constexpr int kCells = 14;
    const auto chip = [](CellularSample const& cell) {
        return glm::smoothstep(0.05f, 0.09f, cell.edgeDistance - 0.2f * cell.random);
    };
    TextureSet set;
    set.color = paint(size, [&](float2 uv) {
        const CellularSample cell = cellularNoise(uv * float(kCells), { kCells, kCells }, 31);
        const float3 stones[] = {
            { 0.52f, 0.48f, 0.42f }, { 0.20f, 0.21f, 0.22f }, { 0.40f, 0.24f, 0.17f }, { 0.62f, 0.60f, 0.56f }
        };
        const float3 cement =
                float3(0.36f, 0.35f, 0.335f) * (0.85f + 0.3f * fractalNoise(uv * 64.0f, { 64, 64 }, 3, 33));
        return encoded(glm::mix(cement, stones[static_cast<int>(cell.random * 4)], chip(cell)));
    });
    set.surface = paint(size, [&](float2 uv) {
        const CellularSample cell = cellularNoise(uv * float(kCells), { kCells, kCells }, 31);
        return surface(glm::mix(0.55f, 0.22f, chip(cell)) + 0.08f * fractalNoise(uv * 8.0f, { 8, 8 }, 3, 34), 0);
    });
    return set;
}

TextureSet checkerTextures(uint32_t size) {
    const auto isGold = [](float2 uv) { return (static_cast<int>(uv.x * 8) + static_cast<int>(uv.y * 8)) % 2 == 0; };
    TextureSet set;
    set.color = paint(size, [&](float2 uv) {
        return encoded(isGold(uv) ? float3(1.00f, 0.71f, 0.29f) : float3(0.012f, 0.012f, 0.014f));
    });
    set.surface = paint(size, [&](float2 uv) { return isGold(uv) ? surface(0.28f, 1) : surface(0.08f, 0); });
    return set;
}

TextureSet dimpleTextures(uint32_t size) {
    constexpr float kDimpleColumns = 8, kDimpleRows = 8;
    TextureSet set;
    set.normal = paintNormals(size, [](float2 uv) {
        const float2 wrapped = wrapUnit(uv);
        const float row = std::floor(wrapped.y * kDimpleRows);
        const float shifted = wrapped.x * kDimpleColumns + (static_cast<int>(row) % 2 ? 0.5f : 0.0f);
        const float2 cell{ shifted - std::floor(shifted) - 0.5f, wrapped.y * kDimpleRows - row - 0.5f };
        const float fromRim = 1 - glm::min(length(cell) / 0.46f, 1.0f);
        return -0.045f * glm::smoothstep(0.0f, 0.8f, fromRim);
    });
    return set;
}

TextureSet latticeTextures(uint32_t size) {
    constexpr float kHoles = 8;
    TextureSet set;
    set.color = paint(size, [](float2 uv) {
        const float2 cell = uv * kHoles - glm::floor(uv * kHoles) - 0.5f;
        // A ramp of half a hole's border, so that the cut at 0.5 stays smooth under filtering.
        const float alpha = glm::clamp((length(cell) - 0.38f) * 16.0f + 0.5f, 0.0f, 1.0f);
        return encoded({ 0.92f, 0.90f, 0.86f }, alpha);
    });
    return set;
}

TextureSet stainedGlassTextures(uint32_t size) {
    constexpr int kCells = 4;
    const auto glass = [](CellularSample const& cell) { return glm::smoothstep(0.045f, 0.06f, cell.edgeDistance); };
    TextureSet set;
    set.color = paint(size, [&](float2 uv) {
        const CellularSample cell = cellularNoise(uv * float(kCells), { kCells, kCells }, 41);
        const float3 colors[] = { { 0.60f, 0.03f, 0.03f },
                                  { 0.03f, 0.12f, 0.55f },
                                  { 0.75f, 0.42f, 0.03f },
                                  { 0.03f, 0.35f, 0.12f },
                                  { 0.35f, 0.05f, 0.40f } };
        const float3 lead{ 0.05f, 0.05f, 0.055f };
        const float isGlass = glass(cell);
        return encoded(glm::mix(lead, colors[static_cast<int>(cell.random * 5)], isGlass),
                       glm::mix(1.0f, 0.55f, isGlass));
    });
    set.surface = paint(size, [&](float2 uv) {
        return surface(glm::mix(0.5f, 0.06f, glass(cellularNoise(uv * float(kCells), { kCells, kCells }, 41))), 0);
    });
    return set;
}

TextureSet lavaTextures(uint32_t size) {
    constexpr int kCells = 6;
    const auto crack = [](float2 uv) {
        const float2 bent = uv * float(kCells) + 0.35f * (fractalNoise(uv * 12.0f, { 12, 12 }, 3, 53) - 0.5f);
        return 1 - glm::smoothstep(0.015f, 0.11f, cellularNoise(bent, { kCells, kCells }, 51).edgeDistance);
    };
    TextureSet set;
    set.color = paint(size, [](float2 uv) {
        return encoded(float3(0.035f, 0.030f, 0.028f) * (0.4f + 1.2f * fractalNoise(uv * 24.0f, { 24, 24 }, 4, 52)));
    });
    set.surface = paint(size, [](float2 uv) {
        return surface(0.7f + 0.3f * fractalNoise(uv * 24.0f, { 24, 24 }, 3, 54), 0);
    });
    set.emission = paint(size, [&](float2 uv) {
        const float heat = crack(uv);
        return encoded({ heat, 0.32f * heat * heat, 0.05f * heat * heat * heat });
    });
    return set;
}

TextureSet brushedTextures(uint32_t size) {
    TextureSet set;
    set.surface = paint(size, [](float2 uv) {
        return surface(0.18f + 0.34f * fractalNoise(uv * float2(2, 128), { 2, 128 }, 3, 61), 1);
    });
    return set;
}

} // namespace filament_core::showcase
