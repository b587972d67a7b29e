// SPDX-License-Identifier: Apache-2.0
/// Points with a size in pixels or metres, and clouds of them: squares of two triangles that a material with
/// `sizedPoints : true` spreads, the built-in material "points" among them.
///   Why     both APIs draw PrimitiveType::Points one pixel wide; larger points of their own are optional features,
///           which vanish as soon as their centre leaves the view.
///   Use     const PointCloudData read = *loadPointCloud("scan.ply");
///           const PointCloud cloud = PointCloud::create(engine, makePointQuads(read.positions, read.colors));
///           cloud.addTo(scene, engine.createInstance(*createBuiltInMaterial(engine, "points")));
///   Draws   every point as a square that faces the view, at the depth of its centre. The vertex block sets its side:
///           `material.pointPixels`, at most 1024, 1 by default, and `material.pointMeters`, in the world, at most
///           1e6, 0 by default. The larger of both counts, so that what is far away keeps its pixels. 0, negative and
///           NaN draw nothing. `getPointCorner()` of the vertex block is the corner, -1 or 1 each way: handed on as a
///           variable it makes discs.
///   Shadows of points in metres are those of squares that face the light; those in pixels count texels of the map.
///   Limits  no bones or morph targets.
///   Memory  80 B a point on the device, and 192 KiB for the indices of a cloud of any size.
///   Thread  PointCloud: the app thread of the engine; all else: any, pure.
#pragma once

#include <filament_core/Box.h>
#include <filament_core/Engine.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>
#include <filament_core/Result.h>
#include <filament_core/Scene.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace filament_core {

/// A corner; the four of a point are equal, and follow each other.
struct PointVertex {
    float3 position{ 0 };            ///< Attribute::Position, relative to PointQuads::center
    std::array<uint16_t, 4> color{}; ///< Attribute::Color, linear, as half floats
};

inline constexpr uint32_t kMaxPointsOfQuads = 16384;

/// Neighbours of a cloud: one renderable, culled as a whole.
struct PointQuads {
    double3 center{ 0 }; ///< where the renderable is in the space of the cloud
    Box bounds{};        ///< of the centres of the points, relative to `center`
    std::vector<PointVertex> vertices{};

    uint32_t pointCount() const { return static_cast<uint32_t>(vertices.size() / 4); }
    uint32_t indexCount() const { return pointCount() * 6; } ///< of pointIndexBuffer(), from 0
    /// Refers to the vector above; for Engine::create() while it lives.
    VertexBufferDesc vertexBuffer() const;
};

/// Divides the points into groups of at most kMaxPointsOfQuads that are close to each other (a k-d tree: Bentley 1975,
/// "Multidimensional binary search trees used for associative searching"). Positions that are not finite are left out.
/// `colors`: linear, one a point; none: white. May throw std::bad_alloc.
std::vector<PointQuads> makePointQuads(std::span<const double3> positions, std::span<const float4> colors = {});

/// The indices of all PointQuads: two triangles a point, for kMaxPointsOfQuads of them.
IndexBufferDesc pointIndexBuffer();

struct PointCloudData {
    std::vector<double3> positions{};
    std::vector<float4> colors{}; ///< linear; empty: the file has none
};

/// Of a .ply the vertices, with or without faces, in the file's own units and axes; coordinates of the type double keep
/// their digits, colours of 8 and 16 bits are sRGB, others are linear. Of a .glb or .gltf the primitives of points,
/// where the nodes put them at rest, with the colours of vertices times those of materials.
/// Fails: Unreadable, Corrupt, Unsupported, OutOfMemory; the file and the reason in one line.
Result<PointCloudData> loadPointCloud(std::filesystem::path const& path);

/// The buffers of a cloud, which any number of scenes may show. It may end before the renderables that show it.
class PointCloud {
public:
    PointCloud() = default; ///< none
    static PointCloud create(Engine& engine, std::span<const PointQuads> quads);

    /// A renderable for each group, below a new node. `marginMeters`: how far points reach beyond their centres, in
    /// the space of the cloud: half of the largest size. Too little, and points may be missing at the edges of the
    /// view and in shadow maps; points in pixels need what these are there.
    Node addTo(Scene& scene, MaterialInstance material, NodeDesc const& node = {}, double marginMeters = 0) const;

private:
    struct Buffers;
    std::shared_ptr<const Buffers> mBuffers; ///< never change; copies share them
};

} // namespace filament_core
