// SPDX-License-Identifier: Apache-2.0
// Shapes of <filament_core/Primitives.h>. Everything is computed in double precision and rounded once, so that points
// that meet have the same bits, and the last bit of a library's sine shows in no vertex.
#include "base/Result.h"
#include "base/math/Elementary.h"
#include "filament_core/assets/geometry/TangentFrame.h"

#include <filament_core/Primitives.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core {
namespace {

constexpr float kLeastLength = 1e-15f, kMostLength = 1e15f;
constexpr uint32_t kMostSegments = 65536;
constexpr uint64_t kMostVertices = uint64_t{ 1 } << 24;
constexpr double kHalfTurn = std::numbers::pi; ///< radians

/// Checks the fields of a shape and keeps the first error.
class Fields {
public:
    explicit Fields(std::string_view function) : mFunction(function) {}

    Fields& length(std::string_view field, float value) {
        if (!mError && !(value >= kLeastLength && value <= kMostLength))
            mError = fail(ErrorCode::InvalidArgument, "{}: {} is {}, and must be in [{}, {}]", mFunction, field, value,
                          kLeastLength, kMostLength);
        return *this;
    }
    Fields& count(std::string_view field, uint32_t value, uint32_t least, uint32_t most = kMostSegments) {
        if (!mError && (value < least || value > most))
            mError = fail(ErrorCode::InvalidArgument, "{}: {} is {}, and must be in [{}, {}]", mFunction, field, value,
                          least, most);
        return *this;
    }
    Fields& rule(bool isMet, std::string_view rule) {
        if (!mError && !isMet) mError = fail(ErrorCode::InvalidArgument, "{}: {}", mFunction, rule);
        return *this;
    }
    /// Every count is below 2^17 here, so nothing overflows.
    Fields& vertices(uint64_t count) {
        if (!mError && count > kMostVertices)
            mError = fail(ErrorCode::InvalidArgument, "{}: these segments give {} vertices; at most {} are possible",
                          mFunction, count, kMostVertices);
        return *this;
    }
    std::optional<Error> const& error() const { return mError; }

private:
    std::string_view mFunction;
    std::optional<Error> mError;
};

struct Direction {
    double sine = 0, cosine = 1;
};

/// Of the angle pi/2 * (numerator / denominator + quarters), with exact quarter turns and the same bits in each
/// quadrant.
Direction directionAt(uint64_t numerator, uint64_t denominator, uint64_t quarters) {
    const uint64_t whole = numerator / denominator, rest = numerator % denominator;
    const double angle = kHalfTurn / 2 * static_cast<double>(rest) / static_cast<double>(denominator);
    const double s = elementary::sin(angle), c = elementary::cos(angle);
    switch ((whole + quarters) % 4) {
    case 0:
        return { s, c };
    case 1:
        return { c, -s };
    case 2:
        return { -s, -c };
    default:
        return { -c, s };
    }
}

float4 frame(double3 normal, double3 tangent) { return tangentsOf(float3(normal), float3(tangent)); }

/// Where a surface of revolution cuts the half plane of one angle. At radius 0 it is a point: each slice has its own
/// vertex, half way between its meridians.
struct ProfilePoint {
    double radius = 0, y = 0;
    Direction normal{}; ///< sine: away from the axis, cosine: up
    double v = 0;
};

/// A cap: its texture coordinates are those of a plane.
struct Cap {
    double radius = 0, up = 1; ///< up: +1 looks to +y, -1 to -y
};

/// Adds surfaces of revolution around the y axis to a mesh.
class Lathe {
public:
    Lathe(Mesh& mesh, uint32_t slices) : mMesh(mesh), mSlices(slices) {
        mMeridians.reserve(size_t{ slices } + 1);
        mMiddles.reserve(slices);
        for (uint64_t i = 0; i < slices; ++i) {
            mMeridians.push_back(directionAt(4 * i, slices, 2)); // -pi at u = 0
            mMiddles.push_back(directionAt(4 * i + 2, slices, 2));
        }
        mMeridians.push_back(mMeridians.front()); // the same bits on both sides of the seam
    }

    /// `profile`: upwards in the texture, as v grows.
    void surface(std::span<const ProfilePoint> profile) {
        for (size_t i = 0; i < profile.size(); ++i) {
            const uint32_t first = addRow(profile[i]);
            if (i > 0) connect(mRow, profile[i - 1].radius == 0, first, profile[i].radius == 0);
            mRow = first;
        }
    }

