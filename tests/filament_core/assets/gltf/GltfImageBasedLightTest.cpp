// SPDX-License-Identifier: Apache-2.0
// EXT_lights_image_based: cubes of radiance and harmonics of irradiance.
#include "base/math/GaussLegendre.h"
#include "filament_core/assets/gltf/GltfEnvironment.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/gltf/ImageBasedLightFile.h"
#include "tests/filament_core/assets/image/PictureFiles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace filament_core::assets::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::string_view kLight = "extensions.EXT_lights_image_based.lights[0]";

uint32_t bitsOf(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha) {
    return red | green << 8 | blue << 16 | alpha << 24;
}

/// A different value for every pixel of a light of up to 8 texels per side.
uint32_t countedPixel(uint32_t level, uint32_t face, uint32_t x, uint32_t y) {
    return bitsOf(face * 40 + level, x * 30, y * 30, 200);
}

CubeLight lightIn(TestFile const& file) {
    const ModelData model = loaded(file);
    if (model.imageBasedLight) return model.imageBasedLight->light;
    ADD_FAILURE() << "the model has no light";
    return { .levels = { IblCubeLevel(1) } };
}

std::string refusalOfLight(TestFile const& file, ErrorCode code = ErrorCode::Corrupt) {
    const Result<ModelData> model = file.load({ .name = "broken.glb" });
    if (model) return "was loaded";
    EXPECT_EQ(model.error().code, code) << model.error().message;
    EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    return model.error().message;
}

/// What GltfEnvironment.h says of a point of a face, written out: s to the right, t down.
float3 directionInFile(uint32_t face, float s, float t) {
    const std::array<float3, 6> directions{ float3(1, t, s),   float3(-1, t, -s), float3(s, 1, t),
                                            float3(s, -1, -t), float3(s, t, -1),  float3(-s, t, 1) };
    return directions[face];
}

// ---- radiance

TEST(GltfImageBasedLight, EveryPixelIsWhereTheExtensionSaysTimesTheIntensity) {
    TestFile file = fileWithLight(8, 4, countedPixel);
    lightOf(file)["intensity"] = 2;
    lightOf(file)["name"] = "studio";
    const ModelData model = loaded(file);
    EXPECT_THAT(model.warnings, IsEmpty());
    ASSERT_TRUE(model.imageBasedLight);
    EXPECT_EQ(model.imageBasedLight->name, "studio");
    CubeLight const& light = model.imageBasedLight->light;
    ASSERT_EQ(light.levels.size(), 4u);
    for (uint32_t level = 0; level < 4; ++level) {
        const uint32_t size = 8u >> level;
        ASSERT_EQ(light.levels[level].size(), size);
        for (uint32_t i = 0; i < 6 * size * size; ++i) {
            const uint32_t face = i / (size * size), x = i % size, y = i / size % size;
            const float3 inFile = directionInFile(face, faceCoordinate(static_cast<int>(x), size),
                                                  faceCoordinate(static_cast<int>(y), size));
            const CubePoint point = cubeFromDirection(inFile * light.worldFromCube);
            const auto texel = [&](float c) { return static_cast<int>((c * 0.5f + 0.5f) * static_cast<float>(size)); };
            const float3 found = light.levels[level].radiance(point.face, texel(point.s), texel(point.t));
            const uint32_t bits = countedPixel(level, face, x, y);
            for (int c = 0; c < 3; ++c) {
                const auto code = static_cast<float>(bits >> (8 * c) & 0xFFu);
                ASSERT_EQ(found[c], code / 200 * 2) << level << ' ' << face << ' ' << x << ' ' << y;
            }
        }
    }
}

TEST(GltfImageBasedLight, TheRotationTurnsTheSurroundings) {
    const double half = std::sqrt(0.5);
    const struct {
        double4 quaternion;
        float3 from, to; ///< a direction before and after
    } turns[] = { { { 0, half, 0, half }, { 0, 0, 1 }, { 1, 0, 0 } },
                  { { half, 0, 0, half }, { 0, 1, 0 }, { 0, 0, 1 } },
                  { { 0, 0, half, half }, { 1, 0, 0 }, { 0, 1, 0 } },
                  { { 0, 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } } };
    const CubeLight still = lightIn(fileWithLight(2, 1, countedPixel));
    for (auto const& turn : turns) {
        TestFile file = fileWithLight(2, 1, countedPixel);
        double4 const& q = turn.quaternion;
        lightOf(file)["rotation"] = { q.x, q.y, q.z, q.w };
        const CubeLight light = lightIn(file);
        const float3 before = turn.from * still.worldFromCube, after = turn.to * light.worldFromCube;
        EXPECT_LT(glm::distance(before, after), 1e-6f) << "the same place of the cube";
        EXPECT_NEAR(glm::determinant(light.worldFromCube), -1, 1e-6f) << "left-handed";
    }
}

