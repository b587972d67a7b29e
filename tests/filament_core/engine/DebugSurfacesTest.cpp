// SPDX-License-Identifier: Apache-2.0
// Debug views of what materials are made of, of overdraw and of triangles, on both APIs, beside their closed forms.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/DebugViews.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <functional>

namespace filament_core {
namespace {

constexpr std::array kMaterialViews{
    DebugView::BaseColor, DebugView::Roughness,          DebugView::Metallic,          DebugView::Normals,
    DebugView::Tangents,  DebugView::TextureCoordinates, DebugView::MaterialOcclusion, DebugView::Emissive,
    DebugView::MipLevel,  DebugView::Overdraw,           DebugView::TransparentLayers, DebugView::Plausibility
};
constexpr std::array kIdViews{ DebugView::ObjectIds, DebugView::MaterialInstanceIds, DebugView::TriangleIds,
                               DebugView::Coverage };

/// Squares before a camera that looks along -z from the origin and sees 2 m at a distance of 1 m.
class SurfaceStage {
public:
    explicit SurfaceStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mSquare(engine) {
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 90 });
        view.size = { 32, 32 };
    }
    ~SurfaceStage() { test::expectNoErrors(engine); }

    MaterialInstance material(std::string const& text, uint16_t filtered = test::kNoLights) {
        mMaterials.push_back(test::loadMaterial(engine, text, {}, filtered));
        mInstances.push_back(engine.own(engine.createInstance(mMaterials.back())));
        return mInstances.back();
    }
    /// `side`: half of it.
    Renderable add(MaterialInstance instance, double3 at = { 0, 0, -1 }, double side = 1) {
        return mSquare.add(scene, instance, at, side);
    }
    Renderable add(MaterialInstance instance, double4x4 const& world) { return mSquare.add(scene, instance, world); }

    Image draw(DebugView debugView) {
        view.debugView = debugView;
        Result<Image> image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    bool says(const char* words) const { return renderer.explain().find(words) != std::string::npos; }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;

private:
    test::SquareMesh mSquare;
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
};

DebugColor debugColorAt(Image const& image, uint32_t x, uint32_t y) {
    const float4 pixel = test::bytePixel(image, x, y) * 255.0f;
    return { static_cast<uint8_t>(std::lround(pixel.x)), static_cast<uint8_t>(std::lround(pixel.y)),
             static_cast<uint8_t>(std::lround(pixel.z)) };
}

/// `expected`: [0, 1]. Half floats keep 11 bits of what comes before.
void expectValue(DebugColor found, double3 expected, std::string_view what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[static_cast<size_t>(c)], 255 * std::clamp(expected[c], 0.0, 1.0), 0.6) << what << ' ' << c;
}

double codeOfLight(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}
double3 codeOfLight(double3 light) { return { codeOfLight(light.x), codeOfLight(light.y), codeOfLight(light.z) }; }

constexpr DebugColor kLightStripe{ 51, 51, 51 }, kDarkStripe{ 26, 26, 26 }, kBlackPixel{ 0, 0, 0 };

bool isStriped(Image const& image) {
    size_t found = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
            found += debugColorAt(image, x, y) == (((x + y) & 4) != 0 ? kLightStripe : kDarkStripe);
    return found == static_cast<size_t>(image.width) * image.height;
}

// ---- values of materials

struct Shaded {
    const char* name;
    bool hasMetallic;
    const char* roughness = "material.roughness = 0.3;";
};

