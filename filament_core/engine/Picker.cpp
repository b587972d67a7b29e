// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/Picker.h"

#include "backend/stream/RecordingGuards.h"
#include "base/OutOfMemory.h"
#include "filament_core/passes/Frame.h"
#include "filament_core/passes/PickPass.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace filament_core::engine {

using namespace backend;

namespace {

static_assert(passes::kPickSide * passes::kPickSide == prepare::kMostCandidates);

// Of what lies in one plane, depths in two texels may differ by rounding.
constexpr float kEqual = 1.0f / (1 << 20);

float pickedDepthAt(std::span<const std::byte> texels, size_t i) {
    float depth = 0;
    if ((i + 1) * sizeof(float) <= texels.size()) std::memcpy(&depth, texels.data() + i * sizeof(float), sizeof depth);
    return depth;
}

/// The texel of the candidate's front faces; none: planes do not cut it.
template <class P>
std::optional<size_t> frontOf(P const& pending, size_t candidate) {
    const auto front = std::ranges::lower_bound(pending.fronts, candidate);
    if (front == pending.fronts.end() || *front != candidate) return {};
    return pending.candidates.size() + static_cast<size_t>(front - pending.fronts.begin());
}

/// Where a back face of the candidate is nearer than all of its front faces: the cap that is seen instead, if one is.
template <class P>
std::optional<prepare::PickedPoint> capOf(P const& pending, std::span<const std::byte> texels, size_t candidate,
                                          prepare::PickedPoint const& point) {
    const std::optional<size_t> front = frontOf(pending, candidate);
    if (!front || pickedDepthAt(texels, *front) >= pickedDepthAt(texels, candidate) * (1 - kEqual)) return {};
    return prepare::pickedCap(pending.section, pending.camera, point);
}

/// Whether candidates that planes cut have left their first surfaces behind where rays enter (PickPass.cpp), also those
/// that are cut off.
template <class P>
bool showsSlabCaps(P const& pending) {
    return !pending.fronts.empty() && prepare::cutsSlabs(pending.section);
}

/// The nearest of what planes cut, as depth.
template <class P>
float firstCutOpen(P const& pending, std::span<const std::byte> texels) {
    float first = 0;
    for (const uint32_t candidate : pending.fronts) first = std::max(first, pickedDepthAt(texels, candidate));
    return first;
}

/// The nearest; of equal ones the last drawn, as on screen.
template <class P>
PickHit nearestHit(P const& pending, std::span<const std::byte> texels) {
    PickHit nearest;
    float nearestDepth = 0;
    const float firstCut = showsSlabCaps(pending) ? firstCutOpen(pending, texels) : 0.0f;
    for (size_t i = 0; i < pending.candidates.size(); ++i) {
        const float depth = pickedDepthAt(texels, i);
        // Depth is reversed: the nearest is the largest, and 0 means that nothing was drawn.
        if (!(depth > 0) || depth < nearestDepth * (1 - kEqual)) continue;
        prepare::PickedPoint point = prepare::pickedPoint(pending.camera, pending.size, pending.pixel, depth);
        const std::optional<prepare::PickedPoint> cap = capOf(pending, texels, i, point);
        const auto isBehind = [&](prepare::PickedPoint const& at) {
            return prepare::isBehindSection(pending.section, pending.camera, at);
        };
        if (firstCut > 0 && frontOf(pending, i) && isBehind(point)) {
            // Cut off, unless it shows where the ray enters it.
            if (!cap || isBehind(*cap) || depth < firstCut * (1 - kEqual)) continue;
        }
        point = cap.value_or(point);
        nearestDepth = depth;
        nearest = pending.candidates[i];
        nearest.distanceMeters = point.distanceMeters;
        nearest.positionWorld = point.positionWorld;
    }
    return nearest;
}

} // namespace

Picker::Picker(Engine::Impl& engine)
        : mEngine(engine), mGraph(mArena), mTransients(*engine.stream), mData(*engine.stream), mBlocks(*engine.stream) {
}

Picker::~Picker() {
    mData.destroy(mEngine.pending);
    mBlocks.destroy(mEngine.pending);
    mTransients.destroyAll(mEngine.pending);
    if (mDepths) mEngine.stream->destroy(mEngine.pending, mDepths);
}

void Picker::makeDepths() {
    if (mDepths) return;
    NewHandle texture(*mEngine.stream, mEngine.stream->allocateTexture());
    mEngine.pending.record(CmdCreateTexture{ texture,
                                             { .format = Format::D32F,
                                               .usage = TextureUsage::DepthAttachment | TextureUsage::TransferSource,
                                               .width = passes::kPickSide,
                                               .height = passes::kPickSide,
                                               .debugName = "picks" } });
    mDepths = texture.keep();
}

