// SPDX-License-Identifier: Apache-2.0
#include <filament/Renderer.h>

#include "backend/stream/RecordingGuards.h"
#include "base/OutOfMemory.h"
#include "filament_core/engine/FrameSummary.h"
#include "filament_core/engine/FrameTimingLog.h"
#include "filament_core/engine/PixelReads.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/passes/ColorPass.h"
#include "filament_core/passes/ToneMapPass.h"
#include "filament_core/prepare/PrepareFrame.h"
#include "framegraph/CompiledGraph.h"
#include "framegraph/Explain.h"

#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace filament {
namespace {

using namespace backend;
using framegraph::CompiledGraph;
using framegraph::FrameGraph;
using framegraph::TextureId;
using passes::FrameContext;

constexpr Sampler kTrilinear{ Filter::Linear, Filter::Linear, MipFilter::Linear };
constexpr Sampler kBilinear{ Filter::Linear, Filter::Linear, MipFilter::None };
constexpr Sampler kNearest{};

uint32_t toneTableSize(ToneMapping mapping) {
    return mapping == ToneMapping::Table16 ? 16 : mapping == ToneMapping::Table32 ? 32 : 64;
}

} // namespace

struct Renderer::Impl {
    Impl(Engine::Impl& owner, RendererOptions const& rendererOptions)
            : engine(owner), options(rendererOptions), data(*owner.stream), graph(arena), transients(*owner.stream),
              ranges(owner.jobs), timings(owner), pixels(owner) {}

    ~Impl() {
        data.destroy(engine.pending);
        transients.destroyAll(engine.pending);
        if (imageTarget) engine.destroy(imageTarget);
    }

    /// An error: the frame was left out, for lack of memory or of a target. What it made on the way serves the next
    /// one.
    Result<void> render(Scene const& scene, View const& view, engine::TextureState const& target) {
        if (!target.handle) return engine::noImage(target.desc.width, target.desc.height);
        try {
            engine.compilations.collect(engine.stream->replayedSubmissions());
            renderFrame(scene, view, target);
            return {};
        } catch (std::bad_alloc const&) {
            plan = {};
            Error error = outOfMemory("a frame is left out");
            engine.report(error.message);
            return error;
        }
    }

    /// The six-line frame of docs/architecture.md, with its measurements.
    void renderFrame(Scene const& scene, View const& view, engine::TextureState const& target) {
        const jobs::AdoptedThread seat(engine.jobs); // the app thread works along
        arena.reset();
        graph.reset();
        plan = {};
        timers.clear();
        engine::FrameTimingLog::Stamps stamps{ .begin = clock() };
        const uint64_t busyBefore = engine.jobs.busyNanoseconds();
        FrameContext* context = arena.make<FrameContext>();
        context->packet = prepareScene(scene, view);
        stamps.prepared = clock();
        if (engine.options.hashFrames) stamps.packetHash = prepare::hashPacket(context->packet);

        const uint32_t tableSize = view.quality.dfgTableSize;
        engine.dfgTable(tableSize); // made before the frame, if this is the first that wants it
        const TextureHandle toneTable = toneTableOf(view);
        {
            FrameCommands commands(*engine.stream); // waits when two frames ahead; submits at the end of this block
            stamps.acquired = clock();
            commands->record(CmdBeginFrame{ ++frame });
            const InReserve<CmdEndFrame> end{ *commands, { frame } };
            engine.useTextureFilter(view.quality.textureFilter);
            engine.drainPending(*commands);
            engine.recordCompilations(*commands);
            upload(*commands, *context, tableSize);
            describe(*context, view, target, toneTable);
            plan = compile(graph, transients);
            framegraph::record(*commands, plan, options.passTimers ? &timers : nullptr, &ranges);
        }

        stamps.recorded = clock();
        stamps.workerBusyNanoseconds = engine.jobs.busyNanoseconds() - busyBefore;
        timings.add(frame, stamps, timers);
        summary = engine::summarize(frame, context->packet, plan);
    }

    prepare::FramePacket prepareScene(Scene const& scene, View const& view) {
        const std::array views{ prepare::ViewInput{
                .camera = view.camera, .size = view.size, .timeSeconds = view.timeSeconds, .quality = view.quality } };
        return prepare::prepareFrame(engine.jobs, arena, scene.impl().upToDate(), views);
    }

    void upload(CommandBuffer& commands, FrameContext& context, uint32_t tableSize) {
        const auto sampler = [&](Sampler const& wanted) { return engine.samplers.get(wanted, commands); };
        prepare::EnvironmentPacket const& environment = context.packet.environment;
        const TextureHandle black = engine.textureHandle(engine.defaults.blackCube);
        data.upload(engine.jobs, commands, context.packet,
                    { .specular = environment.specular ? environment.specular : black,
                      .dfg = engine.textureHandle(engine.dfgTable(tableSize)),
                      .sky = environment.sky ? environment.sky : black,
                      .irradiance = environment.irradiance ? environment.irradiance : black,
                      .trilinear = sampler(kTrilinear),
                      .bilinear = sampler(kBilinear) });
        context.views = data.views();
        context.postGroup = data.postGroup();
        context.deformations = data.deformations();
        context.instanceIds = engine.defaults.instanceIds;
        context.nearestSampler = sampler(kNearest);
    }