TEST(DebugMaterials, ShowTheValuesThatTheCodeGives) {
    const std::array models{ Shaded{ "lit", true }, Shaded{ "subsurface", true }, Shaded{ "cloth", false },
                             Shaded{ "specularGlossiness", false, "material.glossiness = 0.7;" } };
    for (Shaded const& model : models) {
        const std::string code = fmt::format("material.baseColor = vec4(0.02, 0.5, 0.9, 1.0); {} {} "
                                             "material.ambientOcclusion = 0.75; "
                                             "material.emissive = vec4(0.4, 0.003, 3.0, 0.0);",
                                             model.roughness, model.hasMetallic ? "material.metallic = 0.6;" : "");
        const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
            stage.add(stage.material(test::text(fmt::format("shadingModel : {}", model.name), code)));
            std::vector<Image> all;
            for (const DebugView view : { DebugView::BaseColor, DebugView::Roughness, DebugView::MaterialOcclusion,
                                          DebugView::Emissive, DebugView::Metallic, DebugView::Normals })
                all.push_back(stage.draw(view));
            EXPECT_TRUE(stage.says("debugView=normals"));
            EXPECT_TRUE(stage.says("a debug view shows no light"));
            return all;
        });
        expectValue(debugColorAt(images[0], 16, 16), codeOfLight(double3(0.02, 0.5, 0.9)), model.name);
        expectValue(debugColorAt(images[1], 16, 16), double3(0.3), model.name);
        expectValue(debugColorAt(images[2], 16, 16), double3(0.75), model.name);
        expectValue(debugColorAt(images[3], 16, 16), codeOfLight(double3(0.4, 0.003, 1)), model.name);
        if (model.hasMetallic)
            expectValue(debugColorAt(images[4], 16, 16), double3(0.6), model.name);
        else
            EXPECT_TRUE(isStriped(images[4])) << model.name << " has no such value";
        expectValue(debugColorAt(images[5], 16, 16), double3(0.5, 0.5, 1), model.name);
    }
}

TEST(DebugMaterials, ShowEmissionByItsExposure) {
    constexpr Exposure kDaylight{ .aperture = 16, .shutterSeconds = 1.0f / 125, .iso = 100 };
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.add(stage.material(test::text("shadingModel : unlit", "material.emissive = vec4(vec3(3000.0), 1.0);")));
        stage.view.camera.exposure = kDaylight;
        return std::vector{ stage.draw(DebugView::Emissive) };
    });
    expectValue(debugColorAt(images[0], 16, 16), codeOfLight(double3(3000 * static_cast<double>(kDaylight.factor()))),
                "nits");
}

TEST(DebugMaterials, HaveStripesWhereTheyHaveNoSuchValue) {
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.add(stage.material(test::text("shadingModel : unlit", "material.baseColor = vec4(1.0);")));
        std::vector<Image> all;
        for (const DebugView view : kMaterialViews) all.push_back(stage.draw(view));
        return all;
    });
    for (size_t i = 0; i < kMaterialViews.size(); ++i) {
        const bool hasValue = kMaterialViews[i] == DebugView::BaseColor || kMaterialViews[i] == DebugView::Emissive ||
                              kMaterialViews[i] == DebugView::Overdraw ||
                              kMaterialViews[i] == DebugView::TransparentLayers; // counts have none, either
        EXPECT_EQ(isStriped(images[i]), !hasValue) << toString(kMaterialViews[i]);
    }
    EXPECT_EQ(debugColorAt(images[7], 16, 16), kBlackPixel) << "no emission is black";
}

/// Code of a material, and the rule that it breaks.
struct Implausible {
    const char* code;
    PlausibilityRule rule;
};

