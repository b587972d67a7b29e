// SPDX-License-Identifier: Apache-2.0
// Stencil states of material instances, as images on both APIs: every test and operation beside what the contract
// says, the order of what changes values and what tests them, and that nothing happens without them.
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/Renderer.h>

namespace filament_core {
namespace {

using test::MaterialStage;
using test::onBothApis;

constexpr float4 kMaskColor{ 1, 0, 0, 1 }, kSeenThrough{ 0, 1, 0, 1 }, kBareBackground{ 0, 0, 0, 1 };

std::string stencilMaterial(std::string_view properties = "") {
    return fmt::format(R"(material {{ name : stencil, shadingModel : unlit, requires : [ color ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = getColor();
}} }})",
                       properties);
}

/// A surface of a colour with a stencil state, in the middle of the image.
void add(MaterialStage& stage, float4 color, StencilFace const& face, std::string_view properties = "",
         test::Square const& square = {}) {
    const MaterialInstance instance = stage.material(stencilMaterial(properties), test::kNoLights);
    stage.engine.setStencil(instance, bothSides(face));
    stage.add(instance, { { square.z, color, square.facesCamera, square.halfSide } });
}

float4 seen(std::function<void(MaterialStage&)> const& build) { return test::centerPixel(onBothApis(build)); }

/// What the contract of Stencil.h says.
bool passes(StencilTest test, uint8_t reference, uint8_t value) {
    switch (test) {
    case StencilTest::Never:
        return false;
    case StencilTest::Less:
        return reference < value;
    case StencilTest::LessEqual:
        return reference <= value;
    case StencilTest::Equal:
        return reference == value;
    case StencilTest::NotEqual:
        return reference != value;
    case StencilTest::GreaterEqual:
        return reference >= value;
    case StencilTest::Greater:
        return reference > value;
    case StencilTest::Always:
        return true;
    }
    return false;
}

uint8_t after(StencilOperation operation, uint8_t value, uint8_t reference) {
    switch (operation) {
    case StencilOperation::Keep:
        return value;
    case StencilOperation::Zero:
        return 0;
    case StencilOperation::Replace:
        return reference;
    case StencilOperation::IncrementClamp:
        return value == 255 ? 255 : value + 1;
    case StencilOperation::DecrementClamp:
        return value == 0 ? 0 : value - 1;
    case StencilOperation::Invert:
        return static_cast<uint8_t>(~value);
    case StencilOperation::IncrementWrap:
        return static_cast<uint8_t>(value + 1);
    case StencilOperation::DecrementWrap:
        return static_cast<uint8_t>(value - 1);
    }
    return value;
}

constexpr StencilTest kTests[] = { StencilTest::Never,   StencilTest::Less,     StencilTest::LessEqual,
                                   StencilTest::Equal,   StencilTest::NotEqual, StencilTest::GreaterEqual,
                                   StencilTest::Greater, StencilTest::Always };
constexpr StencilOperation kOperations[] = {
    StencilOperation::Keep,           StencilOperation::Zero,           StencilOperation::Replace,
    StencilOperation::IncrementClamp, StencilOperation::DecrementClamp, StencilOperation::Invert,
    StencilOperation::IncrementWrap,  StencilOperation::DecrementWrap,
};

/// Blended surfaces keep the order of their distances: a chain of states, the farthest first.
class Chain {
public:
    explicit Chain(MaterialStage& stage) : mStage(stage) {}

    /// One more step, nearer than those before it.
    void add(float4 color, StencilFace const& face) {
        const MaterialInstance instance =
                mStage.material(stencilMaterial("blending : transparent, depthWrite : false"), test::kNoLights);
        mStage.engine.setStencil(instance, bothSides(face));
        double4x4 world(1);
        world[3].z = mDepth;
        mDepth += 0.1;
        mStage.add(instance, { { 0, color } }, world);
    }
    void set(uint8_t value) { add({}, { .onPass = StencilOperation::Replace, .reference = value }); }
    /// Green where the value is this one.
    void showWhereEqual(uint8_t value) { add(kSeenThrough, { .test = StencilTest::Equal, .reference = value }); }

private:
    MaterialStage& mStage;
    double mDepth = -1;
};

