// SPDX-License-Identifier: Apache-2.0
// Light profiles in images: each pixel of a wall shows the share that the file gives its direction, constant profiles
// are plain lights to the bit, and unneeded tables do not exist.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/tables/LightProfileTable.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/engine/NullFrame.h"
#include "tests/filament_core/engine/quality/QualityFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/LightProfile.h>

#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <sstream>

namespace filament_core {
namespace {

using test::Patch;
using testing::HasSubstr;

std::vector<double> anglesTo(double last, double step) {
    std::vector<double> angles;
    for (int i = 0; i * step <= last; ++i) angles.push_back(i * step);
    return angles;
}

/// Photometric type C.
std::string luminaire(std::vector<double> const& vertical, std::vector<double> const& horizontal,
                      std::function<double(double vertical, double horizontal)> const& candelas) {
    std::ostringstream out;
    out.precision(9);
    out << "IES:LM-63-2019\nTILT=NONE\n1 -1 1 " << vertical.size() << ' ' << horizontal.size() << " 1 2 0 0 0\n1 1 9\n";
    for (const double v : vertical) out << v << '\n';
    for (const double h : horizontal) out << h << '\n';
    for (const double h : horizontal) {
        for (const double v : vertical) out << candelas(v, h) << '\n';
    }
    return out.str();
}

LightProfile profileFrom(Engine& engine, std::string const& text) {
    const Result<LightProfile> profile = engine.create(LightProfileDesc{ std::as_bytes(std::span(text)), "lamp.ies" });
    if (!profile) ADD_FAILURE() << profile.error().message;
    return profile ? *profile : LightProfile{};
}

std::string constantLuminaire(double last = 180) {
    return luminaire(anglesTo(last, 5), { 0 }, [](double, double) { return 70; });
}

class LightProfiles : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
    }
    void TearDown() override { test::expectNoErrors(*engine); }

    static Candela candela(View const& view, float radiance) { return { radiance / view.camera.exposure.factor() }; }

    decltype(test::makeEngine(Backend::Vulkan)) engine{};
};
INSTANTIATE_TEST_SUITE_P(Apis, LightProfiles, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(LightProfiles, AConstantProfileIsAPlainLightToTheBit) {
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, constantLuminaire()));
    for (const double degrees : { 0.0, 60.0 }) {
        Patch patch(*engine, degrees);
        patch.setSurface(float4(0.8f, 0.6f, 0.4f, 1), 0.3f, 0.5f);
        const auto seen = [&](LightProfile used, bool isSpot) {
            PointLight point{ .positionWorld = { 0.03, 0.02, 0.3 }, .intensity = candela(patch.view, 0.1f) };
            SpotLight spot{ .positionWorld = point.positionWorld,
                            .directionWorld = { 0.1f, 0, -1 },
                            .intensity = point.intensity };
            point.profile = spot.profile = used;
            point.directionWorld = { 0.3f, 0.2f, -0.7f };
            const Light light = isSpot ? patch.scene.add(spot) : patch.scene.add(point);
            const Image image = patch.render();
            patch.scene.remove(light);
            return image;
        };
        for (const bool isSpot : { false, true }) {
            const Image plain = seen({}, isSpot);
            EXPECT_GT(test::halfPixel(plain, 8, 8).x, 0.01f);
            EXPECT_EQ(plain.pixels, seen(profile, isSpot).pixels) << degrees << ' ' << isSpot;
        }
    }
}

// Lambert's cosine law from a point: with the profile I cos, a surface below at an angle a receives I cos^4 / h^2.
TEST_P(LightProfiles, ACosineGivesTheFourthPower) {
    const std::string text = luminaire(
            anglesTo(90, 1), { 0 }, [](double v, double) { return 1000 * std::max(std::cos(glm::radians(v)), 0.0); });
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, text));
    for (const double away : { 0.0, 0.5, 1.0, 3.0 }) {
        const auto seen = [&](float color) {
            Patch patch(*engine);
            patch.view.quality.diffuseCoupling = false;
            patch.setSurface(float4(float3(color), 1), 0, 1);
            patch.scene.add(PointLight{ .positionWorld = { 2 * away, 0, 2 },
                                        .intensity = candela(patch.view, 4 * std::numbers::pi_v<float>),
                                        .profile = profile });
            return patch.renderCenter().x;
        };
        const double pixel = 40 * std::tan(glm::radians(0.25)) / 16; // half of one: where its centre is
        const double3 toLight(2 * away - pixel, pixel, 2);
        const double expected = std::pow(2 / glm::length(toLight), 4);
        EXPECT_NEAR(seen(1) - seen(0), expected, 1e-3 * expected + 1e-4) << away;
    }
}

