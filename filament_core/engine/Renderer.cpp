// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Renderer.h>

#include "backend/stream/RecordingGuards.h"
#include "base/OutOfMemory.h"
#include "filament_core/engine/FogHistory.h"
#include "filament_core/engine/FrameResourceCache.h"
#include "filament_core/engine/FrameSummary.h"
#include "filament_core/engine/FrameTarget.h"
#include "filament_core/engine/FrameTimingLog.h"
#include "filament_core/engine/ImageTarget.h"
#include "filament_core/engine/MeshPasses.h"
#include "filament_core/engine/Picker.h"
#include "filament_core/engine/PixelReads.h"
#include "filament_core/engine/PostProcess.h"
#include "filament_core/engine/ProbeTexture.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/ShadowTexture.h"
#include "filament_core/engine/TextureStreamer.h"
#include "filament_core/engine/ViewsOfFrames.h"
#include "filament_core/passes/DebugDrawPass.h"
#include "filament_core/passes/FogLightPass.h"
#include "filament_core/passes/Frame.h"
#include "filament_core/passes/ShadowPass.h"
#include "filament_core/passes/SplatPass.h"
#include "filament_core/prepare/GuardBand.h"
#include "filament_core/prepare/PlaceGrids.h"
#include "filament_core/prepare/PrepareFrame.h"
#include "filament_core/prepare/PrepareSplats.h"
#include "framegraph/CompiledGraph.h"
#include "framegraph/Explain.h"

#include <filament_core/DebugDraw.h>
#include <filament_core/ResolutionController.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace filament_core {
namespace {

using namespace backend;
using engine::checkNumbers;
using engine::checkPlace;
using engine::joinsLastImage;
using engine::PublicCall;
using engine::wholeInputOf;
using engine::withDebugViewOf;
using Target = engine::FrameTarget;
using passes::FrameContext;
using passes::FrameOutput;
using passes::PipelineSource;

bool isDirtOf(FrameContext const& context, Target const& target) {
    const TextureHandle dirt = context.resources.dirt.texture;
    return dirt && (dirt == target.color.handle || (target.depth && dirt == target.depth->handle));
}

/// Numbers leave what a renderer keeps of its frames as it is: all but motion, which counts from one to the next.
bool isKept(View const& view) { return view.aov == Aov::None || view.aov == Aov::Motion; }

} // namespace

struct Renderer::Impl final : engine::Dependent {
    Impl(Engine& ofEngine, RendererOptions const& rendererOptions)
            : engine(ofEngine.impl()), link(ofEngine), options(rendererOptions), resources(engine),
              data(*engine.stream), blocks(*engine.stream),
              debugBuffers(*engine.stream, sizeof(prepare::DebugVertex), "debug draw"),
              splatBuffers(*engine.stream, sizeof(prepare::SplatVertex), "splats"), shadows(engine), probes(engine),
              fogHistory(engine), graph(arena), transients(*engine.stream), ranges(engine.jobs), timings(engine),
              pixels(engine), imageTarget(engine) {
        engine.dependents.push_back(this);
    }

    ~Impl() {
        if (!link.isAlive()) return;
        release();
        std::erase(engine.dependents, this);
    }

    void release() noexcept override {
        plan = {};
        data.destroy(engine.pending);
        blocks.destroy(engine.pending);
        debugBuffers.destroy(engine.pending);
        splatBuffers.destroy(engine.pending);
        shadows.destroy();
        probes.destroy();
        fogHistory.destroy();
        transients.destroyAll(engine.pending);
        imageTarget.destroy();
        picker.reset();
    }

    void check(Scene const& scene) const { engine::requireSame(engine, scene.impl().engine, "scene"); }

    // ------------------------------------------------------------------------------------------ a frame

    /// Both only ever grow.
    uint64_t contentsOf(Scene const& scene) const { return scene.impl().changes + engine.instanceChanges; }

