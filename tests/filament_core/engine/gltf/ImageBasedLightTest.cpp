// SPDX-License-Identifier: Apache-2.0
// EXT_lights_image_based on both APIs: a file draws what the same surroundings draw by the ways that need no file.
#include "base/math/Rgbd.h"
#include "filament_core/assets/environment/IblCube.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/Environment.h>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

namespace filament_core {
namespace {

using assets::cubeFromDirection;
using assets::CubePoint;
using assets::directionFromCube;
using assets::faceCoordinate;
using assets::GlbAlpha;
using assets::GlbImage;
using assets::GlbImageBasedLight;
using assets::GlbScene;
using test::MaterialStage;

constexpr uint32_t kFaceTexels = 8;
const std::string kMirror = test::text(
        "shadingModel : lit", "material.baseColor = vec4(1.0); material.metallic = 1.0; material.roughness = 0.0;");
const std::string kMatte = test::text(
        "shadingModel : lit", "material.baseColor = vec4(1.0); material.metallic = 0.0; material.roughness = 1.0; "
                              "material.reflectance = 0.0;");

/// RGBD: a colour for each axis of the world, a darker corner, and one texel five times as bright.
uint32_t pixelOfWorld(uint32_t face, uint32_t x, uint32_t y) {
    constexpr std::array<uint32_t, 6> kColors{ 0xFF0000FFu, 0xFFFFFF00u, 0xFF00FF00u,
                                               0xFFFF00FFu, 0xFFFF0000u, 0xFF00FFFFu };
    if (x == 2 && y == 5) return 0x33FFFFFFu;
    return x + y < 4 ? kColors[face] & 0xFF7F7F7Fu : kColors[face];
}

uint32_t texelIndex(float c) { return static_cast<uint32_t>((c * 0.5f + 0.5f) * static_cast<float>(kFaceTexels)); }

uint32_t pixelTowards(float3 world) {
    const CubePoint point = cubeFromDirection(world);
    return pixelOfWorld(point.face, texelIndex(point.s), texelIndex(point.t));
}

/// The direction of glTF that a pixel of the extension's images shows: see GltfEnvironment.h.
float3 directionOfPixel(uint32_t face, uint32_t x, uint32_t y, uint32_t side) {
    const float s = faceCoordinate(static_cast<int>(x), side), t = faceCoordinate(static_cast<int>(y), side);
    const std::array<float3, 6> directions{ float3(1, t, s),   float3(-1, t, -s), float3(s, 1, t),
                                            float3(s, -1, -t), float3(s, t, -1),  float3(-s, t, 1) };
    return directions[face];
}

using Pixels = std::function<uint32_t(uint32_t level, float3 inFile)>;

GlbImageBasedLight lightWith(GlbScene& scene, uint32_t side, uint32_t levels, Pixels const& pixelOf) {
    GlbImageBasedLight light{ .size = side };
    for (uint32_t level = 0; level < levels; ++level) {
        const uint32_t size = side >> level;
        std::array<uint32_t, 6>& faces = light.levels.emplace_back();
        for (uint32_t face = 0; face < 6; ++face) {
            std::vector<uint32_t> pixels;
            for (uint32_t i = 0; i < size * size; ++i)
                pixels.push_back(pixelOf(level, directionOfPixel(face, i % size, i / size, size)));
            faces[face] = static_cast<uint32_t>(scene.images.size());
            scene.images.push_back(*assets::glbImageFromPixels("face", size, size, std::as_bytes(std::span(pixels)),
                                                               GlbAlpha::Always));
        }
    }
    light.irradiance[0] = double3(std::numbers::pi * std::sqrt(4 * std::numbers::pi)); // of radiance 1
    return light;
}

std::filesystem::path written(GlbScene const& scene, std::string const& name) {
    const std::filesystem::path folder = test::folderOfThisTest();
    const auto bytes = assets::writeGlb(scene);
    EXPECT_TRUE(bytes.ok());
    std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    return folder / name;
}

constexpr uint32_t kRoughest = 0xFF808080u; // the second level; a mirror takes a twentieth of it

std::filesystem::path fileOfWorld(std::string const& name, glm::dquat const& rotation = { 1, 0, 0, 0 },
                                  uint32_t levels = 2) {
    GlbScene scene;
    const auto turned = [&](uint32_t level, float3 inFile) {
        return level == 0 ? pixelTowards(float3(rotation * double3(inFile))) : kRoughest;
    };
    scene.imageBasedLight = lightWith(scene, kFaceTexels, levels, turned);
    scene.imageBasedLight->rotation = { rotation.x, rotation.y, rotation.z, rotation.w };
    return written(scene, name);
}

using Surroundings = std::function<void(MaterialStage&)>;
EnvironmentSettings radianceAsColor(MaterialStage const& stage) {
    return { .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() } };
}

Surroundings fromModel(std::filesystem::path const& path, float rotationRadians = 0) {
    return [path, rotationRadians](MaterialStage& stage) {
        Result<Model> model = loadGltf(stage.engine, path);
        ASSERT_TRUE(model.ok()) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        ASSERT_TRUE(kept->environment());
        EXPECT_TRUE(kept->warnings().empty());
        EnvironmentSettings settings = radianceAsColor(stage);
        settings.rotationRadians = rotationRadians;
        stage.scene.setEnvironment(*kept->environment(), settings);
    };
}

/// The world's cube as textures, without any file.
struct WorldObjects {
    Owned<Texture> cube, sky;
    Owned<IndirectLight> light;
    Owned<Skybox> skybox;

