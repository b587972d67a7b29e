// SPDX-License-Identifier: Apache-2.0
// Passes of the app and mesh passes: memory runs out at every allocation, the device is lost at every command and
// refuses every creation; on the null backend.
#include "tests/faults/AllocationSweep.h"
#include "tests/faults/FaultStage.h"
#include "tests/filament_core/engine/CompiledMaterials.h"

namespace filament_core::test {
namespace {

using backend::FaultInjector;

constexpr const char* kTwoColours = R"(material { name : two, domain : postprocess,
    outputs : [ { name : a }, { name : b } ] }
fragment { void postProcess(inout PostProcessInputs inputs) { inputs.a = vec4(1.0); } })";
constexpr const char* kTwoOfMeshes = R"(material { name : meshes, shadingModel : unlit,
    outputs : [ { name : a }, { name : b } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.a = vec4(1.0); } })";
constexpr const char* kOverPicture = R"(material { name : over, domain : postprocess,
    parameters : [ { type : sampler2d, name : color }, { type : sampler2d, name : depth } ] }
fragment { void postProcess(inout PostProcessInputs inputs) {
    inputs.color = texelFetch(materialParams_color, getPixel(), 0) * texelFetch(materialParams_depth, getPixel(), 0).x;
} })";

/// A frame with a pass of the app over its picture, a pass without a view, and a mesh pass, which keep to one target;
/// and a pass into a slice.
class PassesStage {
public:
    explicit PassesStage(Engine& engine) : mEngine(engine), mStage(engine) {
        for (const char* text : { kTwoColours, kTwoOfMeshes, kOverPicture }) {
            Result<Material> material = engine.create(MaterialDesc{ .package = compiledPackage(text) });
            EXPECT_TRUE(material);
            mMaterials.push_back(engine.own(*material));
            mInstances.push_back(engine.own(engine.createInstance(mMaterials.back())));
        }
        for (const Format format : { Format::RGBA16F, Format::RGBA8, Format::R32F })
            mTextures.push_back(engine.own(
                    engine.create(TextureDesc{ .format = format, .width = 16, .height = 16, .renderable = true })));
        mTarget = engine.own(engine.create(
                RenderTargetDesc{ .color = mTextures[0], .depth = mTextures[2], .others = { mTextures[1] } }));
        mTextures.push_back(engine.own(engine.create(TextureDesc{ .kind = TextureKind::Texture3D,
                                                                  .format = Format::RGBA16F,
                                                                  .width = 16,
                                                                  .height = 16,
                                                                  .layers = 4,
                                                                  .renderable = true })));
        mSlice = engine.own(
                engine.create(RenderTargetDesc{ .color = mTextures[3], .layer = 2, .others = { mTextures[1] } }));
        mPasses[0] = { mInstances[2], PassPlace::BeforeToneMapping };
        mStage.view().postProcess = mPasses;
    }

    Result<void> draw() {
        Renderer& renderer = mStage.renderer();
        renderer.render(mInstances[0], mTarget);
        renderer.render(mInstances[0], mSlice);
        renderer.render(mStage.scene(), { .material = mInstances[1], .contents = TargetContents::Keep }, mTarget,
                        mStage.view());
        renderer.render(mStage.scene(), { .material = mInstances[1], .keepsHoles = true }, mTarget, mStage.view());
        const Result<Image> pixels = renderer.waitPixels(renderer.readPixels(mTarget));
        const Result<Image> image = mStage.draw();
        if (!pixels) return pixels.error();
        return image ? Result<void>{} : image.error();
    }
    void prewarm() {
        Renderer& renderer = mStage.renderer();
        renderer.prewarm(mInstances[0], mTarget);
        renderer.prewarm(mStage.scene(), { .material = mInstances[1] }, mTarget, mStage.view());
    }

private:
    Engine& mEngine;
    FaultStage mStage;
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::vector<Owned<Texture>> mTextures;
    Owned<RenderTarget> mTarget, mSlice;
    std::array<PostProcessPass, 1> mPasses;
};

