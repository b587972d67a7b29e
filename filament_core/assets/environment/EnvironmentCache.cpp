// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/EnvironmentCache.h"

#include "base/Hash.h"
#include "filament_core/assets/environment/LightNumbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <type_traits>

namespace filament_core::assets {
namespace {

static_assert(std::endian::native == std::endian::little, "cached environments are little-endian");

constexpr uint64_t kMagic = 0x31564E454C494600; // "\0FILENV1"
/// Incremented whenever the baker's results or this layout change.
constexpr uint32_t kBakerVersion = 6;
/// The same for takeLights().
constexpr uint32_t kFinderVersion = 1;
constexpr uint32_t kMaxFaceSize = 2048;

struct CubeHeader {
    uint32_t size, levels, format, reserved;
    uint64_t clippedTexels;
    double lostEnergy;
};

// No padding: it would be written uninitialised, and the file would differ from run to run.
struct FileHeader {
    uint64_t magic, key, checksum; // the checksum covers all bytes after itself
    uint32_t sourceWidth, sourceHeight;
    uint64_t notANumber, infinite, negative;
    std::array<float, 36> irradianceSh;
    CubeHeader specular, sky, irradiance;
};
static_assert(sizeof(FileHeader) == 3 * 8 + 2 * 4 + 3 * 8 + 36 * 4 + 3 * sizeof(CubeHeader) &&
              sizeof(CubeHeader) == 32);
static_assert(std::is_trivially_copyable_v<FileHeader>);

constexpr size_t kChecksummedFrom = 24;

CubeHeader headerOf(Image const& cube, EncodeLoss const& loss) {
    return { cube.width, cube.levels, static_cast<uint32_t>(cube.format), 0, loss.clippedTexels, loss.lostEnergy };
}

// Everyone can write a correct checksum: what passes here becomes a texture.
bool isPlausible(CubeHeader const& cube) {
    const auto format = static_cast<backend::Format>(cube.format);
    return std::has_single_bit(cube.size) && cube.size <= kMaxFaceSize && cube.levels >= 1 &&
           cube.levels <= backend::fullMipCount(cube.size, cube.size) && isEnvironmentFormat(format);
}

bool isPlausible(FileHeader const& header) {
    CubeHeader const& irradiance = header.irradiance;
    return isPlausible(header.specular) && isPlausible(header.sky) && isPlausible(irradiance) &&
           static_cast<backend::Format>(irradiance.format) == backend::Format::RGBA16F &&
           std::ranges::all_of(header.irradianceSh, [](float value) { return std::isfinite(value); });
}

Image emptyImage(CubeHeader const& cube) {
    return { .width = cube.size,
             .height = cube.size,
             .layers = 6,
             .levels = cube.levels,
             .format = static_cast<backend::Format>(cube.format),
             .data = {} };
}

Error corrupt(const char* reason) { return fail(ErrorCode::Corrupt, "a cached environment {}", reason); }

} // namespace

uint64_t environmentKey(std::span<const std::byte> picture, EnvironmentOptions const& options) {
    const std::array<uint32_t, 5> choices{ kBakerVersion, options.faceSize, options.samples,
                                           static_cast<uint32_t>(options.format),
                                           static_cast<uint32_t>(options.mapping) };
    const uint64_t key = hashCombine(hashBytes(picture), hashValue(choices));
    if (options.sun == EnvironmentSun::Keep) return key;
    const uint32_t lights = options.sun == EnvironmentSun::Fit ? options.lights : 0;
    return hashCombine(key, hashValue(std::array<uint32_t, 3>{ kFinderVersion, uint32_t(options.sun), lights }));
}

uint64_t bakedEnvironmentKey(RoughnessMapping mapping) { return environmentKey({}, { .mapping = mapping }); }

bool isBakedEnvironment(std::span<const std::byte> bytes) {
    uint64_t magic = 0;
    if (bytes.size() < sizeof(magic)) return false;
    std::memcpy(&magic, bytes.data(), sizeof(magic));
    return magic == kMagic;
}

std::vector<std::byte> encodeEnvironment(EnvironmentData const& data, uint64_t key) {
    EnvironmentStatistics const& statistics = data.statistics;
    FileHeader header{ kMagic,
                       key,
                       0,
                       statistics.sourceWidth,
                       statistics.sourceHeight,
                       statistics.repairs.notANumber,
                       statistics.repairs.infinite,
                       statistics.repairs.negative,
                       {},
                       headerOf(data.specular, statistics.specularLoss),
                       headerOf(data.sky, statistics.skyLoss),
                       headerOf(data.irradiance, {}) };
    std::memcpy(header.irradianceSh.data(), data.irradianceSh.data(), sizeof(header.irradianceSh));
    std::vector<std::byte> bytes(sizeof(FileHeader));
    bytes.reserve(bytes.size() + data.specular.data.size() + data.sky.data.size() + data.irradiance.data.size());
    std::memcpy(bytes.data(), &header, sizeof(header));
    for (Image const* image : { &data.specular, &data.sky, &data.irradiance })
        bytes.insert(bytes.end(), image->data.begin(), image->data.end());
    if (data.lights.search != SunSearch::Off) { // files without lights end with the texels
        const LightNumbers numbers = numbersOf(data.lights);
        const auto own = std::as_bytes(std::span(numbers));
        bytes.insert(bytes.end(), own.begin(), own.end());
    }
    const uint64_t checksum = hashBytes(std::span(bytes).subspan(kChecksummedFrom));
    std::memcpy(bytes.data() + offsetof(FileHeader, checksum), &checksum, sizeof(checksum));
    return bytes;
}

Result<EnvironmentData> decodeEnvironment(std::span<const std::byte> bytes, uint64_t key) {
    FileHeader header;
    if (bytes.size() < sizeof(header)) return corrupt("is cut short");
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.magic != kMagic || header.key != key) return corrupt("belongs to something else");
    // The header is checked first, because sizes are computed from it; the size of the file before the checksum,
    // because a file that is cut short needs no pass over its bytes; memory is requested only after both.
    if (!isPlausible(header)) return corrupt("has an impossible size");
    EnvironmentData data;
    data.specular = emptyImage(header.specular);
    data.sky = emptyImage(header.sky);
    data.irradiance = emptyImage(header.irradiance);
    uint64_t texelBytes = 0;
    for (Image const* image : { &data.specular, &data.sky, &data.irradiance })
        texelBytes += image->levelOffset(image->levels);
    const bool hasLights = bytes.size() == sizeof(header) + texelBytes + sizeof(LightNumbers);
    if (bytes.size() != sizeof(header) + texelBytes && !hasLights) return corrupt("is cut short");
    if (hashBytes(bytes.subspan(kChecksummedFrom)) != header.checksum) return corrupt("does not match its checksum");

    auto texels = bytes.subspan(sizeof(header));
    for (Image* image : { &data.specular, &data.sky, &data.irradiance }) {
        const auto own = texels.first(image->levelOffset(image->levels));
        image->data.assign(own.begin(), own.end());
        texels = texels.subspan(own.size());
    }
    if (hasLights) {
        LightNumbers numbers{};
        std::memcpy(numbers.data(), texels.data(), sizeof(numbers));
        const std::optional<EnvironmentLights> lights = lightsFrom(numbers);
        if (!lights) return corrupt("has impossible lights");
        data.lights = *lights;
    }
    std::memcpy(data.irradianceSh.data(), header.irradianceSh.data(), sizeof(header.irradianceSh));
    // Follows from the cube, so it is not stored: a file cannot contradict itself there.
    data.levelOfRoughnessOne = static_cast<float>(data.specular.levels - 1);
    data.statistics = { header.sourceWidth,
                        header.sourceHeight,
                        { header.notANumber, header.infinite, header.negative },
                        { header.specular.clippedTexels, header.specular.lostEnergy },
                        { header.sky.clippedTexels, header.sky.lostEnergy },
                        true };
    return data;
}

} // namespace filament_core::assets
