// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/CubePicture.h"

#include "base/Assert.h"
#include "filament_core/assets/image/Ktx2Decoder.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr const char* kCubeCure = "export it as a cube of half floats or BC6H, or as an equirectangular .hdr or .exr";

Result<void> checkCube(Ktx2File const& file, std::string_view name) {
    if (!file.isCube || file.isArray)
        return fail(ErrorCode::Unsupported, "'{}' is {}, which is no environment; {}", name,
                    file.isCube ? "an array of cube maps" : "not a cube map", kCubeCure);
    const uint32_t smallest = std::max(file.width >> (file.levels.size() - 1), 1u);
    if (smallest > kMaxCubeFace)
        return fail(ErrorCode::Unsupported, "'{}' has faces of {} texels a side, more than {}; make it smaller", name,
                    smallest, kMaxCubeFace);
    return {};
}

/// The faces one below the other, as sanitise() takes them.
HdrImage stackedFaces(Image const& cube) {
    HdrImage pixels{ .width = cube.width, .height = 6 * cube.width, .pixels = {}, .repairs = {} };
    pixels.pixels.resize(size_t{ pixels.width } * pixels.height);
    for (size_t i = 0; i < pixels.pixels.size(); ++i)
        std::memcpy(&pixels.pixels[i], &cube.data[i * 4 * sizeof(float)], 3 * sizeof(float));
    return pixels;
}

IblCubeLevel resampledFaces(IblCubeLevel const& level, uint32_t size, jobs::JobSystem& jobs) {
    IblCubeLevel result(size);
    jobs::parallelFor<"cube picture">(jobs, size_t{ 6 } * size, 4, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            const auto face = static_cast<uint32_t>(row / size);
            const auto y = static_cast<int>(row % size);
            for (int x = 0; x < static_cast<int>(size); ++x)
                result.at(face, x, y) = level.sample({ face, faceCoordinate(x, size), faceCoordinate(y, size) });
        }
    });
    result.fillBorder();
    return result;
}

} // namespace

Result<CubePicture> decodeCubePicture(std::span<const std::byte> ktx2, std::string_view name) {
    const Result<Ktx2File> file = readKtx2(ktx2, name);
    if (!file) return file.error();
    if (Result<void> checked = checkCube(*file, name); !checked) return checked.error();
    const Result<Ktx2Texture> texture =
            decodeKtx2(ktx2, name, { .isFull = true, .maxSize = kMaxCubeFace, .isOneLevel = true });
    if (!texture) return texture.error();
    if (texture->image.format != backend::Format::RGBA32F)
        return fail(ErrorCode::Unsupported, "'{}' has 8 bits a channel, too few for light; {}", name, kCubeCure);
    HdrImage pixels = stackedFaces(texture->image);
    // Before the border is filled and before any mean is taken: one NaN would spread to all coarser levels.
    sanitise(pixels);
    const uint32_t size = pixels.width;
    CubePicture picture{ IblCubeLevel(size), pixels.repairs };
    setImage(picture, pixels);
    return picture;
}

HdrImage imageFromPicture(CubePicture const& picture) {
    const uint32_t size = picture.radiance.size();
    HdrImage faces{ .width = size, .height = 6 * size, .pixels = {}, .repairs = {} };
    faces.pixels.reserve(size_t{ size } * faces.height);
    for (uint32_t row = 0; row < faces.height; ++row) {
        for (uint32_t x = 0; x < size; ++x)
            faces.pixels.push_back(
                    picture.radiance.radiance(row / size, static_cast<int>(x), static_cast<int>(row % size)));
    }
    return faces;
}

void setImage(CubePicture& picture, HdrImage const& faces) {
    const uint32_t size = picture.radiance.size();
    FILAMENT_ASSERT(faces.width == size && faces.height == 6 * size, "a cube has six faces of its size");
    for (uint32_t row = 0; row < faces.height; ++row) {
        for (uint32_t x = 0; x < size; ++x) {
            const float3 pixel = faces.at(x, row);
            picture.radiance.at(row / size, static_cast<int>(x), static_cast<int>(row % size)) =
                    Texel{ pixel.x, pixel.y, pixel.z, 0 };
        }
    }
    picture.radiance.fillBorder();
}

IblCube cubeFromPicture(CubePicture const& picture, uint32_t size, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(std::has_single_bit(size), "the size of a cube face is a power of two");
    // Magnified to a power of two first and then halved: means of four texels use every texel of the file, which
    // sampling a smaller size would not.
    const uint32_t start = std::max(std::bit_ceil(picture.radiance.size()), size);
    IblCube cube;
    cube.push_back(start == picture.radiance.size() ? picture.radiance : resampledFaces(picture.radiance, start, jobs));
    while (cube.back().size() > size) cube.back() = halved(cube.back(), jobs);
    while (cube.back().size() > 1) cube.push_back(halved(cube.back(), jobs));
    return cube;
}

} // namespace filament_core::assets
