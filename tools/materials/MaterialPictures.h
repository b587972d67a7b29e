// SPDX-License-Identifier: Apache-2.0
/// MaterialPictures: textures by name, for parameters of materials that are shown.
///   Names   SET/color, SET/normal, SET/surface (roughness in G, metalness in B), SET/emission of the showcase's sets
///           brick, wood, terrazzo, checker, dimple, lattice, glass, lava, brushed, as far as a set has them; and
///           waves/height, waves/normal, waves/occlusion (rolling hills), swirl/direction (xy of a tangent vector that
///           turns around the middle, 0.5 is 0), wedge/thickness (0 to 1 along u), gradient/cube (a cube map),
///           stripes/layers (an array of three), numbers/int and numbers/uint (whole numbers from 0 to 63 along u).
///   Out     mip maps where the format can have them, trilinear and repeating otherwise nearest.
///   Thread  that of the engine.
///   Fails   NotFound with the names that there are.
#pragma once

#include <filament/Engine.h>

namespace filament::tools {

struct MaterialPicture {
    Owned<Texture> texture;
    Sampler sampler{};
};

Result<MaterialPicture> makeMaterialPicture(Engine& engine, std::string const& name);

} // namespace filament::tools