    /// The view's resolution scale, limited by dynamic resolution. Depths are not cut, and what nothing
    /// would read is not drawn. `effects`: of the view, clamped.
    prepare::ViewInput inputFor(Scene const& scene, View const& view, Effects effects, bool hasDepthTarget) const {
        effects.resolution.scale = shares.scale(effects.resolution);
        prepare::ViewInput input = prepare::viewInput(view, effects, contentsOf(scene));
        input.maxTextureSize = engine.device.maxTextureSize;
        input.darkLights = scene.impl().dark.lights;
        input.darkEnvironment = scene.impl().dark.environment;
        const auto looksBeside = [&] {
            return prepare::looksBesidePicture(scene.impl().upToDate(), input.quality, effects);
        };
        const bool isAppPassed = !engine::postProcessOf(view).empty();
        if (input.band > 0 && (hasDepthTarget || isAppPassed || !looksBeside()))
            input.size = input.inside(), input.band = 0;
        return input;
    }

    /// The state of earlier frames, from the TAA history to the shadow atlas, belongs to their scene and
    /// view: another scene or view resets it.
    void beginAnewWithAnother(Scene const& scene, prepare::ViewInput const& input) {
        if (last.isFollowedBy(scene.impl().upToDate(), resolve(input))) return;
        shadows.beginAnew();
        shares.forget();
        timings.skip();
    }

    /// The times of finished frames determine the size of the next one.
    void chooseShare(Resolution const& resolution) {
        if (!resolution.dynamic) return shares.forget();
        timings.visitFinished(options.passTimers, [&](float2 scale, double milliseconds) {
            shares.add(resolution, { scale, milliseconds });
        });
        stamps.scale = shares.scale(resolution);
    }

    /// Everything in a frame except its commands, for frames that are drawn and for those that are only expected.
    FrameContext& planFrame(Scene const& scene, View const& view, Effects const& effects, Target const& target,
                            PipelineSource pipelines, framegraph::TransientPool& pool) {
        const FrameOutput output = outputOf(target);
        arena.reset();
        graph.reset();
        plan = {};
        const std::array views{ inputFor(scene, view, effects, static_cast<bool>(output.depth)) };
        const prepare::FramePacket packet = prepare::prepareFrame(engine.jobs, arena, scene.impl().settled(), views,
                                                                  shadows.held(), last, probes.held(), &fields);
        if (engine.streamer && !pipelines.isRequesting() && !target.isAlone)
            engine.streamer->note(engine.jobs, arena, scene.impl().data, packet);
        FrameContext& context = *passes::makeFrameContext(
                arena, packet, resources.find(view, packet, pipelines, !output.isSceneLinear()));
        context.followsLast = last.isFollowedBy(scene.impl().data, packet.settings);
        engine::usePostProcess(engine, arena, view, context);
        addDebugQuads(context, view, effects, output);
        useKept(context, pipelines);
        blocks.begin();
        context.blocks = &blocks;
        describe(context, target, output);
        plan = compile(graph, pool);
        return context;
    }

    void describe(FrameContext& context, Target const& target, FrameOutput const& output) {
        mesh = target.meshes ? engine::meshDrawOf(engine, arena, *target.meshes) : nullptr;
        if (mesh)
            passes::describeMeshPass(graph, context, *mesh, output, otherOutputsOf(engine, target));
        else if (target.isAlone)
            passes::describeAppPass(graph, context, output, otherOutputsOf(engine, target));
        else
            passes::describeFrame(graph, context, output);
    }

    void useFogHistory(FrameContext& context, bool isExpected) {
        passes::FrameResources& used = context.resources;
        used.lastFogLight = used.fogLight = used.noFogCells;
        const uint32_t bytes = passes::fogLightBytes(context);
        if (isExpected || bytes == 0) return;
        fogHistory.use(bytes);
        used.lastFogLight = fogHistory.previous();
        used.fogLight = fogHistory.current();
        if (!fogHistory.isKept()) context.packet.fogAccumulation = {};
    }

