// SPDX-License-Identifier: Apache-2.0
/// Intersector: finds the triangle that a ray hits. Only this file uses Embree (version 3 or 4, single rays, robust
/// mode).
///   In      parts, to which it keeps a reference.
///   Alpha   triangles exist where their material's mask does not cut them away. Blended triangles always exist: the
///           caller decides whether light passes, and continues with the triangles passed in `Ray::passed`.
///   Thread  build: one. Queries: any number at once. One thread builds the tree, so that it is always the same.
///   Memory  about 100 bytes per triangle.  Fails: OutOfMemory, DeviceUnavailable with Embree's reason.
#pragma once

#include "base/Result.h"
#include "tools/reference/Geometry.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace filament_core::reference {

/// Triangles that a ray has passed through; if there is no room for more, the ray ends.
struct PassedTriangles {
    struct Triangle {
        uint32_t part = 0, index = 0;
    };
    std::array<Triangle, 64> triangles;
    uint32_t count = 0;
    bool isFull() const { return count == triangles.size(); }
};

struct Ray {
    double3 origin{ 0.0 }; ///< relative to the scene's origin
    double3 direction{ 0, 0, -1 };
    double nearest = 0, farthest = std::numeric_limits<double>::infinity();
    bool skipsBackFaces = false;             ///< of single-sided materials, which the camera does not see
    PassedTriangles const* passed = nullptr; ///< not hit again
};

struct Hit {
    uint32_t part = 0;
    TrianglePoint point;
    double distance = 0;
};

class Intersector {
public:
    static Result<Intersector> build(std::span<const Part> parts);

    std::optional<Hit> nearest(Ray const& ray) const;
    /// Whether anything is hit; blended triangles count.
    bool isOccluded(Ray const& ray) const;

private:
    struct Deleter {
        void operator()(void* scene) const;
    };
    explicit Intersector(void* scene) : mScene(scene) {}
    std::unique_ptr<void, Deleter> mScene; // RTCScene, which keeps its device alive
};

} // namespace filament_core::reference
