// SPDX-License-Identifier: Apache-2.0
/// What all draws of a view share: matrices in camera-relative space, exposure, and the pre-exposed environment.
#pragma once

#include "base/math/Frustum.h"
#include "filament_core/prepare/PixelGrid.h"
#include "filament_core/prepare/ViewInput.h"
#include "filament_core/scene/SceneData.h"
#include "shaders/interface/ShaderInterface.h"

namespace filament_core::prepare {

/// A view in the space of the shaders: world axes, camera at the origin.
struct ViewSpace {
    double3 cameraWorld{ 0.0 };
    float3 forward{ 0, 0, -1 }; ///< world axes, unit
    float4x4 clipFromWorld{ 1.0f };
    float4x4 clipFromView{ 1.0f };
    float4x4 viewFromWorld{ 1.0f };
    Frustum frustum{};
    PixelGrid pixels{}; ///< of the views of a camera with one sample a pixel; otherwise no object is too small
    float exposure = 1;
    Layers visibleLayers = kAllLayers;
};

ViewSpace makeViewSpace(ViewInput const& view);

/// Everything of FrameUniforms but the lights (SelectLights.h).
void writeFrameUniforms(shader::FrameUniforms& frame, ViewSpace const& space, ViewInput const& view,
                        scene::SceneData const& scene);

} // namespace filament_core::prepare
