// SPDX-License-Identifier: Apache-2.0
// Every shape against its closed forms: closed surfaces by the divergence theorem, normals and tangents by the formula
// of the surface; and hostile shapes.
#include <filament_core/Primitives.h>

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>

namespace filament_core::test {
namespace {

using testing::HasSubstr;
constexpr double kRadians = std::numbers::pi; ///< of half a turn

Mesh meshOf(Result<Mesh> made) {
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : Mesh{};
}

/// Numbers of places: vertices with the same bits of position have the same.
std::vector<uint32_t> placesOf(Mesh const& mesh) {
    std::map<std::array<float, 3>, uint32_t> known; // -0 and 0 are equal keys
    std::vector<uint32_t> places;
    for (MeshVertex const& vertex : mesh.vertices) {
        const std::array<float, 3> key{ vertex.position.x, vertex.position.y, vertex.position.z };
        places.push_back(known.try_emplace(key, static_cast<uint32_t>(known.size())).first->second);
    }
    return places;
}

struct Measure {
    double area = 0, volume = 0;
};

/// Volume: a third of the flux of the position (Gauss). Negative if the surface is inside out.
Measure measured(Mesh const& mesh) {
    Measure sum;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](size_t corner) { return double3(mesh.vertices[mesh.indices[i + corner]].position); };
        const double3 normal = glm::cross(at(1) - at(0), at(2) - at(0)) * 0.5;
        sum.area += glm::length(normal);
        sum.volume += glm::dot(at(0), normal) / 3;
    }
    return sum;
}

/// A closed surface uses every edge once in each direction. Returns V - E + F: 2 of a ball, 0 of a ring.
int64_t eulerOfClosed(Mesh const& mesh) {
    const std::vector<uint32_t> places = placesOf(mesh);
    std::set<std::pair<uint32_t, uint32_t>> edges;
    std::set<uint32_t> used;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t from = places[mesh.indices[i]], to = places[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
        EXPECT_NE(from, to) << "a triangle without area";
        EXPECT_TRUE(edges.insert({ from, to }).second) << "an edge that two triangles use in the same direction";
        used.insert(from);
    }
    for (auto const& [from, to] : edges) EXPECT_TRUE(edges.contains({ to, from })) << "a hole";
    return static_cast<int64_t>(used.size()) - static_cast<int64_t>(edges.size() / 2) +
           static_cast<int64_t>(mesh.indices.size() / 3);
}

/// A shape of which finer and finer meshes can be made.
struct Shape {
    const char* name;
    std::function<Result<Mesh>(uint32_t level)> make; ///< level n has about 2^n times as many segments as level 0
    double area, volume;
    std::function<double3(double3)> normal; ///< of the surface at a point that is not on a sharp edge; {}: none
    int64_t euler = 2;
    float mostU = 1;
};

void PrintTo(Shape const& shape, std::ostream* out) { *out << shape.name; }

double3 awayFromAxis(double3 p) { return glm::normalize(double3(p.x, 0, p.z)); }

std::vector<Shape> closedShapes() {
    constexpr double r = 0.7, h = 1.9, t = 0.4;
    constexpr auto R = static_cast<float>(r), H = static_cast<float>(h), T = static_cast<float>(t);
    const double slant = std::hypot(r, h), cut = std::hypot(r - t, h);
    std::vector<Shape> shapes;
    shapes.push_back({ "Box",
                       [=](uint32_t n) {
                           return makeBox({ { R, H, T }, { 1 + n, 2 + n, 3 } });
                       },
                       2 * (r * h + h * t + t * r),
                       r * h * t,
                       {} });
    shapes.push_back({ "UvSphere",
                       [=](uint32_t n) {
                           return makeUvSphere({ R, 12u << n, 6u << n });
                       },
                       4 * kRadians * r * r, 4 * kRadians / 3 * r * r * r,
                       [](double3 p) { return glm::normalize(p); } });
    shapes.push_back({ "IcoSphere",
                       [=](uint32_t n) {
                           return makeIcoSphere({ R, 1 + n });
                       },
                       4 * kRadians * r * r, 4 * kRadians / 3 * r * r * r, [](double3 p) { return glm::normalize(p); },
                       2, 1.5f });
    shapes.push_back({ "Cylinder",
                       [=](uint32_t n) {
                           return makeCylinder({ R, H, 12u << n, 3 });
                       },
                       2 * kRadians * r * (r + h),
                       kRadians * r * r * h,
                       {} });
    shapes.push_back({ "Cone",
                       [=](uint32_t n) {
                           return makeCone({ R, H, 0, 12u << n, 4 });
                       },
                       kRadians * r * (r + slant),
                       kRadians * r * r * h / 3,
                       {} });
    shapes.push_back({ "CutCone",
                       [=](uint32_t n) {
                           return makeCone({ R, H, T, 12u << n, 4 });
                       },
                       kRadians * (r * r + t * t + (r + t) * cut),
                       kRadians * h / 3 * (r * r + r * t + t * t),
                       {} });
    shapes.push_back({ "Capsule",
                       [=](uint32_t n) {
                           return makeCapsule({ T, H, 12u << n, 3u << n, 2 });
                       },
                       2 * kRadians * t * h + 4 * kRadians * t * t, kRadians * t * t * h + 4 * kRadians / 3 * t * t * t,
                       [](double3 p) { return glm::normalize(p - double3(0, std::clamp(p.y, -h / 2, h / 2), 0)); } });
    shapes.push_back({ "Torus",
                       [=](uint32_t n) {
                           return makeTorus({ R, T, 12u << n, 8u << n });
                       },
                       4 * kRadians * kRadians * r * t, 2 * kRadians * kRadians * r * t * t,
                       [](double3 p) { return glm::normalize(p - awayFromAxis(p) * double(r)); }, 0 });
    return shapes;
}

