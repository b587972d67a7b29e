// SPDX-License-Identifier: Apache-2.0
/// simplifyMesh: coarser levels of a triangle mesh, which share its vertices, each with the error that it makes.
///   In      positions and triangles; what deforms them, if anything does.   Out: levels, the finest first.
///   How     meshoptimizer's simplifier halves the triangles of each level (Garland and Heckbert 1997, "Surface
///           Simplification Using Quadric Error Metrics"): it moves vertices onto others. Open borders stay, so that a
///           mesh leaves no gap to its neighbours; seams of attributes stay closed. The error is not the simplifier's
///           estimate: it is measured, between the mesh and the level.
///   Thread  any; pure.   Memory: about 150 B a triangle while it runs.
///   Bits    the same on every CPU of an architecture. meshoptimizer is compiled by the distribution, which may fuse
///           multiplications and additions where all CPUs of an architecture can.
///   Limits  attributes other than positions, weights and displacements have no part in the error.
///   Fails   std::bad_alloc. No levels for positions that are not finite, and for meshes of few triangles.
#pragma once

#include "base/math/Math.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets {

/// Of a vertex by one bone.
struct Influence {
    uint32_t bone = 0;
    float weight = 0;
};

struct MeshToSimplify {
    std::span<const float3> positions{};
    std::span<const uint32_t> indices{}; ///< three for each triangle, below positions.size()
    /// All attributes of each vertex in turn, `stride` bytes; vertices of equal bytes count as one. None: vertices are
    /// what their numbers say.
    std::span<const std::byte> vertices{};
    size_t stride = 0;
    std::span<const std::span<const float3>> displacements{}; ///< of each morph target, one a vertex
    std::span<const Influence> influences{};                  ///< as many for each vertex, in turn; none: no bones
};

struct SimplifiedLevel {
    std::vector<uint32_t> indices; ///< of the same vertices
    /// In units of positions. No vertex of the mesh is farther from the level's surface, and no middle of an edge or a
    /// triangle of the level is farther from the mesh. Displacements count with weights between -1 and 1. A difference
    /// of weights counts as a part of the box of the bone's vertices: by so much that bone may lead away from others.
    float error = 0;
};

/// A level has at most three quarters of the triangles of the one before, and no smaller error.
std::vector<SimplifiedLevel> simplifyMesh(MeshToSimplify const& mesh);

} // namespace filament_core::assets
