// SPDX-License-Identifier: Apache-2.0
// Shadows of what transmits light: as dark, in each colour, as the caster stops light; and only where one does.
#include "tests/filament_core/engine/ShadowStage.h"

#include <map>

namespace filament_core {
namespace {

using test::shadowedView;
using test::ShadowStage;

/// At ior 1 nothing is reflected, so that a pane passes exactly its colour.
constexpr const char* kGlassPane = R"(material { name : glass, shadingModel : lit, refractionMode : cubemap,
    refractionType : thin, parameters : [ { type : float3, name : tint } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = materialParams.tint;
    material.roughness = 0.0;
    material.ior = 1.0;
} })";

struct GlassStage : ShadowStage {
    Owned<Material> glass;
    Owned<MaterialInstance> pane, otherPane;
    Scene scene{ engine };

    /// A plane that is seen through nothing; panes are added above the camera.
    explicit GlassStage(Backend backend)
            : ShadowStage(backend), glass(test::loadMaterial(engine, kGlassPane)),
              pane(engine.own(engine.createInstance(glass))), otherPane(engine.own(engine.createInstance(glass))) {
        square.add(scene, white);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
    }

    static View view(ShadowFilter filter, bool isColored) {
        View view = shadowedView({ 0, 0, 1 }, {}, filter);
        view.quality.coloredShadows = isColored;
        return view;
    }
};

double3 meanOf(Image const& image) {
    double3 sum(0.0);
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) sum += double3(test::halfPixel(image, x, y));
    return sum / static_cast<double>(image.width * image.height);
}

void expectNear(double3 found, double3 expected, double limit, const char* what) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], limit) << what << ", channel " << i;
}

/// Filters of moments cut off the darkest fifth, or tenth.
double3 expectedOf(float3 tint, ShadowFilter filter) {
    const double dark = filter == ShadowFilter::Vsm ? 0.2 : filter == ShadowFilter::Evsm ? 0.1 : 0;
    return glm::max((double3(tint) - dark) / (1 - dark), 0.0);
}

TEST(ColoredShadows, AreAsDarkInEachColourAsThePaneStopsIt) {
    std::map<int, Image> first;
    for (const Backend backend : test::kBothApis) {
        GlassStage stage(backend);
        stage.square.add(stage.scene, stage.pane, { 0, 0, 5 });
        const double3 lit =
                meanOf(test::renderLinear(stage.engine, stage.scene, GlassStage::view(ShadowFilter::Off, true)));
        for (const float3 tint : { float3(0.9f, 0.5f, 0.1f), float3(0, 1, 0.25f), float3(1.0f), float3(0.0f) }) {
            ASSERT_TRUE(stage.engine.set(stage.pane, "tint", tint));
            for (const ShadowFilter filter : test::kShadowFilters) {
                const Image image = test::renderLinear(stage.engine, stage.scene, GlassStage::view(filter, true));
                expectNear(meanOf(image) / lit, expectedOf(tint, filter), 0.03, toString(filter));
                const int key =
                        static_cast<int>(filter) * 100 + static_cast<int>(tint.x * 10) + static_cast<int>(tint.y);
                EXPECT_EQ(test::differingPixels(first.try_emplace(key, image).first->second, image), 0u);
            }
            const Image opaque =
                    test::renderLinear(stage.engine, stage.scene, GlassStage::view(ShadowFilter::Pcf5, false));
            expectNear(meanOf(opaque) / lit, double3(0.0), 0, "switched off");
        }
    }
}

TEST(ColoredShadows, OfTwoPanesAreTheProductOfTheirColours) {
    for (const Backend backend : test::kBothApis) {
        GlassStage stage(backend);
        const double3 lit =
                meanOf(test::renderLinear(stage.engine, stage.scene, GlassStage::view(ShadowFilter::Off, true)));
        stage.square.add(stage.scene, stage.pane, { 0, 0, 5 });
        stage.square.add(stage.scene, stage.otherPane, { 0, 0, 3 });
        const float3 tint(0.8f, 0.5f, 0.3f), other(0.5f, 0.6f, 0.9f);
        ASSERT_TRUE(stage.engine.set(stage.pane, "tint", tint));
        ASSERT_TRUE(stage.engine.set(stage.otherPane, "tint", other));
        const Image image = test::renderLinear(stage.engine, stage.scene, GlassStage::view(ShadowFilter::Pcf5, true));
        expectNear(meanOf(image) / lit, double3(tint * other), 0.03, "both panes");
    }
}

TEST(ColoredShadows, AreDrawnAgainOnlyWhenTheColourChanges) {
    GlassStage stage(Backend::Vulkan);
    stage.square.add(stage.scene, stage.pane, { 0, 0, 5 });
    Renderer renderer(stage.engine);
    const auto passes = [&](bool isColored) {
        EXPECT_TRUE(renderer.renderToImage(stage.scene, GlassStage::view(ShadowFilter::Pcf3, isColored)).ok());
        return renderer.statistics().passesRun;
    };
    for (const bool isColored : { true, false }) {
        ASSERT_TRUE(stage.engine.set(stage.pane, "tint", float3(0.5f)));
        const uint32_t drawn = passes(isColored);
        EXPECT_EQ(passes(isColored), drawn - 1) << "a still scene";
        ASSERT_TRUE(stage.engine.set(stage.pane, "tint", float3(0.6f)));
        EXPECT_EQ(passes(isColored), isColored ? drawn : drawn - 1) << "another colour";
    }
}

TEST(ColoredShadows, WithoutACasterThatTransmitsChangeNothing) {
    for (const Backend backend : test::kBothApis) {
        GlassStage stage(backend);
        stage.addBox(stage.scene, { 0.1, 0, 0.3 }, double3(0.2));
        std::vector<Image> images;
        for (const bool isColored : { false, true }) {
            Renderer renderer(stage.engine);
            const View view = GlassStage::view(ShadowFilter::Pcf3, isColored);
            Result<Image> image = renderer.renderToImage(stage.scene, view);
            ASSERT_TRUE(image);
            images.push_back(std::move(*image));
            EXPECT_EQ(renderer.explain().find("light passes through casters"), std::string::npos);
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels);
    }
}

} // namespace
} // namespace filament_core