    void cap(Cap const& cap, double y) {
        const auto begin = mMesh.vertices.size();
        const ProfilePoint rim{ cap.radius, y, { 0, cap.up } }, center{ 0, y, { 0, cap.up } };
        if (cap.up > 0)
            surface(std::array{ rim, center });
        else
            surface(std::array{ center, rim });
        for (MeshVertex& vertex : std::span(mMesh.vertices).subspan(begin)) {
            const double2 across(vertex.position.x, -cap.up * vertex.position.z);
            vertex.uv = float2(across / (2 * cap.radius) + 0.5);
            vertex.tangents = frame(double3(vertex.normal), { 1, 0, 0 });
        }
    }

private:
    uint32_t addRow(ProfilePoint const& point) {
        const auto first = static_cast<uint32_t>(mMesh.vertices.size());
        const bool isPole = point.radius == 0;
        for (uint32_t i = 0; i < mSlices + (isPole ? 0 : 1); ++i) {
            const Direction around = isPole ? mMiddles[i] : mMeridians[i];
            const double3 outward(around.sine, 0, around.cosine), along(around.cosine, 0, -around.sine);
            const double3 normal = outward * point.normal.sine + double3(0, point.normal.cosine, 0);
            const double u = (i + (isPole ? 0.5 : 0.0)) / mSlices;
            mMesh.vertices.push_back({ .position = float3(outward * point.radius + double3(0, point.y, 0)),
                                       .normal = float3(normal),
                                       .tangents = frame(normal, along),
                                       .uv = float2(double2(u, point.v)) });
        }
        return first;
    }

    void connect(uint32_t lower, bool lowerIsPole, uint32_t upper, bool upperIsPole) {
        for (uint32_t i = 0; i < mSlices; ++i) {
            if (!lowerIsPole) triangle(lower + i, lower + i + 1, upper + i + (upperIsPole ? 0 : 1));
            if (!upperIsPole) triangle(lower + i, upper + i + 1, upper + i);
        }
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c) { mMesh.indices.insert(mMesh.indices.end(), { a, b, c }); }

    Mesh& mMesh;
    uint32_t mSlices, mRow = 0;
    std::vector<Direction> mMeridians, mMiddles;
};

/// A rectangle of a grid: point(i, j) for i to the right and j upwards, seen from the front.
template <class Point>
void addGrid(Mesh& mesh, uint2 segments, double3 normal, double3 tangent, Point const& point) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const float4 tangents = frame(normal, tangent);
    for (uint32_t j = 0; j <= segments.y; ++j) {
        for (uint32_t i = 0; i <= segments.x; ++i)
            mesh.vertices.push_back({ .position = point(i, j),
                                      .normal = float3(normal),
                                      .tangents = tangents,
                                      .uv = float2(double2(i, j) / double2(segments)) });
    }
    for (uint32_t j = 0; j < segments.y; ++j) {
        for (uint32_t i = 0; i < segments.x; ++i) {
            const uint32_t a = first + j * (segments.x + 1) + i, d = a + segments.x + 1;
            mesh.indices.insert(mesh.indices.end(), { a, a + 1, d + 1, a, d + 1, d });
        }
    }
}

uint64_t gridVertices(uint64_t columns, uint64_t rows) { return (columns + 1) * (rows + 1); }

/// From -size / 2 to size / 2, with the same bits from either end.
float gridCoordinate(float size, uint32_t i, uint32_t segments) {
    return static_cast<float>(size * ((2.0 * i - segments) / (2.0 * segments)));
}

/// One side of a box: which axes are right and up in its texture, and whether they point to their negative ends.
struct BoxSide {
    int right, up, out;
    bool rightIsNegative, upIsNegative, outIsNegative;
};

constexpr std::array kBoxSides{
    BoxSide{ 2, 1, 0, true, false, false },  BoxSide{ 2, 1, 0, false, false, true }, // +x -x
    BoxSide{ 0, 2, 1, false, true, false },  BoxSide{ 0, 2, 1, false, false, true }, // +y -y
    BoxSide{ 0, 1, 2, false, false, false }, BoxSide{ 0, 1, 2, true, false, true },  // +z -z
};

