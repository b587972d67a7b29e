// SPDX-License-Identifier: Apache-2.0
// EXT_lights_image_based: the inverse of GltfEnvironment.cpp.
#include "base/math/Rgbd.h"
#include "filament_core/assets/gltf/GltfEnvironment.h"
#include "filament_core/assets/gltf/GltfWriter.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace filament_core::assets {
namespace {

Result<GlbImage> pictureOfFace(IblCubeLevel const& level, uint32_t face, std::string name) {
    const uint32_t size = level.size();
    std::vector<std::byte> pixels(size_t{ size } * size * 4);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const uint32_t bits = packRgbd(level.radiance(face, static_cast<int>(x), static_cast<int>(size - 1 - y)));
            std::memcpy(&pixels[(size_t{ y } * size + x) * 4], &bits, sizeof(bits));
        }
    }
    return glbImageFromPixels(std::move(name), size, size, pixels, GlbAlpha::Always);
}

/// Whether the columns are unit vectors at right angles, and none mirrors.
bool isRotation(double3x3 const& m) {
    const double3x3 product = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) < 1e-5)) return false;
        }
    }
    return glm::determinant(m) > 0;
}

} // namespace

Result<GlbImageBasedLight> glbImageBasedLight(CubeLight const& light, std::vector<GlbImage>& images) {
    const double3x3 world(light.worldFromCube);
    const double3x3 rotation(world[0], world[1], -world[2]);
    if (light.levels.empty() || !isRotation(rotation))
        return fail(ErrorCode::InvalidArgument,
                    "an image-based light has levels, and worldFromCube is a rotation times (1, 1, -1)");
    GlbImageBasedLight written;
    written.rotation = poseFrom(double4x4(rotation)).rotation;
    written.size = light.levels.front().size();
    for (size_t i = 0; i < light.irradianceSh.size(); ++i)
        written.irradiance[i] = double3(light.irradianceSh[i]) * (std::numbers::pi / kHarmonicConstants[i]);
    for (uint32_t level = 0; level < light.levels.size(); ++level) {
        std::array<uint32_t, 6>& faces = written.levels.emplace_back();
        for (uint32_t face = 0; face < 6; ++face) {
            Result<GlbImage> picture =
                    pictureOfFace(light.levels[level], face, fmt::format("level {} face {}", level, face));
            if (!picture) return picture.error();
            faces[face] = static_cast<uint32_t>(images.size());
            images.push_back(std::move(*picture));
        }
    }
    return written;
}

} // namespace filament_core::assets
