// SPDX-License-Identifier: Apache-2.0
// Materials prepared before they are drawn: the first draw creates nothing, nobody waits, and impossible requests are
// reported.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <gmock/gmock.h>

#include <thread>

namespace filament_core {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kPlaster =
        R"(material { name : plaster, shadingModel : lit, variantFilter : [ skinning ], parameters : [ { type : float, name : roughness } ] }
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = vec4(0.8, 0.7, 0.6, 1.0);
        material.roughness = materialParams.roughness;
    }
}
)";

constexpr const char* kWithoutSun =
        R"(material { name : cellar, shadingModel : lit, variantFilter : [ directionalLighting ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(1.0); } }
)";

constexpr const char* kGlassPane =
        R"(material { name : pane, shadingModel : lit, blending : transparent, transparency : twoPassesTwoSides, doubleSided : true }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.4); } }
)";

class Compile : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mEngine = test::makeEngine(GetParam());
        ASSERT_TRUE(mEngine);
        mSquare.emplace(*mEngine);
        mRenderer.emplace(*mEngine);
        mView = test::SquareMesh::view();
        mTarget = mEngine->own(mEngine->create(SwapChainDesc{ .size = mView.size }));
    }

    /// Polls like an app without frames.
    CompileProgress finish(Compilation compilation) {
        CompileProgress progress = mEngine->progress(compilation);
        while (!progress.isComplete()) {
            std::this_thread::yield();
            progress = mEngine->progress(compilation);
        }
        return progress;
    }

    uint64_t pipelines() {
        mEngine->waitIdle();
        return mEngine->statistics().pipelinesCreated;
    }
    uint64_t programs() {
        mEngine->waitIdle();
        return mEngine->statistics().programsCreated;
    }
    void draw(Scene const& scene) { mRenderer->render(scene, mView, mTarget); }

    std::optional<Engine> mEngine;
    std::optional<test::SquareMesh> mSquare;
    std::optional<Renderer> mRenderer;
    Owned<SwapChain> mTarget;
    View mView;
};

TEST_P(Compile, WhatIsPreparedForAnExpectedFrameIsNotMadeByTheFirstDraw) {
    for (const char* text : { kPlaster, kGlassPane }) {
        Scene scene(*mEngine);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        const Owned<Material> material = test::loadMaterial(*mEngine, text);
        const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
        mRenderer->prewarm(scene, mView, mTarget);
        const auto compilation = mEngine->compile(material, { .vertices = { mSquare->vertices() } });
        ASSERT_TRUE(compilation) << compilation.error().message;
        const CompileProgress progress = finish(*compilation);
        EXPECT_GE(progress.total, 8u) << "a program and a pipeline for each variant";
        const uint64_t pipelinesBefore = pipelines(), programsBefore = programs();
        mSquare->add(scene, instance);
        draw(scene);
        scene.add(PointLight{ .positionWorld = { 0, 0, 1 } }); // another variant
        draw(scene);
        EXPECT_EQ(pipelines(), pipelinesBefore);
        EXPECT_EQ(programs(), programsBefore);
        EXPECT_THAT(mEngine->takeErrors(), IsEmpty());
    }
}

// Works whatever passes a frame has: expecting a frame walks the graph that draws it.
TEST_P(Compile, AnExpectedFrameRequestsThePipelinesOfItsPasses) {
    constexpr std::array<uint16_t, 6 * 4> kTexels{};
    const Owned<Texture> cube =
            mEngine->own(mEngine->create(TextureDesc{ .kind = TextureKind::Cube,
                                                      .format = Format::RGBA16F,
                                                      .layers = 6,
                                                      .pixels = std::as_bytes(std::span(kTexels)) }));
    const Owned<Skybox> sky = mEngine->own(mEngine->create(SkyboxDesc{ .cube = cube }));
    Scene scene(*mEngine);
    scene.setSkybox(sky, Lux{ 1000 });
    std::vector<View> views(4, mView);
    views[1].quality.toneMapping = ToneMapping::Table16;
    views[2].samples = 4; // the tone mapper cannot be merged
    views[3].quality.depthRange = DepthRange::Ordinary;
    for (size_t i = 0; i < views.size(); ++i) {
        mView = views[i];
        const uint64_t before = pipelines();
        mRenderer->prewarm(scene, mView, mTarget);
        const Owned<Material> material = test::loadMaterial(*mEngine, kPlaster);
        finish(*mEngine->compile(material, { .variants = VariantSet::None, .vertices = { mSquare->vertices() } }));
        const uint64_t expected = pipelines();
        EXPECT_GE(expected, before + 2) << "a pass at least, and one of plaster, for view " << i;
        draw(scene);
        draw(scene);
        EXPECT_EQ(pipelines(), expected) << "view " << i;
    }
    EXPECT_THAT(mEngine->takeErrors(), IsEmpty());
}

