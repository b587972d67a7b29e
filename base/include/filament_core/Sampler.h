// SPDX-License-Identifier: Apache-2.0
/// Sampler: how a material reads a texture. A plain value; equal samplers share one device object.
///   Default  trilinear and repeating, as glTF and other engines read the textures of materials. A texture without mips
///            is then read bilinearly. Integer textures are read without filters, whatever their sampler says.
#pragma once

#include <cstdint>

namespace filament_core {

enum class Filter : uint8_t { Nearest, Linear };
enum class MipFilter : uint8_t { None, Nearest, Linear };
enum class WrapMode : uint8_t { Repeat, MirroredRepeat, ClampToEdge };

struct Sampler {
    Filter magFilter = Filter::Linear;
    Filter minFilter = Filter::Linear;
    MipFilter mipFilter = MipFilter::Linear;
    WrapMode wrapU = WrapMode::Repeat;
    WrapMode wrapV = WrapMode::Repeat;
    uint8_t anisotropy = 1; ///< 1..16
    friend bool operator==(Sampler const&, Sampler const&) = default;
};

/// Single texels up to the edge: tables, pixel art, images shown pixel by pixel.
inline constexpr Sampler kUnfilteredSampler{ .magFilter = Filter::Nearest,
                                             .minFilter = Filter::Nearest,
                                             .mipFilter = MipFilter::None,
                                             .wrapU = WrapMode::ClampToEdge,
                                             .wrapV = WrapMode::ClampToEdge };

} // namespace filament_core