    explicit WorldObjects(MaterialStage& stage) {
        std::vector<uint16_t> texels;
        constexpr uint32_t kTexels = 6 * kFaceTexels * kFaceTexels;
        for (uint32_t i = 0; i < kTexels + kTexels / 4; ++i) {
            const uint32_t bits = i < kTexels ? pixelOfWorld(i / (kFaceTexels * kFaceTexels), i % kFaceTexels,
                                                             i / kFaceTexels % kFaceTexels)
                                              : kRoughest;
            const float3 color = unpackRgbd(bits);
            for (const float c : { color.x, color.y, color.z, 1.0f }) texels.push_back(halfFromFloat(c));
        }
        const auto sharp = std::as_bytes(std::span(texels)).first(kTexels * 8);
        Engine& engine = stage.engine;
        cube = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                     .format = Format::RGBA16F,
                                                     .width = kFaceTexels,
                                                     .height = kFaceTexels,
                                                     .layers = 6,
                                                     .levels = 2,
                                                     .pixels = std::as_bytes(std::span(texels)) }));
        sky = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                    .format = Format::RGBA16F,
                                                    .width = kFaceTexels,
                                                    .height = kFaceTexels,
                                                    .layers = 6,
                                                    .pixels = sharp }));
        IndirectLightDesc desc{ .specular = cube, .specularLevels = 2, .mapping = RoughnessMapping::Linear };
        desc.irradianceSh[0] = float4(1);
        light = engine.own(engine.create(desc));
        skybox = engine.own(engine.create(SkyboxDesc{ .cube = sky }));
        const EnvironmentSettings settings = radianceAsColor(stage);
        stage.scene.setIndirectLight(light, settings.illuminance);
        stage.scene.setSkybox(skybox, settings.illuminance);
    }
};

void fromTextures(MaterialStage& stage) { stage.keep(std::make_shared<WorldObjects>(stage)); }

/// The world's cube, filtered as textures are, as an equirectangular image.
void fromPicture(MaterialStage& stage) {
    assets::IblCubeLevel level(kFaceTexels);
    for (uint32_t i = 0; i < 6 * kFaceTexels * kFaceTexels; ++i) {
        const uint32_t face = i / (kFaceTexels * kFaceTexels), x = i % kFaceTexels, y = i / kFaceTexels % kFaceTexels;
        const float3 color = unpackRgbd(pixelOfWorld(face, x, y));
        level.at(face, static_cast<int>(x), static_cast<int>(y)) = assets::Texel{ color.x, color.y, color.z, 0 };
    }
    level.fillBorder();
    assets::HdrImage picture{ .width = 1024, .height = 512, .pixels = {}, .repairs = {} };
    for (uint32_t i = 0; i < 1024 * 512; ++i) {
        const float2 uv = (float2(i % 1024, i / 1024) + 0.5f) / float2(1024, 512);
        const assets::Texel texel = level.sample(cubeFromDirection(assets::directionFromEquirect(uv)));
        picture.pixels.emplace_back(texel[0], texel[1], texel[2]);
    }
    const std::filesystem::path file = test::folderOfThisTest() / "world.hdr";
    ASSERT_TRUE(assets::writeHdr(file, picture));
    Result<Environment> sky = loadEnvironment(stage.engine, file, { .samples = 8 });
    ASSERT_TRUE(sky.ok()) << sky.error().message;
    const auto kept = std::make_shared<Environment>(std::move(*sky));
    stage.keep(kept);
    stage.scene.setEnvironment(*kept, radianceAsColor(stage));
}