TEST(GltfImageBasedLight, PicturesWithoutAlphaAreSrgb) {
    const auto grey = [](uint32_t, uint32_t, uint32_t, uint32_t) { return bitsOf(188, 255, 10, 255); };
    const CubeLight light = lightIn(fileWithLight(2, 1, grey, GlbAlpha::IfUsed));
    const float3 found = light.levels[0].radiance(3, 1, 0);
    EXPECT_NEAR(found.x, 0.50289f, 2e-5f); // ((188 / 255 + 0.055) / 1.055) ^ 2.4
    EXPECT_EQ(found.y, 1);
    EXPECT_NEAR(found.z, 10.0f / 255 / 12.92f, 1e-5f);
    const CubeLight rgbd = lightIn(fileWithLight(2, 1, grey, GlbAlpha::Always));
    EXPECT_EQ(rgbd.levels[0].radiance(3, 1, 0).x, 188.0f / 255) << "with an alpha of 255, RGBD";
}

TEST(GltfImageBasedLight, AJpegIsSrgb) {
    TestFile file = fileWithLight(8, 1, countedPixel);
    file.root["images"][2]["bufferView"] = file.addView(makeJpeg({}, 8, 8));
    const CubeLight light = lightIn(file);
    for (uint32_t y = 0; y < 8; ++y) {
        const double code = jpegPixel({}, 3, y)[1] / 255, linear = std::pow((code + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(light.levels[0].radiance(2, 3, static_cast<int>(7 - y)).y, linear, 0.02) << y;
    }
}

TEST(GltfImageBasedLight, PixelsWithAlphaZeroAreBlackWithAWarning) {
    const TestFile file = fileWithLight(2, 2, [](uint32_t level, uint32_t face, uint32_t x, uint32_t) {
        return bitsOf(255, 255, 255, level == 1 && face == 4 && x == 0 ? 0 : 255);
    });
    const ModelData model = loaded(file);
    EXPECT_EQ(model.imageBasedLight->light.levels[1].radiance(4, 0, 0), float3(0));
    EXPECT_EQ(model.imageBasedLight->light.levels[1].radiance(5, 0, 0), float3(1));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("specularImages[1][4]: images[10] has 1 pixels with alpha 0")));
}

// ---- irradiance

float3 irradianceAt(CubeLight const& light, float3 normal) {
    return shader::lib::irradianceSh(light.irradianceSh.data(), normal * light.worldFromCube, 3);
}

TEST(GltfImageBasedLight, AWhiteSkyLightsEveryNormalWithItsIntensity) {
    for (const float intensity : { 0.0f, 1.0f, 2.0f, 0.25f }) {
        TestFile file = fileWithLight(1, 1, countedPixel);
        lightOf(file)["intensity"] = intensity;
        const CubeLight light = lightIn(file);
        for (const float3 normal : { float3(1, 0, 0), float3(0, -1, 0), float3(0, 0, 1), float3(0.6f, 0.48f, -0.64f) })
            EXPECT_NEAR(irradianceAt(light, normal).y, intensity, 1e-6f * intensity);
    }
}

/// Irradiance / pi of radiance(direction of the world): exact for polynomials of degree 2.
template <class Radiance>
double lambertOf(double3 normal, Radiance const& radiance) {
    const double3 side =
            glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? double3(1, 0, 0) : double3(0, 1, 0)));
    const double3 other = glm::cross(normal, side);
    constexpr int kAzimuths = 8;
    double sum = 0;
    for (QuadratureNode const& node : gaussLegendre(6)) {
        const double sine = std::sqrt(1 - node.x * node.x);
        for (int i = 0; i < kAzimuths; ++i) {
            const double azimuth = 2 * std::numbers::pi * (i + 0.5) / kAzimuths;
            const double3 d = normal * node.x + (side * std::cos(azimuth) + other * std::sin(azimuth)) * sine;
            sum += node.weight * node.x * radiance(d) * 2 / kAzimuths;
        }
    }
    return sum;
}

