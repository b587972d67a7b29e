// SPDX-License-Identifier: Apache-2.0
/// SplatCloud: 3D Gaussians that are drawn as one picture of a place, from a glTF file (KHR_gaussian_splatting) or from
/// numbers. RenderableDesc::splats shows it, at any number of places.
///   Shown   over the sky and opaque surfaces, which hide what lies behind them; under transparent objects, and seen
///           through refractive ones. All clouds of a view blend together, farthest splats first, by the distance
///           of their centres from the camera. They are not lit, cast no shadows, and leave no depth.
///   Colours are what the cloud was trained with: display-referred, and not changed by exposure. They enter the
///           picture as those of unlit materials do, before tone mapping; ToneMapper::Linear shows them as they are.
///   Memory  40 bytes a splat, and 12 a coefficient; shared by copies of the object. A frame takes 150 bytes for each
///           splat of the clouds in view, and 96 on the device for each one that is visible.
///   Limits  2^24 visible splats: the nearest ones. A centre before the near plane hides its splat.
///   Thread  any; values that never change.
///   Fails   InvalidArgument, OutOfMemory: cloud, splat, number, and what is valid.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace filament_core {

namespace scene {
struct SplatData;
}

/// What colours are encoded in. Splats of one encoding blend as encoded, and the result is decoded, as in training.
enum class SplatColors : uint8_t {
    Srgb,   ///< Rec. 709 with the transfer function of sRGB
    Linear, ///< Rec. 709, linear
};

/// All lists but `harmonics` have one element per splat, of which there is at least one. They are copied.
struct SplatCloudDesc {
    std::span<const float3> positions{}; ///< of the centres, in object space, in metres
    std::span<const float4> rotations{}; ///< quaternions x, y, z, w, of any length but 0; object space from the splat's
    std::span<const float3> scales{};    ///< standard deviations along the splat's axes, in metres; [0, 1e15]
    std::span<const float> opacities{};  ///< of the centres, [0, 1]
    uint32_t degree = 0;                 ///< of the spherical harmonics, [0, 3]
    /// (degree + 1)^2 colours per splat: coefficients of the real spherical harmonics with the Condon-Shortley phase,
    /// by degree l, then by order from -l to l, of the direction from the camera to the splat in object space. The
    /// colour is their sum + 0.5, at least 0.
    std::span<const float3> harmonics{};
    SplatColors colors = SplatColors::Srgb;
    std::string name{};
};

class SplatCloud {
public:
    SplatCloud() = default; ///< none
    static Result<SplatCloud> create(SplatCloudDesc const& desc);

    explicit operator bool() const { return mData != nullptr; }
    size_t count() const; ///< of splats

    explicit SplatCloud(std::shared_ptr<const scene::SplatData> data) : mData(std::move(data)) {}
    std::shared_ptr<const scene::SplatData> const& data() const { return mData; }

private:
    std::shared_ptr<const scene::SplatData> mData;
};

} // namespace filament_core
