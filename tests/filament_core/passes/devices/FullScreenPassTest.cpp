// SPDX-License-Identifier: Apache-2.0
// Full-screen passes on both devices: pixel positions, inputs, and the same bits however the pass is drawn.
#include "filament_core/passes/FullScreenPass.h"

#include "backend/create/CreateDriver.h"
#include "backend/layers/Validated.h"
#include "filament_core/passes/DepthPass.h"
#include "filament_core/prepare/PrepareFrame.h"
#include "framegraph/CompiledGraph.h"
#include "toolkit/packages/PackageCache.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <deque>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::CompiledGraph;
using framegraph::TextureId;

using Floats = std::vector<float>;

struct Output {
    uint32_t width = 1, height = 1;
    uint8_t levels = 1, level = 0; ///< the one that is drawn to and read back
};

/// A device with the parts of an engine that passes need.
class Stage {
public:
    explicit Stage(Backend type)
            : mStream(start(type)), mPipelines(*mStream, mLayouts), mData(*mStream), mBlocks(*mStream), mGraph(mArena),
              mPool(*mStream) {}

    ~Stage() {
        CommandBuffer& commands = mStream->acquire();
        for (scene::Material& material : mMaterials) mPipelines.forget(commands, material);
        mData.destroy(commands);
        mBlocks.destroy(commands);
        mPool.destroyAll(commands);
        mStream->submit(commands);
    }

    CommandStream& stream() { return *mStream; }

    /// A material from the text between "material {" and the end of the fragment block.
    scene::Material& material(std::string const& properties, std::string const& code) {
        return keep(tools::compilePackage("material { name : effect, domain : postprocess,\n" + properties +
                                                  "}\nfragment { void postProcess(inout PostProcessInputs inputs) {\n" +
                                                  code + "\n} }",
                                          "effect.mat"));
    }

    /// One of the engine's.
    scene::Material& materialOfFile(std::string const& path) {
        std::ifstream file(tools::sourceDir() / path);
        const std::string text{ std::istreambuf_iterator<char>(file), {} };
        return keep(tools::compilePackage(text, path));
    }

    /// describe(graph, context, target) declares the passes; returns the RGBA values of the target, top row first.
    template <class Describe>
    Floats draw(Output const& output, Describe&& describe) {
        CommandBuffer& commands = mStream->acquire();
        const TextureHandle target = createTarget(commands, output);
        FrameContext* context = beginFrame(commands);
        const TextureId into = mGraph.importTexture(target,
                                                    { .width = output.width,
                                                      .height = output.height,
                                                      .format = Format::RGBA32F,
                                                      .levels = output.levels,
                                                      .name = "target" },
                                                    framegraph::InitialContents::Undefined);
        describe(mGraph, *context, into);
        mBlocks.upload(commands);
        mPlan = compile(mGraph, mPool);
        record(commands, mPlan, nullptr, nullptr);
        const Ticket ticket = mStream->nextTicket();
        const uint32_t width = output.width >> output.level, height = output.height >> output.level;
        commands.record(CmdReadTexture{
                .texture = target, .level = output.level, .rect = { 0, 0, width, height }, .ticket = ticket });
        commands.record(CmdDestroyTexture{ target });
        mStream->submit(commands);
        const Result<std::vector<std::byte>> bytes = mStream->waitReadback(ticket);
        for (DriverError const& error : mStream->takeErrors()) ADD_FAILURE() << error.message;
        Floats values(bytes ? bytes->size() / sizeof(float) : 0);
        if (bytes) std::memcpy(values.data(), bytes->data(), bytes->size());
        EXPECT_EQ(values.size(), size_t{ width } * height * 4);
        return values;
    }

    bool isMerged(framegraph::PassId pass) const {
        return mPlan.passes[pass.index()].merge == framegraph::Merge::Merged;
    }

private:
    scene::Material& keep(Result<tools::CompiledPackage> const& compiled) {
        EXPECT_TRUE(compiled) << (compiled ? "" : compiled.error().message);
        scene::Material& made = mMaterials.emplace_back();
        made.id = static_cast<uint32_t>(mMaterials.size());
        made.name = "effect";
        if (compiled) made.package = *shader::readPackage(compiled->bytes);
        return made;
    }

    static std::unique_ptr<CommandStream> start(Backend type) {
        auto stream = CommandStream::start([type](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
            Result<std::unique_ptr<Driver>> driver = createDriver(type, { .validation = true }, sink);
            if (!driver) return driver;
            return validate(std::move(*driver), sink);
        });
        return stream ? std::move(*stream) : nullptr;
    }

