// SPDX-License-Identifier: Apache-2.0
#include <filament_core/LoadOptions.h>

#include "filament_core/values/OptionRows.h"

#include <span>
#include <vector>

namespace filament_core {

template <>
std::span<const Option> optionsOf<GltfLoadOptions>() {
    using O = GltfLoadOptions;
    static const std::vector<Option> kOptions{
        option("positions", &O::positions, "Storage of positions."),
        option("tangents", &O::tangents, "Storage of tangent frames."),
        option("deformable", &O::deformable, "Loads skins, morph targets and animations."),
        option("allLevels", &O::allLevels, "Loads all levels of detail, and not only the finest."),
        option("simplified", &O::simplified,
               "Makes [levels of detail](levels-of-detail.md) of meshes; programs do where `lod.pixels` is not 0."),
        option("normalMapRoughness", &O::normalMapRoughness,
               "Mip levels of normal maps raise the roughness by what they average away."),
        option("compressedTextures", &O::compressedTextures,
               "Textures of BC7 [stay compressed](textures.md#compressed-on-the-device) where that shows the same "
               "bits."),
        option("sectionPlanes", &O::sectionPlanes, "[Section planes](sections.md) of the view cut the model open."),
        option("textureBudgetMegabytes", &O::textureBudgetMegabytes, { 0, 1 << 20, "megabytes" },
               "[Streams](texture-streaming.md) textures within this budget. 0: all levels are on the device."),
        option("filesFromAnywhere", &O::filesFromAnywhere,
               "Opens buffers and images outside of the model's folder: only for models that you trust.")
    };
    return kOptions;
}

template <>
std::span<const Option> optionsOf<EnvironmentLoadOptions>() {
    static constexpr std::array<std::string_view, 8> kFaceSizes{
        "16", "32", "64", "128", "256", "512", "1024", "2048"
    };
    static constexpr std::array<std::string_view, 4> kLights{ "1", "2", "3", "4" };
    static constexpr std::array<std::string_view, 6> kSamples{ "16", "64", "256", "512", "1024", "4096" };
    using O = EnvironmentLoadOptions;
    static const std::vector<Option> kOptions{
        option("faceSize", &O::faceSize, { 16, 2048, {}, kFaceSizes, true }, "Texels per side of a cube face."),
        option("format", &O::format, "Storage of light: [quality](quality.md)."),
        option("roughnessMapping", &O::roughnessMapping, "Roughness of each mip level."),
        option("samples", &O::samples, { 1, 65536, {}, kSamples }, "Pieces of the sky that each texel integrates."),
        option("sun", &O::sun, "Makes [the sun](environments.md#the-sun) a light that casts shadows."),
        option("lights", &O::lights, { 1, EnvironmentLights::kMost, {}, kLights },
               "Lights that `sun=fit` makes at most.")
    };
    return kOptions;
}

template <>
std::span<const Option> optionsOf<EnvironmentSettings>() {
    using S = EnvironmentSettings;
    static const std::vector<Option> kOptions{
        option("illuminance", &S::illuminance, { 0, 1e12, "lx" }, "Illuminance that radiance 1 stands for."),
        option("rotationRadians", &S::rotationRadians, { -1e6, 1e6, "radians" }, "Rotation about the vertical axis."),
        option("skybox", &S::skybox, "Draws the environment as background."),
        option("groundHeightMeters", &S::groundHeightMeters, { 0, 1e4, "metres" },
               "Height of the panorama's camera above the ground that the background lies on; 0: it is infinitely far "
               "away."),
        option("groundLevelMeters", &S::groundLevelMeters, { -1e6, 1e6, "metres" }, "World height of that ground."),
        option("groundRadiusMeters", &S::groundRadiusMeters, { 0.01, 1e5, "metres" }, "Radius of the dome over it.")
    };
    return kOptions;
}

} // namespace filament_core
