// SPDX-License-Identifier: Apache-2.0
// What the CPU draws of occluders, beside the rays of each pixel in double precision, and which boxes it hides.
#include "filament_core/prepare/OcclusionBuffer.h"

#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr uint2 kOcclusionSize{ 203, 117 }; // no whole tiles

const std::vector<float3> kSquare{ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }; // faces +z
const std::vector<uint32_t> kSquareIndices{ 0, 1, 2, 0, 2, 3 };

std::vector<float3> boxPositions() {
    std::vector<float3> positions;
    for (int i = 0; i < 8; ++i) positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return positions;
}
const std::vector<uint32_t> kBoxIndices{ 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };

double4x4 placedAt(double3 at, double3 scale) { return glm::scale(glm::translate(double4x4(1), at), scale); }

struct OcclusionBufferTest : testing::Test {
    OcclusionBufferTest()
            : jobs({ .workers = 0 }),
              clipFromWorld(Camera().clipFromView(float(kOcclusionSize.x) / float(kOcclusionSize.y))) {}

    OcclusionBuffer draw(std::vector<std::pair<Occluder, double4x4>> const& objects,
                         DrawnFaces faces = DrawnFaces::Front) {
        std::vector<PlacedOccluder> placed;
        for (auto const& [occluder, world] : objects)
            placed.push_back({ occluder.get(), double4x4(clipFromWorld) * world, faces,
                               glm::determinant(double3x3(world)) < 0 });
        return OcclusionBuffer(jobs, arena, kOcclusionSize, placed);
    }

    bool hides(OcclusionBuffer const& buffer, float3 center, float3 halfExtent) const {
        return buffer.hides(clipFromWorld, center, halfExtent);
    }

    jobs::JobSystem jobs;
    Arena arena;
    float4x4 clipFromWorld;
};

TEST_F(OcclusionBufferTest, AWallHidesWhatIsBehindAllOfIt) {
    const Occluder square = makeOccluder(kSquare, kSquareIndices);
    ASSERT_TRUE(square);
    const OcclusionBuffer wall = draw({ { square, placedAt({ 0, 0, -10 }, double3(2)) } });
    EXPECT_TRUE(hides(wall, { 0, 0, -15 }, float3(1)));
    EXPECT_TRUE(hides(wall, { 0, 0, -10.6f }, float3(0.5f))) << "close behind";
    EXPECT_FALSE(hides(wall, { 0, 0, -10.4f }, float3(0.5f))) << "through the wall";
    EXPECT_FALSE(hides(wall, { 0, 0, -10 }, { 2, 2, 0 })) << "the wall itself";
    EXPECT_FALSE(hides(wall, { 0, 0, -8 }, float3(1))) << "in front";
    EXPECT_FALSE(hides(wall, { 2, 0, -15 }, float3(1.2f))) << "beside";
    EXPECT_FALSE(hides(wall, { 0, 0, -15 }, { 0.1f, 9, 0.1f })) << "above and below";
    EXPECT_FALSE(hides(wall, { 0, 0, 5 }, float3(20))) << "around the camera";
    EXPECT_FALSE(hides(wall, { NAN, 0, -15 }, float3(1)));
    EXPECT_FALSE(hides(wall, { 0, 0, -15 }, float3(INFINITY)));
    EXPECT_FALSE(hides(wall, { 500, 0, -15 }, float3(1))) << "out of view: nothing says that it is hidden";
}

TEST_F(OcclusionBufferTest, FacesThatAreNotDrawnHideNothing) {
    const Occluder square = makeOccluder(kSquare, kSquareIndices);
    const double4x4 front = placedAt({ 0, 0, -10 }, double3(4)), mirrored = placedAt({ 0, 0, -10 }, { -4, 4, 4 });
    const double4x4 back = glm::rotate(front, 3.14159265, double3(0, 1, 0));
    const auto isHidden = [&](double4x4 const& world, DrawnFaces faces) {
        return hides(draw({ { square, world } }, faces), { 0, 0, -15 }, float3(1));
    };
    EXPECT_TRUE(isHidden(front, DrawnFaces::Front));
    EXPECT_TRUE(isHidden(mirrored, DrawnFaces::Front)) << "a device counts the faces of a mirror in its object";
    EXPECT_FALSE(isHidden(back, DrawnFaces::Front));
    EXPECT_TRUE(isHidden(back, DrawnFaces::Back));
    EXPECT_FALSE(isHidden(front, DrawnFaces::Back));
    EXPECT_TRUE(isHidden(front, DrawnFaces::All) && isHidden(back, DrawnFaces::All));
}

