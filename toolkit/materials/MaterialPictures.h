// SPDX-License-Identifier: Apache-2.0
/// MaterialPictures: textures by name, for the parameters of shown materials.
///   Names   SET/color, SET/normal, SET/surface (roughness in G, metalness in B), SET/emission of the showcase's sets
///           brick, wood, terrazzo, checker, dimple, lattice, glass, lava, brushed, if the set has them; and
///           waves/height, waves/normal, waves/occlusion (rolling hills), swirl/direction (xy of a tangent vector that
///           rotates around the centre, with 0.5 as 0), wedge/thickness (0 to 1 along u), gradient/cube (a cube map),
///           stripes/layers (an array of three), veins/volume (a 3D texture), numbers/int and numbers/uint (integers
///           from 0 to 63 along u).
///   Out     trilinear and repeating with mip maps if the format allows them, otherwise nearest.
///   Thread  that of the engine.
///   Fails   NotFound with the existing names.
#pragma once

#include <filament_core/Engine.h>

namespace filament_core::tools {

struct MaterialPicture {
    Owned<Texture> texture;
    Sampler sampler{};
};

Result<MaterialPicture> makeMaterialPicture(Engine& engine, std::string const& name);

} // namespace filament_core::tools