// The coefficients of irradiance are those of radiance times those of the cosine lobe (Ramamoorthi and Hanrahan 2001,
// eqs. 5 and 8), in the real basis: written out here a second time.
TEST(GltfImageBasedLight, RandomCoefficientsAreTheIrradianceOfTheirRadiance) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double pi = std::numbers::pi;
    for (int round = 0; round < 20; ++round) {
        std::array<double, 9> radiance{};
        for (double& c : radiance) c = uniform(random);
        radiance[0] = 12; // positive everywhere
        TestFile file = fileWithLight(1, 1, countedPixel);
        for (size_t i = 0; i < 9; ++i) {
            const double e = radiance[i] * (i == 0 ? pi : i < 4 ? 2 * pi / 3 : pi / 4);
            lightOf(file)["irradianceCoefficients"][i] = { e, 2 * e, 0 };
        }
        const double half = std::sqrt(0.5);
        if (round % 2 == 1) lightOf(file)["rotation"] = { half, 0, 0, half };
        const CubeLight light = lightIn(file);
        const auto radianceOf = [&](double3 world) {
            const double3 d = world * double3x3(light.worldFromCube);
            const std::array<double, 9> basis{ 0.28209479,
                                               0.48860251 * d.y,
                                               0.48860251 * d.z,
                                               0.48860251 * d.x,
                                               1.09254843 * d.x * d.y,
                                               1.09254843 * d.y * d.z,
                                               0.31539157 * (3 * d.z * d.z - 1),
                                               1.09254843 * d.z * d.x,
                                               0.54627422 * (d.x * d.x - d.y * d.y) };
            double sum = 0;
            for (size_t i = 0; i < 9; ++i) sum += radiance[i] * basis[i];
            return sum;
        };
        for (int i = 0; i < 20; ++i) {
            const double3 normal = glm::normalize(double3(uniform(random), uniform(random), uniform(random)));
            const float3 found = irradianceAt(light, float3(normal));
            const double expected = lambertOf(normal, radianceOf);
            EXPECT_NEAR(found.x, expected, 2e-5);
            EXPECT_NEAR(found.y, 2 * expected, 4e-5);
            EXPECT_EQ(found.z, 0);
        }
    }
}

TEST(GltfImageBasedLight, TheSkyIsAboveIfTheSecondCoefficientIsPositive) {
    TestFile file = fileWithLight(1, 1, countedPixel);
    lightOf(file)["irradianceCoefficients"][1] = { 5, 5, 5 };
    const CubeLight light = lightIn(file);
    EXPECT_GT(irradianceAt(light, { 0, 1, 0 }).x, irradianceAt(light, { 0, -1, 0 }).x + 1);
}

// ---- what is read

TEST(GltfImageBasedLight, OnlyTheLightOfTheDefaultSceneIsRead) {
    TestFile file = fileWithLight(2, 1, countedPixel);
    Json& lights = file.root["extensions"]["EXT_lights_image_based"]["lights"];
    lights.push_back(lights[0]);
    lights[1]["intensity"] = 4;
    lights[1]["specularImages"][0][3] = 6;
    file.root["images"].push_back({ { "uri", "no/such/file.png" } });
    EXPECT_EQ(lightIn(file).levels[0].radiance(1, 0, 0).x, 40.0f / 200);
    file.root["scenes"].push_back(file.root["scenes"][0]);
    file.root["scenes"][1]["extensions"]["EXT_lights_image_based"]["light"] = 1;
    EXPECT_EQ(lightIn(file).levels[0].radiance(1, 0, 0).x, 40.0f / 200);
    file.root["scene"] = 1;
    EXPECT_THAT(refusalOfLight(file, ErrorCode::NotFound), HasSubstr("images[6]"));
    lights[1]["specularImages"][0][3] = 5;
    EXPECT_EQ(lightIn(file).levels[0].radiance(1, 0, 0).x, 160.0f / 200);
    file.root["scenes"][1].erase("extensions");
    EXPECT_FALSE(loaded(file).imageBasedLight);
    file.root.erase("scene");
    file.root.erase("scenes");
    EXPECT_FALSE(loaded(file).imageBasedLight) << "without a scene no light is named";
}