    /// An expected frame changes neither maps nor probes: any texture replaces them.
    void useKept(FrameContext& context, PipelineSource const& pipelines) {
        passes::FrameResources& used = context.resources;
        if (!pipelines.isRequesting()) shadows.use(context.packet.shadows);
        used.shadowAtlas = pipelines.isRequesting() ? used.white : shadows.depths();
        used.shadowMoments = pipelines.isRequesting() ? used.white : shadows.moments();
        useFogHistory(context, pipelines.isRequesting());
        if (context.packet.probes.empty()) return;
        if (!pipelines.isRequesting()) probes.use(context.packet.probes);
        used.lighting.probes = pipelines.isRequesting() ? used.lighting.specular : probes.texture();
    }

    void addDebugQuads(FrameContext& context, View const& view, Effects const& effects, FrameOutput const& output) {
        if (view.debugDraw && !view.debugDraw->empty())
            context.debugDraw.quads = prepare::debugQuads(arena, *view.debugDraw, wholeInputOf(view, effects, 0));
        context.keepsDepth =
                output.depth || context.debugDraw.quads.tested > 0 || passes::readsDepth(context.appPasses);
    }

    Result<void> checkPasses(View const& view, Target const& target) {
        const auto drawn = texturesOf(engine, target);
        const engine::PassTargets to{ drawn, target.isAlone, target.colors() };
        return target.meshes ? engine::checkMeshPass(engine, *target.meshes, to)
                             : engine::checkPostProcess(engine, view, to);
    }

    /// Out of memory: the next frame starts without history.
    void keepLast(Scene const& scene, prepare::ViewInput const& input, prepare::FramePacket const& packet) {
        try {
            last.keep(scene.impl().upToDate(), input, packet);
        } catch (std::bad_alloc const&) {
            last.forget();
        }
    }

    /// Submits the commands when it returns.
    void recordFrame(FrameContext& context, Target const& target) {
        FrameCommands commands(*engine.stream); // waits when two frames ahead
        stamps.acquired = clock();
        const uint64_t number = timings.numberInStream(++frame);
        commands->record(CmdBeginFrame{ number });
        const InReserve<CmdEndFrame> end{ *commands, { number } };
        // What the frame binds is made first: instances whose groups the filter needs are pending, then everything
        // pending, then programs that an earlier compile() asked for. Memory may run out while the frame is recorded:
        // the atlas forgets its maps before the frame draws over them, and keeps them when all of it is recorded.
        engine.useTextureFilter(context.settings().quality.textureFilter);
        engine.drainPending(*commands);
        engine.recordCompilations(*commands);
        data.upload(engine.jobs, *commands, context.packet);
        blocks.upload(*commands);
        context.debugDraw.buffers = passes::uploadDebugQuads(debugBuffers, *commands, arena, context.debugDraw.quads);
        context.splats = passes::uploadSplats(splatBuffers, engine.jobs, *commands, arena, context.packet.splats);
        context.views = data.views();
        context.viewBuffers = data.viewBuffers();
        context.deformations = data.deformations();
        shadows.forget(context.packet.shadows);
        probes.copy(context.packet.probes, *commands);
        framegraph::record(*commands, plan, options.passTimers ? &timers : nullptr, &ranges);
        if (target.generatesMips() && !target.isSrgb()) commands->record(CmdGenerateMips{ target.color.handle });
        shadows.keep(context.packet.shadows);
        probes.keep(context.packet.probes);
        fogHistory.keep(passes::fogLightBytes(context));
    }