TEST(DebugMaterials, ShowWhichRuleOfRealMaterialsTheyBreak) {
    using Rule = PlausibilityRule;
    const std::array cases{
        Implausible{ "baseColor.rgb = vec3(0.2);", Rule::None },
        Implausible{ "baseColor.rgb = vec3(0.5); material.metallic = 1.0;", Rule::None },
        Implausible{ "baseColor.rgb = vec3(0.2); material.metallic = 0.5;", Rule::MixedMetallic },
        Implausible{ "baseColor.rgb = vec3(0.02); material.metallic = 0.5;", Rule::MixedMetallic },
        Implausible{ "baseColor.rgb = vec3(0.02);", Rule::DarkAlbedo },
        Implausible{ "baseColor.rgb = vec3(0.95);", Rule::BrightAlbedo },
        Implausible{ "baseColor.rgb = vec3(0.95); material.metallic = 1.0;", Rule::None },
        Implausible{ "baseColor.rgb = vec3(0.2); material.metallic = 1.0;", Rule::DarkMetal },
        Implausible{ "baseColor.rgb = vec3(0.2); material.reflectance = 0.3;", Rule::LowReflectance },
        Implausible{ "baseColor.rgb = vec3(0.2); material.reflectance = 0.35;", Rule::None },
        Implausible{ "baseColor.rgb = vec3(0.2); material.ior = 1.2;", Rule::LowReflectance },
        Implausible{ "baseColor.rgb = vec3(0.2); material.specularFactor = 0.25;", Rule::LowReflectance },
        Implausible{ "baseColor.rgb = vec3(0.2); material.emissive = vec4(0.0, 1.5, 0.0, 0.0);", Rule::BrightEmission },
        Implausible{ "baseColor.rgb = vec3(0.2); material.emissive = vec4(1.0, 1.0, 1.0, 0.0);", Rule::None },
    };
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        std::vector<Image> all;
        for (Implausible const& each : cases) {
            const Renderable square =
                    stage.add(stage.material(test::text("shadingModel : lit", std::string("material.") + each.code)));
            all.push_back(stage.draw(DebugView::Plausibility));
            stage.scene.remove(square);
        }
        return all;
    });
    for (size_t i = 0; i < cases.size(); ++i)
        EXPECT_EQ(plausibilityRuleOf(debugColorAt(images[i], 16, 16)), cases[i].rule) << cases[i].code;
    const DebugColor grey = debugColorAt(images[0], 16, 16), brighter = debugColorAt(images[1], 16, 16);
    EXPECT_GT(grey[0], 51) << "the base colour in grey";
    EXPECT_GT(brighter[0], grey[0]);
}

TEST(DebugMaterials, ShowNormalsAndTangentsInTheWorld) {
    const double4x4 turned = glm::rotate(glm::translate(double4x4(1), double3(0, 0, -2)), 0.6, double3(0, 1, 0)) *
                             glm::rotate(double4x4(1), 0.5, double3(1, 0, 0));
    const std::string code = "material.normal = vec3(0.6, 0.0, 0.8);"; // prepared after it, below
    const std::string text = "material { name : stage, shadingModel : lit }\nfragment { void material(inout "
                             "MaterialInputs material) {\n" +
                             code + " prepareMaterial(material); } }";
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.add(stage.material(text), turned);
        return std::vector{ stage.draw(DebugView::Normals), stage.draw(DebugView::Tangents) };
    });
    const double3x3 axes(turned);
    expectValue(debugColorAt(images[0], 16, 16), (axes[0] * 0.6 + axes[2] * 0.8) * 0.5 + 0.5, "normal");
    expectValue(debugColorAt(images[1], 16, 16), axes[0] * 0.5 + 0.5, "tangent");
    EXPECT_EQ(debugColorAt(images[0], 0, 0), kBlackPixel) << "nothing is there";
}

std::string withCoordinates(std::string_view code = "material.baseColor.rg = getUV0();") {
    return test::text("shadingModel : unlit, requires : [ uv0 ]", code);
}

TEST(DebugMaterials, ShowTextureCoordinates) {
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.view.size = { 48, 24 };
        stage.add(stage.material(withCoordinates())); // uv (0, 0) at the upper left, and flipUv turns v over
        return std::vector{ stage.draw(DebugView::TextureCoordinates) };
    });
    for (uint32_t y = 0; y < 24; ++y)
        for (uint32_t x = 12; x < 36; ++x)
            expectValue(debugColorAt(images[0], x, y), double3((x - 12 + 0.5) / 24, 1 - (y + 0.5) / 24, 0), "uv");
    EXPECT_EQ(debugColorAt(images[0], 4, 12), kBlackPixel);
}

TEST(DebugMaterials, ShowAtWhichLevelALargeTextureIsRead) {
    std::vector<std::pair<uint32_t, double>> shots; // pixels, half of the square's side
    for (const uint32_t pixels : { 8u, 16u, 32u, 64u, 128u, 100u })
        for (const double side : { 1.0, 0.5, 16.0, 64.0 }) shots.emplace_back(pixels, side);
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance instance = stage.material(withCoordinates());
        std::vector<Image> all;
        for (auto const& [pixels, side] : shots) {
            const Renderable square = stage.add(instance, { 0, 0, -1 }, side);
            stage.view.size = uint2(pixels);
            all.push_back(stage.draw(DebugView::MipLevel));
            stage.scene.remove(square);
        }
        return all;
    });
    for (size_t i = 0; i < shots.size(); ++i) {
        auto const& [pixels, side] = shots[i];
        const double level = std::log2(1024 / (pixels * side)); // texels between two pixels
        const DebugColor expected = mipLevelColor(static_cast<float>(level));
        const DebugColor found = debugColorAt(images[i], pixels / 2 - 1, pixels / 2 - 1);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], 1) << pixels << " pixels, side " << side << ", level " << level;
    }
}

