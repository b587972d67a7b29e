// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/CubeLight.h"
#include "base/math/Half.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <cstring>

namespace filament_core::assets {
namespace {

class CubeLightTest : public ::testing::Test {
protected:
    /// Levels of a smooth sky, in directions of the cube.
    static CubeLight lightOf(uint32_t size, uint32_t levels) {
        CubeLight light;
        for (uint32_t i = 0; i < levels; ++i) {
            const uint32_t side = size >> i;
            IblCubeLevel& level = light.levels.emplace_back(side);
            for (uint32_t at = 0; at < 6 * side * side; ++at) {
                const int x = static_cast<int>(at % side), y = static_cast<int>(at / side % side);
                const float3 d = glm::normalize(
                        directionFromCube({ at / (side * side), faceCoordinate(x, side), faceCoordinate(y, side) }));
                level.at(at / (side * side), x, y) = texelOf(d, static_cast<float>(i));
            }
            level.fillBorder();
        }
        light.irradianceSh[2] = float4(1, 2, 3, 0);
        return light;
    }
    static Texel texelOf(float3 d, float level) { return Texel{ 2 + d.x, 2 + d.y, 2 + d.z + level, 0 }; }

    jobs::JobSystem mJobs{ { .workers = 1 } };
};

float3 halfTexel(Image const& image, uint32_t level, uint32_t at) {
    std::array<uint16_t, 3> bits{};
    std::memcpy(bits.data(), &image.data[image.levelOffset(level) + size_t{ at } * 8], sizeof(bits));
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]) };
}

TEST_F(CubeLightTest, GivenLevelsAreEncodedAsTheyAre) {
    CubeLight light = lightOf(16, 3);
    light.worldFromCube = float3x3(float3(0, 0, 1), float3(0, 1, 0), float3(1, 0, 0));
    const EnvironmentData data = environmentFromCube(light, mJobs);
    EXPECT_EQ(data.specular.width, 16u);
    EXPECT_EQ(data.specular.levels, 3u);
    EXPECT_EQ(data.specular.layers, 6u);
    EXPECT_EQ(data.levelOfRoughnessOne, 2);
    EXPECT_EQ(data.mapping, RoughnessMapping::Linear);
    EXPECT_EQ(data.sky.width, 16u);
    EXPECT_EQ(data.sky.levels, 1u);
    EXPECT_TRUE(data.irradiance.data.empty());
    EXPECT_EQ(data.irradianceSh, light.irradianceSh);
    EXPECT_EQ(data.worldFromCube, light.worldFromCube);
    for (uint32_t level = 0; level < 3; ++level) {
        const uint32_t side = 16u >> level;
        for (uint32_t at = 0; at < 6 * side * side; ++at) {
            const float3 exact = light.levels[level].radiance(at / (side * side), static_cast<int>(at % side),
                                                              static_cast<int>(at / side % side));
            ASSERT_LT(glm::distance(halfTexel(data.specular, level, at), exact), 4e-3f);
        }
    }
    EXPECT_EQ(std::memcmp(data.sky.data.data(), data.specular.data.data(), data.sky.data.size()), 0);
}

TEST_F(CubeLightTest, ASingleLevelIsFilteredForRoughSurfaces) {
    const CubeLight light = lightOf(64, 1);
    const EnvironmentData data = environmentFromCube(light, mJobs);
    EXPECT_EQ(data.specular.levels, 3u) << "64, 32, 16";
    EXPECT_EQ(data.levelOfRoughnessOne, 2);
    EXPECT_EQ(data.sky.levels, 1u);
    const float sharp = halfTexel(data.specular, 0, 32 * 64 + 32).x; // towards +x
    const float rough = halfTexel(data.specular, 2, 8 * 16 + 8).x;
    EXPECT_NEAR(sharp, 3, 0.01f);
    EXPECT_LT(rough, 2.8f);
    EXPECT_GT(rough, 2.2f);
}

TEST_F(CubeLightTest, ASingleTexelIsALightToo) {
    const EnvironmentData data = environmentFromCube(lightOf(1, 1), mJobs);
    EXPECT_EQ(data.specular.levels, 1u);
    EXPECT_EQ(data.levelOfRoughnessOne, 0);
}

TEST_F(CubeLightTest, ThePictureShowsEveryDirectionOfTheWorld) {
    CubeLight light = lightOf(64, 1);
    for (const float3x3 worldFromCube : { float3x3(1.0f), float3x3(float3(0, 0, 1), float3(0, 1, 0), float3(1, 0, 0)),
                                          float3x3(float3(0, 1, 0), float3(0, 0, 1), float3(1, 0, 0)) }) {
        light.worldFromCube = worldFromCube;
        const HdrImage picture = pictureFromCube(light, 128, mJobs);
        ASSERT_EQ(picture.pixels.size(), 128u * 64u);
        for (uint32_t i = 0; i < picture.pixels.size(); i += 7) {
            const float2 uv = (float2(i % 128, i / 128) + 0.5f) / float2(128, 64);
            const float3 inCube = glm::transpose(worldFromCube) * directionFromEquirect(uv);
            const Texel exact = texelOf(inCube, 0);
            ASSERT_LT(glm::distance(picture.pixels[i], float3(exact[0], exact[1], exact[2])), 2e-3f) << i;
        }
    }
}

} // namespace
} // namespace filament_core::assets