/// The middles of as many images: an engine for all of them on each API.
std::vector<float4> seenInEach(size_t pictures, std::function<void(Chain&, size_t)> const& build) {
    std::vector<float4> colors[2];
    for (size_t i = 0; i < 2; ++i) {
        auto engine = test::makeEngine(test::kBothApis[i]);
        if (!engine) return {};
        for (size_t picture = 0; picture < pictures; ++picture) {
            MaterialStage stage(*engine);
            Chain chain(stage);
            build(chain, picture);
            colors[i].push_back(test::centerPixel(test::renderLinear(*engine, stage.scene, stage.view)));
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_TRUE(colors[0] == colors[1]) << "not the same bits on both APIs";
    return colors[0];
}

TEST(Stencil, EveryTestComparesTheReferenceToTheValue) {
    constexpr std::pair<uint8_t, uint8_t> kPairs[] = { { 3, 2 }, { 3, 3 }, { 3, 4 } };
    const std::vector<float4> colors =
            seenInEach(std::size(kTests) * std::size(kPairs), [&](Chain& chain, size_t picture) {
                const auto& [reference, value] = kPairs[picture % std::size(kPairs)];
                chain.set(value);
                chain.add(kSeenThrough, { .test = kTests[picture / std::size(kPairs)], .reference = reference });
            });
    for (size_t i = 0; i < colors.size(); ++i) {
        const auto& [reference, value] = kPairs[i % std::size(kPairs)];
        const bool isSeen = passes(kTests[i / std::size(kPairs)], reference, value);
        EXPECT_EQ(colors[i], isSeen ? kSeenThrough : kBareBackground) << i;
    }
}

TEST(Stencil, EveryOperationChangesTheValue) {
    constexpr uint8_t kValues[] = { 0, 7, 255 }, kReference = 90;
    const std::vector<float4> colors =
            seenInEach(std::size(kOperations) * std::size(kValues), [&](Chain& chain, size_t picture) {
                const StencilOperation operation = kOperations[picture / std::size(kValues)];
                const uint8_t value = kValues[picture % std::size(kValues)];
                chain.set(value);
                chain.add({}, { .onPass = operation, .reference = kReference });
                chain.showWhereEqual(after(operation, value, kReference));
            });
    for (float4 const& color : colors) EXPECT_EQ(color, kSeenThrough);
    EXPECT_FALSE(colors.empty());
}

TEST(Stencil, MasksSelectTheBitsThatAreReadAndWritten) {
    const float4 color = seen([](MaterialStage& stage) {
        Chain chain(stage);
        chain.set(0b1010'0101);
        chain.add({}, { .onPass = StencilOperation::Invert, .writeMask = 0x0F });
        chain.showWhereEqual(0b1010'1010);
    });
    EXPECT_EQ(color, kSeenThrough);
    for (const bool isRead : { false, true }) {
        const float4 masked = seen([&](MaterialStage& stage) {
            Chain chain(stage);
            chain.set(0b0101'0000);
            chain.add(kSeenThrough, { .test = StencilTest::Equal,
                                      .reference = 0b0101'1111,
                                      .readMask = isRead ? uint8_t{ 0xFF } : uint8_t{ 0xF0 } });
        });
        EXPECT_EQ(masked, isRead ? kBareBackground : kSeenThrough);
    }
}

TEST(Stencil, WhatFailsDepthOrStencilHasOperationsOfItsOwn) {
    for (const bool isHidden : { false, true }) {
        const float4 color = seen([&](MaterialStage& stage) {
            stage.add(stage.material(stencilMaterial(), test::kNoLights),
                      { { .z = isHidden ? 0.0f : -3.0f, .color = kBareBackground } });
            Chain chain(stage); // behind the surface at z = 0, or before that at z = -3
            chain.add({}, { .onDepthFail = StencilOperation::Replace,
                            .onPass = StencilOperation::IncrementClamp,
                            .reference = 9 });
            const MaterialInstance shown =
                    stage.material(stencilMaterial("blending : transparent, depthCulling : false"), test::kNoLights);
            stage.engine.setStencil(shown, bothSides({ .test = StencilTest::Equal,
                                                       .reference = isHidden ? uint8_t{ 9 } : uint8_t{ 1 } }));
            stage.add(shown, { { 1, kSeenThrough } });
        });
        EXPECT_EQ(color, kSeenThrough) << isHidden;
    }
    const float4 failed = seen([](MaterialStage& stage) {
        Chain chain(stage);
        chain.add({}, { .test = StencilTest::Never, .onFail = StencilOperation::Invert });
        chain.showWhereEqual(0xFF);
    });
    EXPECT_EQ(failed, kSeenThrough);
}

TEST(Stencil, TheSidesOfASurfaceHaveAStateEach) {
    for (const bool facesCamera : { false, true }) {
        const float4 color = seen([&](MaterialStage& stage) {
            const MaterialInstance mask = stage.material(
                    stencilMaterial("culling : none, colorWrite : false, depthWrite : false"), test::kNoLights);
            stage.engine.setStencil(mask,
                                    StencilState{ .front = { .onPass = StencilOperation::Replace, .reference = 1 },
                                                  .back = { .onPass = StencilOperation::Replace, .reference = 2 } });
            stage.add(mask, { { 0, kMaskColor, facesCamera } });
            add(stage, kSeenThrough,
                { .test = StencilTest::Equal, .reference = facesCamera ? uint8_t{ 1 } : uint8_t{ 2 } });
        });
        EXPECT_EQ(color, kSeenThrough) << facesCamera;
    }
}

/// A portal: what lies behind it in the scene is drawn only where its mask is, wherever both are in the scene.
TEST(Stencil, OpaqueMasksAreDrawnBeforeWhatTestsThem) {
    for (const bool maskFirst : { false, true }) {
        for (const float z : { -0.5f, 0.5f }) { // of what is shown: behind and before the mask
            const Image image = onBothApis([&](MaterialStage& stage) {
                const auto addMask = [&] {
                    add(stage, kMaskColor, { .onPass = StencilOperation::Replace, .reference = 1 },
                        "colorWrite : false, depthWrite : false", { .halfSide = 0.4f });
                };
                const auto addShown = [&] {
                    add(stage, kSeenThrough, { .test = StencilTest::Equal, .reference = 1 }, "", { .z = z });
                };
                if (maskFirst) addMask();
                addShown();
                if (!maskFirst) addMask();
            });
            EXPECT_EQ(test::centerPixel(image), kSeenThrough) << maskFirst << " " << z;
            EXPECT_EQ(test::halfPixel(image, 0, 0), kBareBackground) << maskFirst << " " << z;
        }
    }
}

TEST(Stencil, HoldsASampleWithMsaaAndItsDepthsAreResolved) {
    const Image image = onBothApis([](MaterialStage& stage) {
        stage.view.size = { 33, 33 };
        stage.view.samples = 4;
        add(stage, kMaskColor, { .onPass = StencilOperation::Replace, .reference = 1 }, "colorWrite : false",
            { .z = -1, .halfSide = 0.51f });
        add(stage, kSeenThrough, { .test = StencilTest::Equal, .reference = 1 });
        // refracts: depth is resolved before it is drawn, and stencil values are kept
        const MaterialInstance glass = stage.material(
                R"(material { name : glass, shadingModel : lit, refractionMode : screenspace, refractionType : thin }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.roughness = 0.0; material.transmission = 1.0; material.ior = 1.0; material.microThickness = 0.0;
} })",
                test::kNoLights);
        stage.engine.setStencil(glass, bothSides({ .test = StencilTest::Equal, .reference = 1 }));
        stage.add(glass, { { .z = 0.5f } });
    });
    EXPECT_EQ(test::halfPixel(image, 0, 0), kBareBackground);
    EXPECT_GT(test::centerPixel(image).y, 0.9f);
    bool hasEdge = false;
    for (uint32_t x = 0; x < image.width; ++x) {
        const float green = test::halfPixel(image, x, image.height / 2).y;
        hasEdge = hasEdge || (green > 0.1f && green < 0.9f);
    }
    EXPECT_TRUE(hasEdge) << "the edge of the mask is smoothed";
}

TEST(Stencil, RunsOnlyIfSomethingVisibleHasAState) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        const MaterialInstance instance = stage.material(stencilMaterial(), test::kNoLights);
        stage.add(instance, { { 0, kSeenThrough } });
        Renderer renderer(*engine);
        const auto why = [&] {
            test::renderLinear(*engine, renderer, stage.scene, stage.view);
            for (auto const& decision : renderer.decisions())
                if (decision.name == "stencil") return decision.reason;
            return std::string("no line");
        };
        EXPECT_EQ(why(), "nothing in view has a stencil state");
        engine->setStencil(instance, bothSides({ .onPass = StencilOperation::Replace, .reference = 1 }));
        EXPECT_EQ(why(), "1 in view");
        engine->setStencil(instance, {});
        EXPECT_EQ(why(), "nothing in view has a stencil state");
        test::expectNoErrors(*engine);
    }
}

TEST(Stencil, StatesThatDifferInTheirReferenceShareAPipeline) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        const MaterialInstance instance = stage.material(stencilMaterial(), test::kNoLights);
        stage.add(instance, { { 0, kSeenThrough } });
        const auto pipelinesAfter = [&](uint8_t reference) {
            engine->setStencil(instance, bothSides({ .onPass = StencilOperation::Replace, .reference = reference }));
            test::renderLinear(*engine, stage.scene, stage.view);
            return engine->statistics().pipelinesCreated;
        };
        const uint64_t first = pipelinesAfter(1);
        EXPECT_EQ(pipelinesAfter(2), first);
        EXPECT_EQ(pipelinesAfter(200), first);
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