TEST_P(Compile, OrderIndependentMaterialsArePreparedForAllTheirPassesAndOthersForTheColourPassAlone) {
    const Owned<Material> glass = test::loadMaterial(*mEngine, kGlassPane);
    const Owned<Material> plaster = test::loadMaterial(*mEngine, kPlaster);
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(glass));
    const auto requestsOf = [&](Material material) {
        return finish(*mEngine->compile(material, { .vertices = { mSquare->vertices() } })).total;
    };
    Scene scene(*mEngine);
    for (const double z : { 0.0, -1.0 }) mSquare->add(scene, instance, { 0, 0, z });
    mRenderer->prewarm(scene, mView, mTarget);
    const uint32_t ofSortedGlass = requestsOf(glass), ofPlaster = requestsOf(plaster);
    for (const TransparencyOrder order : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        mView.quality.transparency = order;
        mRenderer->prewarm(scene, mView, mTarget);
    }
    EXPECT_GT(requestsOf(glass), ofSortedGlass);
    EXPECT_LT(requestsOf(plaster), ofPlaster) << "the tone mapper is no longer merged with it";
    const uint64_t pipelinesBefore = pipelines(), programsBefore = programs();
    for (const TransparencyOrder order : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        mView.quality.transparency = order;
        draw(scene);
    }
    EXPECT_EQ(pipelines(), pipelinesBefore);
    EXPECT_EQ(programs(), programsBefore);
    EXPECT_THAT(mEngine->takeErrors(), IsEmpty());
}

TEST_P(Compile, WithoutItTheFirstDrawMakesThem) {
    Scene scene(*mEngine);
    draw(scene);
    const uint64_t before = pipelines();
    const Owned<Material> material = test::loadMaterial(*mEngine, kPlaster);
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    mSquare->add(scene, instance);
    draw(scene);
    EXPECT_EQ(pipelines(), before + 1) << "this is what the test above would notice";
}

TEST_P(Compile, KnowsThePassesAndTheVerticesOfFramesThatWereDrawn) {
    Scene scene(*mEngine);
    const Owned<Material> first = test::loadMaterial(*mEngine, kWithoutSun);
    const Owned<MaterialInstance> shown = mEngine->own(mEngine->createInstance(first));
    mSquare->add(scene, shown);
    draw(scene);
    const Owned<Material> second = test::loadMaterial(*mEngine, kPlaster);
    const Owned<MaterialInstance> later = mEngine->own(mEngine->createInstance(second));
    mEngine->setCulling(later, Culling::Front); // a state of its own, known before compile()
    finish(*mEngine->compile(second));
    const uint64_t before = pipelines();
    mSquare->add(scene, later, { 0, 0, 0.1 });
    draw(scene);
    EXPECT_EQ(pipelines(), before);
    mEngine->setDepthWrite(later, false);
    draw(scene);
    EXPECT_EQ(pipelines(), before + 1) << "a state that nobody announced";
}

TEST_P(Compile, GoesInSlicesWithTheFramesAndTellsHowFarItIs) {
    Scene scene(*mEngine);
    const Owned<Material> material = test::loadMaterial(*mEngine, kPlaster);
    mRenderer->prewarm(scene, mView, mTarget);
    draw(scene);
    mEngine->waitIdle();
    std::vector<CompileProgress> told;
    const auto compilation = mEngine->compile(
            material, { .vertices = { mSquare->vertices() },
                        .onProgress = [&](CompileProgress const& progress) { told.push_back(progress); } });
    ASSERT_TRUE(compilation);
    for (int frame = 0; frame < 50; ++frame) {
        const uint64_t before = pipelines() + programs();
        draw(scene);
        EXPECT_LE(pipelines() + programs(), before + 2) << "what a frame carries at normal priority";
    }
    ASSERT_FALSE(told.empty());
    EXPECT_GE(told.size(), 4u) << "eight creations, two a frame";
    for (size_t i = 1; i < told.size(); ++i) EXPECT_EQ(told[i].done, told[i - 1].done + 2);
    EXPECT_TRUE(told.back().isComplete());
    EXPECT_EQ(mEngine->progress(*compilation), told.back());
}

