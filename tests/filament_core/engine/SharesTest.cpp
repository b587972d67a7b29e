// SPDX-License-Identifier: Apache-2.0
// Shares of lights and effects: that they add up to the picture's bits, and that each is what its light alone gives.
#include "tests/filament_core/engine/WhiteEnvironment.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/scenes/GridOf.h"

#include <filament_core/ExplainPixel.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <map>

namespace filament_core {
namespace {

constexpr uint2 kShareSize{ 24, 16 };
constexpr const char* kShareChalk = R"(material { name : chalk, requires : [ tangents ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(0.5, 0.25, 1.0, 1.0);
    material.roughness = 0.75;
    material.emissive = vec4(0.01, 0.02, 0.0, 0.0);
} })";

/// A square with a smaller one before it, a sun that is in the sky, too, a lamp, another that shines on the smaller
/// square alone, and an environment.
struct ShareStage {
    Engine engine;
    test::SquareMesh square{ engine };
    Owned<Material> material;
    Owned<MaterialInstance> instance;
    WhiteEnvironment white{ engine };
    Scene scene{ engine };
    View view = test::SquareMesh::view(kShareSize);
    Node lampNode;
    std::vector<Light> lights;

    explicit ShareStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              material(test::loadMaterial(engine, kShareChalk)),
              instance(engine.own(engine.createInstance(material, "wall"))) {
        const Node near = scene.add(NodeDesc{ .name = "near" });
        square.add(scene, instance);
        scene.add(
                { .vertices = square.vertices(),
                  .indices = square.indices(),
                  .material = instance,
                  .node = scene.add(NodeDesc{ .parent = near, .parentFromNode = placed(double3(0.2, 0.1, 0.3), 0.2) }),
                  .lightChannels = 3 });
        lampNode = scene.add(NodeDesc{ .name = "lamp" });
        lights = {
            scene.add(SunLight{ .directionWorld = { 0.5f, -0.3f, -1 }, .illuminance = Lux{ 3e4f }, .showsDisc = true }),
            scene.add(PointLight{ .positionWorld = { -0.5, 0, 0.5 }, .intensity = Candela{ 2e4f } }, lampNode),
            scene.add(
                    PointLight{ .positionWorld = { 0.5, 0.2, 0.7 }, .intensity = Candela{ 1e4f }, .lightChannels = 2 })
        };
        white.light(scene, view.camera);
        view.camera.worldFromView = view.camera.worldFromView * placed(double3(0.4, 0, 0), 1); // the sky is in view
    }
    ~ShareStage() { test::expectNoErrors(engine); }

    static double4x4 placed(double3 at, double scale) {
        double4x4 world(scale);
        world[3] = double4(at, 1);
        return world;
    }

    Shares shares(ShareOptions const& options = {}) {
        Result<Shares> shares = renderShares(engine, scene, view, options);
        if (shares) return std::move(*shares);
        ADD_FAILURE() << shares.error().message;
        return {};
    }
    Image picture() { return test::renderLinear(engine, scene, view); }
};

std::vector<std::string> namesOf(Shares const& shares) {
    std::vector<std::string> names;
    for (ShareTerm const& term : shares.terms) names.push_back(term.name);
    return names;
}

template <class Function>
void forEachPixel(uint2 size, Function const& function) {
    for (uint32_t y = 0; y < size.y; ++y)
        for (uint32_t x = 0; x < size.x; ++x) function(uint2(x, y));
}

/// Pixels whose channels, added up in doubles and rounded, are not those of the picture.
size_t wrongSums(Shares const& shares, Image const& picture) {
    size_t wrong = 0;
    forEachPixel(shares.size, [&](uint2 at) {
        double4 sum(0);
        for (size_t term = 0; term < shares.terms.size(); ++term) sum += shares.share(term, at);
        const float4 expected = test::halfPixel(picture, at.x, at.y);
        wrong += sum != double4(expected);
    });
    return wrong;
}

const std::vector<std::string> kLightNames{ "emission", "environment", "light0", "light1 lamp", "light2" };

TEST(Shares, OfLightsAddUpToThePicturesBits) {
    test::sameOnBothApis<ShareStage>([&](ShareStage& stage) {
        const Shares shares = stage.shares();
        EXPECT_EQ(namesOf(shares), kLightNames);
        EXPECT_EQ(wrongSums(shares, stage.picture()), 0u);
        return shares.sums;
    });
}