    /// The six lines of docs/architecture.md, with their measurements: plan, then record.
    Result<void> drawFrame(Scene const& scene, View const& view, Target const& target) {
        const jobs::AdoptedThread seat(engine.jobs); // the app thread takes part in the work
        Result<void> usable = checkPasses(view, target);
        if (!usable) return leaveOut(usable.error());
        timers.clear();
        stamps = { .begin = clock() };
        const Effects effects = clamped(view.effects);
        const auto input = [&] { return inputFor(scene, view, effects, target.depth != nullptr); };
        // Before the share is chosen: times of another view say nothing about this one.
        if (isKept(view)) beginAnewWithAnother(scene, input());
        chooseShare(effects.resolution);
        const uint64_t busyBefore = engine.jobs.busyNanoseconds();
        FrameContext& context = planFrame(scene, view, effects, target, PipelineSource(engine.pipelines), transients);
        if (target.meshes) {
            Result<void> fits = engine::checkMeshDraws(engine, *target.meshes, context.packet.mainView());
            if (!fits) return leaveOut(fits.error());
        }
        const bool samples = target.state && !target.isAlone; // materials of objects may
        scene::MaterialInstance const* material = samples ? samplerOf(context.packet, target) : nullptr;
        // After the plan, which knows what is drawn, and before anything is recorded: the frame can still be left out.
        if (material) return leaveOut(engine::samplesTarget(*material, target));
        if (target.state && isDirtOf(context, target)) return leaveOut(engine::dirtIsTarget(target));
        stamps.prepared = clock();
        if (engine.options.hashFrames) stamps.packetHash = prepare::hashPacket(context.packet);
        recordFrame(context, target);
        stamps.recorded = clock();
        // Only after recording: a frame that was left out has drawn nothing that the next one could reuse.
        if (isKept(view)) keepLast(scene, input(), context.packet);
        stamps.workerBusyNanoseconds = engine.jobs.busyNanoseconds() - busyBefore;
        timings.add(frame, stamps, timers);
        summary = engine::summarize(frame, context.packet, plan);
        engine::keepProbes(scene.impl().data.probes, context.packet.probes, probeLines);
        engine::keepGrids(scene.impl().data, context.packet.grids, gridLines);
        return {};
    }

    Error leaveOut(Error error) {
        plan = {};
        engine.report(error.message);
        return error;
    }

    /// On an error the frame was left out, because memory or a target was missing. Whatever was created on the way
    /// serves the next frame.
    Result<void> render(Scene const& scene, View const& view, Target const& target) {
        backend::DeviceTextureDesc const& desc = target.color.desc;
        if (!target.isAlone) checkNumbers(view, desc.format);
        if (!target.color.handle) return engine::noImage(desc.width, desc.height);
        try {
            // Outside of the frame: callbacks of finished compilations may compile and destroy materials.
            engine.compilations.collect(engine.stream->replayedSubmissions());
            if (engine.streamer) engine.streamer->beginFrame();
            Result<void> drawn =
                    withDebugViewOf(view, [&](View const& shown) { return drawFrame(scene, shown, target); });
            if (!drawn) return drawn;
            // Only once the frame is recorded: what failed has drawn nothing.
            target.keepContents(engine);
            return {};
        } catch (std::bad_alloc const&) {
            return leaveOut(outOfMemory("a frame is left out"));
        }
    }

    /// The next image becomes the current one once it has been drawn. A view that keeps its contents joins the current
    /// one.
    Result<void> renderInto(engine::SwapChainState& chain, Scene const& scene, View const& view) {
        const uint32_t step = joinsLastImage(view) ? 0 : 1;
        const uint32_t next = (chain.current + step) % static_cast<uint32_t>(chain.images.size());
        Result<void> drawn = render(scene, view, { engine.textures.get(chain.images[next]) });
        if (drawn) chain.current = next;
        return drawn;
    }

    /// By a renderer of their own: what this one keeps of its frames stays. Calls `use(Renderer::Impl, empty scene)`.
    template <class Use>
    void useAlone(Target& target, Use&& use) {
        engine.orReport("a pass", target.color.name, [&] {
            if (!alone) alone = std::make_unique<Alone>(*engine.self);
            target.isAlone = true;
            use(*alone->renderer.mImpl, alone->nothing);
        });
    }

    void renderAlone(MaterialInstance pass, View const& view, Target target) {
        useAlone(target, [&](Impl& by, Scene const& nothing) {
            const PostProcessPass only{ pass, PassPlace::Last };
            (void)by.render(nothing, engine::viewOfPass(only, view, target.size()), target);
        });
    }
    void prewarmAlone(MaterialInstance pass, View const& view, Target target) {
        useAlone(target, [&](Impl& by, Scene const& nothing) {
            const PostProcessPass only{ pass, PassPlace::Last };
            by.prewarm(nothing, engine::viewOfPass(only, view, target.size()), target);
        });
    }