    TextureHandle createTarget(CommandBuffer& commands, Output const& output) {
        const TextureHandle target = mStream->allocateTexture();
        commands.record(CmdCreateTexture{
                target,
                { .format = Format::RGBA32F,
                  .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource | TextureUsage::Sampled,
                  .levels = output.levels,
                  .width = output.width,
                  .height = output.height,
                  .debugName = "target" } });
        return target;
    }

    /// The view has another size, which no pass here uses.
    FrameContext* beginFrame(CommandBuffer& commands) {
        mArena.reset();
        mGraph.reset();
        mBlocks.begin();
        if (!mNearest) {
            mNearest = mStream->allocateSampler();
            commands.record(CmdCreateSampler{ mNearest, {} });
        }
        FrameContext* context = mArena.make<FrameContext>();
        const std::array views{ prepare::ViewInput{ .size = { 640, 480 } } };
        context->packet = prepareFrame(mJobs, mArena, mScene, views);
        mData.upload(mJobs, commands, context->packet);
        context->arena = &mArena;
        context->resources.pipelines = PipelineSource(mPipelines);
        context->resources.samplers.nearest = mNearest;
        context->blocks = &mBlocks;
        context->views = mData.views();
        return context;
    }

    std::unique_ptr<CommandStream> mStream;
    jobs::JobSystem mJobs{ { .workers = 0 } };
    scene::SceneData mScene;
    scene::GeometryLayouts mLayouts;
    std::deque<scene::Material> mMaterials;
    PipelineCache mPipelines;
    FrameData mData;
    PassBlocks mBlocks;
    Arena mArena;
    framegraph::FrameGraph mGraph;
    framegraph::TransientPool mPool;
    CompiledGraph mPlan;
    SamplerHandle mNearest;
};

class FullScreenPasses : public testing::Test {
protected:
    void SetUp() override {
        for (const Backend type : { Backend::Vulkan, Backend::Gles }) {
            auto probe = CommandStream::start(
                    [type](ResultSink& sink) { return createDriver(type, { .validation = true }, sink); });
            if (!probe) GTEST_SKIP() << "needs a Vulkan and an OpenGL ES device";
        }
    }

    /// Runs draw(stage) on both devices; the images must be equal to the bit.
    template <class Draw>
    static Floats onBoth(Draw&& draw) {
        Stage vulkan(Backend::Vulkan), gles(Backend::Gles);
        const Floats picture = draw(vulkan), other = draw(gles);
        EXPECT_EQ(picture.size(), other.size());
        for (size_t i = 0; i < std::min(picture.size(), other.size()); ++i) {
            if (std::bit_cast<uint32_t>(picture[i]) == std::bit_cast<uint32_t>(other[i])) continue;
            ADD_FAILURE() << "value " << i << ": " << picture[i] << " on Vulkan, " << other[i] << " on OpenGL ES";
            break;
        }
        return picture;
    }
};

TEST_F(FullScreenPasses, CountCoordinatesOverTheTargetAndNotOverTheView) {
    for (Output const& output : { Output{ 64, 48 }, Output{ 32, 24 }, Output{ 64, 48, 3, 1 }, Output{ 64, 48, 3, 2 },
                                  Output{ 33, 17, 2, 1 } }) {
        const Floats picture = onBoth([&](Stage& stage) {
            scene::Material& where = stage.material("", "inputs.color = vec4(getNormalizedUV(), getResolution().xy);");
            return stage.draw(output, [&](framegraph::FrameGraph& graph, FrameContext const& context,
                                          TextureId target) {
                addFullScreenPass(graph, context,
                                  { .name = "where", .material = where, .target = target, .level = output.level });
            });
        });
        const uint32_t width = output.width >> output.level, height = output.height >> output.level;
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        for (uint32_t y = 0; y < height; ++y) {
            for (uint32_t x = 0; x < width; ++x) {
                const float* at = &picture[(size_t{ y } * width + x) * 4];
                ASSERT_EQ(at[0], (static_cast<float>(x) + 0.5f) * (1 / w)) << x << ", " << y;
                ASSERT_EQ(at[1], (static_cast<float>(y) + 0.5f) * (1 / h)) << x << ", " << y;
                ASSERT_EQ(at[2], w);
                ASSERT_EQ(at[3], h);
            }
        }
    }
}

// A pattern of integers, so that sums are exact.
constexpr const char* kPattern = "inputs.color = vec4(float(getPixel().x * 3 + getPixel().y * 256), 1.0, 2.0, 3.0);";