// A light's share is the picture of a scene with that light alone, to the rounding of half floats.
TEST(Shares, AreWhatEachLightGivesAlone) {
    ShareStage stage(Backend::Vulkan);
    stage.view.quality.shadows = ShadowFilter::Pcf3;
    stage.view.effects.ambientOcclusion.enabled = true;
    stage.view.effects.bloom = { .enabled = true, .strength = 0.3f };
    const Shares shares = stage.shares();
    ASSERT_EQ(namesOf(shares), kLightNames);
    const Image base = shares.image(0);
    for (size_t kept = 0; kept < stage.lights.size(); ++kept) {
        ShareStage alone(Backend::Vulkan);
        alone.view = stage.view;
        for (size_t i = 0; i < alone.lights.size(); ++i)
            if (i != kept) alone.scene.remove(alone.lights[i]);
        alone.scene.setIndirectLight({}, Lux{ 0 });
        const Image picture = alone.picture();
        double brightest = 0;
        forEachPixel(kShareSize, [&](uint2 at) {
            const double4 share = shares.share(kept + 2, at);
            const double4 expected =
                    double4(test::halfPixel(picture, at.x, at.y)) - shares.share(0, at); // emission shines there, too
            const double4 whole(test::halfPixel(shares.sums.back(), at.x, at.y));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], expected[c], 2e-3 * whole[c] + 1e-5) << kept;
            brightest = std::max(brightest, share.x);
        });
        EXPECT_GT(brightest, 0.05) << kept;
    }
    EXPECT_EQ(base.format, Format::RGBA32F);
}

TEST(Shares, OfGroupsAreThoseOfTheirLights) {
    ShareStage stage(Backend::Gles);
    const std::array groups{ LightGroup{ "lamps", { stage.lights[2], stage.lights[1] } } };
    const Shares shares = stage.shares({ .groups = groups });
    EXPECT_EQ(namesOf(shares), (std::vector<std::string>{ "emission", "environment", "lamps", "light0" }));
    EXPECT_EQ(shares.terms[2].lights, groups[0].lights);
    EXPECT_EQ(wrongSums(shares, stage.picture()), 0u);
}

// Effects that are not additive, each in its place or together behind the lights.
TEST(Shares, OfEffectsAddUpToThePicturesBits) {
    test::sameOnBothApis<ShareStage>([&](ShareStage& stage) {
        View& view = stage.view;
        view.quality.shadows = ShadowFilter::Pcf3;
        view.quality.antiAliasing = AntiAliasing::Fxaa;
        Effects& effects = view.effects;
        effects.ambientOcclusion.enabled = effects.autoExposure.enabled = effects.vignette.enabled = true;
        effects.fog = { .enabled = true, .density = 0.3f };
        effects.bloom = { .enabled = true, .threshold = 0.5f };
        const Image picture = stage.picture();
        const std::vector<std::string> names{ "shadows",      "ambientOcclusion", "refraction", "fog",
                                              "antiAliasing", "autoExposure",     "bloom",      "vignette" };
        std::vector<Image> sums;
        for (const ShareTerms terms : { ShareTerms::Lights, ShareTerms::All }) {
            const Shares shares = stage.shares({ .terms = terms });
            EXPECT_EQ(wrongSums(shares, picture), 0u) << toString(terms);
            std::vector<std::string> expected = kLightNames;
            if (terms == ShareTerms::Lights)
                expected.push_back("effects");
            else
                expected.insert(expected.end(), names.begin(), names.end());
            EXPECT_EQ(namesOf(shares), expected);
            sums.insert(sums.end(), shares.sums.begin(), shares.sums.end());
        }
        return sums;
    });
}

// What a light gives to fog is its own share, in cells, too; and so are its disc in the sky and lists by channel.
TEST(Shares, OfDarkLightsAreNothing) {
    ShareStage stage(Backend::Vulkan);
    stage.view.effects.fog = { .enabled = true, .density = 0.2f, .volumetric = true };
    const Shares shares = stage.shares();
    ASSERT_EQ(namesOf(shares), kLightNames);
    EXPECT_EQ(wrongSums(shares, stage.picture()), 0u);
    for (const Light light : stage.lights) stage.scene.remove(light);
    stage.scene.setIndirectLight({}, Lux{ 0 });
    stage.view.effects.fog.enabled = false;
    EXPECT_EQ(stage.picture().pixels, stage.shares().sums[0].pixels);
    stage.view.effects.fog.enabled = true;
    stage.view.effects.fog.color = LinearColor{ 0 };
    EXPECT_EQ(wrongSums(stage.shares(), stage.picture()), 0u);
}