/// A white wall a little below a lamp: every pixel is another direction.
struct Wall {
    static constexpr uint32_t kPixels = 48;
    static constexpr double kLampHeight = 0.06;

    explicit Wall(Engine& engine) : patch(engine) {
        patch.view.size = { kPixels, kPixels };
        patch.setSurface(float4(1), 0, 1);
    }
    /// Direction from the lamp to the pixel; unit.
    static double3 awayTo(uint32_t x, uint32_t y) {
        const double half = 40 * std::tan(glm::radians(0.25));
        const auto at = [&](uint32_t i) { return ((i + 0.5) / kPixels * 2 - 1) * half; };
        return glm::normalize(double3(at(x), -at(y), -kLampHeight));
    }

    Patch patch;
};

// The files of the conformance scenes: every type and symmetry. Half floats and the place of pixels round to a
// thousandth.
TEST_P(LightProfiles, EveryPixelOfAWallShowsTheShareOfItsDirection) {
    prepare::Random random(7);
    const auto axis = [&] {
        return float3(glm::normalize(double3(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1))));
    };
    struct ProfiledLamp {
        const char* name;
        double resampling; // of the table: files of type C keep their values, edges of half a degree suffer
    };
    for (ProfiledLamp const& lamp :
         { ProfiledLamp{ "downlight", 2e-5 }, ProfiledLamp{ "pendant", 2e-5 }, ProfiledLamp{ "street", 2e-5 },
           ProfiledLamp{ "flood", 0.03 }, ProfiledLamp{ "spiral", 2e-5 }, ProfiledLamp{ "car", 0.1 } }) {
        const char* const name = lamp.name;
        const auto path = tools::sourceDir() / "tests/conformance/scenes/profiles" / (std::string(name) + ".ies");
        const Result<LightProfile> loaded = loadLightProfile(*engine, path);
        ASSERT_TRUE(loaded) << loaded.error().message;
        const Owned<LightProfile> profile = engine->own(*loaded);
        const assets::IesFile file = *assets::readIes(*assets::readFileBytes(path), name);
        const assets::LightProfileTable table = assets::makeLightProfileTable(file);
        for (int turn = 0; turn < 4; ++turn) {
            Wall wall(*engine);
            const float3 direction = turn == 0 ? float3(0, 0, -1) : axis(), up = turn == 0 ? float3(0, 1, 0) : axis();
            PointLight light{ .positionWorld = { 0, 0, Wall::kLampHeight },
                              .intensity = candela(wall.patch.view, 0.005f),
                              .directionWorld = direction * 3.0f,
                              .upWorld = up * 0.2f };
            const Light without = wall.patch.scene.add(light);
            const Image plain = wall.patch.render();
            wall.patch.scene.remove(without);
            light.profile = profile;
            wall.patch.scene.add(light);
            const Image seen = wall.patch.render();
            const double3 forward = glm::normalize(double3(direction));
            const double3 side = glm::normalize(glm::cross(forward, double3(up)));
            double worst = 0, sum = 0;
            for (uint32_t y = 0; y < Wall::kPixels; ++y) {
                for (uint32_t x = 0; x < Wall::kPixels; ++x) {
                    const double3 away = Wall::awayTo(x, y);
                    const double3 local(glm::dot(away, side), glm::dot(away, glm::cross(side, forward)),
                                        -glm::dot(away, forward));
                    const double share = static_cast<double>(test::halfPixel(seen, x, y).x) /
                                         static_cast<double>(test::halfPixel(plain, x, y).x);
                    worst = std::max(worst, std::abs(share - table.shareAt(local)));
                    sum += share;
                    // The pixel's centre is rounded: near the last row of a table either side is right.
                    ASSERT_NEAR(share, table.shareAt(local), 4e-3) << name << ' ' << turn << ' ' << x << ' ' << y;
                    const double exact = file.candelasAt(local) / static_cast<double>(file.peak);
                    ASSERT_NEAR(table.shareAt(local), exact, lamp.resampling) << lamp.name;
                }
            }
            if (turn == 0) {
                EXPECT_GT(sum, 2) << name << " shines on the wall";
            }
        }
    }
}

TEST_P(LightProfiles, TheConeOfASpotCutsItsProfile) {
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, constantLuminaire(90)));
    const auto seen = [&](float3 direction, float3 away) {
        Patch patch(*engine);
        patch.setSurface(float4(1), 0, 1);
        patch.scene.add(SpotLight{ .positionWorld = double3(-away),
                                   .directionWorld = direction,
                                   .intensity = candela(patch.view, 1),
                                   .outerConeRadians = 0.3f,
                                   .profile = profile });
        return patch.renderCenter().x;
    };
    EXPECT_GT(seen({ 0, 0, -1 }, { 0, 0, -1 }), 0.1f);
    EXPECT_EQ(seen({ 0.6f, 0, -1 }, { 0, 0, -1 }), 0) << "in the profile, but not in the cone";
}