/// The first or the second frame with passes, or their announcement.
class DrawsPasses final : public Scenario {
public:
    enum class What { First, Second, Expected };
    explicit DrawsPasses(What what) : mWhat(what), mEngine(makeEngine({})), mStage(*mEngine) {
        if (what == What::Second) EXPECT_TRUE(mStage.draw());
    }
    Result<void> act() override {
        if (mWhat != What::Expected) return mStage.draw();
        mStage.prewarm();
        return {};
    }
    void expectSound(Result<void> const& outcome) override {
        if (!outcome.ok()) {
            const ErrorCode code = outcome.error().code;
            EXPECT_TRUE(code == ErrorCode::OutOfMemory || code == ErrorCode::DeviceLost ||
                        code == ErrorCode::DeviceUnavailable)
                    << outcome.error().message;
        }
        const Result<void> again = mStage.draw();
        EXPECT_TRUE(again || again.error().code == ErrorCode::DeviceLost) << again.error().message;
        mEngine->waitIdle();
        for (std::string const& error : mEngine->takeErrors()) EXPECT_TRUE(contains(error, "memory")) << error;
    }

private:
    What mWhat;
    Result<Engine> mEngine;
    PassesStage mStage;
};

void sweepPasses(std::string const& name, DrawsPasses::What what, uint64_t stride) {
    const uint64_t failed =
            sweepAllocations({ .name = name, .stride = stride }, [&] { return std::make_unique<DrawsPasses>(what); });
    EXPECT_GT(failed, what == DrawsPasses::What::Second ? 2u : 20u);
}

TEST(PassMemory, RunsOutInTheFirstFrameWithPasses) { sweepPasses("passes-first", DrawsPasses::What::First, 5); }
TEST(PassMemory, RunsOutInALaterFrameWithPasses) { sweepPasses("passes-later", DrawsPasses::What::Second, 1); }
TEST(PassMemory, RunsOutWhilePassesAreAnnounced) { sweepPasses("passes-expected", DrawsPasses::What::Expected, 3); }

struct BrokenPasses {
    BrokenPasses() : engine(makeEngine({}, injector)) {
        EXPECT_TRUE(engine.ok());
        stage.emplace(*engine);
        engine->waitIdle();
    }
    std::shared_ptr<FaultInjector> injector = std::make_shared<FaultInjector>();
    Result<Engine> engine;
    std::optional<PassesStage> stage;
};

std::pair<uint64_t, uint64_t> countsOfPasses() {
    BrokenPasses whole;
    whole.injector->arm({});
    EXPECT_TRUE(whole.stage->draw());
    whole.engine->waitIdle();
    return { whole.injector->commandsSeen(), whole.injector->creationsSeen() };
}

TEST(PassDevice, IsToldLostOnceAtEveryCommandOfPasses) {
    const uint64_t commands = countsOfPasses().first;
    ASSERT_GT(commands, 60u);
    const uint64_t stride = isStress() ? 1 : 3;
    for (uint64_t at = 1; at <= commands; at += stride) {
        SCOPED_TRACE(at);
        BrokenPasses broken;
        broken.injector->arm({ .loseDeviceAt = at });
        EXPECT_FALSE(broken.stage->draw());
        EXPECT_FALSE(broken.stage->draw()) << "returns without waiting";
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << errors[0];
        EXPECT_TRUE(contains(errors[0], "lost")) << errors[0];
    }
}

TEST(PassDevice, RefusesEveryCreationOfPassesAndTheRestIsDrawn) {
    const uint64_t creations = countsOfPasses().second;
    ASSERT_GT(creations, 15u);
    for (uint64_t at = 1; at <= creations; ++at) {
        SCOPED_TRACE(at);
        BrokenPasses broken;
        broken.injector->arm({ .refuseCreation = at });
        const Result<void> drawn = broken.stage->draw();
        EXPECT_TRUE(drawn || drawn.error().code == ErrorCode::DeviceUnavailable) << drawn.error().message;
        EXPECT_TRUE(broken.injector->hasStruck());
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << errors[0];
        EXPECT_TRUE(contains(errors[0], "out of device memory")) << errors[0];
    }
}

} // namespace
} // namespace filament_core::test
