// SPDX-License-Identifier: Apache-2.0
/// IblTree: the environment cut into pieces, each as large as a lobe allows.
///   In      an IblCube.  Out: mean radiance over a GGX lobe around any direction, without noise.
///   How     Barnes and Hut 1986, "A Hierarchical O(N log N) Force-Calculation Algorithm", with light instead of mass:
///           one quadtree per face whose nodes hold their energy and its centre. A node is taken whole when it is small
///           against its distance from the lobe's axis; else its four children are looked at. Because energy sits at
///           its centre, a sun is exact in whichever node it happens to be.
///   Why     importance sampling with 512 samples leaves 10 to 50 % of error in a studio of small bright lamps at
///           roughness 1, in the same time (bench/filament_core/assets/README.md).
///   Thread  made on the job system; integrate() from any thread.
///   Memory  53 bytes a texel of a cube, at most kMaxLeafSize texels a face: 21 MiB for 256.
///   Fails   never.
#pragma once

#include "filament_core/assets/environment/IblCube.h"

namespace filament::assets {

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
    static constexpr uint32_t kCoarsestSize = 8; ///< nodes a face side that are always looked at

    /// `cube` has levels down to one texel and at least kCoarsestSize texels a face.
    IblTree(IblCube const& cube, jobs::JobSystem& jobs);

    /// Mean radiance around `axis` (unit), weighted by D and n.l.
    float3 integrate(float3 axis, Lobe const& lobe) const;

private:
    /// Four siblings, element by element.
    struct Quad {
        Texel x, y, z;                   // direction of the node's middle
        Texel energyX, energyY, energyZ; // direction of its energy
        Texel red, green, blue;          // radiance * solid angle
        Texel solidAngle;
    };
    struct Level {
        uint32_t size = 0;       // nodes a face side
        std::vector<Quad> quads; // of (size / 2)^2 * 6 parents
    };
    struct Sums;

    static Level leavesOf(IblCubeLevel const& texels, jobs::JobSystem& jobs);
    static Level parentsOf(Level const& children, jobs::JobSystem& jobs);
    void addQuad(size_t level, size_t quad, float3 axis, Lobe const& lobe, Sums& sums) const;

    std::vector<Level> mLevels; // coarsest first
};

} // namespace filament::assets
