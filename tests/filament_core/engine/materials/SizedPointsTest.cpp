// SPDX-License-Identifier: Apache-2.0
// Every pixel of points with a size against the square or disc that it should be, computed in double precision; the
// same bits on both APIs. Clouds: each point once, in groups of neighbours, from files too.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Points.h>

#include <glm/ext/matrix_transform.hpp>

#include <fstream>
#include <limits>
#include <random>
#include <set>

namespace filament_core {
namespace {

using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr uint32_t kSide = 64;
constexpr double kLens = 2.41421356237309505; // 1 / tan(45 / 2 degrees)

struct PointPaint {
    float pixels = 1, meters = 0;
    bool disc = false;
};

MaterialInstance pointMaterial(MaterialStage& stage, PointPaint const& paint) {
    const Result<Material> found = createBuiltInMaterial(stage.engine, "points");
    EXPECT_TRUE(found);
    const MaterialInstance instance = stage.keep(*found);
    EXPECT_TRUE(stage.engine.set(instance, "pointPixels", paint.pixels));
    EXPECT_TRUE(stage.engine.set(instance, "pointMeters", paint.meters));
    EXPECT_TRUE(stage.engine.set(instance, "disc", paint.disc));
    return instance;
}

Node addPoints(MaterialStage& stage, std::span<const double3> positions, PointPaint const& paint,
               NodeDesc const& node = {}) {
    auto cloud = std::make_shared<PointCloud>(PointCloud::create(stage.engine, makePointQuads(positions)));
    stage.keep(cloud);
    return cloud->addTo(stage.scene, pointMaterial(stage, paint), node, 8);
}

Image drawnPoints(std::span<const double3> positions, PointPaint const& paint, NodeDesc const& node = {},
                  uint8_t samples = 1) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = { kSide, kSide };
        stage.view.samples = samples;
        addPoints(stage, positions, paint, node);
    });
}

double2 pixelOfPoint(double3 point) {
    const double distance = 4.0 - point.z; // the camera is at z = 4 and looks down -z
    return (double2(point.x, -point.y) * kLens / distance + 1.0) * 0.5 * double{ kSide };
}

double halfSideOf(double3 point, PointPaint const& paint) {
    const double meters = 0.5 * double{ paint.meters } * kLens / (4.0 - point.z) * 0.5 * kSide;
    return std::max(0.5 * double{ paint.pixels }, meters);
}

size_t drawnPixels(Image const& image) {
    size_t count = 0;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) count += halfPixel(image, x, y).x > 0;
    return count;
}

void expectShapes(std::span<const double3> points, PointPaint const& paint, int seed) {
    constexpr double kRounding = 0.02; // pixels: positions snap to 1/256, and clip space rounds
    const Image image = drawnPoints(points, paint);
    size_t wrong = 0;
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            double inside = -1e9; // > 0: the distance to the nearest edge
            for (double3 const& point : points) {
                const double2 d = glm::abs(double2(x + 0.5, y + 0.5) - pixelOfPoint(point));
                const double distance = paint.disc ? glm::length(d) : std::max(d.x, d.y);
                inside = std::max(inside, halfSideOf(point, paint) - distance);
            }
            if (std::abs(inside) > kRounding) wrong += (inside > 0) != (halfPixel(image, x, y).x > 0);
        }
    }
    EXPECT_EQ(wrong, 0u) << "pixels, seed " << seed;
    EXPECT_GT(drawnPixels(image), 3u) << "seed " << seed;
}

TEST(SizedPoints, CoverTheirSquareOrDiscInPixelsOrMetres) {
    for (int seed = 0; seed < 16; ++seed) {
        std::mt19937 bits(static_cast<uint32_t>(seed));
        const auto between = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(bits()) / 4294967295.0;
        };
        std::vector<double3> points;
        for (int i = 0; i < 3; ++i) points.emplace_back(between(-1.5, 1.5), between(-1.5, 1.5), between(-3, 2));
        PointPaint paint{ .pixels = static_cast<float>(between(3, 20)), .disc = seed % 2 == 0 };
        if (seed % 4 >= 2) paint = { .pixels = 4, .meters = static_cast<float>(between(0.1, 1)), .disc = paint.disc };
        expectShapes(points, paint, seed);
    }
}