TEST(GltfImageBasedLight, WhatIsNoRotationOrIntensityIsRepairedWithAWarning) {
    TestFile file = fileWithLight(1, 1, countedPixel);
    lightOf(file)["rotation"] = { 0, 0, 0, 0 };
    ModelData model = loaded(file);
    EXPECT_EQ(model.imageBasedLight->light.worldFromCube, float3x3(float3(1, 0, 0), float3(0, 1, 0), float3(0, 0, -1)));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("lights[0].rotation: has no length and was ignored")));
    lightOf(file)["rotation"] = { 0, 3, 0, 3 };
    model = loaded(file);
    EXPECT_LT(glm::distance(model.imageBasedLight->light.worldFromCube[0], float3(0, 0, -1)), 1e-6f);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("lights[0].rotation: its length is not 1; it was normalised")));
    lightOf(file).erase("rotation");
    lightOf(file)["intensity"] = -2;
    model = loaded(file);
    EXPECT_EQ(model.imageBasedLight->light.irradianceSh[0].x, 0);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("lights[0].intensity: -2 is outside [0, 1")));
    lightOf(file)["intensity"] = 1e300;
    model = loaded(file);
    EXPECT_LE(model.imageBasedLight->light.levels[0].radiance(5, 0, 0).x, kMaxRadiance);
}

// ---- what is refused

TEST(GltfImageBasedLight, MissingAndMiscountedFieldsAreNamed) {
    TestFile file = fileWithLight(4, 3, countedPixel);
    const Json good = lightOf(file);
    const auto refusal = [&](const char* field, Json value) {
        lightOf(file) = good;
        if (value.is_null())
            lightOf(file).erase(field);
        else
            lightOf(file)[field] = std::move(value);
        const std::string text = refusalOfLight(file);
        EXPECT_THAT(text, HasSubstr(fmt::format("broken.glb: {}.{}", kLight, field)));
        return text;
    };
    EXPECT_THAT(refusal("irradianceCoefficients", {}), HasSubstr(": missing, must be 9 arrays of 3 numbers; export"));
    EXPECT_THAT(refusal("specularImages", {}), HasSubstr(": missing, must be arrays of 6 images; export"));
    EXPECT_THAT(refusal("specularImageSize", {}), HasSubstr(": must be a non-negative integer, found nothing"));
    EXPECT_THAT(refusal("specularImages", Json::array()), HasSubstr(": has no images; export"));
    EXPECT_THAT(refusal("specularImages", { { 0, 1, 2, 3, 4 } }), HasSubstr("[0]: has 5 images instead of 6; export"));
    EXPECT_THAT(refusal("specularImages", { { 0, 1, 2, 3, 4, 18 } }),
                HasSubstr("[0][5]: index 18 is out of range, the file has 18 images"));
    Json four = good["specularImages"];
    four.push_back(four[2]);
    EXPECT_THAT(refusal("specularImages", four), HasSubstr(": has 4 levels, but faces of 4 texels have only 3"));
    Json eight = good["irradianceCoefficients"];
    eight.erase(8);
    EXPECT_THAT(refusal("irradianceCoefficients", eight), HasSubstr(": has 8 coefficients instead of 9; export"));
    Json pair = good["irradianceCoefficients"];
    pair[3] = { 1, 2 };
    EXPECT_THAT(refusal("irradianceCoefficients", pair), HasSubstr("[3]: must be an array of 3 numbers"));
    pair[3] = { 1, "two", 3 };
    EXPECT_THAT(refusal("irradianceCoefficients", pair), HasSubstr("[3]: must be an array of 3 numbers"));
    pair[3] = { 1, 1e300, 3 };
    EXPECT_THAT(refusal("irradianceCoefficients", pair), HasSubstr("[3]: 1e+300 is no irradiance"));
    pair[3] = { 1, nullptr, 3 };
    EXPECT_THAT(refusal("irradianceCoefficients", pair), HasSubstr("[3]: must be an array of 3 numbers"));
    EXPECT_THAT(refusal("rotation", { 0, 0, 1 }), HasSubstr(": must be an array of 4 numbers"));
    EXPECT_THAT(refusal("intensity", "bright"), HasSubstr(": must be a number"));
    EXPECT_THAT(refusal("specularImageSize", 0), HasSubstr(": 0 is not a power of two; export"));
    EXPECT_THAT(refusal("specularImageSize", 12), HasSubstr(": 12 is not a power of two; export"));
    EXPECT_THAT(refusal("specularImageSize", 3.5), HasSubstr(": must be a non-negative integer"));
    lightOf(file) = good;
    lightOf(file)["specularImageSize"] = 4096;
    EXPECT_THAT(refusalOfLight(file, ErrorCode::Unsupported),
                HasSubstr("specularImageSize: 4096 texels are beyond the limit of 2048; make them smaller"));
}

