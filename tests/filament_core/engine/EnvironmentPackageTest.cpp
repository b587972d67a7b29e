// SPDX-License-Identifier: Apache-2.0
// What a package of cmgen draws is what its image draws, on both APIs.
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/LoadTicket.h>

namespace filament_core {
namespace {

using test::MaterialStage;

const EnvironmentLoadOptions kSmallBake{ .faceSize = 32, .samples = 32 };

assets::HdrImage panorama() {
    assets::HdrImage picture{ .width = 64, .height = 32, .pixels = {}, .repairs = {} };
    for (uint32_t i = 0; i < 64 * 32; ++i) {
        const float3 d = assets::directionFromEquirect((float2(i % 64, i / 64) + 0.5f) / float2(64, 32));
        picture.pixels.push_back(float3(0.6f) + d * 0.5f + (d.x > 0.8f ? float3(9, 4, 1) : float3(0)));
    }
    return picture;
}

/// A cube as another program writes it: half floats, radiance 0.6 + d / 2.
std::vector<std::byte> foreignCube() {
    assets::Image cube{ .width = 40, .height = 40, .layers = 6, .format = backend::Format::RGBA16F, .data = {} };
    for (uint32_t i = 0; i < 6 * 40 * 40; ++i) {
        const auto at = [](uint32_t texel) { return assets::faceCoordinate(static_cast<int>(texel), 40); };
        const float3 d = glm::normalize(assets::directionFromCube({ i / 1600, at(i % 40), at(i / 40 % 40) }));
        for (const float c : { 0.6f + d.x / 2, 0.6f + d.y / 2, 0.6f + d.z / 2, 1.0f }) {
            const uint16_t half = halfFromFloat(c);
            cube.data.push_back(static_cast<std::byte>(half)), cube.data.push_back(static_cast<std::byte>(half >> 8));
        }
    }
    return assets::encodeKtx2(cube);
}

/// A half rough ball in front of the sky, the same on both APIs.
Image ballUnderFile(std::filesystem::path const& file, bool isAsync = false) {
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Environment> sky = isAsync ? loadEnvironmentAsync(stage.engine, file, kSmallBake).wait()
                                          : loadEnvironment(stage.engine, file, kSmallBake);
        ASSERT_TRUE(sky.ok()) << sky.error().message;
        const auto kept = std::make_shared<Environment>(std::move(*sky));
        stage.keep(kept);
        stage.scene.setEnvironment(*kept, { .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() } });
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 });
        stage.view.size = { 48, 48 };
        test::addSphere(stage, stage.material(test::text("shadingModel : lit",
                                                         "material.baseColor = vec4(0.8, 0.7, 0.6, 1.0); "
                                                         "material.metallic = 0.6; material.roughness = 0.35;"),
                                              test::kNoLights));
    });
}

TEST(EnvironmentPackages, DrawWhatTheirPictureDrawsBitForBit) {
    const std::filesystem::path folder = test::folderOfThisTest();
    ASSERT_TRUE(assets::writeExr(folder / "sky.exr", 64, 32, panorama().pixels));
    jobs::JobSystem jobs({ .workers = 0 });
    const auto baked = assets::loadEnvironment(
            folder / "sky.exr", jobs,
            { .useCache = false, .faceSize = kSmallBake.faceSize, .samples = kSmallBake.samples });
    ASSERT_TRUE(baked) << baked.error().message;
    ASSERT_TRUE(assets::writeEnvironmentPackage(*baked, folder / "sky.ktx2"));

    const Image expected = ballUnderFile(folder / "sky.exr");
    EXPECT_GT(test::extremesOf(expected).most, 1.0f) << "the lamp is seen";
    EXPECT_EQ(test::differingPixels(ballUnderFile(folder / "sky.ktx2"), expected), 0u);
    EXPECT_EQ(test::differingPixels(ballUnderFile(folder / "sky.ktx2", true), expected), 0u);
}

// The background shows directions as colours: a cube that lies otherwise would show others.
TEST(EnvironmentPackages, CubesOfOtherProgramsLieInTheWorldAsTheySay) {
    const std::filesystem::path file = test::folderOfThisTest() / "cube.ktx2";
    ASSERT_TRUE(assets::replaceFile(file, foreignCube()));
    const Image seen = ballUnderFile(file);
    for (const auto& [x, y] : { std::pair(0u, 0u), { 47u, 0u }, { 0u, 47u }, { 47u, 47u } }) {
        const float half = std::tan(glm::radians(30.0f));
        const float2 at = (float2(x, y) + 0.5f) / 48.0f * 2.0f - 1.0f;
        const float3 d = glm::normalize(float3(at.x * half, -at.y * half, -1));
        const float4 pixel = test::halfPixel(seen, x, y);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], 0.6f + d[c] / 2, 0.03f) << x << ' ' << y << ' ' << c;
    }
}

TEST(EnvironmentPackages, AFileThatIsNoEnvironmentSaysWhatItIs) {
    const std::filesystem::path file = test::folderOfThisTest() / "flat.ktx2";
    assets::Image flat{ .width = 4, .height = 4, .format = backend::Format::RGBA16F, .data = {} };
    flat.data.resize(flat.levelBytes(0));
    ASSERT_TRUE(assets::replaceFile(file, assets::encodeKtx2(flat)));
    std::optional<Engine> engine = test::makeEngine(Backend::Null, 0);
    const Result<Environment> sky = loadEnvironment(*engine, file);
    ASSERT_FALSE(sky);
    EXPECT_NE(sky.error().message.find("flat.ktx2' is not a cube map"), std::string::npos) << sky.error().message;
}

} // namespace
} // namespace filament_core