TEST_F(OcclusionBufferTest, WallsThatMeetHideTogetherUpToTheirSeam) {
    const Occluder square = makeOccluder(kSquare, kSquareIndices);
    const OcclusionBuffer walls = draw(
            { { square, placedAt({ -3, 0, -10 }, double3(3)) }, { square, placedAt({ 3.001, 0, -9.9 }, double3(3)) } });
    EXPECT_TRUE(hides(walls, { -2, 0, -14 }, float3(1)));
    EXPECT_TRUE(hides(walls, { 2.5f, 0, -14 }, float3(1)));
    const OcclusionBuffer apart = draw(
            { { square, placedAt({ -3.3, 0, -10 }, double3(3)) }, { square, placedAt({ 3.3, 0, -10 }, double3(3)) } });
    EXPECT_FALSE(hides(apart, { 0, 0, -14 }, float3(1))) << "a gap of several pixels";
}

TEST_F(OcclusionBufferTest, TheNearPlaneCutsWallsBesideTheCamera) {
    const Occluder square = makeOccluder(kSquare, kSquareIndices);
    const double4x4 beside = glm::rotate(placedAt({ 1, 0, 0 }, double3(40)), -1.5707963, double3(0, 1, 0));
    EXPECT_TRUE(hides(draw({ { square, beside } }), { 6, 0, -12 }, float3(1)));
    EXPECT_FALSE(hides(draw({ { square, beside } }), { 0, 0, -12 }, float3(1)));
}

/// The nearest depth of the triangles at the middle of a pixel, in double precision; 0: none. `safe`: pixels to every
/// edge.
struct Exact {
    double depth = 0, nearestEdge = 1e9;
};

Exact exactAt(OccluderMesh const& mesh, double4x4 const& clipFromObject, double2 pixel) {
    Exact exact;
    for (OccluderMesh::Triangle const& triangle : mesh.triangles) {
        std::array<double2, 3> at;
        std::array<double, 3> z;
        for (size_t i = 0; i < 3; ++i) {
            const double4 clip = clipFromObject * double4(double3(mesh.positions[triangle.corners[i]]), 1);
            at[i] = (double2(clip) / clip.w * 0.5 + 0.5) * double2(kOcclusionSize);
            z[i] = clip.z / clip.w;
        }
        const auto cross = [](double2 a, double2 b) { return a.x * b.y - a.y * b.x; };
        const double area = cross(at[1] - at[0], at[2] - at[0]);
        if (area >= 0) continue; // a back
        std::array<double, 3> weight;
        bool isInside = true;
        for (size_t i = 0; i < 3; ++i) {
            const double2 edge = at[(i + 2) % 3] - at[(i + 1) % 3];
            weight[i] = cross(edge, pixel - at[(i + 1) % 3]) / area;
            isInside = isInside && weight[i] >= 0;
            exact.nearestEdge = std::min(exact.nearestEdge, std::abs(weight[i] * area) / glm::length(edge));
        }
        if (isInside) exact.depth = std::max(exact.depth, weight[0] * z[0] + weight[1] * z[1] + weight[2] * z[2]);
    }
    return exact;
}

TEST_F(OcclusionBufferTest, CoversWhatRaysHitAndIsNeverNearer) {
    const Occluder box = makeOccluder(boxPositions(), kBoxIndices);
    ASSERT_EQ(box->triangles.size(), 12);
    Random random(7);
    int covered = 0, clear = 0;
    for (int i = 0; i < 30; ++i) {
        double4x4 world = placedAt({ random.within(-3, 3), random.within(-2, 2), random.within(-20, -7) },
                                   { random.within(0.2, 3), random.within(0.2, 3), random.within(0.2, 3) });
        world = glm::rotate(world, random.within(0, 6), glm::normalize(double3(random.within(-1, 1), 0.5, 0.3)));
        const OcclusionBuffer buffer = draw({ { box, world } });
        for (uint32_t y = 0; y < kOcclusionSize.y; ++y) {
            for (uint32_t x = 0; x < kOcclusionSize.x; ++x) {
                const Exact exact = exactAt(*box, double4x4(clipFromWorld) * world, double2(x, y) + 0.5);
                const double found = static_cast<double>(buffer.depthAt({ x, y }));
                ASSERT_LE(found, exact.depth) << i << ": " << x << ' ' << y;
                if (exact.depth > 0 && exact.nearestEdge > 0.05) {
                    ASSERT_GT(found, exact.depth * 0.98) << i << ": " << x << ' ' << y;
                    ++covered;
                }
                clear += exact.depth == 0;
            }
        }
    }
    EXPECT_GT(covered, 5000);
    EXPECT_GT(clear, 5000);
}