TEST_P(LightProfiles, ANodeTurnsTheProfileOfItsLight) {
    const std::string text = luminaire(anglesTo(90, 10), { 0, 90, 180, 270, 360 }, [](double, double h) {
        return h == 90 ? 1000 : 100; // towards +Y
    });
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, text));
    const auto seen = [&](double4x4 const& world) {
        Patch patch(*engine);
        patch.setSurface(float4(1), 0, 1);
        const Node node = patch.scene.add(NodeDesc{ .parentFromNode = world });
        patch.scene.add(PointLight{ .intensity = candela(patch.view, 1), .profile = profile }, node);
        return patch.renderCenter().x;
    };
    const double3 below(0, -1, 1), right(1, 0, 1); // of the node: the patch is towards +Y, or -X
    const double4x4 plain{ { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, double4(below, 1) };
    const double4x4 turned{ { 0, 1, 0, 0 }, { -1, 0, 0, 0 }, { 0, 0, 1, 0 }, double4(right, 1) }; // +Y becomes -X
    double4x4 unturned = plain;
    unturned[3] = double4(right, 1);
    const float bright = seen(plain);
    EXPECT_NEAR(seen(turned), bright, 2e-3f * bright);
    EXPECT_NEAR(seen(unturned), bright / 10, 2e-3f * bright);
}

// The file's frame is that of the node; its candelas times the multiplier.
TEST_P(LightProfiles, OfAModelShineAsTheirNodesSay) {
    const std::string text = luminaire(anglesTo(180, 15), anglesTo(360, 45), [](double v, double h) {
        return 2000 + 900 * std::cos(glm::radians(h + 20)) * std::sin(glm::radians(v));
    });
    assets::test::TestFile file;
    file.root["extensions"]["EXT_lights_ies"]["lights"] = {
        { { "bufferView", file.addView(std::as_bytes(std::span(text))) }, { "mimeType", "application/x-ies-lm-63" } }
    };
    file.root["nodes"] = assets::test::Json::parse(R"([ { "translation": [ 0.02, 0.01, 0.1 ],
        "rotation": [ 0.5, 0.5, -0.5, 0.5 ], "scale": [ 3, 3, 3 ],
        "extensions": { "EXT_lights_ies": { "light": 0, "multiplier": 0.25, "color": [ 1, 0.5, 0.25 ] } } } ])");
    file.root.erase("meshes");
    const std::filesystem::path path = tools::buildDir() / fmt::format("luminaire-{}.glb", toString(GetParam()));
    const std::vector<std::byte> glb = file.glb();
    std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
    const Result<Model> model = loadGltf(*engine, path);
    ASSERT_TRUE(model) << model.error().message;
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, text));
    // The rotation takes x to -z, y to x and z to -y.
    const PointLight light{ .positionWorld = { 0.02, 0.01, 0.1 },
                            .intensity = Candela{ 0.25f * engine->describe(profile).peak.value },
                            .color = { 1, 0.5f, 0.25f },
                            .profile = profile,
                            .directionWorld = { 0, 1, 0 },
                            .upWorld = { 1, 0, 0 } };
    Patch ofModel(*engine), ofLight(*engine);
    for (Patch* patch : { &ofModel, &ofLight }) {
        patch->setSurface(float4(1), 0, 0.6f);
        patch->view.camera.exposure = { .iso = 100 };
    }
    ofModel.scene.add(*model);
    ofLight.scene.add(light);
    EXPECT_EQ(ofModel.scene.lightCount(), 1u);
    const Image seen = ofModel.render(), expected = ofLight.render();
    for (uint32_t i = 0; i < 16; ++i) {
        const float4 a = test::halfPixel(seen, i, 15 - i), b = test::halfPixel(expected, i, 15 - i);
        EXPECT_GT(b.x, 1e-3f);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-3f * b[c]) << i;
    }
}

TEST_P(LightProfiles, LightsKeepAProfileThatWasDestroyed) {
    Patch patch(*engine);
    patch.setSurface(float4(1), 0, 0.5f);
    const std::string text = luminaire(anglesTo(90, 10), { 0 }, [](double v, double) { return 1000 - 10 * v; });
    const LightProfile profile = profileFrom(*engine, text);
    patch.scene.add(
            PointLight{ .positionWorld = { 0.5, 0, 0.5 }, .intensity = candela(patch.view, 0.5f), .profile = profile });
    const Image before = patch.render();
    engine->destroy(profile);
    const Owned<LightProfile> other = engine->own(profileFrom(*engine, constantLuminaire()));
    EXPECT_EQ(patch.render().pixels, before.pixels);
}