Picker::Pending Picker::describe(scene::SceneData const& scene, View const& view, uint2 pixel,
                                 prepare::PreparedPick const& pick) const {
    Pending pending{ .camera = view.camera,
                     .size = view.size,
                     .pixel = pixel,
                     .section = view.section,
                     .fronts = { pick.fronts.begin(), pick.fronts.end() } };
    pending.candidates.reserve(pick.renderables.size());
    for (const uint32_t at : pick.renderables) {
        const Renderable renderable = scene.renderables.index.handleAt(at);
        const auto shape = std::ranges::find(scene.lightShapes, renderable, &scene::LightShape::renderable);
        if (shape != scene.lightShapes.end()) {
            pending.candidates.push_back({ .light = shape->light, .node = scene::nodeOf(scene, shape->light) });
            continue;
        }
        pending.candidates.push_back({ .renderable = renderable,
                                       .node = scene::nodeOf(scene, renderable),
                                       .primitive = prepare::primitiveOf(scene, renderable) });
    }
    return pending;
}

PickTicket Picker::ask(scene::SceneData const& scene, View const& view, prepare::ViewInput const& input,
                       FrameResourceCache& resources, uint2 pixel, PickAim aim,
                       std::span<const prepare::DrawnLevel> last) {
    const jobs::AdoptedThread seat(mEngine.jobs);
    mArena.reset();
    mGraph.reset();
    const prepare::PreparedPick pick = prepare::preparePick(mEngine.jobs, mArena, scene, input, pixel, aim, last);
    const Ticket ticket = mEngine.stream->nextTicket();
    // Noted before the commands are recorded: once they are, the answer will come, and needs its place.
    mPending[ticket.value] = describe(scene, view, pixel, pick);
    if (pick.renderables.empty()) return { ticket.value }; // nothing to draw
    try {
        record(view, pick, resources, pixel, ticket);
    } catch (std::bad_alloc const&) {
        mPending.erase(ticket.value);
        throw;
    }
    return { ticket.value };
}

void Picker::record(View const& view, prepare::PreparedPick const& pick, FrameResourceCache& resources, uint2 pixel,
                    Ticket ticket) {
    makeDepths();
    passes::FrameResources found = resources.find(view, pick.packet, passes::PipelineSource(mEngine.pipelines), false);
    found.motion = mEngine.motionInstance();
    passes::FrameContext& context = *passes::makeFrameContext(mArena, pick.packet, found);
    mBlocks.begin();
    context.blocks = &mBlocks;
    constexpr uint32_t kSide = passes::kPickSide;
    const framegraph::TextureId depths =
            mGraph.importTexture(mDepths, { .width = kSide, .height = kSide, .format = Format::D32F, .name = "picks" },
                                 framegraph::InitialContents::Undefined);
    passes::addPickPass(mGraph, context, depths, view.size, pixel);
    const framegraph::CompiledGraph plan = framegraph::compile(mGraph, mTransients);
    FrameCommands commands(*mEngine.stream); // submits when it ends
    mEngine.useTextureFilter(context.settings().quality.textureFilter);
    mEngine.drainPending(*commands);
    mData.upload(mEngine.jobs, *commands, context.packet);
    mBlocks.upload(*commands);
    context.views = mData.views();
    context.deformations = mData.deformations();
    framegraph::record(*commands, plan);
    const size_t texels = pick.renderables.size() + pick.fronts.size();
    const auto rows = static_cast<uint32_t>((texels + kSide - 1) / kSide);
    commands->record(CmdReadTexture{ mDepths, 0, 0, { 0, 0, kSide, rows }, ticket });
}

Picker::Pendings::iterator Picker::find(PickTicket ticket) {
    const auto entry = mPending.find(ticket.value);
    FILAMENT_ASSERT(entry != mPending.end(), "a pick is taken once, from the renderer that gave its ticket");
    return entry;
}

std::optional<PickHit> Picker::take(PickTicket ticket) {
    if (!ticket) return PickHit{}; // out of memory in ask()
    const auto entry = find(ticket);
    Pending const& pending = entry->second;
    PickHit hit;
    if (!pending.candidates.empty()) {
        const auto texels = mEngine.stream->takeReadback({ ticket.value });
        if (!texels && !mEngine.stream->isDeviceLost()) return std::nullopt;
        if (texels) hit = nearestHit(pending, *texels);
    }
    mPending.erase(entry);
    return hit;
}

Result<PickHit> Picker::wait(PickTicket ticket) {
    if (!ticket) return outOfMemory("pick: not asked");
    const auto entry = find(ticket);
    const Pending pending = std::move(entry->second);
    mPending.erase(entry);
    return orOutOfMemory("pick", {}, [&]() -> Result<PickHit> {
        if (pending.candidates.empty()) return PickHit{};
        const auto texels = mEngine.stream->waitReadback({ ticket.value });
        if (!texels) return texels.error();
        return nearestHit(pending, *texels);
    });
}

} // namespace filament_core::engine
