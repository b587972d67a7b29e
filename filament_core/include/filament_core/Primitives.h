// SPDX-License-Identifier: Apache-2.0
/// Primitives: meshes of simple shapes, centred at the origin, with +y as their axis.
///   Use      const Result<Mesh> ball = makeUvSphere({ .radius = 2 });
///   Units    metres, or those of your scene: lengths are finite and in [1e-15, 1e15].
///   Closed   every shape but the plane, and those without caps, is closed: seen from outside all triangles are
///            counter-clockwise, each edge belongs to two triangles, and vertices that meet there have the same bits.
///   Uv       u to the right and v upwards, seen from outside; in [0, 1] (makeIcoSphere() says where not). Around an
///            axis u = 0.5 + atan2(x, z) / 2 pi: the centre of an image is at +z, its seam at -z.
///   Normals  those of the shape itself, not of its triangles; the tangent is the direction in which u grows.
///   Colour   white.
///   Limits   65 536 segments each way and 2^24 vertices.
///   Thread   any; pure.   Cost: 64 B a vertex.
///   Fails    InvalidArgument: the function, the field, its value and its range. std::bad_alloc.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Mesh.h>
#include <filament_core/Result.h>

#include <cstdint>

namespace filament_core {

/// In the plane y = 0, its front towards +y; u along +x, v along -z.
struct PlaneShape {
    float width = 1, depth = 1;                    ///< along x and z
    uint32_t widthSegments = 1, depthSegments = 1; ///< >= 1
};
Result<Mesh> makePlane(PlaneShape const& shape = {});

/// Each face shows the whole image, upright on the sides; on the top and on the bottom u is along +x.
struct BoxShape {
    float3 size{ 1 };
    uint3 segments{ 1 }; ///< along x, y and z, >= 1
};
Result<Mesh> makeBox(BoxShape const& shape = {});

/// Meridians and parallels: v = 1 - acos(y / radius) / pi, the north pole is at +y.
struct UvSphereShape {
    float radius = 0.5f;
    uint32_t slices = 32; ///< around the axis, >= 3
    uint32_t stacks = 16; ///< from pole to pole, >= 2
};
Result<Mesh> makeUvSphere(UvSphereShape const& shape = {});

/// An icosahedron with a corner at each pole, its triangles divided into four `subdivisions` times: nearly equal
/// triangles everywhere. The texture coordinates are those of the UV sphere; in triangles across the seam, u continues
/// to at most 1.5, for samplers that repeat.
struct IcoSphereShape {
    float radius = 0.5f;
    uint32_t subdivisions = 3; ///< [0, 8]: 20 * 4^n triangles
};
Result<Mesh> makeIcoSphere(IcoSphereShape const& shape = {});

/// The side shows the whole image; so does each cap: a disc within it, with u along +x.
struct CylinderShape {
    float radius = 0.5f, height = 1;
    uint32_t slices = 32; ///< around the axis, >= 3
    uint32_t stacks = 1;  ///< along the axis, >= 1
    bool caps = true;
};
Result<Mesh> makeCylinder(CylinderShape const& shape = {});

/// Its base at y = -height / 2, its apex at height / 2; with a top radius the apex is cut off.
struct ConeShape {
    float radius = 0.5f, height = 1;
    float topRadius = 0;  ///< 0, or a length
    uint32_t slices = 32; ///< around the axis, >= 3
    uint32_t stacks = 1;  ///< along the axis, >= 1
    bool caps = true;     ///< the base, and what is cut off
};
Result<Mesh> makeCone(ConeShape const& shape = {});

/// Half a ball at each end of a cylinder; v is proportional to the way along the surface.
struct CapsuleShape {
    float radius = 0.25f;
    float height = 0.5f;     ///< of the cylinder: all of the capsule has height + 2 radius
    uint32_t slices = 32;    ///< around the axis, >= 3
    uint32_t capStacks = 8;  ///< of each half ball, >= 1
    uint32_t sideStacks = 1; ///< of the cylinder, >= 1
};
Result<Mesh> makeCapsule(CapsuleShape const& shape = {});

/// A tube around the y axis. v goes once around the tube, upwards on the outside: 0.5 is the outermost circle.
struct TorusShape {
    float radius = 0.5f;     ///< of the circle in the middle of the tube
    float tubeRadius = 0.2f; ///< less than `radius`
    uint32_t slices = 48;    ///< around the axis, >= 3
    uint32_t stacks = 24;    ///< around the tube, >= 3
};
Result<Mesh> makeTorus(TorusShape const& shape = {});

} // namespace filament_core