TEST_P(Compile, HigherPrioritiesGoFirst) {
    Scene scene(*mEngine);
    const Owned<Material> low = test::loadMaterial(*mEngine, kPlaster), high = test::loadMaterial(*mEngine, kPlaster),
                          critical = test::loadMaterial(*mEngine, kPlaster);
    std::vector<std::string> order;
    const auto compile = [&](Material material, CompilePriority priority, std::string const& name) {
        const auto done = [&order, name](CompileProgress const& progress) {
            if (progress.isComplete()) order.push_back(name);
        };
        return *mEngine->compile(material, { .priority = priority, .onProgress = done });
    };
    const Compilation last = compile(low, CompilePriority::Low, "low");
    compile(high, CompilePriority::High, "high");
    compile(critical, CompilePriority::Critical, "critical");
    finish(last);
    EXPECT_THAT(order, ElementsAre("critical", "high", "low"));
}

TEST_P(Compile, PreparesProgramsWhenNoPassIsKnown) {
    const Owned<Material> material = test::loadMaterial(*mEngine, kPlaster);
    const uint64_t before = programs();
    EXPECT_EQ(finish(*mEngine->compile(material)), (CompileProgress{ 7, 7 }));
    EXPECT_EQ(programs(), before + 7);
    EXPECT_EQ(finish(*mEngine->compile(material)), CompileProgress{}) << "they exist";
    EXPECT_EQ(finish(*mEngine->compile(material, { .variants = VariantSet::DirectionalLighting })), CompileProgress{});
    const Owned<Material> other = test::loadMaterial(*mEngine, kPlaster);
    EXPECT_EQ(finish(*mEngine->compile(other, { .variants = VariantSet::DirectionalLighting })).total, 2u)
            << "with the sun, and without";
}

TEST_P(Compile, AVariantThatWasFilteredOutIsAnErrorThatNamesMaterialVariantAndFilter) {
    const Owned<Material> material = test::loadMaterial(*mEngine, kWithoutSun);
    const auto refused =
            mEngine->compile(material, { .variants = VariantSet::DirectionalLighting | VariantSet::DynamicLighting });
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(
            refused.error().message,
            "compile: material 'cellar': variant 'directionalLighting, dynamicLighting' is asked for, but it was "
            "compiled without 'directionalLighting' (variantFilter): it is not drawn; compile it without that filter");
    EXPECT_TRUE(mEngine->compile(material)) << "whatever the package has";
}

TEST_P(Compile, DrawingAVariantThatWasFilteredOutIsAnErrorToTakeOnce) {
    const Owned<Material> material = test::loadMaterial(*mEngine, kWithoutSun);
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    Scene scene(*mEngine);
    mSquare->add(scene, instance);
    mSquare->add(scene, instance, { 0, 0, 0.2 }, -0.5); // mirrored: another pipeline, the same program
    scene.add(SunLight{});
    for (int frame = 0; frame < 3; ++frame) draw(scene);
    mView.samples = 4; // another pass, too
    draw(scene);
    mEngine->waitIdle();
    EXPECT_THAT(mEngine->takeErrors(),
                ElementsAre(HasSubstr("material 'cellar': variant 'directionalLighting, shadowReceiver' is asked")));
}

TEST_P(Compile, AMaterialForPicturesCannotBeASurface) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material { name : grade, domain : postprocess,
    parameters : [ { type : sampler2d, name : picture } ] }