TEST_F(FullScreenPasses, AtHalfSizeReadTheFourPixelsThatTheyCover) {
    const Floats picture = onBoth([](Stage& stage) {
        scene::Material& pattern = stage.material("", kPattern);
        scene::Material& half = stage.material(
                "parameters : [ { name : color, type : sampler2d } ]",
                "vec2 texel = 0.25 / getResolution().xy; vec2 uv = getNormalizedUV();\n"
                "for (int i = 0; i < 4; ++i) { vec2 corner = vec2((i & 1) == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);\n"
                "inputs.color += texture(materialParams_color, uv + corner * texel); }");
        return stage.draw({ 16, 12 }, [&](framegraph::FrameGraph& graph, FrameContext const& context,
                                          TextureId target) {
            const TextureId full =
                    graph.createTexture({ .width = 32, .height = 24, .format = Format::RGBA32F, .name = "full" });
            addFullScreenPass(graph, context, { .name = "pattern", .material = pattern, .target = full });
            const std::array inputs{ FullScreenInput{ .name = "color", .texture = full } };
            addFullScreenPass(graph, context, { .name = "half", .material = half, .inputs = inputs, .target = target });
        });
    });
    const auto pattern = [](uint32_t x, uint32_t y) { return static_cast<float>(x * 3 + y * 256); };
    for (uint32_t y = 0; y < 12; ++y) {
        for (uint32_t x = 0; x < 16; ++x) {
            const float sum = pattern(2 * x, 2 * y) + pattern(2 * x + 1, 2 * y) + pattern(2 * x, 2 * y + 1) +
                              pattern(2 * x + 1, 2 * y + 1);
            ASSERT_EQ(picture[(y * 16 + x) * 4], sum) << x << ", " << y;
            ASSERT_EQ(picture[(y * 16 + x) * 4 + 3], 1.0f + 4 * 3.0f) << "alpha begins at 1";
        }
    }
}

/// pattern -> effect, which reads its own pixel and a second image; `between` prevents merging.
Floats drawEffect(Stage& stage, bool between) {
    scene::Material& pattern = stage.material("", kPattern);
    scene::Material& other = stage.material("", "inputs.color = vec4(getNormalizedUV().yx, 0.5, 1.0);");
    scene::Material& effect = stage.material(
            "parameters : [ { name : map, type : sampler2d }, { name : color, type : sampler2d, currentPixel : true "
            "},\n"
            "{ name : strength, type : float3 }, { name : offset, type : int } ]",
            "vec4 color = getCurrentPixel(materialParams_color);\n"
            "inputs.color = sqrt(color) * vec4(materialParams.strength, 1.0)\n"
            "        + texture(materialParams_map, getNormalizedUV().yx) + float(materialParams.offset);");
    constexpr std::string_view kInputs[] = { "map", "color" };
    constexpr FullScreenParameter kValues[] = { { "strength", ParameterType::Float3 },
                                                { "offset", ParameterType::Int } };
    const Result<void> fits = checkFullScreenMaterial(effect, { "effect", kInputs, kValues });
    EXPECT_TRUE(fits) << (fits ? "" : fits.error().message);
    framegraph::PassId last;
    const Floats picture = stage.draw({ 20, 14 }, [&](framegraph::FrameGraph& graph, FrameContext const& context,
                                                      TextureId target) {
        const framegraph::GraphTextureDesc like{ .width = 20, .height = 14, .format = Format::RGBA32F, .name = "a" };
        const TextureId color = graph.createTexture(like), map = graph.createTexture(like);
        const auto draw = [&](scene::Material& material, TextureId into) {
            addFullScreenPass(graph, context, { .name = "make", .material = material, .target = into });
        };
        if (between) draw(pattern, color);
        draw(other, map);
        if (!between) draw(pattern, color);
        const std::array inputs{ FullScreenInput{ .name = "color", .texture = color },
                                 FullScreenInput{ .name = "map", .texture = map } };
        const std::array values{ FullScreenValue{ "offset", int32_t{ 7 } },
                                 FullScreenValue{ "strength", float3(1, 10, 100) } };
        last = addFullScreenPass(
                graph, context,
                { .name = "effect", .material = effect, .inputs = inputs, .values = values, .target = target });
    });
    EXPECT_EQ(stage.isMerged(last), !between);
    return picture;
}