TEST(DebugMaterials, ShowWhatIsBehindHolesAndTheNearestTransparentSurface) {
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const char* const wall = "material.baseColor = vec4(0.0, 0.0, 1.0, 1.0);";
        const char* const mask = "material.baseColor = vec4(1.0, 0.0, 0.0, gl_FragCoord.x < 8.0 ? 0.0 : 1.0);";
        const char* const pane = "material.baseColor = vec4(0.0, 0.2, 0.0, 0.2);";
        stage.add(stage.material(test::text("shadingModel : unlit", wall)), { 0, 0, -3 }, 8);
        stage.add(stage.material(test::text("shadingModel : unlit, blending : masked", mask)), { 0, 0, -2 }, 8);
        Image holes = stage.draw(DebugView::BaseColor);
        stage.add(stage.material(test::text("shadingModel : unlit, blending : transparent", pane)), { 0, 0, -1 }, 0.5);
        return std::vector{ std::move(holes), stage.draw(DebugView::BaseColor) };
    });
    expectValue(debugColorAt(images[0], 4, 16), double3(0, 0, 1), "behind the hole");
    expectValue(debugColorAt(images[0], 12, 16), double3(1, 0, 0), "beside the hole");
    expectValue(debugColorAt(images[1], 16, 16), codeOfLight(double3(0, 0.2, 0)), "the pane, multiplied by its alpha");
    expectValue(debugColorAt(images[1], 4, 4), double3(0, 0, 1), "beside the pane");
}

/// The same silhouettes as in the normal image, for all vertex transformations.
class DebugModels : public test::AssetTest, public testing::WithParamInterface<const char*> {};

std::vector<Image> shotsOf(Backend backend, const char* file) {
    std::vector<Image> images;
    auto engine = test::makeEngine(backend);
    if (!engine) return images;
    {
        auto model = loadGltf(*engine, tools::assetDir() / "models" / file);
        if (!model) {
            ADD_FAILURE() << model.error().message;
            return images;
        }
        Scene scene(*engine);
        const Node root = scene.add(*model, fitToUnitCube(model->bounds()));
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
        View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 55 }),
                   .size = { 120, 90 },
                   .clearColor = float4(0) };
        Renderer renderer(*engine);
        Animator animator(*model, scene, root);
        if (model->animationCount() > 0) animator.apply(0, 0.9);
        images.push_back(test::renderLinear(*engine, renderer, scene, view));
        const auto shoot = [&](DebugView debugView) {
            view.debugView = debugView;
            auto image = renderer.renderToImage(scene, view);
            EXPECT_TRUE(image.ok());
            if (image) images.push_back(std::move(*image));
        };
        for (const DebugView debugView : kMaterialViews) shoot(debugView);
        for (const DebugView debugView : kIdViews) shoot(debugView);
    }
    test::expectNoErrors(*engine);
    return images;
}

TEST_P(DebugModels, AreSeenWhereTheyAreInThePicture) {
    const std::vector<Image> images = shotsOf(Backend::Vulkan, GetParam()), other = shotsOf(Backend::Gles, GetParam());
    constexpr size_t kFirstId = kMaterialViews.size() + 1;
    ASSERT_EQ(images.size(), kFirstId + kIdViews.size());
    ASSERT_EQ(other.size(), images.size());
    for (size_t i = 0; i < images.size(); ++i) {
        ASSERT_FALSE(images[i].pixels.empty()) << i;
        EXPECT_TRUE(images[i].pixels == other[i].pixels) << i << ": not the same bits on both APIs";
    }
    size_t covered = 0;
    for (uint32_t y = 0; y < 90; ++y) {
        for (uint32_t x = 0; x < 120; ++x) {
            const bool isCovered = test::halfPixel(images[0], x, y).w > 0;
            covered += isCovered;
            ASSERT_EQ(debugColorAt(images[10], x, y) != kBlackPixel, isCovered) << x << ' ' << y << ": overdraw";
            ASSERT_EQ(debugColorAt(images[4], x, y) != kBlackPixel, isCovered) << x << ' ' << y << ": normals";
            for (size_t i = kFirstId; i < images.size(); ++i)
                ASSERT_EQ(debugColorAt(images[i], x, y) != kBlackPixel, isCovered) << x << ' ' << y << ": ids, " << i;
            ASSERT_TRUE(isCovered || debugColorAt(images[1], x, y) == kBlackPixel) << x << ' ' << y << ": base colour";
        }
    }
    EXPECT_GT(covered, 300u);
}