    /// The passes of such a frame, as slots of the pipeline cache, and their own pipelines as wishes.
    void expect(Scene const& scene, View const& view, engine::TextureState const& target) {
        const jobs::AdoptedThread seat(engine.jobs);
        arena.reset();
        graph.reset();
        plan = {};
        FrameContext* context = arena.make<FrameContext>();
        context->packet = prepareScene(scene, view);
        const TextureHandle toneTable = toneTableOf(view);
        const FramePasses passes = describe(*context, view, target, toneTable);
        plan = compile(graph, transients);
        const uint32_t colorSlot = engine.pipelines.slot(
                passes::slotOf(context->settings, plan.passLayout(passes.color), plan.subpass(passes.color)));
        if (context->skybox) wishForPicture(*context->skybox, colorSlot);
        if (passes.toneMap) {
            const bool isMerged = plan.passes[passes.toneMap.index()].merge == framegraph::Merge::Merged;
            const passes::ToneMapMaterials materials = toneMapMaterials(view.colorGrading, toneTable);
            wishForPicture(isMerged ? *materials.merged : *materials.sampled,
                           engine.pipelines.slot(passes::fullScreenSlot(plan.passLayout(passes.toneMap),
                                                                        plan.subpass(passes.toneMap))));
        }
        plan = {};
    }

    void wishForPicture(scene::Material& material, uint32_t slot) {
        engine.compilations.add({ .material = &material, .wishes = { { .slot = slot, .isFullScreen = true } } },
                                CompilePriority::Critical);
    }

    void tryExpect(Scene const& scene, View const& view, engine::TextureState const& target) {
        try {
            expect(scene, view, target);
        } catch (std::bad_alloc const&) {
            plan = {};
            engine.reportOutOfMemory("expecting a frame");
        }
    }

    struct FramePasses {
        framegraph::PassId color, toneMap; ///< toneMap: none for scene-linear targets
    };

    /// Which passes the frame has. A scene-linear target takes the colour pass as it is.
    FramePasses describe(FrameContext& context, View const& view, engine::TextureState const& target,
                         TextureHandle toneTable) {
        FILAMENT_ASSERT(view.samples == 1 || view.samples == 4, "a view has 1 or 4 samples a pixel");
        const bool halfIsThere = engine.stream->info().features.halfFloatShaders;
        context.settings = { view.size,
                             view.samples,
                             view.clearColor,
                             passes::shadingKey(view.quality, context.packet.environment.storage),
                             view.quality.depthRange,
                             halfIsThere ? view.quality.shadingPrecision : ShadingPrecision::Full };
        context.arena = &arena;
        context.pipelines = &engine.pipelines;
        if (context.packet.environment.sky)
            context.skybox = &engine.materials.get(
                    engine.engineMaterial("skybox", { { "isRgbm", context.packet.environment.skyIsRgbm } }));

        const TextureId output = graph.importTexture(target.handle,
                                                     { .width = target.desc.width,
                                                       .height = target.desc.height,
                                                       .format = target.desc.format,
                                                       .name = "output" },
                                                     framegraph::InitialContents::Undefined);
        if (target.desc.format == Format::RGBA16F) {
            return { passes::addColorPass(graph, &context, output), {} };
        }
        const TextureId color = graph.createTexture(
                { .width = view.size.x, .height = view.size.y, .format = Format::RGBA16F, .name = "color" });
        const framegraph::PassId colorPass = passes::addColorPass(graph, &context, color);
        return { colorPass, passes::addToneMapPass(graph, &context, toneMapMaterials(view.colorGrading, toneTable),
                                                   color, output) };
    }

    TextureHandle toneTableOf(View const& view) {
        const ToneMapping mapping = view.quality.toneMapping;
        if (mapping == ToneMapping::Analytic) return {};
        return engine.textureHandle(engine.toneTable(view.colorGrading.toneMapper, toneTableSize(mapping)));
    }

    /// `table`: none for the formula.
    passes::ToneMapMaterials toneMapMaterials(ColorGrading grading, TextureHandle table) {
        const auto entry = toneMaps.try_emplace({ grading.toneMapper, grading.dither, static_cast<bool>(table) }).first;
        if (!entry->second.merged || !entry->second.sampled) {
            std::vector<MaterialConstant> constants{ { "dither", grading.dither } };
            if (!table) constants.push_back({ "toneMapper", static_cast<int32_t>(grading.toneMapper) });
            const char* const merged = table ? "tonemap_table" : "tonemap";
            const char* const sampled = table ? "tonemap_table_sampled" : "tonemap_sampled";
            entry->second.merged = &engine.materials.get(engine.engineMaterial(merged, constants));
            entry->second.sampled = &engine.materials.get(engine.engineMaterial(sampled, constants));
        }
        entry->second.table = table;
        return entry->second;
    }

