// SPDX-License-Identifier: Apache-2.0
// samples/feature_edges/edges.mat: the ink across the edges of a cube against the lines that they are by projection,
// and no ink inside of what is flat or smooth. The same bits on both APIs.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace filament_core {
namespace {

using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr uint32_t kSide = 160;
constexpr double kLens = 2.41421356237309505; // 1 / tan(45 / 2 degrees)

std::string edgesText() {
    std::ifstream file(tools::sourceDir() / "samples/feature_edges/edges.mat");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

struct LineLook {
    float width = 1.5f;
    bool labels = false; ///< instead of surfaces: 0 and 1 in the left and the right half of the picture
    float selected = 0;
};

/// The mesh 4 m before the camera; with black lines if `look` is not null.
Image drawnMesh(Mesh const& mesh, double4x4 const& world, LineLook const* look) {
    return onBothApis([&](MaterialStage& stage) {
        const Result<Material> lit = createBuiltInMaterial(stage.engine, "lit");
        ASSERT_TRUE(lit);
        const MaterialInstance clay = stage.keep(*lit);
        EXPECT_TRUE(stage.engine.set(clay, "emissive", float3(1e4f)));
        auto vertices =
                std::make_shared<Owned<VertexBuffer>>(stage.engine.own(stage.engine.create(mesh.vertexBuffer())));
        auto indices = std::make_shared<Owned<IndexBuffer>>(stage.engine.own(stage.engine.create(mesh.indexBuffer())));
        stage.keep(vertices);
        stage.keep(indices);
        stage.scene.add({ .vertices = *vertices, .indices = *indices, .material = clay, .worldFromObject = world });
        stage.view.size = { kSide, kSide };
        stage.view.clearColor = float4(1);
        if (!look) return;
        const MaterialInstance lines = stage.material(edgesText(), 0);
        const std::array<uint8_t, 8> halves{ 0, 0, 0, 255, 255, 0, 0, 255 };
        const Texture labels = stage.own(stage.engine.create(
                TextureDesc{ .width = 2, .height = 1, .pixels = std::as_bytes(std::span(halves)), .name = "labels" }));
        EXPECT_TRUE(stage.engine.set(lines, "labels", labels, kUnfilteredSampler));
        EXPECT_TRUE(stage.engine.set(lines, "labelChannels", float4(look->labels ? 1 : 0, 0, 0, 0)));
        EXPECT_TRUE(stage.engine.set(lines, "surfaces", look->labels ? 0.0f : 1.0f));
        EXPECT_TRUE(stage.engine.set(lines, "front", labels));
        EXPECT_TRUE(stage.engine.set(lines, "hidden", 1.0f));
        EXPECT_TRUE(stage.engine.set(lines, "selected", look->selected));
        EXPECT_TRUE(stage.engine.set(lines, "crease", std::cos(0.61f)));
        EXPECT_TRUE(stage.engine.set(lines, "width", look->width));
        EXPECT_TRUE(stage.engine.set(lines, "ink", float4(0, 0, 0, 1)));
        auto passes = std::make_shared<std::vector<PostProcessPass>>(
                1, PostProcessPass{ lines, PassPlace::AfterToneMapping });
        stage.keep(passes);
        stage.view.postProcess = *passes;
    });
}

/// How much of each pixel is covered by lines, [0, 1].
class Ink {
public:
    Ink(Mesh const& mesh, double4x4 const& world, LineLook const& look)
            : mPlain(drawnMesh(mesh, world, nullptr)), mLined(drawnMesh(mesh, world, &look)) {}

    double of(uint32_t x, uint32_t y) const {
        return 1 - double{ halfPixel(mLined, x, y).x } / double{ halfPixel(mPlain, x, y).x };
    }
    /// Between pixels, of the four around.
    double at(double2 place) const {
        const auto pixel = [&](double x, double y) {
            const auto clamped = [](double v) { return static_cast<uint32_t>(glm::clamp(v, 0.0, kSide - 1.0)); };
            return of(clamped(x), clamped(y));
        };
        const double2 low = glm::floor(place - 0.5), part = place - 0.5 - low;
        return glm::mix(glm::mix(pixel(low.x, low.y), pixel(low.x + 1, low.y), part.x),
                        glm::mix(pixel(low.x, low.y + 1), pixel(low.x + 1, low.y + 1), part.x), part.y);
    }

private:
    Image mPlain, mLined;
};

double2 projected(double3 point) {
    const double distance = 4.0 - point.z; // the camera is at z = 4 and looks down -z
    return (double2(point.x, -point.y) * kLens / distance + 1.0) * 0.5 * double{ kSide };
}

struct Profile {
    double width = 0; ///< the integral of the ink across
    double peak = 0;
};

Profile profileAt(Ink const& ink, double2 place, double2 across) {
    constexpr double kStep = 0.125, kReach = 6; // pixels
    Profile profile;
    for (double t = -kReach; t < kReach; t += kStep) {
        const double here = ink.at(place + across * t);
        profile.width += here * kStep;
        profile.peak = std::max(profile.peak, here);
    }
    return profile;
}

/// Of a cube of 1 m, turned by this: its edges that border on a face towards the camera.
std::vector<std::array<double3, 2>> visibleEdges(double4x4 const& world) {
    std::vector<std::array<double3, 2>> edges;
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
            double3 begin(0), first(0), second(0);
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            begin[u] = first[u] = (corner & 1) != 0 ? 0.5 : -0.5;
            begin[v] = second[v] = (corner & 2) != 0 ? 0.5 : -0.5;
            const auto faces = [&](double3 middle) { // the face with this middle, whose normal is twice that
                const double3 normal = glm::dmat3(world) * middle, at = double3(world * double4(middle, 1));
                return glm::dot(normal, double3(0, 0, 4) - at) > 0.02;
            };
            if (!faces(first) && !faces(second)) continue;
            double3 end = begin;
            begin[axis] = -0.5, end[axis] = 0.5;
            edges.push_back({ double3(world * double4(begin, 1)), double3(world * double4(end, 1)) });
        }
    }
    return edges;
}