INSTANTIATE_TEST_SUITE_P(Files, DebugModels,
                         testing::Values("Fox/Fox.glb", "AnimatedMorphCube/AnimatedMorphCube.glb",
                                         "SimpleInstancing/SimpleInstancing.glb",
                                         "AlphaBlendModeTest/AlphaBlendModeTest.glb"),
                         [](testing::TestParamInfo<const char*> const& file) {
                             const std::string_view path = file.param;
                             return std::string(path.substr(0, path.find('/')));
                         });

// ---- overdraw

constexpr const char* kDarkGlass = "material.baseColor = vec4(0.1, 0.1, 0.1, 0.1);";

TEST(DebugOverdraw, CountsWhatLiesBehindEachOther) {
    const std::array counts{ 1u, 2u, 3u, 5u, 8u, 9u, 20u, 70u, 256u };
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance pane =
                stage.material(test::text("shadingModel : unlit, blending : transparent", kDarkGlass));
        std::vector<Image> all;
        uint32_t added = 0;
        for (const uint32_t count : counts) {
            for (; added < count; ++added) stage.add(pane, { 0, 0, -1 - 0.01 * added }, 0.5);
            all.push_back(stage.draw(DebugView::Overdraw));
        }
        return all;
    });
    for (size_t i = 0; i < counts.size(); ++i) {
        EXPECT_EQ(debugColorAt(images[i], 16, 16), countColor(counts[i])) << counts[i];
        EXPECT_EQ(debugColorAt(images[i], 1, 1), kBlackPixel);
    }
}

TEST(DebugOverdraw, ShowsWhatTheOrderAndADepthPrepassSave) {
    constexpr uint32_t kWalls = 5;
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        std::vector<Image> all;
        for (uint32_t i = 0; i < kWalls; ++i) { // in one slice of the order (SortKey.h), so that materials decide it
            const MaterialInstance wall = stage.material(test::text("shadingModel : unlit", ""));
            stage.add(wall, { 0, 0, -1.22 + 0.04 * i }, 0.5);
            if (i == 0) all.push_back(stage.draw(DebugView::Overdraw));
        }
        all.push_back(stage.draw(DebugView::Overdraw));
        stage.view.quality.depthPrepass = DepthPrepass::On;
        all.push_back(stage.draw(DebugView::Overdraw));
        return all;
    });
    EXPECT_EQ(debugColorAt(images[0], 16, 16), countColor(1));
    EXPECT_EQ(debugColorAt(images[1], 16, 16), countColor(kWalls)) << "the farthest is drawn first";
    EXPECT_EQ(debugColorAt(images[2], 16, 16), countColor(1)) << "the prepass leaves the nearest alone";
}