    SwapChain imageTargetOf(uint2 size) {
        if (imageTarget && engine.swapChains.get(imageTarget).size == size) return imageTarget;
        if (imageTarget) engine.destroy(std::exchange(imageTarget, {}));
        imageTarget = engine.createSwapChain({ .size = size, .imageCount = 1, .name = "renderToImage" });
        return imageTarget;
    }

    /// The next image becomes the current one when it is drawn.
    Result<void> renderInto(engine::SwapChainState& chain, Scene const& scene, View const& view) {
        const uint32_t next = (chain.current + 1) % static_cast<uint32_t>(chain.images.size());
        Result<void> drawn = render(scene, view, engine.textures.get(chain.images[next]));
        if (drawn) chain.current = next;
        return drawn;
    }

    static engine::FrameTimingLog::TimePoint clock() { return std::chrono::steady_clock::now(); }

    Engine::Impl& engine;
    RendererOptions options;
    Arena arena;
    passes::FrameData data;
    FrameGraph graph;
    framegraph::TransientPool transients;
    framegraph::RangeRecorder ranges;
    CompiledGraph plan;
    std::vector<framegraph::PassTimer> timers;
    engine::FrameTimingLog timings;
    std::map<std::tuple<ToneMapper, bool, bool>, passes::ToneMapMaterials> toneMaps; ///< mapper, dither, from a table
    engine::PixelReads pixels;
    SwapChain imageTarget;
    uint64_t frame = 0;
    engine::FrameSummary summary;
};

Renderer::Renderer(Engine& engine, RendererOptions const& options) : mImpl(new Impl(engine.impl(), options)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::render(Scene const& scene, View const& view, SwapChain swapChain) {
    engine::SwapChainState& state = mImpl->engine.swapChains.get(swapChain);
    FILAMENT_ASSERT(state.size == view.size, "a view has the size of its swap chain");
    (void)mImpl->renderInto(state, scene, view); // takeErrors() says why it may not be there
}

void Renderer::render(Scene const& scene, View const& view, RenderTarget target) {
    engine::TextureState const& color = mImpl->engine.textures.get(mImpl->engine.renderTargets.get(target).color);
    FILAMENT_ASSERT(color.desc.width == view.size.x && color.desc.height == view.size.y,
                    "a view has the size of its render target");
    (void)mImpl->render(scene, view, color);
}

void Renderer::expect(Scene const& scene, View const& view, SwapChain swapChain) {
    engine::SwapChainState const& state = mImpl->engine.swapChains.get(swapChain);
    mImpl->tryExpect(scene, view, mImpl->engine.textures.get(state.images[state.current]));
}

void Renderer::expect(Scene const& scene, View const& view, RenderTarget target) {
    mImpl->tryExpect(scene, view, mImpl->engine.textures.get(mImpl->engine.renderTargets.get(target).color));
}

PixelTicket Renderer::readPixels(SwapChain swapChain) {
    engine::SwapChainState const& state = mImpl->engine.swapChains.get(swapChain);
    return mImpl->pixels.ask(mImpl->engine.textures.get(state.images[state.current]));
}

PixelTicket Renderer::readPixels(RenderTarget target) {
    return mImpl->pixels.ask(mImpl->engine.textures.get(mImpl->engine.renderTargets.get(target).color));
}

std::optional<Image> Renderer::takePixels(PixelTicket ticket) { return mImpl->pixels.take(ticket); }
Result<Image> Renderer::waitPixels(PixelTicket ticket) { return mImpl->pixels.wait(ticket); }

Result<Image> Renderer::renderToImage(Scene const& scene, View const& view) {
    return orOutOfMemory("render to image", {}, [&]() -> Result<Image> {
        engine::SwapChainState& target = mImpl->engine.swapChains.get(mImpl->imageTargetOf(view.size));
        if (Result<void> drawn = mImpl->renderInto(target, scene, view); !drawn) return drawn.error();
        return waitPixels(mImpl->pixels.ask(mImpl->engine.textures.get(target.images[target.current])));
    });
}

FrameStatistics Renderer::statistics() const { return mImpl->summary.statistics; }
std::vector<FrameTimings> Renderer::takeTimings() { return mImpl->timings.take(); }

std::string Renderer::explain() const { return engine::explain(mImpl->summary, mImpl->plan); }

std::string Renderer::graphviz() const {
    return mImpl->plan.graph ? framegraph::toGraphviz(mImpl->plan) : std::string();
}

} // namespace filament
