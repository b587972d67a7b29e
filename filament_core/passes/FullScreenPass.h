// SPDX-License-Identifier: Apache-2.0
/// FullScreenPass: draws a material of the domain postprocess over every pixel of a target. An effect is one .mat file
/// and one call:
///
///   FullScreenInput inputs[] = { { .name = "color", .texture = hdr }, { .name = "dirt", .image = dirt } };
///   FullScreenValue values[] = { { "strength", 0.04f } };
///   addFullScreenPass(graph, context, { "bloom", bloom, inputs, values, half });
///
///   Inputs  A currentPixel input is a subpass input if the graph can merge the pass with the one that wrote it;
///           otherwise it is sampled. The material contains both forms, and both give the same bits.
///   Target  getResolution() and getNormalizedUV() use the size of the level that is drawn to.
///   Checks  checkFullScreenMaterial(), once, when the material is loaded: names, types and domain. Later, a name that
///           was not checked is a bug and asserts.
///   Thread  the app thread.   Memory: the arena of the graph. A steady frame allocates nothing.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FullScreenInterface.h"

#include <filament_core/Objects.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

namespace filament_core::passes {

struct FullScreenInput {
    std::string_view name{};          ///< of the parameter
    framegraph::TextureId texture{};  ///< a texture of the graph, or
    backend::TextureHandle image{};   ///< a texture that the graph does not know: a table, noise, or
                                      ///< neither: a 2D texture that this material's constants leave unread
    backend::SamplerHandle sampler{}; ///< none: the nearest texel
    backend::TextureRange range{};    ///< of `texture`; for a level that is read while another one is drawn to
};

struct FullScreenValue {
    std::string_view name;
    ParameterValue value;
};

static_assert(std::is_same_v<std::variant_alternative_t<static_cast<size_t>(ParameterType::Float4x4), ParameterValue>,
                             float4x4>,
              "values have the types of ParameterType, in their order");

/// FullScreenInterface::values of a pass that gives these: names and types then stand in one place.
template <size_t N>
std::array<FullScreenParameter, N> parametersOf(std::array<FullScreenValue, N> const& values) {
    std::array<FullScreenParameter, N> parameters;
    std::transform(values.begin(), values.end(), parameters.begin(), [](FullScreenValue const& one) {
        return FullScreenParameter{ one.name, static_cast<ParameterType>(one.value.index()) };
    });
    return parameters;
}

/// A part of the target, with values of its own.
struct FullScreenTile {
    backend::Rect rect; ///< pixels of the level that is drawn to
    std::span<const FullScreenValue> values{};
    scene::Material const* material = nullptr; ///< none: that of the pass; otherwise one of the same package, which may
                                               ///< leave inputs of the pass unread
};

/// The pixels of a target around `inside`, which lies in it; some rectangles may be empty.
std::array<backend::Rect, 4> rectsAround(backend::Rect const& inside, uint2 size);

struct FullScreenPass {
    std::string_view name;
    scene::Material const& material;
    std::span<const FullScreenInput> inputs{};
    std::span<const FullScreenValue> values{};
    std::span<const std::byte> block{}; ///< instead of values: all of the material's parameters, as they are stored
    framegraph::TextureId target{};
    framegraph::TextureId resolve{};                 ///< of a target with several samples a pixel: receives their mean
    uint8_t level = 0;                               ///< of the target
    uint16_t layer = 0;                              ///< of the target
    std::span<const framegraph::TextureId> others{}; ///< attachments 1, 2, ...: level 0 of textures of its size
    std::span<const FullScreenTile> tiles{}; ///< only these are drawn, with their own values; none: all of the target
    bool fillsTarget = false;                ///< the tiles do: what the target holds need not be kept
    bool clears = false; ///< what lies outside of the tiles becomes `clearColor`; otherwise it keeps its contents
    float4 clearColor{ 0 };
};

framegraph::PassId addFullScreenPass(framegraph::FrameGraph& graph, FrameContext const& context,
                                     FullScreenPass const& pass);

} // namespace filament_core::passes