TEST(SizedPoints, StayWhereTheirCentreLeavesTheView) {
    const double edge = 4 / kLens; // of the view, at z = 0
    const double3 outside[] = { { edge + 0.05, 0, 0 }, { 0.1, -edge - 0.1, 0 } };
    expectShapes(outside, { .pixels = 12 }, -1);
    expectShapes(outside, { .pixels = 0, .meters = 1, .disc = true }, -2);
}

TEST(SizedPoints, DrawNothingForSizesThatAreNoneOrBehindTheCamera) {
    const double3 middle[] = { { 0.02, 0.01, 0 } }, behind[] = { { 0, 0, 5 }, { 0, 0, 4 }, { 1, 0, 1e6 } };
    for (const float size : { 0.0f, -3.0f, std::numeric_limits<float>::quiet_NaN() })
        EXPECT_EQ(drawnPixels(drawnPoints(middle, { .pixels = size, .meters = size })), 0u) << size;
    EXPECT_EQ(drawnPixels(drawnPoints(behind, { .pixels = 100, .meters = 100 })), 0u);
    EXPECT_EQ(drawnPixels(drawnPoints(middle, { .pixels = 1 })), 1u);
}

TEST(SizedPoints, OfHugeSizesFillTheView) {
    constexpr float kHuge = std::numeric_limits<float>::infinity();
    const double3 middle[] = { { 0.02, 0.01, 0 } };
    EXPECT_EQ(drawnPixels(drawnPoints(middle, { .pixels = kHuge })), kSide * kSide);
    EXPECT_EQ(drawnPixels(drawnPoints(middle, { .meters = kHuge })), kSide * kSide);
}

TEST(SizedPoints, OfAMirroredObjectAreDrawn) {
    const double3 points[] = { { 0.3, 0.2, 0 }, { -0.4, 0.1, 0.5 } };
    const double3 mirrored[] = { { -0.3, 0.2, 0 }, { 0.4, 0.1, 0.5 } };
    const NodeDesc mirror{ .parentFromNode = glm::scale(double4x4(1), double3(-1, 1, 1)) };
    EXPECT_EQ(drawnPoints(points, { .pixels = 9, .disc = true }, mirror).pixels,
              drawnPoints(mirrored, { .pixels = 9, .disc = true }).pixels);
}

/// Camera and cloud moved together by whole numbers: what changes is nothing.
TEST(SizedPoints, FarFromTheOriginHaveTheSameBits) {
    const double3 points[] = { { 0.375, 0.25, 0 }, { -0.4375, 0.125, 0.5 }, { 0.0625, -0.5, -1 } };
    const auto picture = [&](double3 origin) {
        return onBothApis([&](MaterialStage& stage) {
            stage.view.size = { kSide, kSide };
            stage.view.camera = Camera::lookAt(origin + double3(0, 0, 4), origin, { .verticalFovDegrees = 45 });
            std::vector<double3> moved;
            for (double3 const& point : points) moved.push_back(point + origin);
            addPoints(stage, moved, { .pixels = 5, .meters = 0.3f, .disc = true });
        });
    };
    const Image here = picture({ 0, 0, 0 });
    EXPECT_EQ(here.pixels, picture({ 5e6, -3e5, 7e6 }).pixels);
    EXPECT_GT(drawnPixels(here), 50u);
}

TEST(SizedPoints, OfSeveralSamplesCoverTheAreaOfADisc) {
    const double3 points[] = { { 0.013, 0.021, 0 } };
    const Image image = drawnPoints(points, { .pixels = 21, .disc = true }, {}, 4);
    double area = 0;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) area += double{ halfPixel(image, x, y).x };
    const double exact = 3.14159265358979 * 10.5 * 10.5, rim = 2 * 3.14159265358979 * 10.5;
    EXPECT_NEAR(area, exact + rim / 8, 0.02 * exact)
            << "masks round up by an eighth of a pixel (docs/anti-aliasing.md)";
    EXPECT_GT(halfPixel(image, 32, 32).x, 0.99f);
}