    void renderMeshes(Scene const& scene, MeshPass const& pass, View const& view, Target target) {
        target.meshes = &pass;
        useAlone(target, [&](Impl& by, Scene const&) {
            (void)by.render(scene, engine::viewOfMeshPass(view, target.size()), target);
        });
    }
    void prewarmMeshes(Scene const& scene, MeshPass const& pass, View const& view, Target target) {
        target.meshes = &pass;
        useAlone(target, [&](Impl& by, Scene const&) {
            by.prewarm(scene, engine::viewOfMeshPass(view, target.size()), target);
        });
    }

    // ------------------------------------------------------------------------------------------ expected frames

    /// The passes of such a frame become slots of the pipeline cache; their own pipelines are requested.
    void prewarm(Scene const& scene, View const& view, Target const& target) {
        if (!target.isAlone) checkNumbers(view, target.color.desc.format);
        try {
            const jobs::AdoptedThread seat(engine.jobs);
            Result<void> usable = checkPasses(view, target);
            if (!usable) return engine.report(usable.error().message);
            std::vector<passes::FullScreenRequest> requests;
            withDebugViewOf(view, [&](View const& shown) { rehearse(scene, shown, target, requests); });
            engine.dispatches.makeExpected(engine.pending);
            if (view.quality.shadows != ShadowFilter::Off)
                engine.pipelines.slot(
                        passes::shadowSlot(view.quality, view.section.isUsed(), prepare::cutsSlabs(view.section)));
            for (passes::FullScreenRequest const& request : requests) {
                engine.compilations.add({ .material = request.material,
                                          .requests = { { .slot = request.slot, .isFullScreen = true } } },
                                        CompilePriority::Critical);
            }
            if (mesh) engine::requestMeshPipelines(engine, *mesh);
        } catch (std::bad_alloc const&) {
            engine.reportOutOfMemory("expecting a frame");
        }
        plan = {};
    }

    /// With a pool of its own: nothing is created, and the next frame finds what the last one left.
    void rehearse(Scene const& scene, View const& view, Target const& target,
                  std::vector<passes::FullScreenRequest>& requests) {
        struct ExpectedTextures {
            framegraph::TransientPool pool;
            CommandBuffer& commands;
            ~ExpectedTextures() { pool.destroyAll(commands); }
        } expected{ framegraph::TransientPool(*engine.stream), engine.pending };
        planFrame(scene, view, clamped(view.effects), target, PipelineSource(engine.pipelines, &requests),
                  expected.pool);
        framegraph::rehearse(plan);
    }

    engine::Picker& pickerOfRenderer() {
        if (!picker) picker.emplace(engine);
        return *picker;
    }

    PickTicket pick(Scene const& scene, View const& view, uint2 pixel, PickAim aim) {
        FILAMENT_ASSERT(pixel.x < view.size.x && pixel.y < view.size.y, "a picked pixel lies in the view");
        return engine.orNone("picking", {}, [&] {
            return pickerOfRenderer().ask(scene.impl().upToDate(), view,
                                          wholeInputOf(view, clamped(view.effects), contentsOf(scene)), resources,
                                          pixel, aim, last.levels());
        });
    }

    static engine::FrameTimingLog::TimePoint clock() { return std::chrono::steady_clock::now(); }

    struct Alone {
        explicit Alone(Engine& of) : renderer(of), nothing(of) {}
        Renderer renderer;
        Scene nothing;
    };

    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    RendererOptions options;
    engine::FrameResourceCache resources;
    Arena arena;
    passes::FrameData data;
    passes::PassBlocks blocks;
    passes::QuadBuffers debugBuffers, splatBuffers;
    engine::ShadowTexture shadows;
    engine::ProbeTexture probes;
    engine::FogHistory fogHistory;
    prepare::FieldCache fields;
    framegraph::FrameGraph graph;
    framegraph::TransientPool transients;
    framegraph::RangeRecorder ranges;
    framegraph::CompiledGraph plan;
    passes::MeshDraw* mesh = nullptr; ///< of the plan; null: it has no mesh pass
    std::vector<framegraph::PassTimer> timers;
    engine::FrameTimingLog::Stamps stamps; ///< of the frame that is made now
    engine::FrameTimingLog timings;
    engine::PixelReads pixels;
    engine::ImageTarget imageTarget;
    std::optional<engine::Picker> picker; ///< after the first pick
    std::unique_ptr<Alone> alone;         ///< after the first pass without a view
    uint64_t frame = 0;
    prepare::LastFrame last; ///< that was drawn
    ResolutionController shares;
    engine::FrameSummary summary;
    std::vector<engine::ProbeLine> probeLines;
    engine::GridLines gridLines;
};