class ClosedShapes : public testing::TestWithParam<Shape> {};

TEST_P(ClosedShapes, HaveEveryEdgeTwiceAndFaceOutwards) {
    for (uint32_t level = 0; level < 3; ++level) {
        const Mesh mesh = meshOf(GetParam().make(level));
        EXPECT_EQ(eulerOfClosed(mesh), GetParam().euler);
        EXPECT_GT(measured(mesh).volume, 0);
    }
}

TEST_P(ClosedShapes, ConvergeToTheAreaAndTheVolumeOfTheShape) {
    Shape const& shape = GetParam();
    const auto errors = [&](uint32_t level) {
        const Measure found = measured(meshOf(shape.make(level)));
        return Measure{ 1 - found.area / shape.area, 1 - found.volume / shape.volume };
    };
    const Measure coarse = errors(2), fine = errors(3);
    if (std::string_view(shape.name) == "Box") {
        EXPECT_NEAR(coarse.area, 0, 1e-7);
        EXPECT_NEAR(coarse.volume, 0, 1e-7);
        return;
    }
    EXPECT_NEAR(coarse.area / fine.area, 4, 0.15) << "half the step, a quarter of the error";
    EXPECT_NEAR(coarse.volume / fine.volume, 4, 0.15);
    EXPECT_LT(std::abs(fine.area), 0.003);
    EXPECT_LT(std::abs(fine.volume), 0.005);
}

TEST_P(ClosedShapes, HaveUnitNormalsAndFramesAtRightAngles) {
    const Mesh mesh = meshOf(GetParam().make(1));
    for (MeshVertex const& vertex : mesh.vertices) {
        EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-6);
        EXPECT_NEAR(glm::length(vertex.tangents), 1, 1e-6);
        const TangentFrame frame = frameOf(vertex.tangents);
        // |w| >= 1 / 32767 turns a frame by at most 2 / 32767.
        EXPECT_NEAR(glm::length(frame.normal - vertex.normal), 0, 7e-5);
        EXPECT_NEAR(glm::dot(frame.normal, frame.tangent), 0, 1e-6);
        EXPECT_NEAR(glm::length(frame.bitangent - glm::cross(frame.normal, frame.tangent)), 0, 1e-6) << "not mirrored";
        EXPECT_EQ(vertex.color, float4(1));
    }
}

TEST_P(ClosedShapes, HaveTheNormalsOfTheSurface) {
    const Mesh mesh = meshOf(GetParam().make(2));
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<MeshVertex, 3> corners;
        for (size_t c = 0; c < 3; ++c) corners[c] = mesh.vertices[mesh.indices[i + c]];
        const double3 face = glm::normalize(glm::cross(double3(corners[1].position - corners[0].position),
                                                       double3(corners[2].position - corners[0].position)));
        for (MeshVertex const& vertex : corners) {
            EXPECT_GT(glm::dot(face, double3(vertex.normal)), 0.96) << "within 16 degrees of the triangle";
            if (GetParam().normal) {
                EXPECT_NEAR(glm::length(GetParam().normal(double3(vertex.position)) - double3(vertex.normal)), 0, 1e-6);
            }
        }
    }
}