fragment {
    void postProcess(inout PostProcessInputs postProcess) {
        postProcess.color = texelFetch(materialParams_picture, ivec2(gl_FragCoord.xy), 0).bgra;
    }
}
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    const auto refused = mEngine->compile(material);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("material 'grade' is of domain postprocess"));
    Scene scene(*mEngine);
    mSquare->add(scene, instance);
    for (int frame = 0; frame < 2; ++frame) draw(scene);
    mEngine->waitIdle();
    EXPECT_THAT(mEngine->takeErrors(), ElementsAre(HasSubstr("material 'grade' is of domain postprocess")));
}

TEST_P(Compile, WhatIsLeftOfADestroyedMaterialCountsAsDone) {
    Owned<Material> material = test::loadMaterial(*mEngine, kPlaster);
    const Compilation compilation = *mEngine->compile(material);
    material.reset();
    EXPECT_TRUE(mEngine->progress(compilation).isComplete());
    mEngine->waitIdle();
    EXPECT_THAT(mEngine->takeErrors(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(BothApis, Compile, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// ---------------------------------------------------------------------------------------------- state of instances

class InstanceState : public Compile {};

TEST_P(InstanceState, ChangesWhatIsDrawnFromTheNextFrameOn) {
    const Owned<Material> material =
            test::loadMaterial(*mEngine, R"(material { shadingModel : unlit, blending : masked, maskThreshold : 0.5 }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(1.0, 1.0, 1.0, 0.6); } }
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    const auto isDrawn = [&] { return test::shownBy(*mEngine, instance).x > 0; };
    EXPECT_TRUE(isDrawn());
    EXPECT_TRUE(mEngine->setMaskThreshold(instance, 0.7f));
    EXPECT_FALSE(isDrawn());
    EXPECT_TRUE(mEngine->setMaskThreshold(instance, 0.5f));
    for (const auto& [culling, drawn] : { std::pair{ Culling::Front, false },
                                          { Culling::FrontAndBack, false },
                                          { Culling::None, true },
                                          { Culling::Back, true } }) {
        mEngine->setCulling(instance, culling);
        EXPECT_EQ(isDrawn(), drawn) << static_cast<int>(culling);
    }
    mEngine->setColorWrite(instance, false);
    EXPECT_FALSE(isDrawn());
    mEngine->setColorWrite(instance, true);
    EXPECT_TRUE(isDrawn());
    EXPECT_EQ(mEngine->setMaskThreshold(instance, 1.5f).error().code, ErrorCode::InvalidArgument);
    test::expectNoErrors(*mEngine);
}

TEST_P(InstanceState, DecidesWhoIsInFront) {
    const auto unlit = [&](std::string const& color) {
        return test::loadMaterial(*mEngine,
                                  "material { shadingModel : unlit }\nfragment { void material(inout MaterialInputs m) "
                                  "{ prepareMaterial(m); m.baseColor = vec4(" +
                                          color + ", 1.0); } }\n");
    };
    const Owned<Material> red = unlit("1.0, 0.0, 0.0"), green = unlit("0.0, 1.0, 0.0");
    const Owned<MaterialInstance> nearRed = mEngine->own(mEngine->createInstance(red));
    const Owned<MaterialInstance> farGreen = mEngine->own(mEngine->createInstance(green));
    Scene scene(*mEngine);
    mSquare->add(scene, nearRed, { 0, 0, 0.1 });
    mSquare->add(scene, farGreen);
    const auto pixel = [&] { return test::halfPixel(test::renderLinear(*mEngine, scene, mView), 8, 8); };
    EXPECT_EQ(pixel(), float4(1, 0, 0, 1));
    mEngine->setDepthCulling(farGreen, false); // drawn behind red in the list of opaque things, over whatever is there
    EXPECT_EQ(pixel(), float4(0, 1, 0, 1));
    mEngine->setDepthCulling(farGreen, true);
    mEngine->setDepthWrite(nearRed, false); // drawn after what writes depth: neither green nor a sky erases it
    EXPECT_EQ(pixel(), float4(1, 0, 0, 1));
    mEngine->setDepthWrite(farGreen, false); // both late: the one that is drawn last
    mEngine->setDepthCulling(farGreen, false);
    EXPECT_EQ(pixel(), float4(0, 1, 0, 1));
    EXPECT_THAT(mEngine->setMaskThreshold(nearRed, 0.5f).error().message, HasSubstr("only blending : masked cuts out"));
    test::expectNoErrors(*mEngine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, InstanceState, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
