// SPDX-License-Identifier: Apache-2.0
/// Interiors: generated rooms, for comparisons of light that is reflected between surfaces.
///   Out     a scene for writeGlb(), the box of the room, and five cameras in it. The same settings give the same
///           bytes.
///   Space   metres, +Y up, the floor at y = 0.
///   Thread  any; pure functions.
///   Fails   never; settings outside of their ranges are asserted.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/HdrImage.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::interiors {

struct InteriorCamera {
    double3 eye{ 0.0 }, at{ 0.0 };
    float fovDegrees = 50; ///< vertical
};

struct Interior {
    assets::GlbScene model; ///< its name names the interior
    double3 center{ 0.0 };  ///< of the box between the inner faces of the walls
    double3 halfExtent{ 1.0 };
    std::vector<InteriorCamera> cameras;
};

/// The box of Goral, Torrance, Greenberg and Battaile 1984, "Modeling the Interaction of Light between Diffuse
/// Surfaces": red and green sides, a lamp below the ceiling, two blocks, open towards +z. x from -1 to 1, y from 0 to
/// 2, z from -1 to 1. One mesh and node for each colour; the blocks are one mesh that two nodes share.
///   lamp  emission of the lamp, on the scale of glTF's emissiveFactor, >= 0; 0: there is none
Interior cornellBox(float lamp = 8);

struct GalleryOptions {
    double lengthMeters = 12; ///< along x, [6, 60]
    double widthMeters = 6;   ///< along z, [4, 20]
    double heightMeters = 4;  ///< [3, 10]
    uint32_t columns = 3;     ///< beside the windows, [0, 16]
    uint32_t pictures = 4;    ///< on the wall across from the windows, [0, 16]
    /// > 0: floor, ceiling and walls are cut into panels of at most so many metres, a mesh and a node each, [0.25, 60].
    /// 0: each is one mesh.
    double panelMeters = 0;
};

/// A long room with walls of 20 cm: one end is red, the other one blue, and the sky shines through a wide window in a
/// long side. Columns, pictures, and pedestals with a sphere or a block.
Interior gallery(GalleryOptions const& options = {});

/// A clear sky of 64 x 32 texels without a sun above grey ground; radiance 1 stands for 30 000 lux, as the programs'
/// default is.
assets::HdrImage interiorSky();

struct InteriorFiles {
    std::filesystem::path model, sky; ///< NAME.glb, NAME.hdr
};

/// Writes both into `folder`, which is created if missing. Fails: as writeGlb() and writeHdr().
Result<InteriorFiles> writeInterior(Interior const& interior, std::filesystem::path const& folder);

} // namespace filament_core::interiors