/// Derivatives of the position over a triangle.
struct Gradients {
    double3 byU{ 0 }, byV{ 0 };
    double area = 0; ///< in the texture, with its sign
};

Gradients gradientsOf(Mesh const& mesh, size_t first) {
    std::array<double3, 3> p;
    std::array<double2, 3> t;
    for (size_t c = 0; c < 3; ++c) {
        MeshVertex const& vertex = mesh.vertices[mesh.indices[first + c]];
        p[c] = vertex.position, t[c] = vertex.uv;
    }
    const double2 a = t[1] - t[0], b = t[2] - t[0];
    const double area = a.x * b.y - a.y * b.x;
    return { ((p[1] - p[0]) * b.y - (p[2] - p[0]) * a.y) / area, ((p[2] - p[0]) * a.x - (p[1] - p[0]) * b.x) / area,
             area };
}

TEST_P(ClosedShapes, HaveUprightTexturesWithTangentsAlongU) {
    const Mesh mesh = meshOf(GetParam().make(2));
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Gradients gradients = gradientsOf(mesh, i);
        ASSERT_GT(gradients.area, 0) << "no triangle is mirrored in the texture";
        for (size_t c = 0; c < 3; ++c) {
            MeshVertex const& vertex = mesh.vertices[mesh.indices[i + c]];
            EXPECT_GE(std::min(vertex.uv.x, vertex.uv.y), 0);
            EXPECT_LE(vertex.uv.x, GetParam().mostU);
            EXPECT_LE(vertex.uv.y, 1);
            const TangentFrame frame = frameOf(vertex.tangents);
            if (GetParam().mostU > 1) continue; // an icosahedron's triangles at the poles are large: below
            EXPECT_GT(glm::dot(glm::normalize(gradients.byU), double3(frame.tangent)), 0.9);
            EXPECT_GT(glm::dot(glm::normalize(gradients.byV), double3(frame.bitangent)), 0.7);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, ClosedShapes, testing::ValuesIn(closedShapes()),
                         [](auto const& each) { return each.param.name; });

TEST(Primitives, OfEverySmallNumberOfSegmentsAreClosed) {
    for (uint32_t slices = 3; slices <= 9; ++slices) {
        for (uint32_t stacks = 1; stacks <= 4; ++stacks) {
            EXPECT_EQ(eulerOfClosed(meshOf(makeUvSphere({ 1, slices, stacks + 1 }))), 2);
            EXPECT_EQ(eulerOfClosed(meshOf(makeCylinder({ 1, 2, slices, stacks }))), 2);
            EXPECT_EQ(eulerOfClosed(meshOf(makeCone({ 1, 2, 0, slices, stacks }))), 2);
            EXPECT_EQ(eulerOfClosed(meshOf(makeCone({ 1, 2, 3, slices, stacks }))), 2);
            EXPECT_EQ(eulerOfClosed(meshOf(makeCapsule({ 1, 2, slices, stacks, 1 + slices % 3 }))), 2);
            EXPECT_EQ(eulerOfClosed(meshOf(makeTorus({ 1, 0.5f, slices, stacks + 2 }))), 0);
            EXPECT_EQ(eulerOfClosed(meshOf(makeBox({ float3(1), { slices, stacks, 2 } }))), 2);
        }
    }
    for (uint32_t i = 0; i <= 4; ++i) EXPECT_EQ(eulerOfClosed(meshOf(makeIcoSphere({ 1, i }))), 2);
}

TEST(Primitives, OfAnySizeAreClosedAndFaceOutwards) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> exponent(-15, 15), share(0.01f, 0.99f);
    for (int i = 0; i < 200; ++i) {
        const float size = std::clamp(std::pow(10.0f, exponent(random)), 1e-15f, 1e15f),
                    part = std::max(size * share(random), 1e-15f);
        for (Result<Mesh> const& made :
             { makeUvSphere({ size, 7, 5 }), makeIcoSphere({ size, 1 }), makeBox({ { size, part, size } }),
               makeCapsule({ part, size, 5, 2, 1 }), makeCylinder({ size, part, 5, 2 }) }) {
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_EQ(eulerOfClosed(*made), 2) << size;
            EXPECT_GT(measured(*made).volume, 0) << size;
        }
    }
}

