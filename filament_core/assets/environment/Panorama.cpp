// SPDX-License-Identifier: Apache-2.0
// Faces are those of OpenEXR's ImfEnvmap.h ("Technical Introduction to OpenEXR", environment maps): seen from outside,
// and the first and last pixels of a row lie on the edges of the cube, so that neighbours share them.
#include "filament_core/assets/environment/Panorama.h"

#include "base/Log.h"
#include "filament_core/assets/environment/CubePicture.h"
#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/HdrReader.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::assets {
namespace {

float3 sampleFaces(HdrImage const& faces, float3 direction) {
    const CubePoint point = cubeFromDirection(direction); // seen from inside
    const bool isSide = point.face / 2 != 1;
    const float last = static_cast<float>(faces.width - 1);
    const float x = ((isSide ? -point.s : point.s) + 1) / 2 * last, y = ((isSide ? point.t : -point.t) + 1) / 2 * last;
    const auto left = static_cast<uint32_t>(std::clamp(x, 0.0f, last)),
               top = static_cast<uint32_t>(std::clamp(y, 0.0f, last));
    const uint32_t right = std::min(left + 1, faces.width - 1), bottom = std::min(top + 1, faces.width - 1);
    const uint32_t first = point.face * faces.width;
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
    const float3 upper = faces.at(left, first + top) * (1 - u) + faces.at(right, first + top) * u;
    const float3 lower = faces.at(left, first + bottom) * (1 - u) + faces.at(right, first + bottom) * u;
    return glm::max(upper * (1 - v) + lower * v, float3(0)); // rounding at the edges
}

HdrImage panoramaOf(HdrImage const& faces) {
    HdrImage image{ .width = 4 * faces.width, .height = 2 * faces.width, .pixels = {}, .repairs = faces.repairs };
    image.pixels.reserve(size_t{ image.width } * image.height);
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float2 at((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                            (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
            image.pixels.push_back(sampleFaces(faces, directionFromEquirect(at)));
        }
    }
    return image;
}

} // namespace

Result<HdrImage> decodePanorama(std::span<const std::byte> bytes, std::string_view name) {
    Result<HdrImage> image = decodeHdrImage(bytes, name);
    if (!image || !image->isCube) return image;
    if (image->height != 6 * image->width || image->width > kMaxCubeFace)
        return fail(
                ErrorCode::Unsupported,
                "'{}' says that it is a cube map (envmap 1), but {} x {} pixels are not six faces of at most {}, one "
                "below the other; convert it with 'exrenvmap -latlong'",
                name, image->width, image->height, kMaxCubeFace);
    return panoramaOf(*image);
}

void warnAboutPanorama(std::span<const std::byte> bytes, std::string_view name) {
    const HdrImage header = readHdrHeader(bytes);
    for (std::vector<std::string> const* list : { &header.warnings, &header.panoramaWarnings })
        for (std::string const& line : *list) log(Severity::Warning, "'{}': {}", name, line);
}

Result<HdrImage> readPanorama(std::filesystem::path const& path) {
    const Result<std::vector<std::byte>> bytes = readFileBytes(path);
    if (!bytes) return bytes.error();
    Result<HdrImage> image = decodePanorama(*bytes, path.string());
    if (image) warnAboutPanorama(*bytes, path.string());
    return image;
}

} // namespace filament_core::assets