TEST(DebugTransparentLayers, CountsVisibleTransparentSurfaces) {
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance wall = stage.material(test::text("shadingModel : unlit", ""));
        stage.add(wall, { 0, 0, -3 }, 3);
        std::vector<Image> all{ stage.draw(DebugView::TransparentLayers) };
        const MaterialInstance pane =
                stage.material(test::text("shadingModel : unlit, blending : transparent", kDarkGlass));
        for (int i = 0; i < 3; ++i) stage.add(pane, { 0, 0, -1 - 0.1 * i }, 0.5);
        stage.add(pane, { 0, 0, -4 }, 2); // behind the wall
        all.push_back(stage.draw(DebugView::TransparentLayers));
        stage.add(
                stage.material(test::text("shadingModel : unlit, blending : fade", "material.baseColor = vec4(0.0);")),
                { 0, 0, -0.9 }, 0.4);
        all.push_back(stage.draw(DebugView::TransparentLayers));
        stage.add(stage.material(test::text("shadingModel : unlit, blending : add", "material.baseColor = vec4(0.0);")),
                  { 0, 0, -0.8 }, 0.4);
        all.push_back(stage.draw(DebugView::TransparentLayers));
        stage.add(stage.material(
                          test::text("shadingModel : unlit, blending : masked", "material.baseColor = vec4(1.0);")),
                  { 0, 0, -1.05 }, 0.5);
        all.push_back(stage.draw(DebugView::TransparentLayers));
        return all;
    });
    EXPECT_EQ(debugColorAt(images[0], 16, 16), kBlackPixel) << "a wall is no layer";
    EXPECT_EQ(debugColorAt(images[1], 16, 16), countColor(3)) << "the fourth is behind the wall";
    EXPECT_EQ(debugColorAt(images[1], 1, 1), kBlackPixel);
    EXPECT_EQ(debugColorAt(images[2], 16, 16), countColor(3)) << "what has faded covers nothing";
    EXPECT_EQ(debugColorAt(images[3], 16, 16), countColor(4)) << "what adds light may shine";
    EXPECT_EQ(debugColorAt(images[4], 16, 16), countColor(2)) << "masked ones hide two of them";
}

// ---- triangles

/// Of a square of two triangles around the image centre: which of them contains each pixel's centre.
int triangleAt(double2 at) {
    if (std::max(std::abs(at.x), std::abs(at.y)) > 1) return 0;
    return at.x > at.y ? 1 : 2; // below the diagonal from the lower left: 0, 1, 2
}

TEST(DebugWireframe, HasLinesBetweenTrianglesAndAroundThem) {
    const uint2 size(61, 47);
    const double side = 0.71;
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.view.size = size;
        stage.add(stage.material(test::text("shadingModel : lit, culling : none", "")),
                  glm::scale(glm::translate(double4x4(1), double3(0.03, 0.01, -1)), double3(side, 0.8 * side, 1)));
        return std::vector{ stage.draw(DebugView::WireframeAlone), stage.draw(DebugView::Wireframe) };
    });
    const auto triangle = [&](uint32_t x, uint32_t y) {
        const double perPixel = 2.0 / size.y;
        const double2 at((x + 0.5 - size.x * 0.5) * perPixel, (size.y * 0.5 - y - 0.5) * perPixel);
        return triangleAt((at - double2(0.03, 0.01)) / double2(side, 0.8 * side));
    };
    size_t lines = 0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const bool isEdge = triangle(x, y) != triangle(std::min(x + 1, size.x - 1), y) ||
                                triangle(x, y) != triangle(x, std::min(y + 1, size.y - 1));
            lines += isEdge;
            ASSERT_EQ(debugColorAt(images[0], x, y), isEdge ? (DebugColor{ 255, 255, 255 }) : kBlackPixel)
                    << x << ' ' << y;
            ASSERT_EQ(debugColorAt(images[1], x, y) == (DebugColor{ 230, 159, 0 }), isEdge) << x << ' ' << y;
        }
    }
    EXPECT_GT(lines, 100u);
    const DebugColor grey = debugColorAt(images[1], 1, 1);
    EXPECT_EQ(grey[0], grey[1]);
    EXPECT_GT(grey[0], 0) << "the picture";
}

TEST(DebugWireframe, TransparentSurfacesAlsoHideEdgesBehind) {
    const auto images = test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance wall = stage.material(test::text("shadingModel : unlit", ""));
        const MaterialInstance pane =
                stage.material(test::text("shadingModel : unlit, blending : transparent", kDarkGlass));
        std::vector<Image> all;
        stage.add(pane, { 0, 0, -1 }, 1.01);
        all.push_back(stage.draw(DebugView::WireframeAlone));
        stage.add(wall, { 0.1, 0.3, -2 }, 0.6);
        all.push_back(stage.draw(DebugView::WireframeAlone));
        return all;
    });
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

// ---- beside other frames

