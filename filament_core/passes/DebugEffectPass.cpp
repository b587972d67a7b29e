// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DebugEffectPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/PostProcessPass.h"
#include "filament_core/passes/Reprojection.h"
#include "filament_core/passes/SectionDepthPass.h"

#include <array>

namespace filament_core::passes {
namespace {

using framegraph::FrameGraph;
using framegraph::TextureId;
using prepare::Effect;

constexpr std::string_view kDebugFocusInputs[] = { "depth" };
constexpr FullScreenParameter kDebugFocusValues[] = { { "focus", ParameterType::Float3 } };
constexpr FullScreenInterface kDebugFocus{ .pass = "debug view",
                                           .inputs = kDebugFocusInputs,
                                           .values = kDebugFocusValues };
constexpr std::string_view kDebugHistoryInputs[] = { "shares" };
constexpr FullScreenInterface kDebugHistory{ .pass = "debug view", .inputs = kDebugHistoryInputs };
constexpr std::string_view kHistogramSumInputs[] = { "histogram" };
constexpr FullScreenInterface kHistogramSum{ .pass = "histogram sum", .inputs = kHistogramSumInputs };
constexpr std::string_view kDebugHistogramInputs[] = { "color", "counts", "exposure" };
constexpr FullScreenParameter kDebugHistogramValues[] = { { "shares", ParameterType::Float2 } };
constexpr FullScreenInterface kDebugHistogram{ .pass = "debug view",
                                               .inputs = kDebugHistogramInputs,
                                               .values = kDebugHistogramValues };

constexpr std::string_view kDebugLuminanceInputs[] = { "color" };
constexpr FullScreenInterface kDebugLuminance{ .pass = "debug view", .inputs = kDebugLuminanceInputs };
constexpr std::string_view kDebugNumericsInputs[] = { "color", "shown" };
constexpr FullScreenInterface kDebugNumerics{ .pass = "debug view", .inputs = kDebugNumericsInputs };
constexpr std::string_view kDebugMaterialInputs[] = { "value" };
constexpr FullScreenInterface kDebugMaterial{ .pass = "debug view", .inputs = kDebugMaterialInputs };
constexpr std::string_view kDebugDepthInputs[] = { "depth" };
constexpr FullScreenInterface kDebugDepth{ .pass = "debug view", .inputs = kDebugDepthInputs };
constexpr std::string_view kDebugMotionInputs[] = { "depth", "motion" };
constexpr FullScreenParameter kDebugMotionValues[] = { { "lastFromPixel", ParameterType::Float4x4 },
                                                       { "perSample", ParameterType::Float2 },
                                                       { "jitter", ParameterType::Float2 } };
constexpr FullScreenInterface kDebugMotion{ .pass = "debug view",
                                            .inputs = kDebugMotionInputs,
                                            .values = kDebugMotionValues };
constexpr std::string_view kDebugWireframeInputs[] = { "triangles", "color" };
constexpr FullScreenInterface kDebugWireframe{ .pass = "debug view", .inputs = kDebugWireframeInputs };

void addFocusView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    prepare::Focus const& focus = context.packet.focus;
    const bool isOn = context.packet.demand.needs(Effect::DepthOfField);
    const float3 value = isOn ? float3(focus.radius, focus.radiusTimesFocus, focus.mostPixels) : float3(0);
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = targets.prepassDepth } };
    const std::array values{ FullScreenValue{ "focus", value } };
    const std::array constants{ EffectConstant{ "hasDepth", static_cast<bool>(targets.prepassDepth) },
                                EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_focus", constants, kDebugFocus),
                        .inputs = inputs,
                        .values = values,
                        .target = targets.output });
}

void addHistoryView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    const std::array inputs{ FullScreenInput{ .name = "shares", .texture = targets.historyWeight } };
    const std::array constants{ EffectConstant{ "hasShares", static_cast<bool>(targets.historyWeight) },
                                EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_history", constants, kDebugHistory),
                        .inputs = inputs,
                        .target = targets.output });
}

/// One texel for four bins, in numbers that count any image.
TextureId addHistogramSum(FrameGraph& graph, FrameContext const& context, TextureId histogram) {
    const TextureId sum = graph.createTexture({ .width = graph.texture(histogram).desc.width,
                                                .height = 1,
                                                .format = backend::Format::RGBA32F,
                                                .name = "histogram sum" });
    const std::array inputs{ FullScreenInput{ .name = "histogram", .texture = histogram } };
    addFullScreenPass(graph, context,
                      { .name = "histogram sum",
                        .material = context.resources.effects->get("histogram_sum", {}, kHistogramSum),
                        .inputs = inputs,
                        .target = sum });
    return sum;
}