TEST(FeatureEdges, OfACubeHaveTheirWidthAllAlong) {
    const Result<Mesh> cube = makeBox();
    ASSERT_TRUE(cube);
    for (const float width : { 1.5f, 3.0f }) {
        const double4x4 tilted = glm::rotate(double4x4(1), 0.5, double3(1, 0, 0));
        const double4x4 turned = glm::scale(glm::rotate(tilted, 0.7, double3(0, 1, 0)), double3(1.3));
        const Ink ink(*cube, turned, { .width = width });
        const auto edges = visibleEdges(turned);
        EXPECT_EQ(edges.size(), 9u);
        double sum = 0, count = 0, least = 9, most = 0, peak = 1;
        for (auto const& [begin, end] : edges) {
            const double2 from = projected(begin), along = projected(end) - from;
            const double2 across = glm::normalize(double2(-along.y, along.x));
            for (double t = 0.2; t <= 0.8; t += 0.02) {
                const Profile profile = profileAt(ink, from + along * t, across);
                sum += profile.width, ++count;
                least = std::min(least, profile.width), most = std::max(most, profile.width);
                peak = std::min(peak, profile.peak);
            }
        }
        EXPECT_NEAR(sum / count, width, 0.15);
        EXPECT_GT(least, width - 0.45);
        EXPECT_LT(most, width + 0.45);
        EXPECT_GT(peak, 0.7) << "no gaps";
        std::printf("width %.1f: mean %.3f, from %.3f to %.3f, least peak %.3f\n", double{ width }, sum / count, least,
                    most, peak);
    }
}

TEST(FeatureEdges, OfASphereAreItsOutlineAlone) {
    const Result<Mesh> sphere = makeUvSphere({ .radius = 0.9f });
    ASSERT_TRUE(sphere);
    const Ink ink(*sphere, double4x4(1), { .width = 2 });
    // Tangents from the camera touch where sin = radius / distance.
    const double radius = 0.5 * kSide * kLens * std::tan(std::asin(0.9 / 4));
    double inside = 0;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x)
            if (glm::length(double2(x, y) + 0.5 - 0.5 * kSide) < radius - 3) inside = std::max(inside, ink.of(x, y));
    EXPECT_EQ(inside, 0);
    double sum = 0;
    for (int i = 0; i < 360; ++i) {
        const double2 out(std::cos(i * 0.0174532925), std::sin(i * 0.0174532925));
        const Profile profile = profileAt(ink, 0.5 * kSide + out * radius, out);
        EXPECT_GT(profile.peak, 0.7) << i << " degrees";
        sum += profile.width / 360;
    }
    EXPECT_NEAR(sum, 2, 0.2);
}

TEST(FeatureEdges, OfAGroundInPerspectiveAreItsOwnAlone) {
    const Result<Mesh> plane = makePlane({ .width = 40, .depth = 40, .widthSegments = 8, .depthSegments = 8 });
    ASSERT_TRUE(plane);
    const Ink ink(*plane, glm::translate(double4x4(1), double3(0, -0.5, 0)), {});
    const auto horizon = static_cast<uint32_t>(projected({ 0, -0.5, -20 }).y);
    double most = 0;
    for (uint32_t y = horizon + 4; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) most = std::max(most, ink.of(x, y));
    EXPECT_EQ(most, 0);
    EXPECT_GT(profileAt(ink, double2(0.5 * kSide, projected({ 0, -0.5, -20 }).y), { 0, 1 }).peak, 0.7);
}

TEST(FeatureEdges, OfLabelsAreWhereTheseDiffer) {
    const Result<Mesh> cube = makeBox();
    ASSERT_TRUE(cube);
    const Ink ink(*cube, double4x4(1), { .width = 3, .labels = true });
    const Ink selected(*cube, double4x4(1), { .width = 3, .labels = true, .selected = 1 });
    const Ink none(*cube, double4x4(1), { .width = 3, .labels = true, .selected = 2 });
    for (uint32_t y = 0; y < kSide; ++y) {
        EXPECT_NEAR(profileAt(ink, { 0.5 * kSide, y + 0.5 }, { 1, 0 }).width, 3, 0.35);
        EXPECT_EQ(ink.of(kSide / 4, y), 0);
        EXPECT_EQ(selected.of(kSide / 2, y), ink.of(kSide / 2, y)) << "one against all others";
        EXPECT_EQ(none.of(kSide / 2, y), 0);
    }
}

} // namespace
} // namespace filament_core