// A grid's light has the factor of the environment's, and is dark with it.
TEST(Shares, OfIrradianceGridsAreTheEnvironments) {
    test::sameOnBothApis<ShareStage>([&](ShareStage& stage) {
        IrradianceGridDesc grid =
                scenes::gridOf(float3(3), uint3(2), [](float3) { return scenes::ambientOf(float3(0.5f)); });
        grid.intensity = 1 / stage.view.camera.exposure.factor();
        const IrradianceGrid added = stage.scene.add(grid);
        const Shares shares = stage.shares();
        EXPECT_EQ(namesOf(shares), kLightNames);
        EXPECT_EQ(wrongSums(shares, stage.picture()), 0u);
        stage.scene.remove(added);
        for (const Light light : stage.lights) stage.scene.remove(light);
        stage.scene.setIndirectLight({}, Lux{ 0 });
        EXPECT_EQ(shares.sums[0].pixels, stage.picture().pixels);
        return shares.sums;
    });
}

TEST(Shares, LeaveTheFramesOfOtherRenderersAsTheyAre) {
    test::sameOnBothApis<ShareStage>([&](ShareStage& stage) {
        stage.view.quality.antiAliasing = AntiAliasing::Taa;
        std::vector<Image> frames;
        for (const bool draws : { false, true }) {
            Renderer renderer(stage.engine);
            (void)renderer.renderToImage(stage.scene, stage.view);
            if (draws) (void)stage.shares({ .frames = 2 });
            frames.push_back(*renderer.renderToImage(stage.scene, stage.view));
        }
        EXPECT_EQ(frames[0].pixels, frames[1].pixels);
        return frames;
    });
}

std::string textOfFile(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

Image oneHalfPixel(uint16_t bits) {
    Image image{ .width = 1, .height = 1, .format = Format::RGBA16F, .pixels = std::vector<std::byte>(8) };
    std::memcpy(image.pixels.data(), &bits, sizeof(bits));
    return image;
}

// 65504 - 2^-24 has 40 bits: floats need a layer for what they cannot hold.
TEST(Shares, AreLayersOfAnExrFile) {
    const std::filesystem::path file = test::folderOfThisTest() / "shares.exr";
    Shares shares{ .size = { 1, 1 },
                   .terms = { { .name = "emission" }, { .kind = ShareKind::Lights, .name = "light0 a.b" } },
                   .sums = { oneHalfPixel(0x7BFF), oneHalfPixel(0x3C00) } };
    ASSERT_TRUE(saveExr(file, shares));
    EXPECT_NE(textOfFile(file).find("light0_a_b.R"), std::string::npos);
    EXPECT_EQ(textOfFile(file).find("rounding.R"), std::string::npos);
    shares.sums[1] = oneHalfPixel(0x0001);
    ASSERT_TRUE(saveExr(file, shares));
    EXPECT_NE(textOfFile(file).find("rounding.R"), std::string::npos);
    EXPECT_EQ(shares.share(0, {}).x + shares.share(1, {}).x, std::ldexp(1.0, -24));
}

TEST(Shares, WithNamesThatAreEqualOnceTheyAreShortAreLayersOfTheirOwn) {
    const std::filesystem::path file = test::folderOfThisTest() / "shares.exr";
    const std::string longName = "lamps of the assembly hall"; // 24 letters: "lamps of the assembly ha"
    Shares shares{ .size = { 1, 1 },
                   .terms = { { .name = longName + " on the left" },
                              { .name = longName + " on the right" },
                              { .name = "rounding" },
                              { .name = "a.b" },
                              { .name = "a b" } },
                   .sums = std::vector(5, oneHalfPixel(0x3C00)) };
    const Result<void> saved = saveExr(file, shares);
    ASSERT_TRUE(saved) << saved.error().message;
    const std::string text = textOfFile(file);
    for (const char* name :
         { "lamps_of_the_assembly_ha.R", "lamps_of_the_assembly__2.R", "rounding_2.R", "a_b.R", "a_b_2.R" })
        EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(ExplainPixel, TermsAddUpAndTheSurfaceIsNamed) {
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        ShareStage stage(backend);
        stage.view.quality.shadows = ShadowFilter::Pcf3;
        stage.view.effects.vignette.enabled = true;
        constexpr uint2 kAt{ 9, 6 };
        const Image before = stage.picture();
        const Result<PixelExplanation> explained = explainPixel(stage.engine, stage.scene, stage.view, kAt);
        ASSERT_TRUE(explained) << explained.error().message;
        double4 sum(0);
        for (PixelTerm const& term : explained->terms) sum += term.value;
        EXPECT_EQ(sum, explained->value);
        EXPECT_EQ(sum, double4(test::halfPixel(stage.picture(), kAt.x, kAt.y)));
        double4 lobes(0);
        for (PixelLobe const& lobe : explained->lobes) lobes += lobe.value;
        EXPECT_EQ(lobes, explained->value);
        EXPECT_EQ(explained->lobes.front().name, "all") << "the material has no factors";
        EXPECT_EQ(stage.picture().pixels, before.pixels) << "materials are what they were";
        ASSERT_TRUE(explained->surface);
        PixelSurface const& surface = *explained->surface;
        EXPECT_EQ(surface.object, "near");
        EXPECT_EQ(surface.material, "chalk");
        EXPECT_EQ(surface.instance, "wall");
        EXPECT_EQ(surface.baseColor, float3(0.5f, 0.25f, 1));
        EXPECT_EQ(surface.roughness, 0.75f);
        EXPECT_EQ(surface.objectId, surface.renderable.index() + 1);
        EXPECT_TRUE(surface.materialId && surface.materialInstanceId && surface.triangleId);
        EXPECT_NEAR(surface.distanceMeters, 0.7, 1e-5);
        texts.push_back(toJson(*explained));
    }
    EXPECT_EQ(texts[0], texts[1]);
    const nlohmann::json json = nlohmann::json::parse(texts[0]);
    EXPECT_EQ(json["pixel"], nlohmann::json({ 9, 6 }));
    EXPECT_EQ(json["terms"][3]["name"], "light1 lamp");
    EXPECT_EQ(json["terms"].back()["kind"], "effect");
    EXPECT_EQ(json["surface"]["material"], "chalk");
}

constexpr const char* kShareLayers = R"(material { name : layers, requires : [ tangents ], parameters : [
    { type : float3, name : baseColor }, { type : float, name : metallic }, { type : float, name : clearCoat },
    { type : float3, name : emissive } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = materialParams.baseColor;
    material.metallic = materialParams.metallic;
    material.roughness = 0.5;
    material.clearCoat = materialParams.clearCoat;
    material.emissive = vec4(materialParams.emissive, 0.0);
} })";

