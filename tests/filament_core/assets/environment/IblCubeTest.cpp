// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/IblCube.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <numeric>

namespace filament_core::assets {
namespace {

class IblCubeTest : public ::testing::Test {
protected:
    jobs::JobSystem mJobs{ { .workers = 1 } };
};

double energy(IblCubeLevel const& level) {
    const std::vector<float> angles = texelSolidAngles(level.size());
    double sum = 0;
    for (uint32_t face = 0; face < 6; ++face) {
        for (size_t i = 0; i < angles.size(); ++i) {
            sum += angles[i] *
                   level.radiance(face, static_cast<int>(i % level.size()), static_cast<int>(i / level.size())).x;
        }
    }
    return sum;
}

// OpenGL ES 3.2 table 8.25, written out by hand: texel (0, 0) and the middle of the first row of each face.
TEST_F(IblCubeTest, FaceCoordinatesAreThoseOfTheGraphicsApis) {
    const std::array<float3, 6> centres{ float3(1, 0, 0),  float3(-1, 0, 0), float3(0, 1, 0),
                                         float3(0, -1, 0), float3(0, 0, 1),  float3(0, 0, -1) };
    const std::array<float3, 6> topLeft{ float3(1, 1, 1),   float3(-1, 1, -1), float3(-1, 1, -1),
                                         float3(-1, -1, 1), float3(-1, 1, 1),  float3(1, 1, -1) };
    for (uint32_t face = 0; face < 6; ++face) {
        EXPECT_EQ(directionFromCube({ face, 0, 0 }), centres[face]);
        EXPECT_EQ(directionFromCube({ face, -1, -1 }), topLeft[face]);
    }
}

TEST_F(IblCubeTest, DirectionsAndCubePointsAreInverses) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-0.999f, 0.999f);
    for (int i = 0; i < 1000; ++i) {
        const CubePoint point{ static_cast<uint32_t>(i) % 6, uniform(random), uniform(random) };
        const CubePoint again = cubeFromDirection(directionFromCube(point) * 3.0f);
        EXPECT_EQ(again.face, point.face);
        EXPECT_NEAR(again.s, point.s, 1e-6f);
        EXPECT_NEAR(again.t, point.t, 1e-6f);
    }
}

TEST_F(IblCubeTest, DirectionsAndPixelsOfThePictureAreInverses) {
    EXPECT_NEAR(equirectFromDirection({ 0, 0, 1 }).x, 0.5f, 1e-6f) << "+z is the middle of the picture";
    EXPECT_NEAR(equirectFromDirection({ 1, 0, 0 }).x, 0.25f, 1e-6f) << "+x is left of it";
    EXPECT_NEAR(equirectFromDirection({ 0, 1, 0 }).y, 0.0f, 1e-6f) << "the zenith is row 0";
    for (float u = 0.05f; u < 1; u += 0.1f) {
        for (float v = 0.05f; v < 1; v += 0.1f) {
            const float2 again = equirectFromDirection(directionFromEquirect({ u, v }));
            EXPECT_NEAR(again.x, u, 1e-5f);
            EXPECT_NEAR(again.y, v, 1e-5f);
        }
    }
}

// Six pixels of the image have colours; their places follow by hand from u = 0.5 - atan2(x, z) / 2pi, v = acos(y) /
// pi.
TEST_F(IblCubeTest, SixColouredDirectionsLandOnTheirFacesAndTexels) {
    HdrImage image{ .width = 512, .height = 256, .pixels = std::vector<float3>(512 * 256), .repairs = {} };
    struct Mark {
        uint32_t x, y; // pixels
        uint32_t face;
        float s, t;
    };
    // +x at u = 1/4, -x at 3/4, +z at 1/2, -z at the seam; an eighth above the horizon (v = 3/8) t is -tan(22.5).
    const std::array<Mark, 4> marks{
        { { 128, 128, 0, 0, 0 }, { 384, 128, 1, 0, 0 }, { 256, 96, 4, 0, -0.41421f }, { 0, 160, 5, 0, 0.41421f } }
    };
    for (size_t i = 0; i < marks.size(); ++i) {
        for (int dy = -2; dy < 2; ++dy) {
            for (int dx = -2; dx < 2; ++dx) {
                const uint32_t x = (marks[i].x + 512u + static_cast<uint32_t>(dx)) % 512;
                image.at(x, marks[i].y + static_cast<uint32_t>(dy)) = float3(float(i + 1), 0, 0);
            }
        }
    }
    for (uint32_t x = 0; x < 512; ++x) {
        for (uint32_t y = 0; y < 4; ++y) image.at(x, y) = float3(5, 0, 0), image.at(x, 255 - y) = float3(6, 0, 0);
    }
    const IblCubeLevel level = faceLevelFromEquirect(image, 128, mJobs);
    for (size_t i = 0; i < marks.size(); ++i) {
        EXPECT_NEAR(level.sample({ marks[i].face, marks[i].s, marks[i].t })[0], float(i + 1), 0.05f) << "mark " << i;
    }
    EXPECT_NEAR(level.sample({ 2, 0, 0 })[0], 5.0f, 0.05f) << "zenith on +y";
    EXPECT_NEAR(level.sample({ 3, 0, 0 })[0], 6.0f, 0.05f) << "nadir on -y";
    EXPECT_EQ(level.sample({ 4, 0.5f, 0.5f })[0], 0.0f);
}

