// SPDX-License-Identifier: Apache-2.0
/// LoadOptions: how glTF files and environments are loaded, and how an environment lights a scene. Plain values; each
/// field but `progress` is an option (Options.h).
///   Thread   any.
#pragma once

#include <filament_core/EnvironmentFormat.h>
#include <filament_core/EnvironmentLights.h>
#include <filament_core/Quality.h>
#include <filament_core/Units.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace filament_core {

/// Called with the name of the stage, the steps done and the total, on the loading thread or a worker, never on two
/// threads at once.
using LoadProgress = std::function<void(std::string_view stage, size_t done, size_t total)>;

struct GltfLoadOptions {
    PositionStorage positions = PositionStorage::AsAuthored;
    TangentStorage tangents = TangentStorage::Snorm16;
    /// False: skins and morph targets are applied once, in the rest pose, and animations are not loaded. This is
    /// cheaper to draw.
    bool deformable = true;
    /// Of things with levels of detail (MSFT_lod): true loads all of them, for ModelCopy::chooseLevels(). False: the
    /// finest alone, which takes less time and memory.
    bool allLevels = false;
    /// True: meshes get coarser levels of detail, which views draw where these differ by few pixels (View::lod). Takes
    /// time to load, and at most as much memory for indices again.
    bool simplified = false;
    /// True: mip levels of normal maps raise the roughness by the variation of normals that they average away, so that
    /// highlights keep their width at a distance. Takes time to load, and no memory.
    bool normalMapRoughness = false;
    /// True: textures that the file holds as BC7 with all of their levels, and lightmaps of BC6H without openness, stay
    /// compressed, where the device shows the bits of the decoded texels (docs/textures.md). This takes a quarter of
    /// the memory and less time to load. Mesa's CPU drivers decode blocks whenever a texel is read: frames take longer.
    bool compressedTextures = false;
    /// True: View::section cuts the model open. Its materials take longer to draw, also where nothing cuts them.
    bool sectionPlanes = false;
    /// More than 0: of the textures only the mip levels that frames need are on the device, in so many units of 2^20
    /// bytes for all streamed models of the engine (<filament_core/TextureStreaming.h>), [0, 1048576].
    /// 0: all levels are.
    uint32_t textureBudgetMegabytes = 0;
    /// True: buffers and images may also lie outside of the model's folder: behind absolute paths, "..", and links that
    /// lead out. Only for models that you trust.
    bool filesFromAnywhere = false;
    LoadProgress progress{};
};

struct EnvironmentLoadOptions {
    uint32_t faceSize = 256; ///< texels per side of a cube face, power of two in [16, 2048]
    EnvironmentFormat format = EnvironmentFormat::Rgba16F; ///< the others take half the memory
    RoughnessMapping roughnessMapping = RoughnessMapping::Quadratic;
    uint32_t samples = 512; ///< pieces of the sky that each texel integrates, about, [1, 65536]
    /// Light that Scene::setEnvironment() adds as suns, which cast shadows. It is taken out of the light of the
    /// environment, not out of its background.
    EnvironmentSun sun = EnvironmentSun::Keep;
    uint32_t lights = 1; ///< at most, with EnvironmentSun::Fit, [1, 4]
    LoadProgress progress{};
};

struct EnvironmentSettings {
    Lux illuminance{ 30'000 }; ///< illuminance that radiance 1 of the environment stands for
    float rotationRadians = 0; ///< around +Y
    bool skybox = true;        ///< draw the environment as background
    /// The lower half of the background lies on the ground, under a dome, so that things stand on it: height of the
    /// panorama's camera above the ground, below which it is at x = z = 0; [0, 1e4] m. 0: infinitely far away.
    float groundHeightMeters = 0;
    float groundLevelMeters = 0;   ///< world height of the ground, [-1e6, 1e6] m
    float groundRadiusMeters = 50; ///< of the dome, (height, 1e5] m; from outside it shows what lies straight on
};

} // namespace filament_core