void addHistogramView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    TextureId counts;
    if (targets.histogram) counts = addHistogramSum(graph, context, targets.histogram);
    AutoExposure const& exposure = context.settings().effects.autoExposure;
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "counts", .texture = counts },
                             FullScreenInput{ .name = "exposure", .texture = targets.exposure } };
    const std::array values{ FullScreenValue{ "shares", float2(exposure.lowPercentile, exposure.highPercentile) } };
    const std::array constants{ EffectConstant{ "hasHistogram", static_cast<bool>(counts) },
                                EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_histogram", constants, kDebugHistogram),
                        .inputs = inputs,
                        .values = values,
                        .target = targets.output });
}

void addLuminanceView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color } };
    const std::array constants{ EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_luminance", constants, kDebugLuminance),
                        .inputs = inputs,
                        .target = targets.output });
}

/// Where nothing is shown on a display, nothing is clipped.
void addNumericsView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    FrameTargets shown = targets;
    shown.output = TextureId{};
    if (isEncoded) {
        shown.output = createLike(graph, targets.color, backend::Format::RGBA8, 1, "shown");
        addPostProcessPasses(graph, context, shown, false);
    }
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "shown", .texture = shown.output } };
    const std::array constants{ EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_numerics", constants, kDebugNumerics),
                        .inputs = inputs,
                        .target = targets.output });
}

/// Of the views that can give their numbers.
std::array<EffectConstant, 3> constantsOf(FrameContext const& context, bool isEncoded) {
    return { EffectConstant{ "view", static_cast<int32_t>(context.settings().debugView) },
             EffectConstant{ "isEncoded", isEncoded }, EffectConstant{ "isNumber", context.settings().givesNumbers } };
}

void addMaterialView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    const std::array inputs{ FullScreenInput{ .name = "value", .texture = targets.color } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_material", constantsOf(context, isEncoded),
                                                                   kDebugMaterial),
                        .inputs = inputs,
                        .target = targets.output });
}

void addDepthView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    const TextureId depth = targets.sectionDepth ? targets.sectionDepth : depthWithCaps(graph, context, targets.depth);
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = depth } };
    addFullScreenPass(
            graph, context,
            { .name = "debug view",
              .material = context.resources.effects->get("debug_depth", constantsOf(context, isEncoded), kDebugDepth),
              .inputs = inputs,
              .target = targets.output });
}

void addMotionNumbers(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = targets.depth },
                             FullScreenInput{ .name = "motion", .texture = targets.motionVectors } };
    const std::array values{ FullScreenValue{ "lastFromPixel", lastFromPixel(context, double2(1)) },
                             FullScreenValue{ "perSample", 1.0f / float2(context.settings().size) },
                             FullScreenValue{ "jitter", float2(0) } };
    const std::array constants{ EffectConstant{ "hasMotion", static_cast<bool>(targets.motionVectors) },
                                EffectConstant{ "isElsewhere", context.packet.last.isElsewhere } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_motion", constants, kDebugMotion),
                        .inputs = inputs,
                        .values = values,
                        .target = targets.output });
}

void addWireframeView(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, bool isEncoded) {
    const bool hasPicture = context.settings().debugView == DebugView::Wireframe;
    const std::array inputs{ FullScreenInput{ .name = "triangles", .texture = targets.triangles },
                             FullScreenInput{ .name = "color", .texture = hasPicture ? targets.color : TextureId{} } };
    const std::array constants{ EffectConstant{ "hasPicture", hasPicture }, EffectConstant{ "isEncoded", isEncoded } };
    addFullScreenPass(graph, context,
                      { .name = "debug view",
                        .material = context.resources.effects->get("debug_wireframe", constants, kDebugWireframe),
                        .inputs = inputs,
                        .target = targets.output });
}

} // namespace

void addDebugEffectPass(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets,
                        bool isSceneLinear) {
    const bool isEncoded = !isSceneLinear;
    switch (context.settings().debugView) {
    case DebugView::CircleOfConfusion:
        return addFocusView(graph, context, targets, isEncoded);
    case DebugView::HistoryWeight:
        return addHistoryView(graph, context, targets, isEncoded);
    case DebugView::Histogram:
        return addHistogramView(graph, context, targets, isEncoded);
    case DebugView::Luminance:
        return addLuminanceView(graph, context, targets, isEncoded);
    case DebugView::Numerics:
        return addNumericsView(graph, context, targets, isEncoded);
    case DebugView::Motion:
        return addMotionNumbers(graph, context, targets);
    case DebugView::Depth:
    case DebugView::Positions:
        return addDepthView(graph, context, targets, isEncoded);
    case DebugView::Wireframe:
    case DebugView::WireframeAlone:
        return addWireframeView(graph, context, targets, isEncoded);
    default:
        return addMaterialView(graph, context, targets, isEncoded);
    }
}

} // namespace filament_core::passes