TEST_F(IblCubeTest, SolidAnglesOfACubeAddUpToTheSphere) {
    for (const uint32_t size : { 1u, 2u, 64u }) {
        const std::vector<float> angles = texelSolidAngles(size);
        EXPECT_NEAR(6 * std::accumulate(angles.begin(), angles.end(), 0.0), 4 * std::numbers::pi, 1e-4);
    }
    EXPECT_GT(texelSolidAngles(64)[32 * 64 + 32], 4.9f * texelSolidAngles(64)[0])
            << "corners are seen 3^1.5 times smaller";
}

TEST_F(IblCubeTest, AConstantSkyStaysConstantOnEveryLevelAndBorder) {
    const IblCube cube = cubeFromEquirect(pictureOf(32, [](float3) { return float3(1, 2, 3); }), 64, mJobs);
    ASSERT_EQ(cube.size(), 7u);
    for (IblCubeLevel const& level : cube) {
        const int last = static_cast<int>(level.size());
        for (uint32_t face = 0; face < 6; ++face) {
            for (int y = -1; y <= last; ++y) {
                for (int x = -1; x <= last; ++x)
                    EXPECT_LT(glm::distance(level.radiance(face, x, y), float3(1, 2, 3)), 1e-5f);
            }
        }
    }
}

// A sun of a few pixels, at places where the image is distorted in different ways.
TEST_F(IblCubeTest, TheEnergyOfASmallBrightDiscIsTheSameInThePictureAndOnAllLevels) {
    for (const float3 sun :
         { float3(0.3f, 0.2f, 0.9f), float3(1, 1, 1), float3(0.02f, 1, 0.01f), float3(0, 0.1f, -1) }) {
        const float3 towards = glm::normalize(sun);
        const float cosRadius = std::cos(0.02f);
        const HdrImage image = pictureOf(
                256, [&](float3 d) { return float3(glm::dot(d, towards) > cosRadius ? 1e5f : 0.01f); }, 4);
        double inPicture = 0;
        for (uint32_t y = 0; y < image.height; ++y) {
            const double angle = 2 * std::numbers::pi / image.width *
                                 (std::cos(std::numbers::pi * y / image.height) -
                                  std::cos(std::numbers::pi * (y + 1) / image.height));
            for (uint32_t x = 0; x < image.width; ++x) inPicture += angle * image.at(x, y).x;
        }
        const IblCube cube = cubeFromEquirect(image, 128, mJobs);
        for (IblCubeLevel const& level : cube) {
            EXPECT_NEAR(energy(level) / energy(cube[0]), 1.0, 1e-4) << "level of " << level.size();
        }
        EXPECT_NEAR(energy(cube[0]) / inPicture, 1.0, 0.01) << "towards " << sun.x << " " << sun.y << " " << sun.z;
    }
}

// A smooth sky sampled along a path over edges and corners: no step is larger than those of the sky itself.
TEST_F(IblCubeTest, LookUpsAreSmoothAcrossFaceEdgesAndCorners) {
    const auto sky = [](float3 d) { return float3(1 + 0.5f * d.x + 0.3f * d.y * d.z); };
    const IblCube cube = cubeFromEquirect(pictureOf(128, sky), 32, mJobs);
    for (uint32_t i = 0; i < 2000; ++i) {
        const float angle = float(i) / 2000 * 2 * kPi;
        const float3 d = glm::normalize(float3(std::cos(angle), std::sin(angle), std::sin(2 * angle)));
        EXPECT_NEAR(cube[0].sample(cubeFromDirection(d))[0], sky(d).x, 5e-3f)
                << "direction " << d.x << " " << d.y << " " << d.z;
    }
    for (const float3 corner : { float3(1, 1, 1), float3(-1, 1, -1), float3(1, -1, -1) }) {
        const float3 d = glm::normalize(corner);
        EXPECT_NEAR(cube[0].sample(cubeFromDirection(d))[0], sky(d).x, 0.02f);
    }
}

} // namespace
} // namespace filament_core::assets