void addBoxSide(Mesh& mesh, BoxShape const& shape, BoxSide const& side) {
    double3 normal(0), tangent(0);
    normal[side.out] = side.outIsNegative ? -1 : 1;
    tangent[side.right] = side.rightIsNegative ? -1 : 1;
    const uint2 segments(shape.segments[side.right], shape.segments[side.up]);
    addGrid(mesh, segments, normal, tangent, [&](uint32_t i, uint32_t j) {
        const uint32_t right = side.rightIsNegative ? segments.x - i : i, up = side.upIsNegative ? segments.y - j : j;
        float3 position;
        position[side.right] = gridCoordinate(shape.size[side.right], right, segments.x);
        position[side.up] = gridCoordinate(shape.size[side.up], up, segments.y);
        position[side.out] = gridCoordinate(shape.size[side.out], side.outIsNegative ? 0 : 1, 1);
        return position;
    });
}

/// The stretch of a straight side, without its first point if something ends there already.
void addSide(std::vector<ProfilePoint>& profile, ProfilePoint const& from, ProfilePoint const& to, uint32_t stacks) {
    for (uint32_t i = 0; i <= stacks; ++i) {
        const double t = static_cast<double>(i) / stacks;
        const auto between = [&](double a, double b) { return i == stacks ? b : a + (b - a) * t; };
        profile.push_back(
                { between(from.radius, to.radius), between(from.y, to.y), from.normal, between(from.v, to.v) });
    }
}

} // namespace

Result<Mesh> makePlane(PlaneShape const& shape) {
    Fields fields("makePlane");
    fields.length("width", shape.width).length("depth", shape.depth);
    fields.count("widthSegments", shape.widthSegments, 1).count("depthSegments", shape.depthSegments, 1);
    fields.vertices(gridVertices(shape.widthSegments, shape.depthSegments));
    if (fields.error()) return *fields.error();
    Mesh mesh;
    addGrid(mesh, { shape.widthSegments, shape.depthSegments }, { 0, 1, 0 }, { 1, 0, 0 }, [&](uint32_t i, uint32_t j) {
        return float3(gridCoordinate(shape.width, i, shape.widthSegments), 0,
                      gridCoordinate(shape.depth, shape.depthSegments - j, shape.depthSegments));
    });
    return mesh;
}

Result<Mesh> makeBox(BoxShape const& shape) {
    Fields fields("makeBox");
    fields.length("size.x", shape.size.x).length("size.y", shape.size.y).length("size.z", shape.size.z);
    const uint3 n = shape.segments;
    fields.count("segments.x", n.x, 1).count("segments.y", n.y, 1).count("segments.z", n.z, 1);
    fields.vertices(2 * (gridVertices(n.x, n.y) + gridVertices(n.y, n.z) + gridVertices(n.z, n.x)));
    if (fields.error()) return *fields.error();
    Mesh mesh;
    for (BoxSide const& side : kBoxSides) addBoxSide(mesh, shape, side);
    return mesh;
}

Result<Mesh> makeUvSphere(UvSphereShape const& shape) {
    Fields fields("makeUvSphere");
    fields.length("radius", shape.radius).count("slices", shape.slices, 3).count("stacks", shape.stacks, 2);
    fields.vertices(gridVertices(shape.slices, shape.stacks));
    if (fields.error()) return *fields.error();
    std::vector<ProfilePoint> profile;
    for (uint32_t j = 0; j <= shape.stacks; ++j) {
        const Direction latitude = directionAt(2 * uint64_t{ j }, shape.stacks, 3); // -pi/2 at v = 0
        const bool isPole = j == 0 || j == shape.stacks;
        profile.push_back({ .radius = isPole ? 0 : shape.radius * latitude.cosine,
                            .y = shape.radius * latitude.sine,
                            .normal = { latitude.cosine, latitude.sine },
                            .v = static_cast<double>(j) / shape.stacks });
    }
    Mesh mesh;
    Lathe(mesh, shape.slices).surface(profile);
    return mesh;
}

Result<Mesh> makeCylinder(CylinderShape const& shape) {
    Fields fields("makeCylinder");
    fields.length("radius", shape.radius).length("height", shape.height);
    fields.count("slices", shape.slices, 3).count("stacks", shape.stacks, 1);
    fields.vertices(gridVertices(shape.slices, uint64_t{ shape.stacks } + (shape.caps ? 4 : 0)));
    if (fields.error()) return *fields.error();
    return makeCone({ .radius = shape.radius,
                      .height = shape.height,
                      .topRadius = shape.radius,
                      .slices = shape.slices,
                      .stacks = shape.stacks,
                      .caps = shape.caps });
}