TEST_P(LightProfiles, NoDirectionGivesWhatIsNotANumberOrNegative) {
    const Owned<LightProfile> narrow = engine->own(
            profileFrom(*engine, luminaire({ 0, 0.001 }, { 0, 180 }, [](double, double h) { return 1e-3 + h; })));
    for (const double height : { 0.0, 1e-9, 0.01, 1e7 }) {
        Patch patch(*engine);
        patch.setSurface(float4(0.8f, 0.8f, 0.8f, 1), 0.5f, 0);
        patch.scene.add(PointLight{ .positionWorld = { 0, 0, height },
                                    .intensity = candela(patch.view, 1),
                                    .profile = narrow,
                                    .directionWorld = { 0, 0, -1e-18f },
                                    .upWorld = float3(std::numeric_limits<float>::quiet_NaN()) });
        const Image image = patch.render();
        for (uint32_t i = 0; i < 16; ++i) {
            const float seen = test::halfPixel(image, i, i).x;
            ASSERT_TRUE(seen >= 0 && std::isfinite(seen)) << height << ' ' << i << ' ' << seen;
        }
    }
}

// ---- what is not needed

/// A patch under one plain light, and one with a profile.
test::NullFrame frameWith(PointLight other, bool hasProfile) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0, .hashFrames = true });
    if (!engine) {
        ADD_FAILURE() << engine.error().message;
        return {};
    }
    Patch patch(*engine);
    const Owned<LightProfile> profile = engine->own(profileFrom(*engine, constantLuminaire()));
    patch.scene.add(PointLight{ .positionWorld = { 0, 0, 1 } });
    if (hasProfile) other.profile = profile;
    patch.scene.add(other);
    return test::nullFrame(*engine, patch.scene, patch.view);
}

TEST(LightProfileDemand, AProfileThatNoLitSurfaceSeesChangesNoCommand) {
    const PointLight far{ .positionWorld = { 500, 0, 0 }, .rangeMeters = 1 };
    const PointLight ofOthers{ .positionWorld = { 0, 0, 1 }, .lightChannels = 0b10 };
    const PointLight dark{ .positionWorld = { 0, 0, 1 }, .intensity = Candela{ 0 } };
    for (PointLight const& light : { far, ofOthers, dark }) {
        const test::NullFrame with = frameWith(light, true), without = frameWith(light, false);
        EXPECT_NE(with.stream, 0u);
        EXPECT_EQ(with.stream, without.stream);
        EXPECT_THAT(with.explanation, HasSubstr("light profiles        not needed"));
    }
    const PointLight near{ .positionWorld = { 0, 0, 1 } };
    const test::NullFrame with = frameWith(near, true);
    EXPECT_NE(with.stream, frameWith(near, false).stream);
    EXPECT_THAT(with.explanation, HasSubstr("light profiles        needed"));
}

// ---- files

TEST(LightProfileFiles, AreDescribedByTheirPeakAndTheirFlux) {
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const Owned<LightProfile> constant = engine->own(profileFrom(*engine, constantLuminaire()));
    EXPECT_FLOAT_EQ(engine->describe(constant).peak.value, 70);
    EXPECT_NEAR(engine->describe(constant).flux.value, 70 * 4 * std::numbers::pi, 0.1);
    const Owned<LightProfile> lower = engine->own(profileFrom(*engine, constantLuminaire(90)));
    EXPECT_NEAR(engine->describe(lower).flux.value, 70 * 2 * std::numbers::pi, 0.1);
}

TEST(LightProfileFiles, ThatAreBrokenAreErrorsWithNameAndLine) {
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const std::string whole = constantLuminaire();
    for (size_t size = 0; size < whole.size() - 3; size += 7) { // the last value may be shorter
        const std::string part = whole.substr(0, size);
        const Result<LightProfile> profile =
                engine->create(LightProfileDesc{ std::as_bytes(std::span(part)), "street.ies" });
        ASSERT_FALSE(profile) << size;
        EXPECT_THAT(profile.error().message, HasSubstr("street.ies: line ")) << size;
    }
    const Result<LightProfile> nameless = engine->create(LightProfileDesc{});
    ASSERT_FALSE(nameless);
    EXPECT_THAT(nameless.error().message, HasSubstr("light profile: line 1"));
    const Result<LightProfile> missing = loadLightProfile(*engine, "no/such/lamp.ies");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    EXPECT_THAT(missing.error().message, HasSubstr("no/such/lamp.ies"));
    test::expectNoErrors(*engine);
}

TEST(LightProfilesDeathTest, DirectionsOfZeroAreAssertions) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    const Owned<LightProfile> live = engine->own(profileFrom(*engine, constantLuminaire()));
    EXPECT_DEATH(scene.add(PointLight{ .profile = live, .directionWorld = float3(0) }), "finite and not zero");
}

} // namespace
} // namespace filament_core