Renderer::Renderer(Engine& engine, RendererOptions const& options) : mImpl(std::make_shared<Impl>(engine, options)) {}
Renderer::~Renderer() {
    if (mImpl && mImpl->link.isAlive()) const PublicCall call(mImpl, "Renderer::~Renderer()");
}

void Renderer::render(Scene const& scene, View const& view, SwapChain swapChain) {
    const PublicCall call(mImpl, "Renderer::render(Scene, View, SwapChain)");
    mImpl->check(scene);
    engine::SwapChainState& state = mImpl->engine.swapChains.get(swapChain);
    checkPlace(view, state.size);
    (void)mImpl->renderInto(state, scene, view); // takeErrors() says why a frame may be missing
}

void Renderer::render(Scene const& scene, View const& view, RenderTarget target) {
    const PublicCall call(mImpl, "Renderer::render(Scene, View, RenderTarget)");
    mImpl->check(scene);
    const Target drawn = engine::targetOf(mImpl->engine, target);
    checkPlace(view, drawn.size());
    (void)mImpl->render(scene, view, drawn);
}

void Renderer::render(MaterialInstance pass, RenderTarget target, View const& view) {
    const PublicCall call(mImpl, "Renderer::render(MaterialInstance, RenderTarget, View)");
    mImpl->renderAlone(pass, view, engine::targetOf(mImpl->engine, target));
}

void Renderer::render(Scene const& scene, MeshPass const& pass, RenderTarget target, View const& view) {
    const PublicCall call(mImpl, "Renderer::render(Scene, MeshPass, RenderTarget, View)");
    mImpl->check(scene);
    mImpl->renderMeshes(scene, pass, view, engine::targetOf(mImpl->engine, target));
}

void Renderer::present(SwapChain swapChain) {
    const PublicCall call(mImpl, "Renderer::present(SwapChain)");
    engine::SwapChainState& state = mImpl->engine.swapChains.get(swapChain);
    mImpl->engine.orReport("presenting an image", state.name, [&] { mImpl->engine.present(state); });
}

bool Renderer::canPresent(SwapChain swapChain) const {
    const PublicCall call(mImpl, "Renderer::canPresent(SwapChain)");
    engine::SwapChainState const& state = mImpl->engine.swapChains.get(swapChain);
    return mImpl->engine.stream->replayedSubmissions() >= state.presents[0] && state.takesImage();
}

void Renderer::prewarm(Scene const& scene, View const& view, SwapChain swapChain) {
    const PublicCall call(mImpl, "Renderer::prewarm(Scene, View, SwapChain)");
    mImpl->check(scene);
    engine::SwapChainState const& state = mImpl->engine.swapChains.get(swapChain);
    mImpl->prewarm(scene, view, { mImpl->engine.textures.get(state.images[state.current]) });
}

void Renderer::prewarm(Scene const& scene, View const& view, RenderTarget target) {
    const PublicCall call(mImpl, "Renderer::prewarm(Scene, View, RenderTarget)");
    mImpl->check(scene);
    mImpl->prewarm(scene, view, engine::targetOf(mImpl->engine, target));
}

void Renderer::prewarm(MaterialInstance pass, RenderTarget target, View const& view) {
    const PublicCall call(mImpl, "Renderer::prewarm(MaterialInstance, RenderTarget, View)");
    mImpl->prewarmAlone(pass, view, engine::targetOf(mImpl->engine, target));
}