/// A mirror ball in front of its surroundings: almost every direction, and a part of the sky directly.
Image ballUnder(Surroundings const& surroundings, float3 towards = { 0, 0, -1 }) {
    return test::onBothApis([&](MaterialStage& stage) {
        const float3 up = std::abs(towards.y) > 0.5f ? float3(0, 0, 1) : float3(0, 1, 0);
        stage.view.camera =
                Camera::lookAt(double3(towards * -3.0f), { 0, 0, 0 }, { .verticalFovDegrees = 80 }, {}, double3(up));
        stage.view.size = { 96, 96 };
        surroundings(stage);
        test::addSphere(stage, stage.material(kMirror, test::kNoLights));
    });
}

struct Distance {
    double mean = 0;
    float largest = 0;
};

Distance distanceOf(Image const& a, Image const& b) {
    Distance distance;
    if (a.pixels.size() != b.pixels.size() || a.pixels.empty()) return { 1e9, 1e9f };
    for (uint32_t i = 0; i < a.width * a.height; ++i) {
        const float4 one = test::halfPixel(a, i % a.width, i / a.width),
                     other = test::halfPixel(b, i % a.width, i / a.width);
        const float off = glm::length(float3(one) - float3(other));
        distance.mean += static_cast<double>(off) / (a.width * a.height);
        distance.largest = std::max(distance.largest, off);
    }
    return distance;
}

constexpr std::array<float3, 6> kAxes{ float3(0, 0, -1), float3(1, 0, 0),  float3(-1, 0, 0),
                                       float3(0, 1, 0),  float3(0, -1, 0), float3(0, 0, 1) };

// The texels are the same; where the cube lies otherwise, the filter adds them in another order.
constexpr float kRounding = 2e-3f; // one step of a half float below 4; measured 7e-4

TEST(ImageBasedLight, AFileDrawsWhatTheSameCubeOfTexturesDraws) {
    const Surroundings file = fromModel(fileOfWorld("world.glb"));
    for (const float3 towards : kAxes) {
        const Image picture = ballUnder(file, towards);
        const Distance distance = distanceOf(picture, ballUnder(fromTextures, towards));
        EXPECT_LT(distance.largest, kRounding) << towards.x << towards.y << towards.z;
        EXPECT_GT(test::extremesOf(picture).most, 3) << "a bright texel is in view";
    }
}

TEST(ImageBasedLight, AFileDrawsWhatAPictureOfTheSameSkyDraws) {
    const Surroundings file = fromModel(fileOfWorld("one-level.glb", { 1, 0, 0, 0 }, 1));
    for (const float3 towards : { kAxes[0], kAxes[1], kAxes[3] }) {
        const Distance distance = distanceOf(ballUnder(file, towards), ballUnder(fromPicture, towards));
        EXPECT_LT(distance.mean, 0.01) << towards.x << towards.y << towards.z;
    }
}

// Rotations of files by quarter turns, whose images show the world turned back.
TEST(ImageBasedLight, AFileThatIsTurnedAboutAnyAxisDrawsTheSame) {
    const Image straight = ballUnder(fromModel(fileOfWorld("world.glb")));
    const double half = std::sqrt(0.5);
    const std::pair<const char*, glm::dquat> turns[] = { { "x.glb", { half, half, 0, 0 } },
                                                         { "y.glb", { half, 0, half, 0 } },
                                                         { "z.glb", { half, 0, 0, half } },
                                                         { "xyz.glb", { 0.5, -0.5, 0.5, 0.5 } } };
    for (auto const& [name, rotation] : turns) {
        const Image turned = ballUnder(fromModel(fileOfWorld(name, rotation)));
        EXPECT_LT(distanceOf(straight, turned).largest, kRounding) << name;
    }
}