TEST_F(OcclusionBufferTest, InnerEdgesHaveNoHoles) {
    std::vector<float3> positions;
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y <= 10; ++y)
        for (uint32_t x = 0; x <= 10; ++x)
            positions.emplace_back(float(x) / 5 - 1, float(y) / 5 - 1, 0.1f * std::sin(float(x * 5 + y * 3)));
    for (uint32_t i = 0; i < 110; ++i) {
        if (i % 11 == 10) continue;
        for (const uint32_t corner : { i, i + 1, i + 12, i, i + 12, i + 11 }) indices.push_back(corner);
    }
    const Occluder sheet = makeOccluder(positions, indices);
    const OcclusionBuffer buffer = draw({ { sheet, placedAt({ 0, 0, -5 }, { 5, 5, 1 }) } });
    for (uint32_t y = 0; y < kOcclusionSize.y; ++y)
        for (uint32_t x = 0; x < kOcclusionSize.x; ++x) ASSERT_GT(buffer.depthAt({ x, y }), 0) << x << ' ' << y;
}

/// A level edge that is open loses a margin, and the quotient of what is left and the tilt is larger than any integer.
TEST_F(OcclusionBufferTest, NearlyLevelEdgesStayInTheirRows) {
    const Occluder square = makeOccluder(kSquare, kSquareIndices);
    for (const double tilt : { 1e-7, 1e-10, 1e-13, -1e-7, -1e-10, -1e-13 }) {
        for (int i = 0; i < 400; ++i) {
            const double4x4 world = placedAt({ 0, 0.002 * i, -10 }, double3(2));
            const OcclusionBuffer wall =
                    draw({ { square, glm::rotate(world, tilt, double3(0, 0, 1)) } }, DrawnFaces::All);
            for (uint32_t y = 0; y < kOcclusionSize.y; ++y) ASSERT_EQ(wall.depthAt({ 0, y }), 0) << tilt << ' ' << i;
        }
    }
}

TEST_F(OcclusionBufferTest, WorkersDoNotChangeABit) {
    const Occluder box = makeOccluder(boxPositions(), kBoxIndices);
    Random random(3);
    std::vector<PlacedOccluder> placed;
    for (int i = 0; i < 100; ++i)
        placed.push_back(
                { .mesh = box.get(),
                  .clipFromObject = double4x4(clipFromWorld) *
                                    placedAt({ random.within(-9, 9), random.within(-6, 6), random.within(-30, 0) },
                                             double3(random.within(0.2, 3))) });
    const OcclusionBuffer alone(jobs, arena, kOcclusionSize, placed);
    for (const int workers : { 1, 2, 7 }) {
        jobs::JobSystem many({ .workers = workers });
        const OcclusionBuffer buffer(many, arena, kOcclusionSize, placed);
        for (uint32_t y = 0; y < kOcclusionSize.y; ++y)
            for (uint32_t x = 0; x < kOcclusionSize.x; ++x)
                ASSERT_EQ(buffer.depthAt({ x, y }), alone.depthAt({ x, y }));
    }
}

TEST(Occluder, IsMadeOfTheLargestTriangles) {
    EXPECT_FALSE(makeOccluder({}, {}));
    EXPECT_FALSE(makeOccluder(kSquare, std::vector<uint32_t>{ 0, 0, 1 })) << "no area";
    EXPECT_FALSE(makeOccluder(kSquare, kSquareIndices, 0));
    const Occluder half = makeOccluder(kSquare, kSquareIndices, 1);
    ASSERT_TRUE(half);
    EXPECT_EQ(half->triangles[0].neighbors, (std::array<uint16_t, 3>{ 0xFFFF, 0xFFFF, 0xFFFF }))
            << "the other is left out";
    const Occluder whole = makeOccluder(kSquare, kSquareIndices);
    EXPECT_EQ(whole->positions.size(), 4);
    EXPECT_EQ(whole->triangles[0].neighbors[2], 1);
    EXPECT_EQ(whole->triangles[1].neighbors[0], 0);
    EXPECT_FALSE(makeOccluder(boxPositions(), kBoxIndices, 5)) << "less than half of the area";
    std::vector<float3> broken = kSquare;
    broken[3].x = NAN;
    EXPECT_EQ(makeOccluder(broken, kSquareIndices)->triangles.size(), 1);
    const std::vector<uint32_t> thrice{ 0, 1, 2, 0, 2, 3, 0, 2, 1 };
    const Occluder shared = makeOccluder(kSquare, thrice);
    for (OccluderMesh::Triangle const& triangle : shared->triangles)
        for (const uint16_t neighbor : triangle.neighbors) EXPECT_TRUE(neighbor == OccluderMesh::kNone || neighbor < 3);
}

} // namespace
} // namespace filament_core::prepare