TEST(SizedPoints, OfMetresCastTheShadowsOfDiscs) {
    const auto litGround = [](bool hasPoint) {
        const Image image = onBothApis([&](MaterialStage& stage) {
            stage.view.size = { kSide, kSide };
            const Result<Material> lit = createBuiltInMaterial(stage.engine, "lit");
            ASSERT_TRUE(lit);
            stage.add(stage.keep(*lit), { { .z = -1 } });
            stage.scene.add(SunLight{ .directionWorld = { 0.6f, 0, -1 } });
            const double3 point[] = { { -0.6, 0, 0 } };
            if (hasPoint) addPoints(stage, point, { .meters = 0.5f, .disc = true });
        });
        return halfPixel(image, kSide / 2, kSide / 2).x; // where the ray of light through the point meets the ground
    };
    const float open = litGround(false);
    EXPECT_GT(open, 0.0f);
    EXPECT_LT(litGround(true), 0.1f * open);
}

TEST(SizedPoints, ArePickedWhereTheyAreDrawn) {
    const double3 points[] = { { 0.25, 0.125, 0 } };
    for (const Backend backend : test::kBothApis) {
        for (PointPaint const& paint :
             { PointPaint{ .pixels = 17, .disc = true }, PointPaint{ .pixels = 0, .meters = 0.8f, .disc = true } }) {
            auto engine = test::makeEngine(backend);
            ASSERT_TRUE(engine);
            MaterialStage stage(*engine);
            stage.view.size = { kSide, kSide };
            addPoints(stage, points, paint);
            Renderer renderer(*engine);
            const Image image = test::renderLinear(*engine, renderer, stage.scene, stage.view);
            const auto row = static_cast<uint32_t>(pixelOfPoint(points[0]).y) - 4;
            for (uint32_t x = 20; x < kSide; x += 3) {
                const Result<PickHit> hit = renderer.waitPick(renderer.pick(stage.scene, stage.view, { x, row }));
                ASSERT_TRUE(hit) << hit.error().message;
                EXPECT_EQ(static_cast<bool>(*hit), halfPixel(image, x, row).x > 0) << x;
            }
            test::expectNoErrors(*engine);
        }
    }
}

TEST(PointQuads, HoldEveryFinitePointOnceInGroupsOfNeighbours) {
    std::mt19937 bits(3);
    std::vector<double3> points;
    for (int i = 0; i < 100000; ++i) points.emplace_back(bits() % 1000, bits() % 1000, bits() % 1000);
    points[5].x = std::numeric_limits<double>::quiet_NaN();
    points[6].y = std::numeric_limits<double>::infinity();
    const auto key = [](double3 p) { return std::array{ p.x, p.y, p.z }; };
    std::multiset<std::array<double, 3>> missing;
    for (size_t i = 0; i < points.size(); ++i)
        if (i != 5 && i != 6) missing.insert(key(points[i]));
    const std::vector<PointQuads> groups = makePointQuads(points);
    EXPECT_EQ(groups.size(), 7u);
    double volume = 0;
    for (PointQuads const& group : groups) {
        EXPECT_LE(group.pointCount(), kMaxPointsOfQuads);
        const double3 size = group.bounds.max - group.bounds.min;
        volume += size.x * size.y * size.z;
        for (size_t i = 0; i < group.vertices.size(); i += 4) {
            const auto found = missing.find(key(group.center + double3(group.vertices[i].position)));
            ASSERT_NE(found, missing.end());
            missing.erase(found);
            for (size_t c = 1; c < 4; ++c) ASSERT_EQ(group.vertices[i].position, group.vertices[i + c].position);
        }
    }
    EXPECT_TRUE(missing.empty());
    EXPECT_LE(volume, 1.001e9) << "boxes that hardly overlap";
    EXPECT_TRUE(makePointQuads({}).empty());
}

TEST(PointCloudFile, KeepsColoursAndTheDigitsOfDoubles) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "points-test.ply";
    std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
                           "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                           "end_header\n4500000.125 -700000.0625 12.5 255 0 188\n4500001.375 -700000 12 0 255 0\n";
    const Result<PointCloudData> cloud = loadPointCloud(path);
    ASSERT_TRUE(cloud) << cloud.error().message;
    ASSERT_EQ(cloud->positions.size(), 2u);
    EXPECT_EQ(cloud->positions[0], double3(4500000.125, -700000.0625, 12.5));
    EXPECT_EQ(cloud->positions[1], double3(4500001.375, -700000, 12));
    EXPECT_NEAR(cloud->colors[0].z, 0.5029f, 1e-4f) << "188 of sRGB";
    std::filesystem::remove(path);
    EXPECT_NE(loadPointCloud(path).error().message.find("points-test.ply"), std::string::npos);
}

} // namespace
} // namespace filament_core