TEST(Primitives, ShowPicturesUprightFromTheirFronts) {
    struct Case {
        Mesh mesh;
        float3 normal, right, up;
    };
    const Mesh box = meshOf(makeBox({}));
    const Case cases[] = {
        { meshOf(makePlane({ 2, 2, 3, 4 })), { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
        { box, { 1, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 } },
        { box, { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },
        { box, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } },
        { box, { 0, 0, -1 }, { -1, 0, 0 }, { 0, 1, 0 } },
        { box, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
        { box, { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
        { meshOf(makeCylinder({ 1, 1, 8, 1 })), { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
        { meshOf(makeCone({ 1, 1, 0, 8, 1 })), { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
    };
    for (Case const& c : cases) {
        size_t found = 0;
        for (MeshVertex const& vertex : c.mesh.vertices) {
            if (vertex.normal != c.normal) continue;
            ++found;
            const double side = 2 * std::max({ std::abs(c.mesh.bounds().min.x), c.mesh.bounds().max.x });
            EXPECT_NEAR(glm::dot(vertex.position, c.right) / side + 0.5f, vertex.uv.x, 1e-6);
            EXPECT_NEAR(glm::dot(vertex.position, c.up) / side + 0.5f, vertex.uv.y, 1e-6);
            EXPECT_NEAR(glm::length(frameOf(vertex.tangents).tangent - c.right), 0, 7e-5);
        }
        EXPECT_GE(found, 4u);
    }
}

TEST(Primitives, AroundAnAxisHaveTheMiddleOfTheirPictureAtPlusZ) {
    for (Mesh const& mesh : { meshOf(makeUvSphere({ 1, 8, 4 })), meshOf(makeIcoSphere({ 1, 2 })), meshOf(makeTorus({})),
                              meshOf(makeCapsule({})), meshOf(makeCylinder({ .caps = false })) }) {
        for (MeshVertex const& vertex : mesh.vertices) {
            if (glm::length(float2(vertex.position.x, vertex.position.z)) < 1e-6f) continue; // a pole has any u
            const double u = 0.5 + std::atan2(double(vertex.position.x), double(vertex.position.z)) / (2 * kRadians);
            const double turns = u - double(vertex.uv.x);
            EXPECT_NEAR(turns - std::round(turns), 0, 1e-6);
        }
    }
}

TEST(Primitives, WithoutCapsAreOpenOnlyAtTheirEnds) {
    const Mesh tube = meshOf(makeCylinder({ 1, 2, 16, 3, false }));
    EXPECT_EQ(tube.indices.size(), 3u * 2 * 16 * 3);
    for (MeshVertex const& vertex : tube.vertices) EXPECT_EQ(vertex.normal.y, 0);
    EXPECT_EQ(meshOf(makeCone({ 1, 2, 0, 16, 1, false })).indices.size(), 3u * 16);
}

TEST(Primitives, HaveTheNumbersOfVerticesThatTheirLimitsCount) {
    EXPECT_EQ(meshOf(makePlane({ 1, 1, 3, 5 })).vertices.size(), 4u * 6);
    EXPECT_EQ(meshOf(makeBox({})).vertices.size(), 24u);
    EXPECT_EQ(meshOf(makeUvSphere({ 1, 5, 4 })).vertices.size(), 5u * 2 + 6 * 3);
    const Mesh ico = meshOf(makeIcoSphere({ 1, 3 }));
    EXPECT_EQ(ico.indices.size(), 3u * 20 * 64);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
constexpr std::array kBadLengths{ 0.0f, -0.0f, -1.0f, kNan, kInfinity, -kInfinity, 1e-16f, 1e16f, 1e-45f };
constexpr std::array kBadCounts{ 0u, 65537u, 0x7FFFFFFFu, 0xFFFFFFFFu };

void expectRefused(Result<Mesh> const& made, std::string const& function, std::string const& field) {
    ASSERT_FALSE(made) << function << " " << field;
    EXPECT_EQ(made.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(made.error().message, testing::StartsWith(function + ": " + field));
    EXPECT_THAT(made.error().message, testing::Not(HasSubstr("\n")));
}

TEST(HostilePrimitives, WithLengthsOutOfRangeNameTheField) {
    for (const float bad : kBadLengths) {
        expectRefused(makePlane({ .width = bad }), "makePlane", "width is ");
        expectRefused(makePlane({ .depth = bad }), "makePlane", "depth is ");
        for (int axis = 0; axis < 3; ++axis) {
            float3 size(1);
            size[axis] = bad;
            expectRefused(makeBox({ .size = size }), "makeBox", std::string("size.") + "xyz"[axis] + " is ");
        }
        expectRefused(makeUvSphere({ .radius = bad }), "makeUvSphere", "radius is ");
        expectRefused(makeIcoSphere({ .radius = bad }), "makeIcoSphere", "radius is ");
        expectRefused(makeCylinder({ .radius = bad }), "makeCylinder", "radius is ");
        expectRefused(makeCylinder({ .height = bad }), "makeCylinder", "height is ");
        expectRefused(makeCone({ .radius = bad }), "makeCone", "radius is ");
        expectRefused(makeCone({ .height = bad }), "makeCone", "height is ");
        if (bad != 0) expectRefused(makeCone({ .topRadius = bad }), "makeCone", "topRadius is ");
        expectRefused(makeCapsule({ .radius = bad }), "makeCapsule", "radius is ");
        expectRefused(makeCapsule({ .height = bad }), "makeCapsule", "height is ");
        expectRefused(makeTorus({ .radius = bad }), "makeTorus", "radius is ");
        expectRefused(makeTorus({ .tubeRadius = bad }), "makeTorus", "tubeRadius is ");
    }
    expectRefused(makeTorus({ .radius = 1, .tubeRadius = 1 }), "makeTorus", "tubeRadius must be less than radius");
}

TEST(HostilePrimitives, WithCountsOutOfRangeNameTheField) {
    for (const uint32_t bad : kBadCounts) {
        expectRefused(makePlane({ .widthSegments = bad }), "makePlane", "widthSegments is ");
        expectRefused(makePlane({ .depthSegments = bad }), "makePlane", "depthSegments is ");
        for (int axis = 0; axis < 3; ++axis) {
            uint3 segments(1);
            segments[axis] = bad;
            expectRefused(makeBox({ .segments = segments }), "makeBox",
                          std::string("segments.") + "xyz"[axis] + " is ");
        }
        expectRefused(makeUvSphere({ .stacks = bad }), "makeUvSphere", "stacks is ");
        expectRefused(makeCylinder({ .stacks = bad }), "makeCylinder", "stacks is ");
        expectRefused(makeCone({ .stacks = bad }), "makeCone", "stacks is ");
        expectRefused(makeCapsule({ .capStacks = bad }), "makeCapsule", "capStacks is ");
        expectRefused(makeCapsule({ .sideStacks = bad }), "makeCapsule", "sideStacks is ");
        expectRefused(makeTorus({ .stacks = bad }), "makeTorus", "stacks is ");
        if (bad > 0) expectRefused(makeIcoSphere({ .subdivisions = bad }), "makeIcoSphere", "subdivisions is ");
        for (const uint32_t few : { bad, 1u, 2u }) {
            expectRefused(makeUvSphere({ .slices = few }), "makeUvSphere", "slices is ");
            expectRefused(makeCylinder({ .slices = few }), "makeCylinder", "slices is ");
            expectRefused(makeCone({ .slices = few }), "makeCone", "slices is ");
            expectRefused(makeCapsule({ .slices = few }), "makeCapsule", "slices is ");
            expectRefused(makeTorus({ .slices = few }), "makeTorus", "slices is ");
        }
    }
    expectRefused(makeIcoSphere({ .subdivisions = 9 }), "makeIcoSphere", "subdivisions is 9, and must be in [0, 8]");
    expectRefused(makeUvSphere({ .stacks = 1 }), "makeUvSphere", "stacks is 1, and must be in [2, 65536]");
}

TEST(HostilePrimitives, WithMoreVerticesThanTheLimitAreRefusedBeforeTheyTakeMemory) {
    constexpr uint32_t kMost = 65536;
    const std::string problem = "these segments give ";
    expectRefused(makePlane({ .widthSegments = kMost, .depthSegments = kMost }), "makePlane", problem);
    expectRefused(makeBox({ .segments = uint3(kMost) }), "makeBox", problem);
    expectRefused(makeUvSphere({ .slices = kMost, .stacks = kMost }), "makeUvSphere", problem);
    expectRefused(makeCylinder({ .slices = kMost, .stacks = kMost }), "makeCylinder", problem);
    expectRefused(makeCone({ .slices = kMost, .stacks = kMost }), "makeCone", problem);
    expectRefused(makeCapsule({ .slices = kMost, .capStacks = kMost, .sideStacks = kMost }), "makeCapsule", problem);
    expectRefused(makeTorus({ .slices = kMost, .stacks = kMost }), "makeTorus", problem);
}

} // namespace
} // namespace filament_core::test
