// SPDX-License-Identifier: Apache-2.0
/// NeededLevels: which mip levels of streamed textures the views of a frame can choose.
///   In      a frame packet, and what is known of materials, meshes and textures (StreamedTextures).
///   Out     for each texture the smallest level of detail that a sampler can compute, in levels of the whole texture;
///           +infinity: no view shows it.
///   Bound   a pixel of a triangle covers at least the area A = w^2 P cos(c) in the world: P is the area of a pixel in
///           the plane at distance 1 along the view, w the distance of the nearest point of the renderable's box, c the
///           angle between the axis and the corner of the image. Sampling takes the longer of the two texel steps a, b
///           between pixels (Vulkan 1.3, "Scale Factor Operation"), and max(a, b)^2 >= |a x b| = A D W H |det M|: D is
///           the square of the mesh's density (scene/UvDensity.h) over the scale of areas of the transform, W and H the
///           size of the texture, M its transform. So lod >= log2(A D W H |det M|) / 2, less kLevelMargin for the error
///           of the device's logarithm. Anisotropic filters divide by up to 16 samples: 2.5 levels more at most.
///   Shadows of maps that are drawn in this frame: materials that cut out, in the same way.
///   Deformed  one level more, and the largest scale of the bones: triangles stretch.
///   Thread  jobs over the drawn objects; joined when it returns. The same for any number of workers.
///   Memory  the result, in the arena.   Fails: never.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/scene/UvDensity.h"
#include "jobsystem/JobSystem.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace filament_core::prepare {

/// A texture parameter of a material instance that shows a streamed texture.
struct StreamedMap {
    static constexpr uint32_t kNoMatrix = ~0u;
    uint32_t texture = 0;        ///< into StreamedTextures::textures
    uint32_t slot = 0;           ///< into scene::MaterialInstance::textures
    uint32_t uvSet = 0;          ///< [0, 4)
    uint32_t matrix = kNoMatrix; ///< byte of the instance's parameters where the transform of coordinates is
};

struct StreamedTextures {
    struct Texture {
        backend::TextureHandle handle; ///< that instances have now; none: it is not streamed any more
        float texels = 0;              ///< width times height of level 0
    };
    std::vector<Texture> textures;
    std::unordered_map<uint32_t, std::vector<StreamedMap>> maps; ///< by scene::MaterialInstance::id
    std::unordered_map<uint32_t, scene::UvDensity> densities;    ///< by bits of vertex buffers
};

std::span<const float> neededLevels(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                                    FramePacket const& packet, StreamedTextures const& streamed);

} // namespace filament_core::prepare