TEST(ImageBasedLight, TheScenesOwnRotationComesOnTop) {
    constexpr float kQuarter = std::numbers::pi_v<float> / 2;
    const double half = std::sqrt(0.5);
    const Image once = ballUnder(fromModel(fileOfWorld("world.glb"), kQuarter));
    const Image twice = ballUnder(fromModel(fileOfWorld("z.glb", { half, 0, 0, half }), kQuarter));
    EXPECT_LT(distanceOf(once, twice).largest, kRounding);
    EXPECT_GT(distanceOf(once, ballUnder(fromModel(fileOfWorld("world.glb")))).mean, 0.1) << "it turns";
}

// ---- irradiance

Image matteUnder(float intensity) {
    GlbScene scene;
    scene.imageBasedLight = lightWith(scene, 1, 1, [](uint32_t, float3) { return 0xFFFFFFFFu; });
    scene.imageBasedLight->intensity = intensity;
    const std::filesystem::path path = written(scene, fmt::format("white{}.glb", intensity));
    return test::onBothApis([&](MaterialStage& stage) {
        stage.view.size = { 32, 32 };
        fromModel(path)(stage);
        test::addSphere(stage, stage.material(kMatte, test::kNoLights));
    });
}

TEST(ImageBasedLight, AWhiteSurfaceUnderAWhiteSkyIsAsBrightAsTheIntensity) {
    for (const float intensity : { 1.0f, 2.0f, 0.5f }) {
        const test::Extremes found = test::extremesOf(matteUnder(intensity));
        EXPECT_NEAR(found.least, intensity, 1e-3f * intensity);
        EXPECT_NEAR(found.most, intensity, 1e-3f * intensity);
    }
}

// ---- roughness

// Each of five levels has another radiance; linear in perceptual roughness, whatever an image's mapping would be.
TEST(ImageBasedLight, LevelsAreThoseOfPerceptualRoughness) {
    GlbScene scene;
    scene.imageBasedLight =
            lightWith(scene, 16, 5, [](uint32_t level, float3) { return (level + 1) * 0x333333u | 0xFF000000u; });
    const std::filesystem::path path = written(scene, "levels.glb");
    for (const float roughness : { 0.25f, 0.5f, 0.625f, 1.0f }) {
        const std::string metal =
                test::text("shadingModel : lit", fmt::format("material.baseColor = vec4(1.0); material.metallic = 1.0; "
                                                             "material.roughness = {:.4f};",
                                                             roughness));
        const Image image = test::onBothApis([&](MaterialStage& stage) {
            stage.view.size = { 9, 9 };
            stage.view.quality.energyCompensation = true;
            fromModel(path)(stage);
            stage.add(stage.material(metal, test::kNoLights), { {} });
        });
        EXPECT_NEAR(test::centerPixel(image).x, (1 + 4 * roughness) / 5, 0.02f) << roughness;
    }
}

TEST(ImageBasedLight, AModelWhoseSceneNamesNoneHasNone) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    const Result<Model> model = loadGltf(*engine, written(GlbScene{}, "none.glb"));
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_EQ(model->environment(), nullptr);
}

// A light without an irradiance cube answers every choice of the quality with its coefficients.
TEST(ImageBasedLight, DiffuseLightComesFromTheCoefficientsWhateverTheQuality) {
    const Surroundings file = fromModel(fileOfWorld("world.glb"));
    const auto matte = [&](DiffuseIrradiance choice) {
        return test::onBothApis([&](MaterialStage& stage) {
            stage.view.size = { 16, 16 };
            stage.view.quality.diffuseIrradiance = choice;
            file(stage);
            test::addSphere(stage, stage.material(kMatte, test::kNoLights));
        });
    };
    EXPECT_EQ(matte(DiffuseIrradiance::Cube).pixels, matte(DiffuseIrradiance::SphericalHarmonics).pixels);
}

} // namespace
} // namespace filament_core
