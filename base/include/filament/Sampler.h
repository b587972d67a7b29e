// SPDX-License-Identifier: Apache-2.0
/// Sampler: how a texture is read. A plain value; equal samplers share one device object.
#pragma once

#include <cstdint>

namespace filament {

enum class Filter : uint8_t { Nearest, Linear };
enum class MipFilter : uint8_t { None, Nearest, Linear };
enum class WrapMode : uint8_t { Repeat, MirroredRepeat, ClampToEdge };
/// `None`: an ordinary sampler without comparison.
enum class CompareOp : uint8_t { None, Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };

struct Sampler {
    Filter magFilter = Filter::Nearest;
    Filter minFilter = Filter::Nearest;
    MipFilter mipFilter = MipFilter::None;
    WrapMode wrapU = WrapMode::ClampToEdge;
    WrapMode wrapV = WrapMode::ClampToEdge;
    WrapMode wrapW = WrapMode::ClampToEdge;
    CompareOp compare = CompareOp::None;
    uint8_t anisotropy = 1; ///< 1..16
    friend bool operator==(Sampler const&, Sampler const&) = default;
};

} // namespace filament