Result<Mesh> makeCone(ConeShape const& shape) {
    Fields fields("makeCone");
    fields.length("radius", shape.radius).length("height", shape.height);
    if (shape.topRadius != 0) fields.length("topRadius", shape.topRadius);
    fields.count("slices", shape.slices, 3).count("stacks", shape.stacks, 1);
    fields.vertices(gridVertices(shape.slices, uint64_t{ shape.stacks } + (shape.caps ? 4 : 0)));
    if (fields.error()) return *fields.error();
    const double bottom = shape.radius, top = shape.topRadius, height = shape.height;
    const double slant = elementary::hypot(bottom - top, height);
    const Direction normal{ height / slant, (bottom - top) / slant };
    std::vector<ProfilePoint> profile;
    addSide(profile, { bottom, -height / 2, normal, 0 }, { top, height / 2, normal, 1 }, shape.stacks);
    Mesh mesh;
    Lathe lathe(mesh, shape.slices);
    lathe.surface(profile);
    if (shape.caps) lathe.cap({ bottom, -1 }, -height / 2);
    if (shape.caps && top > 0) lathe.cap({ top, 1 }, height / 2);
    return mesh;
}

Result<Mesh> makeCapsule(CapsuleShape const& shape) {
    Fields fields("makeCapsule");
    fields.length("radius", shape.radius).length("height", shape.height);
    fields.count("slices", shape.slices, 3)
            .count("capStacks", shape.capStacks, 1)
            .count("sideStacks", shape.sideStacks, 1);
    fields.vertices(gridVertices(shape.slices, 2 * uint64_t{ shape.capStacks } + shape.sideStacks));
    if (fields.error()) return *fields.error();
    const double radius = shape.radius, half = shape.height / 2.0, arc = kHalfTurn / 2 * radius, way = 2 * (arc + half);
    std::vector<ProfilePoint> profile;
    const auto ball = [&](uint32_t j, uint64_t quarters, double center, double before) {
        const Direction latitude = directionAt(j, shape.capStacks, quarters);
        const bool isPole = quarters == 3 ? j == 0 : j == shape.capStacks;
        profile.push_back({ .radius = isPole ? 0 : radius * latitude.cosine,
                            .y = center + radius * latitude.sine,
                            .normal = { latitude.cosine, latitude.sine },
                            .v = (before + arc * j / shape.capStacks) / way });
    };
    for (uint32_t j = 0; j < shape.capStacks; ++j) ball(j, 3, -half, 0);
    addSide(profile, { radius, -half, { 1, 0 }, arc / way }, { radius, half, { 1, 0 }, 1 - arc / way },
            shape.sideStacks);
    for (uint32_t j = 1; j <= shape.capStacks; ++j) ball(j, 0, half, way - arc);
    Mesh mesh;
    Lathe(mesh, shape.slices).surface(profile);
    return mesh;
}

Result<Mesh> makeTorus(TorusShape const& shape) {
    Fields fields("makeTorus");
    fields.length("radius", shape.radius).length("tubeRadius", shape.tubeRadius);
    fields.rule(shape.tubeRadius < shape.radius, "tubeRadius must be less than radius, or the tube cuts itself");
    fields.count("slices", shape.slices, 3).count("stacks", shape.stacks, 3);
    fields.vertices(gridVertices(shape.slices, shape.stacks));
    if (fields.error()) return *fields.error();
    std::vector<ProfilePoint> profile;
    for (uint32_t j = 0; j <= shape.stacks; ++j) {
        const Direction around = directionAt(4 * uint64_t{ j % shape.stacks }, shape.stacks, 2); // -pi at v = 0
        profile.push_back({ .radius = double(shape.radius) + double(shape.tubeRadius) * around.cosine,
                            .y = double(shape.tubeRadius) * around.sine,
                            .normal = { around.cosine, around.sine },
                            .v = static_cast<double>(j) / shape.stacks });
    }
    Mesh mesh;
    Lathe(mesh, shape.slices).surface(profile);
    return mesh;
}

} // namespace filament_core