TEST_F(FullScreenPasses, GiveTheSameBitsMergedAndSampled) {
    const Floats merged = onBoth([](Stage& stage) { return drawEffect(stage, false); });
    const Floats sampled = onBoth([](Stage& stage) { return drawEffect(stage, true); });
    EXPECT_EQ(merged, sampled);
    for (const size_t pixel : { size_t{ 0 }, size_t{ 5 * 20 + 3 }, size_t{ 13 * 20 + 19 } }) {
        const auto x = static_cast<float>(pixel % 20), y = static_cast<float>(pixel / 20);
        const float* const at = &merged[pixel * 4];
        EXPECT_NEAR(at[0], std::sqrt(x * 3 + y * 256) + (x + 0.5f) / 20 + 7, 0.06f) << "the map is looked up nearest";
        EXPECT_NEAR(at[1], 10 + (y + 0.5f) / 14 + 7, 0.06f);
        EXPECT_NEAR(at[2], 100 * std::sqrt(2.0f) + 0.5f + 7, 1e-3f);
        EXPECT_NEAR(at[3], std::sqrt(3.0f) + 1 + 7, 1e-5f);
    }
}

TEST_F(FullScreenPasses, OfSteadyFramesMakeNothingNew) {
    Stage stage(Backend::Vulkan);
    scene::Material& tinted =
            stage.material("parameters : [ { name : tint, type : float4 } ]", "inputs.color = materialParams.tint;");
    for (int frame = 0; frame < 6; ++frame) {
        const float value = static_cast<float>(frame);
        const Floats picture =
                stage.draw({ 4, 4 }, [&](framegraph::FrameGraph& graph, FrameContext const& context, TextureId target) {
                    const std::array values{ FullScreenValue{ "tint", float4(value, value, value, 1) } };
                    addFullScreenPass(graph, context,
                                      { .name = "tint", .material = tinted, .values = values, .target = target });
                });
        ASSERT_EQ(picture[0], value) << "values are of their frame";
    }
    EXPECT_EQ(stage.stream().statistics().programsCreated, 1u);
}

/// From the level before it, as DepthPass.cpp adds it.
void addLevel(framegraph::FrameGraph& graph, FrameContext const& context, scene::Material const& material,
              uint8_t level, TextureId target) {
    const std::array inputs{ FullScreenInput{
            .name = "level", .texture = target, .range = oneLevel(static_cast<uint8_t>(level - 1)) } };
    addFullScreenPass(graph, context,
                      { .name = "pyramid", .material = material, .inputs = inputs, .target = target, .level = level });
}

// Every pixel is below one cell of each level, also where rows and columns are left over.
TEST_F(FullScreenPasses, OfThePyramidKeepTheNearestDistanceBelowEachCell) {
    const auto pattern = [](uint32_t x, uint32_t y) { return static_cast<float>((x * 73 + y * 179) % 251 + 1); };
    for (const uint2 size : { uint2(8, 8), uint2(13, 7), uint2(33, 17), uint2(64, 48), uint2(5, 40), uint2(130, 67) }) {
        const auto levels = static_cast<uint8_t>(pyramidLevels(size));
        for (uint8_t level = 1; level < levels; ++level) {
            const Floats picture = onBoth([&](Stage& stage) {
                scene::Material& source = stage.material(
                        "", "inputs.color = vec4(float((getPixel().x * 73 + getPixel().y * 179) % 251 + 1));");
                scene::Material& pyramid = stage.materialOfFile("shaders/post/depth_pyramid.mat");
                return stage.draw({ size.x, size.y, levels, level },
                                  [&](framegraph::FrameGraph& graph, FrameContext const& context, TextureId target) {
                                      addFullScreenPass(graph, context,
                                                        { .name = "source", .material = source, .target = target });
                                      for (uint8_t at = 1; at <= level; ++at)
                                          addLevel(graph, context, pyramid, at, target);
                                  });
            });
            const uint32_t width = size.x >> level, height = size.y >> level;
            ASSERT_EQ(picture.size(), size_t{ width } * height * 4);
            Floats nearest(size_t{ width } * height, 1e9f);
            for (uint32_t y = 0; y < size.y; ++y) {
                for (uint32_t x = 0; x < size.x; ++x) {
                    float& cell = nearest[std::min(y >> level, height - 1) * width + std::min(x >> level, width - 1)];
                    cell = std::min(cell, pattern(x, y));
                }
            }
            for (size_t i = 0; i < nearest.size(); ++i)
                ASSERT_EQ(picture[4 * i], nearest[i]) << size.x << " x " << size.y << ", level " << int{ level };
        }
    }
}

} // namespace
} // namespace filament_core::passes