TEST(DebugSurfaces, CostTheNextFrameNothing) {
    test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance wall = stage.material(test::text("shadingModel : lit", ""), 0);
        stage.add(wall, { 0, 0, -3 }, 4);
        stage.add(wall, { 0, 0.2, -2 }, 0.5);
        stage.scene.add(SunLight{ .directionWorld = { 0.2f, -0.6f, -1 }, .illuminance = Lux{ 100'000 } });
        stage.view.quality.shadows = ShadowFilter::Pcf3;
        const Image before = stage.draw(DebugView::None);
        for (size_t i = static_cast<size_t>(DebugView::Luminance); i < kDebugViewCount; ++i) {
            const Image debug = stage.draw(static_cast<DebugView>(i));
            const Image after = stage.draw(DebugView::None);
            EXPECT_EQ(after.pixels, before.pixels) << toString(static_cast<DebugView>(i));
            EXPECT_FALSE(stage.says("debug")) << stage.renderer.explain();
            EXPECT_FALSE(stage.says("depth of triangles"));
            EXPECT_NE(debug.pixels, before.pixels) << toString(static_cast<DebugView>(i));
        }
        return std::vector{ before };
    });
}

TEST(DebugSurfaces, DrawNothingBesideThem) {
    test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        stage.add(stage.material(test::text("shadingModel : lit", ""), 0), { 0, 0, -3 }, 4);
        stage.scene.add(SunLight{ .directionWorld = { 0.2f, -0.6f, -1 }, .illuminance = Lux{ 100'000 } });
        stage.view.quality.shadows = ShadowFilter::Pcf3;
        stage.view.effects.ambientOcclusion.enabled = true;
        stage.view.effects.bloom.enabled = stage.view.effects.fog.enabled = true;
        const Image image = stage.draw(DebugView::Roughness);
        EXPECT_EQ(stage.renderer.statistics().passesRun, 2u) << stage.renderer.explain();
        EXPECT_EQ(stage.renderer.statistics().passesCulled, 0u);
        return std::vector{ image };
    });
}

TEST(DebugSurfaces, SayOfMaterialsThatCannotShowThem) {
    for (const Backend backend : test::kBothApis) {
        std::optional<Engine> engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        const Owned<Material> material =
                test::loadMaterial(*engine, test::text("shadingModel : unlit", ""), {}, shader::kVariantDebug);
        const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
        const test::SquareMesh square(*engine);
        Scene scene(*engine);
        square.add(scene, instance);
        Renderer renderer(*engine);
        View view = test::SquareMesh::view();
        EXPECT_TRUE(renderer.renderToImage(scene, view));
        EXPECT_TRUE(engine->takeErrors().empty());
        view.debugView = DebugView::BaseColor;
        const Result<Image> image = renderer.renderToImage(scene, view);
        ASSERT_TRUE(image);
        EXPECT_EQ(debugColorAt(*image, 8, 8), kBlackPixel);
        const std::vector<std::string> errors = engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u);
        EXPECT_NE(errors[0].find("has no variant 'debugViews': this debug view does not show it; compile it again "
                                 "without that filter (variantFilter)"),
                  std::string::npos)
                << errors[0];
    }
}

/// Pictures of one pixel and of odd sizes, also as light, with four samples, and without anything in view.
TEST(DebugSurfaces, AreDrawnInAllSizesAndTargets) {
    test::sameOnBothApis<SurfaceStage>([&](SurfaceStage& stage) {
        const MaterialInstance wall = stage.material(test::text("shadingModel : lit, requires : [ uv0 ]", ""));
        stage.view.samples = 4;
        stage.view.quality.antiAliasing = AntiAliasing::Taa;
        std::vector<Image> images;
        for (size_t i = static_cast<size_t>(DebugView::Luminance); i < kDebugViewCount; ++i) {
            for (const uint2 size : { uint2(1, 1), uint2(3, 70), uint2(131, 17) }) {
                stage.view.size = size;
                images.push_back(stage.draw(static_cast<DebugView>(i)));
                const Renderable square = stage.add(wall);
                images.push_back(stage.draw(static_cast<DebugView>(i)));
                images.push_back(test::renderLinear(stage.engine, stage.scene, stage.view));
                stage.scene.remove(square);
            }
        }
        return images;
    });
}

} // namespace
} // namespace filament_core
