// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/AppPass.h"

#include "filament_core/passes/DebugSurfacePass.h"
#include "filament_core/passes/SectionDepthPass.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kAppCopyInputs[] = { "picture" };
constexpr FullScreenParameter kAppCopyValues[] = { { "offset", ParameterType::Int2 } };
constexpr FullScreenInterface kAppCopy{ .pass = "copy", .inputs = kAppCopyInputs, .values = kAppCopyValues };
constexpr std::string_view kAppDistanceInputs[] = { "depth" };
constexpr FullScreenInterface kAppDistance{ .pass = "distances", .inputs = kAppDistanceInputs };

TextureId addAppDistances(FrameGraph& graph, FrameContext const& context, TextureId depth) {
    const TextureId distances = createLike(graph, depth, Format::R32F, 1, "distances");
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = depth } };
    addFullScreenPass(graph, context,
                      { .name = "distances",
                        .material = context.resources.effects->get("linear_depth", {}, kAppDistance),
                        .inputs = inputs,
                        .target = distances });
    return distances;
}

/// Made for the first pass that reads them.
void makeAppInputs(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, AppPass const& pass) {
    if (pass.has(AppInput::Depth) && !targets.appDistances)
        targets.appDistances = addAppDistances(graph, context, depthWithCaps(graph, context, targets.sceneDepth));
    if (pass.has(AppInput::Normals) && !targets.appNormals)
        targets.appNormals = addNormalsPass(graph, context, context.settings().size);
}

std::span<const FullScreenInput> appInputsOf(FrameContext const& context, FrameTargets const& targets,
                                             AppPass const& pass, TextureId color, TextureId last) {
    // In the order of kAppInputs. Depths and normals of two surfaces have no mean.
    const std::array<TextureId, kAppInputs.size()> frames{ color, targets.appDistances, targets.appNormals, last };
    FrameSamplers const& samplers = context.resources.samplers;
    const std::array<backend::SamplerHandle, kAppInputs.size()> filters{ samplers.bilinear, samplers.nearest,
                                                                         samplers.nearest, samplers.bilinear };
    const std::span inputs = context.arena->array<FullScreenInput>(kAppInputs.size() + pass.images.size());
    size_t count = 0;
    for (size_t i = 0; i < kAppInputs.size(); ++i) {
        if (pass.reads[i]) inputs[count++] = { .name = kAppInputs[i], .texture = frames[i], .sampler = filters[i] };
    }
    std::ranges::copy(pass.images, inputs.begin() + static_cast<std::ptrdiff_t>(count));
    return inputs.first(count + pass.images.size());
}

/// `into`: none: an image like `color`.
TextureId addAppPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, AppPass const& pass,
                     TextureId color, TextureId into) {
    makeAppInputs(graph, context, targets, pass);
    framegraph::GraphTextureDesc desc = graph.texture(color).desc;
    desc.name = pass.name;
    framegraph::History history;
    TextureId target = into;
    if (pass.has(AppInput::History)) {
        desc.name = pass.history;
        history = graph.history(desc, {}, !context.followsLast);
        target = history.current;
    } else if (!into) {
        target = graph.createTexture(desc);
    }
    addFullScreenPass(graph, context,
                      { .name = pass.name,
                        .material = *pass.material,
                        .inputs = appInputsOf(context, targets, pass, color, history.previous),
                        .block = pass.parameters,
                        .target = target });
    if (into && target != into) addCopyPass(graph, context, target, into);
    return into ? into : target;
}

} // namespace

bool hasAppPasses(FrameContext const& context, PassPlace place) {
    return std::ranges::count(context.appPasses, place, &AppPass::place) > 0;
}

bool readsDepth(std::span<const AppPass> passes) {
    return std::ranges::any_of(passes, [](AppPass const& pass) { return pass.has(AppInput::Depth); });
}

TextureId addAppPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, PassPlace place,
                       TextureId color, TextureId into) {
    auto left = std::ranges::count(context.appPasses, place, &AppPass::place);
    for (AppPass const& pass : context.appPasses) {
        if (pass.place != place) continue;
        color = addAppPass(graph, context, targets, pass, color, --left == 0 ? into : TextureId{});
    }
    return color;
}

void addCopyPass(FrameGraph& graph, FrameContext const& context, TextureId from, TextureId to, TextureId resolve) {
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = from } };
    const std::array values{ FullScreenValue{ "offset", int2(0) } };
    addFullScreenPass(graph, context,
                      { .name = "copy",
                        .material = context.resources.effects->get("place", {}, kAppCopy),
                        .inputs = inputs,
                        .values = values,
                        .target = to,
                        .resolve = resolve });
}

} // namespace filament_core::passes
