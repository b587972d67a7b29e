// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/math/Half.h"

#include <filament_core/filament_core.h>

#include <span>
#include <vector>

namespace filament_core {

/// Radiance 1 from everywhere.
class WhiteEnvironment {
public:
    explicit WhiteEnvironment(Engine& engine) {
        const std::vector<uint16_t> ones(6 * (16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1) * 4, halfFromFloat(1.0f));
        mCube = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                      .format = Format::RGBA16F,
                                                      .width = 16,
                                                      .height = 16,
                                                      .layers = 6,
                                                      .levels = 5,
                                                      .pixels = std::as_bytes(std::span(ones)),
                                                      .name = "ones" }));
        IndirectLightDesc light{ .specular = mCube, .specularLevels = 5, .name = "furnace" };
        light.irradianceSh[0] = float4(1);
        mLight = engine.own(engine.create(light));
    }

    /// Undoes the exposure of the camera, so that pixels are radiances.
    void light(Scene& scene, Camera const& camera) const {
        scene.setIndirectLight(mLight, Lux{ 1 / camera.exposure.factor() });
    }

private:
    Owned<Texture> mCube;
    Owned<IndirectLight> mLight;
};

} // namespace filament_core
