// SPDX-License-Identifier: Apache-2.0
/// SceneBuilder: combines shapes, images and materials into a glTF scene, one mesh and one node per call.
///   Thread  one thread at a time.
///   Fails   only addPictures(), if the encoder does.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"
#include "jobsystem/JobSystem.h"
#include "toolkit/showcase/Shapes.h"
#include "toolkit/showcase/Textures.h"

#include <string>

namespace filament_core::showcase {

/// Images of one TextureSet in the scene; kNone for missing ones.
struct TextureSetImages {
    uint32_t color = assets::kNone, normal = assets::kNone, surface = assets::kNone, emission = assets::kNone;
};

class SceneBuilder {
public:
    explicit SceneBuilder(std::string name);

    Result<TextureSetImages> addPictures(std::string const& name, TextureSet const& set);
    uint32_t add(assets::MaterialData material);
    /// `rotationRadians` rotates around +Y.
    void place(std::string name, Shape const& shape, uint32_t material, float3 position, float rotationRadians = 0);
    /// Light from infinitely far away. `towardsLight` need not be unit.
    void addSun(float3 towardsLight, float3 color, float lux);

    assets::GlbScene take() { return std::move(mScene); }

private:
    assets::GlbScene mScene;
};

/// Trilinear, repeating.
assets::TextureRef textured(uint32_t image);

} // namespace filament_core::showcase
