// SPDX-License-Identifier: Apache-2.0
/// IblTree: cuts the environment into pieces that are as large as a lobe allows.
///   In      an IblCube.  Out: mean radiance over a GGX lobe around any direction, without noise.
///   How     Barnes and Hut 1986, "A Hierarchical O(N log N) Force-Calculation Algorithm", with light instead of mass:
///           one quadtree per face whose nodes store their energy and its centre. A node is used as a whole if it is
///           small compared with its distance from the lobe's axis; otherwise its four children are examined. Because
///           energy is placed at its centre, a sun is exact in whichever node it lies.
///   Why     in the same time, importance sampling with 512 samples leaves an error of 10 to 50 % in a studio of small
///           bright lamps at roughness 1 (bench/filament_core/assets/README.md).
///   Thread  built on the job system; integrate() from any thread.
///   Memory  53 bytes per texel of a cube, with at most kMaxLeafSize texels per side: 21 MiB for 256.
///   Fails   never.
#pragma once

#include "filament_core/assets/environment/IblCube.h"

namespace filament_core::assets {

/// A GGX lobe with view = normal: its weight depends on the angle to the axis only.
struct Lobe {
    float alpha = 1;
    float openingAngle = 0.2f; ///< largest size of a node over its distance from the axis

    /// The opening angle that cuts the hemisphere into about `pieces` nodes.
    static Lobe ofPieces(float alpha, uint32_t pieces);
};

class IblTree {
public:
    static constexpr uint32_t kMaxLeafSize = 512;
    static constexpr uint32_t kCoarsestSize = 8; ///< nodes per face side that are always examined

    /// `cube` has levels down to one texel and at least kCoarsestSize texels per side.
    IblTree(IblCube const& cube, jobs::JobSystem& jobs);

    /// Mean radiance around `axis` (unit), weighted by D and n.l.
    float3 integrate(float3 axis, Lobe const& lobe) const;

private:
    /// Four siblings, element by element.
    struct Quad {
        Texel x, y, z;                   // direction of the node's centre
        Texel energyX, energyY, energyZ; // direction of its energy
        Texel red, green, blue;          // radiance * solid angle
        Texel solidAngle;
    };
    struct Level {
        uint32_t size = 0;       // nodes per face side
        std::vector<Quad> quads; // one per parent: (size / 2)^2 * 6
    };
    struct Sums;

    static Level leavesOf(IblCubeLevel const& texels, jobs::JobSystem& jobs);
    static Level parentsOf(Level const& children, jobs::JobSystem& jobs);
    void addQuad(size_t level, size_t quad, float3 axis, Lobe const& lobe, Sums& sums) const;

    std::vector<Level> mLevels; // coarsest first
};

} // namespace filament_core::assets
