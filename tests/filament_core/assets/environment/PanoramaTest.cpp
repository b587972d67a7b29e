// SPDX-License-Identifier: Apache-2.0
// Panoramas from the cube maps of OpenEXR, and the warnings of environments, whether they are baked or cached.
#include "filament_core/assets/environment/Panorama.h"
#include "base/Log.h"
#include "filament_core/assets/environment/Environment.h"
#include "jobsystem/JobSystem.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/PlainExr.h"

#include <gmock/gmock.h>

namespace filament_core::assets {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// What a pixel of a cube of `size` sees, by the table of ImfEnvmap.h: the positions of a face along two axes of the
/// world, of which pixels of its first and last row and column lie on its edges.
float3 directionOfPixel(int x, int y, int size) {
    const int face = y / size;
    const auto along = [&](int at) { return 2.0f * static_cast<float>(at) / static_cast<float>(size - 1) - 1; };
    const float right = along(x), down = along(y % size);
    switch (face) {
    case 0: // +x: columns grow with z, rows fall with y
        return { 1, -down, right };
    case 1:
        return { -1, -down, -right };
    case 2: // +y: columns grow with x, rows fall with z
        return { right, 1, -down };
    case 3:
        return { right, -1, down };
    case 4: // +z: columns fall with x
        return { -right, -down, 1 };
    default:
        return { right, -down, -1 };
    }
}

float3 light(float3 direction) { return 1.5f + glm::normalize(direction); }

std::vector<std::byte> exrCubeFile(int size) {
    return PlainExr{
        .data = { 0, 0, size - 1, 6 * size - 1 },
        .envmap = 1,
        .pixel = [size](int x, int y) { return light(directionOfPixel(x, y, size)); }
    }.bytes();
}

TEST(Panorama, OfACubeMapShowsTheSameLight) {
    const auto image = decodePanorama(exrCubeFile(64), "cube.exr");
    ASSERT_TRUE(image.ok()) << image.error().message;
    ASSERT_EQ(image->width, 256u);
    ASSERT_EQ(image->height, 128u);
    const HdrImage expected = pictureOf(128, light);
    for (size_t i = 0; i < expected.pixels.size(); ++i)
        ASSERT_LT(glm::distance(image->pixels[i], expected.pixels[i]), 1e-3f) << i % 256 << ' ' << i / 256;
}

TEST(Panorama, OtherImagesAreTheirOwn) {
    const PlainExr file{ .data = { 0, 0, 7, 3 }, .envmap = 0, .pixel = [](int x, int y) { return float3(x, y, 1); } };
    EXPECT_EQ(decodePanorama(file.bytes(), "a.exr")->pixels, decodePanorama(file.bytes(), "a.exr")->pixels);
    EXPECT_EQ(decodePanorama(file.bytes(), "a.exr")->width, 8u);
}

TEST(Panorama, ACubeThatHasNotSixFacesNamesTheCure) {
    const auto image = decodePanorama(PlainExr{ .data = { 0, 0, 7, 3 }, .envmap = 1 }.bytes(), "a.exr");
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(image.error().message, HasSubstr("'a.exr' says that it is a cube map (envmap 1), but 8 x 4 pixels"));
    EXPECT_THAT(image.error().message, HasSubstr("exrenvmap -latlong"));
}

TEST(Panorama, AnEnvironmentWarnsBakedAndCached) {
    const TemporaryFolder folder;
    jobs::JobSystem jobs;
    const std::vector<std::byte> file =
            PlainExr{ .data = { 0, 0, 15, 7 }, .pixelAspectRatio = 2.0f, .whiteLuminance = 80.0f }.bytes();
    for (const bool fromCache : { false, true }) {
        std::vector<std::string> lines;
        const LogSink before = setLogSink([&](Severity, std::string_view line) { lines.emplace_back(line); });
        const auto data = loadEnvironmentFromMemory(file, "sky.exr", jobs,
                                                    { .cacheDirectory = folder.path(), .faceSize = 16, .samples = 4 });
        setLogSink(before);
        ASSERT_TRUE(data.ok()) << data.error().message;
        EXPECT_EQ(data->statistics.fromCache, fromCache);
        EXPECT_THAT(lines, Contains(HasSubstr("'sky.exr': its pixelAspectRatio of 2 is left out")));
        EXPECT_THAT(lines, Contains(HasSubstr("whiteLuminance of 80 cd/m^2")));
    }
}

TEST(Panorama, ACubeMapBakesAsItsPanorama) {
    jobs::JobSystem jobs;
    const EnvironmentOptions options{ .useCache = false, .faceSize = 16, .samples = 16 };
    const auto cube = loadEnvironmentFromMemory(exrCubeFile(32), "cube.exr", jobs, options);
    ASSERT_TRUE(cube.ok()) << cube.error().message;
    const auto panorama = bakeEnvironment(pictureOf(64, light), jobs, options);
    for (size_t i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(cube->irradianceSh[i][c], panorama->irradianceSh[i][c], 2e-3f) << i;
}

} // namespace
} // namespace filament_core::assets