void Renderer::prewarm(Scene const& scene, MeshPass const& pass, RenderTarget target, View const& view) {
    const PublicCall call(mImpl, "Renderer::prewarm(Scene, MeshPass, RenderTarget, View)");
    mImpl->check(scene);
    mImpl->prewarmMeshes(scene, pass, view, engine::targetOf(mImpl->engine, target));
}

PixelTicket Renderer::readPixels(SwapChain swapChain) {
    const PublicCall call(mImpl, "Renderer::readPixels(SwapChain)");
    engine::SwapChainState const& state = mImpl->engine.swapChains.get(swapChain);
    return mImpl->pixels.ask(mImpl->engine.textures.get(state.images[state.current]));
}

PixelTicket Renderer::readPixels(RenderTarget target) {
    const PublicCall call(mImpl, "Renderer::readPixels(RenderTarget)");
    const Target read = engine::targetOf(mImpl->engine, target);
    return mImpl->pixels.ask(read.color, read.level(), read.layer());
}

std::optional<Image> Renderer::takePixels(PixelTicket ticket) {
    const PublicCall call(mImpl, "Renderer::takePixels(PixelTicket)");
    return mImpl->pixels.take(ticket);
}
Result<Image> Renderer::waitPixels(PixelTicket ticket) {
    const PublicCall call(mImpl, "Renderer::waitPixels(PixelTicket)");
    return mImpl->pixels.wait(ticket);
}

PickTicket Renderer::pick(Scene const& scene, View const& view, uint2 pixel, PickAim aim) {
    const PublicCall call(mImpl, "Renderer::pick(Scene, View, uint2, PickAim)");
    mImpl->check(scene);
    return mImpl->pick(scene, view, pixel, aim);
}
std::optional<PickHit> Renderer::takePick(PickTicket ticket) {
    const PublicCall call(mImpl, "Renderer::takePick(PickTicket)");
    return mImpl->pickerOfRenderer().take(ticket);
}
Result<PickHit> Renderer::waitPick(PickTicket ticket) {
    const PublicCall call(mImpl, "Renderer::waitPick(PickTicket)");
    return mImpl->pickerOfRenderer().wait(ticket);
}

Result<Image> Renderer::renderToImage(Scene const& scene, View const& view) {
    const PublicCall call(mImpl, "Renderer::renderToImage(Scene, View)");
    mImpl->check(scene);
    return orOutOfMemory("render to image", {}, [&]() -> Result<Image> {
        engine::SwapChainState& target = mImpl->engine.swapChains.get(mImpl->imageTarget.of(view.size));
        View whole = view;
        whole.viewport.reset();
        if (Result<void> drawn = mImpl->renderInto(target, scene, whole); !drawn) return drawn.error();
        return waitPixels(mImpl->pixels.ask(mImpl->engine.textures.get(target.images[target.current])));
    });
}

FrameStatistics Renderer::statistics() const {
    const PublicCall call(mImpl, "Renderer::statistics()");
    return mImpl->summary.statistics;
}
std::vector<FrameTimings> Renderer::takeTimings() {
    const PublicCall call(mImpl, "Renderer::takeTimings()");
    return mImpl->timings.take();
}

std::vector<EffectDecision> Renderer::decisions() const {
    const PublicCall call(mImpl, "Renderer::decisions()");
    return engine::decisions(mImpl->summary, mImpl->plan, mImpl->timings.latestPasses());
}

std::string Renderer::explain() const {
    const PublicCall call(mImpl, "Renderer::explain()");
    return engine::explain(mImpl->summary, mImpl->plan, mImpl->timings.latestPasses()) +
           engine::explainProbes(mImpl->probeLines) + engine::explainGrids(mImpl->gridLines) +
           (mImpl->engine.streamer ? mImpl->engine.streamer->explain() : std::string());
}

std::string Renderer::graphviz() const {
    const PublicCall call(mImpl, "Renderer::graphviz()");
    return mImpl->plan.graph ? framegraph::toGraphviz(mImpl->plan) : std::string();
}

} // namespace filament_core