TEST(GltfImageBasedLight, NumbersThatAreNotFiniteAreRefused) {
    TestFile file = fileWithLight(1, 1, countedPixel);
    std::string text = file.root.dump();
    text.replace(text.find("11.13"), 5, "9e999");
    Json finished = file.root;
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<ModelData> model = loadGltfFromMemory(glbFrom(text, file.binary), ".", jobs);
    ASSERT_FALSE(model);
    EXPECT_THAT(model.error().message, HasSubstr("a number beyond the range of double"));
}

TEST(GltfImageBasedLight, ASceneThatNamesNoSuchLightIsRefused) {
    TestFile file = fileWithLight(1, 1, countedPixel);
    Json& scene = file.root["scenes"][0]["extensions"]["EXT_lights_image_based"];
    scene["light"] = 1;
    EXPECT_THAT(
            refusalOfLight(file),
            HasSubstr("scenes[0].extensions.EXT_lights_image_based.light: index 1 is out of range, the file has 1"));
    scene = Json::object();
    EXPECT_THAT(refusalOfLight(file), HasSubstr("scenes[0].extensions.EXT_lights_image_based.light: missing"));
    scene["light"] = 0;
    file.root["scenes"].push_back({ { "extensions", { { "EXT_lights_image_based", { { "light", 7 } } } } } });
    EXPECT_TRUE(file.load()) << "another scene than the one that is shown";
    file.root["scene"] = 1;
    EXPECT_THAT(refusalOfLight(file), HasSubstr("scenes[1].extensions.EXT_lights_image_based.light: index 7"));
    file = fileWithLight(1, 1, countedPixel);
    file.root.erase("extensions");
    EXPECT_THAT(refusalOfLight(file), HasSubstr("light: index 0 is out of range, the file has 0"));
}

TEST(GltfImageBasedLight, PicturesOfOtherSizesAreRefused) {
    TestFile file = fileWithLight(4, 2, countedPixel);
    const auto refusal = [&](Bytes const& picture, size_t image, ErrorCode code = ErrorCode::Corrupt) {
        TestFile changed = file;
        changed.root["images"][image] = { { "bufferView", changed.addView(picture) } };
        return refusalOfLight(changed, code);
    };
    const auto black = [](uint32_t, uint32_t) { return 0xFF000000u; };
    EXPECT_THAT(
            refusal(facePicture(2, GlbAlpha::Always, black), 3),
            HasSubstr(fmt::format("{}.specularImages[0][3]: images[3] is 2 x 2 pixels instead of 4 x 4, which level 0 "
                                  "of specularImageSize 4 has; export the light again",
                                  kLight)));
    EXPECT_THAT(refusal(facePicture(4, GlbAlpha::Always, black), 11),
                HasSubstr("specularImages[1][5]: images[11] is 4 x 4 pixels instead of 2 x 2, which level 1"));
    const Bytes wide = glbImageFromPixels("wide", 4, 2, Bytes(32, std::byte{ 9 }))->file;
    EXPECT_THAT(refusal(wide, 0), HasSubstr("specularImages[0][0]: images[0] is 4 x 2 pixels instead of 4 x 4"));
    EXPECT_THAT(refusal(facePicture(3, GlbAlpha::Always, black), 1), HasSubstr("images[1] is 3 x 3 pixels"));
    Bytes cut = facePicture(4, GlbAlpha::Always, black);
    cut.resize(cut.size() / 2);
    EXPECT_THAT(refusal(cut, 8), HasSubstr("specularImages[1][2]: image 'images[8]' cannot be decoded"));
    EXPECT_THAT(refusal(Bytes(40, std::byte{ 'x' }), 8, ErrorCode::Unsupported),
                HasSubstr("specularImages[1][2]: image 'images[8]' is none of PNG, JPEG, WebP and AVIF; convert it"));
    TestFile missing = file;
    missing.root["images"][7] = { { "uri", "none.png" } };
    EXPECT_THAT(refusalOfLight(missing, ErrorCode::NotFound), HasSubstr("images[7]: "));
}

