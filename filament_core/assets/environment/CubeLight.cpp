// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/CubeLight.h"

#include "base/Assert.h"

namespace filament_core::assets {
namespace {

constexpr uint32_t kPiecesOfALobe = 512; // as EnvironmentOptions::samples

/// What a file with a single level leaves out: reflections of rough surfaces.
std::vector<IblCubeLevel> withRoughLevels(IblCubeLevel const& radiance, jobs::JobSystem& jobs) {
    if (radiance.size() < 2) return { radiance };
    IblCube cube{ radiance };
    while (cube.back().size() > 1) cube.push_back(halved(cube.back(), jobs));
    return prefilterSpecular(cube, radiance.size(), kPiecesOfALobe, jobs, {}, RoughnessMapping::Linear);
}

} // namespace

EnvironmentData environmentFromCube(CubeLight const& light, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(!light.levels.empty(), "a cube has at least one level");
    std::vector<IblCubeLevel> rough;
    if (light.levels.size() == 1) rough = withRoughLevels(light.levels.front(), jobs);
    std::vector<IblCubeLevel> const& levels = rough.empty() ? light.levels : rough;

    EnvironmentData data;
    EncodedCube specular = encodeCube(levels, backend::Format::RGBA16F, jobs);
    EncodedCube sky = encodeCube(std::span(light.levels).first(1), backend::Format::RGBA16F, jobs);
    data.specular = std::move(specular.image);
    data.sky = std::move(sky.image);
    data.statistics.specularLoss = specular.loss;
    data.statistics.skyLoss = sky.loss;
    data.irradianceSh = light.irradianceSh;
    data.levelOfRoughnessOne = static_cast<float>(levels.size() - 1);
    data.mapping = RoughnessMapping::Linear;
    data.worldFromCube = light.worldFromCube;
    return data;
}

HdrImage pictureFromCube(CubeLight const& light, uint32_t width, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(!light.levels.empty() && width > 0 && width % 2 == 0,
                    "a cube of at least one level becomes a picture twice as wide as high");
    HdrImage picture{ .width = width, .height = width / 2, .pixels = {}, .repairs = {} };
    picture.pixels.resize(size_t{ picture.width } * picture.height);
    jobs::parallelFor<"picture of a cube">(jobs, picture.height, 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.height);
            for (uint32_t x = 0; x < width; ++x) {
                const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
                const float3 inCube = directionFromEquirect({ u, v }) * light.worldFromCube; // the inverse
                const Texel texel = light.levels.front().sample(cubeFromDirection(inCube));
                picture.at(x, static_cast<uint32_t>(y)) = { texel[0], texel[1], texel[2] };
            }
        }
    });
    return picture;
}

} // namespace filament_core::assets