// Under white light from the front.
TEST(ExplainPixel, TellsTheLobesOfTheMaterialApart) {
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend, kShareLayers);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.instance);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 3e4f } });
        ASSERT_TRUE(stage.engine.set(stage.instance, "baseColor", float3(0.5f, 0.25f, 1)));
        ASSERT_TRUE(stage.engine.set(stage.instance, "clearCoat", 1.0f));
        ASSERT_TRUE(stage.engine.set(stage.instance, "emissive", float3(0.25f, 0, 0.5f)));
        for (const float metallic : { 0.0f, 0.5f, 1.0f }) {
            ASSERT_TRUE(stage.engine.set(stage.instance, "metallic", metallic));
            const Result<PixelExplanation> explained =
                    explainPixel(stage.engine, scene, test::SquareMesh::view(), uint2(8));
            ASSERT_TRUE(explained) << explained.error().message;
            std::string names;
            std::map<std::string, double4> lobes;
            double4 sum(0);
            for (PixelLobe const& lobe : explained->lobes) {
                names += lobe.name + ' ';
                lobes[lobe.name] = lobe.value;
                sum += lobe.value;
            }
            EXPECT_EQ(sum, explained->value);
            EXPECT_EQ(names, metallic == 0   ? "specular diffuse clearCoat emission "
                             : metallic == 1 ? "specular clearCoat emission "
                                             : "specular baseColor clearCoat emission ");
            EXPECT_NEAR(lobes["emission"].x, 0.25, 1e-3 * explained->value.x);
            EXPECT_EQ(lobes["emission"].y, 0);
            EXPECT_NEAR(lobes["emission"].z, 0.5, 1e-3 * explained->value.z);
            texts.push_back(toJson(*explained));
            if (metallic > 0) continue;
            EXPECT_GT(lobes["specular"].x, 0);
            EXPECT_EQ(lobes["specular"].x, lobes["specular"].z) << "dielectrics reflect white";
            EXPECT_NEAR(lobes["diffuse"].x / lobes["diffuse"].y, 2, 0.02);
            EXPECT_NEAR(lobes["diffuse"].z / lobes["diffuse"].x, 2, 0.02);
        }
    }
    EXPECT_EQ(std::vector(texts.begin(), texts.begin() + 3), std::vector(texts.begin() + 3, texts.end()));
}

TEST(ExplainPixel, ShowsNoSurfaceInTheSky) {
    ShareStage stage(Backend::Gles);
    const Result<PixelExplanation> explained =
            explainPixel(stage.engine, stage.scene, stage.view, uint2(23, 8), { .terms = ShareTerms::Effects });
    ASSERT_TRUE(explained);
    EXPECT_FALSE(explained->surface);
    EXPECT_EQ(explained->terms.front().value, explained->value);
    EXPECT_EQ(toJson(*explained).find("surface"), std::string::npos);
}

TEST(SharesDeathTest, AreOfPictures) {
    ShareStage stage(Backend::Null);
    stage.view.debugView = DebugView::Fog;
    EXPECT_DEATH((void)renderShares(stage.engine, stage.scene, stage.view), "shares are of a picture");
}

} // namespace
} // namespace filament_core