TEST(GltfImageBasedLight, EveryCutOfTheBufferIsRefusedOrWhole) {
    const TestFile file = fileWithLight(2, 2, countedPixel);
    size_t refused = 0;
    for (size_t size = 36; size < file.binary.size(); size += 7) {
        TestFile cut = file;
        cut.binary.resize(size);
        refused += !cut.load();
    }
    EXPECT_GT(refused, 50u);
}

// ---- the way back

CubeLight randomLight(uint32_t size) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> uniform(0, 6);
    CubeLight light;
    for (uint32_t side = size; side >= size / 2; side /= 2) {
        IblCubeLevel& level = light.levels.emplace_back(side);
        for (uint32_t i = 0; i < 6 * side * side; ++i)
            level.at(i / (side * side), static_cast<int>(i % side), static_cast<int>(i / side % side)) =
                    Texel{ uniform(random), uniform(random), uniform(random), 0 };
    }
    for (float4& c : light.irradianceSh) c = float4(uniform(random), uniform(random), uniform(random), 0);
    const double4x4 turned = matrixFrom({ .rotation = { 0.1, 0.7, -0.3, 0.6 } });
    light.worldFromCube = float3x3(turned) * float3x3(float3(1, 0, 0), float3(0, 1, 0), float3(0, 0, -1));
    return light;
}

TEST(GltfImageBasedLight, AWrittenLightIsReadBackWithinARoundingOfRgbd) {
    const CubeLight light = randomLight(8);
    GlbScene scene;
    auto written = glbImageBasedLight(light, scene.images);
    ASSERT_TRUE(written) << written.error().message;
    written->name = "written";
    scene.imageBasedLight = *written;
    const Result<Bytes> file = writeGlb(scene);
    ASSERT_TRUE(file) << file.error().message;
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<ModelData> model = loadGltfFromMemory(*file, ".", jobs);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, IsEmpty());
    ASSERT_TRUE(model->imageBasedLight);
    EXPECT_EQ(model->imageBasedLight->name, "written");
    CubeLight const& read = model->imageBasedLight->light;
    ASSERT_EQ(read.levels.size(), light.levels.size());
    for (size_t i = 0; i < read.levels.size(); ++i) {
        const int side = static_cast<int>(read.levels[i].size());
        for (uint32_t face = 0; face < 6; ++face) {
            for (int at = 0; at < side * side; ++at) {
                const float3 found = read.levels[i].radiance(face, at % side, at / side),
                             exact = light.levels[i].radiance(face, at % side, at / side);
                ASSERT_LT(glm::distance(found, exact), 0.022f) << "three components of half a step of 1 / 42";
            }
        }
    }
    for (size_t i = 0; i < 9; ++i) EXPECT_LT(glm::distance(read.irradianceSh[i], light.irradianceSh[i]), 1e-5f) << i;
    for (int column = 0; column < 3; ++column)
        EXPECT_LT(glm::distance(read.worldFromCube[column], light.worldFromCube[column]), 1e-6f);
}

TEST(GltfImageBasedLight, WhatIsNoRotationOfTheCubeIsNotWritten) {
    std::vector<GlbImage> images;
    CubeLight light = randomLight(2);
    light.worldFromCube = float3x3(1.0f); // mirrored, for the extension
    EXPECT_EQ(glbImageBasedLight(light, images).error().code, ErrorCode::InvalidArgument);
    light.worldFromCube[2].z = -2;
    EXPECT_FALSE(glbImageBasedLight(light, images));
    EXPECT_FALSE(glbImageBasedLight({ .worldFromCube = { 1, 0, 0, 0, 1, 0, 0, 0, -1 } }, images));
    GlbScene scene;
    scene.imageBasedLight = GlbImageBasedLight{ .size = 1, .levels = { { 0, 0, 0, 0, 0, 0 } } };
    EXPECT_EQ(writeGlb(scene).error().message, "imageBasedLight: an image is out of range");
}

} // namespace
} // namespace filament_core::assets::test
