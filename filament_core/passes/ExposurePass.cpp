// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ExposurePass.h"

#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kSampleInputs[] = { "color" };
constexpr FullScreenInterface kSamples{ .pass = "luminance", .inputs = kSampleInputs };
constexpr std::string_view kHistogramInputs[] = { "luminance" };
constexpr FullScreenInterface kHistogram{ .pass = "histogram", .inputs = kHistogramInputs };
constexpr std::string_view kExposureInputs[] = { "histogram", "last" };
constexpr FullScreenParameter kExposureValues[] = { { "shares", ParameterType::Float2 },
                                                    { "compensation", ParameterType::Float },
                                                    { "stops", ParameterType::Float2 },
                                                    { "steps", ParameterType::Float2 } };
constexpr FullScreenInterface kExposure{ .pass = "exposure", .inputs = kExposureInputs, .values = kExposureValues };

// At most 14 400 samples, so 480 in a row of the histogram: a half float counts exactly up to 2048.
constexpr uint2 kMostSamples(160, 90); // of the image, each way
constexpr uint32_t kColumns = 16;      // of the histogram: four bins in each texel
constexpr uint32_t kRows = 30;         // each counts a part of the image

uint2 samplesOf(uint2 view) {
    const uint2 block = (view + kMostSamples - 1u) / kMostSamples;
    const uint32_t side = std::max(block.x, block.y);
    return (view + side - 1u) / side;
}

scene::Material const& materialOf(FrameContext const& context, std::string_view name,
                                  FullScreenInterface const& given) {
    return context.resources.effects->get(name, {}, given);
}

TextureId addSamples(FrameGraph& graph, FrameContext const& context, TextureId color) {
    const uint2 size = samplesOf(sizeOf(graph, color));
    const TextureId luminance =
            graph.createTexture({ .width = size.x, .height = size.y, .format = Format::R32F, .name = "luminance" });
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = color } };
    addFullScreenPass(graph, context,
                      { .name = "luminance",
                        .material = materialOf(context, "luminance", kSamples),
                        .inputs = inputs,
                        .target = luminance });
    return luminance;
}

TextureId addHistogram(FrameGraph& graph, FrameContext const& context, TextureId luminance) {
    const TextureId histogram =
            graph.createTexture({ .width = kColumns, .height = kRows, .format = Format::RGBA16F, .name = "histogram" });
    const std::array inputs{ FullScreenInput{ .name = "luminance", .texture = luminance } };
    addFullScreenPass(graph, context,
                      { .name = "histogram",
                        .material = materialOf(context, "histogram", kHistogram),
                        .inputs = inputs,
                        .target = histogram });
    return histogram;
}

} // namespace

void addExposurePasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::AutoExposure)) return;
    targets.histogram = addHistogram(graph, context, addSamples(graph, context, targets.color));
    AutoExposure const& options = context.settings().effects.autoExposure;
    prepare::LastView const& last = context.packet.last;
    const framegraph::History history =
            graph.history({ .width = 1, .height = 1, .format = Format::R32F, .name = "exposure" }, {}, !last.isExposed);
    // The first frame is exposed at once; there is nothing to adapt from.
    const float2 steps = last.isExposed ? float2(options.speedUp, options.speedDown) * last.secondsSince : float2(-1);
    const std::array inputs{ FullScreenInput{ .name = "histogram", .texture = targets.histogram },
                             FullScreenInput{ .name = "last", .texture = history.previous } };
    const std::array values{
        FullScreenValue{ "shares", float2(options.lowPercentile, options.highPercentile) },
        FullScreenValue{ "compensation", options.compensation },
        FullScreenValue{ "stops", float2(options.minStops, std::max(options.minStops, options.maxStops)) },
        FullScreenValue{ "steps", steps },
    };
    addFullScreenPass(graph, context,
                      { .name = "exposure",
                        .material = materialOf(context, "exposure", kExposure),
                        .inputs = inputs,
                        .values = values,
                        .target = history.current });
    targets.exposure = history.current;
}

} // namespace filament_core::passes
