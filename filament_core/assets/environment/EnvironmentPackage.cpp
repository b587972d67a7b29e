// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/EnvironmentPackage.h"

#include "base/Assert.h"
#include "filament_core/assets/environment/LightNumbers.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "filament_core/assets/image/Ktx2Inflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace filament_core::assets {
namespace {

/// With lights, which earlier programs would lose, another one.
constexpr const char *kLayoutVersion = "1", *kLayoutWithLights = "2";
constexpr std::string_view kLayoutKey = "filament.environment", kMappingKey = "filament.roughnessMapping",
                           kShKey = "filament.irradianceSh", kIrradianceKey = "filament.irradiance",
                           kSkyboxKey = "filament.skybox", kPictureKey = "filament.picture",
                           kLightsKey = "filament.lights";
constexpr uint32_t kMaxPackageFace = 2048;

constexpr std::array<std::pair<RoughnessMapping, const char*>, 3> kMappingNames{ {
        { RoughnessMapping::Quadratic, "quadratic" },
        { RoughnessMapping::Logarithmic, "logarithmic" },
        { RoughnessMapping::Linear, "linear" },
} };

std::string_view asciiOf(std::span<const std::byte> value) {
    const std::string_view text(reinterpret_cast<const char*>(value.data()), value.size());
    return text.substr(0, text.find('\0'));
}

/// Decimal numbers between white space. The shortest text that reads as the same bits is what fmt writes.
template <class T, size_t kCount>
bool numbersIn(std::string_view text, std::array<T, kCount>& numbers) {
    const auto skip = [&] { text.remove_prefix(std::min(text.find_first_not_of(" \n\r\t"), text.size())); };
    for (T& number : numbers) {
        skip();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc()) return false;
        text.remove_prefix(static_cast<size_t>(end - text.data()));
    }
    skip();
    return text.empty();
}

std::string shText(std::array<float4, 9> const& sh) {
    std::string text;
    for (float4 const& c : sh) text += fmt::format("{} {} {}\n", c.x, c.y, c.z);
    return text;
}

std::string pictureText(EnvironmentStatistics const& s) {
    return fmt::format("{} {} {} {} {} {} {} {} {}", s.sourceWidth, s.sourceHeight, s.repairs.notANumber,
                       s.repairs.infinite, s.repairs.negative, s.specularLoss.clippedTexels, s.skyLoss.clippedTexels,
                       s.specularLoss.lostEnergy, s.skyLoss.lostEnergy);
}

std::string lightsText(EnvironmentLights const& lights) {
    std::string text;
    for (const float number : numbersOf(lights)) text += fmt::format("{} ", number);
    return text;
}

std::optional<EnvironmentStatistics> statisticsOf(std::string_view text) {
    std::array<double, 9> n{};
    const auto isCount = [](double number) { return number >= 0 && number < 0x1p53 && number == std::floor(number); };
    if (!numbersIn(text, n) || !std::all_of(n.begin(), n.begin() + 7, isCount)) return std::nullopt;
    if (std::max(n[0], n[1]) > 0xFFFFFFFFu || !std::isfinite(n[7]) || !std::isfinite(n[8])) return std::nullopt;
    std::array<uint64_t, 7> counts{};
    std::transform(n.begin(), n.begin() + 7, counts.begin(),
                   [](double number) { return static_cast<uint64_t>(number); });
    return EnvironmentStatistics{ static_cast<uint32_t>(counts[0]),
                                  static_cast<uint32_t>(counts[1]),
                                  { counts[2], counts[3], counts[4] },
                                  { counts[5], n[7] },
                                  { counts[6], n[8] },
                                  true };
}

/// Radiance is what shaders may add up without ending at NaN.
bool isRadiance(backend::Format format, std::span<const std::byte> texels) {
    if (format == backend::Format::RGBA16F) {
        constexpr uint16_t kInfinity = 0x7C00;
        for (size_t at = 0; at < texels.size(); at += 2) {
            uint16_t half = 0;
            std::memcpy(&half, &texels[at], sizeof(half));
            if (half >= kInfinity) return false; // the sign is the highest bit
        }
    }
    if (format == backend::Format::R11G11B10F) {
        constexpr uint32_t kRed = 0x7C0, kGreen = kRed << 11, kBlue = 0xF8000000u; // exponents
        for (size_t at = 0; at < texels.size(); at += 4) {
            uint32_t bits = 0;
            std::memcpy(&bits, &texels[at], sizeof(bits));
            if ((bits & kRed) == kRed || (bits & kGreen) == kGreen || (bits & kBlue) == kBlue) return false;
        }
    }
    return true;
}

/// Reads the parts of one package.
class PackageReader {
public:
    PackageReader(Ktx2File const& file, std::string_view name) : mFile(file), mName(name) {}

    Result<EnvironmentData> read() {
        if (text(kLayoutKey) != kLayoutVersion && text(kLayoutKey) != kLayoutWithLights)
            return fail(ErrorCode::Unsupported,
                        "'{}' is an environment package of another layout than {} and {}, which this version reads; "
                        "bake it again with cmgen",
                        mName, kLayoutVersion, kLayoutWithLights);
        if (!readTexts()) return damaged(mReason);
        for (const auto& [key, cube] : { std::pair(std::string_view(), &mData.specular),
                                         { kSkyboxKey, &mData.sky },
                                         { kIrradianceKey, &mData.irradiance } }) {
            if (Result<void> read = readPart(key, *cube); !read) return read.error();
        }
        if (mData.irradiance.layers == 6 && mData.irradiance.format != backend::Format::RGBA16F)
            return damaged("its irradiance is not RGBA16F");
        mData.levelOfRoughnessOne = static_cast<float>(mData.specular.levels - 1);
        return std::move(mData);
    }

private:
    Error damaged(std::string_view what) const {
        return fail(ErrorCode::Corrupt, "'{}' is a damaged environment package: {}; bake it again with cmgen", mName,
                    what);
    }

    std::string_view text(std::string_view key) const { return asciiOf(mFile.value(key).value_or(mNothing)); }

    /// False: mReason says why.
    bool readTexts() {
        const std::string_view mapping = text(kMappingKey);
        const auto known = std::ranges::find(kMappingNames, mapping, [](auto const& pair) { return pair.second; });
        mReason = "its filament.roughnessMapping is none of quadratic, logarithmic and linear";
        if (known == kMappingNames.end()) return false;
        mData.mapping = known->first;
        std::array<float, 27> sh{};
        mReason = "its filament.irradianceSh is not 27 finite numbers";
        if (!numbersIn(text(kShKey), sh)) return false;
        if (!std::ranges::all_of(sh, [](float value) { return std::isfinite(value); })) return false;
        for (size_t i = 0; i < 9; ++i) mData.irradianceSh[i] = { sh[3 * i], sh[3 * i + 1], sh[3 * i + 2], 0 };
        const std::optional<EnvironmentStatistics> statistics = statisticsOf(text(kPictureKey));
        mReason = "its filament.picture is not nine numbers";
        if (statistics) mData.statistics = *statistics;
        return statistics && readLights();
    }

    bool readLights() {
        const std::string_view lights = text(kLightsKey);
        if (text(kLayoutKey) == kLayoutVersion) return true;
        LightNumbers numbers{};
        mReason = "its filament.lights is not 42 numbers of lights";
        if (!numbersIn(lights, numbers)) return false;
        const std::optional<EnvironmentLights> read = lightsFrom(numbers);
        if (read) mData.lights = *read;
        return read && read->search != SunSearch::Off;
    }

    /// The file itself, or the one in a value.
    Result<void> readPart(std::string_view key, Image& cube) {
        if (key.empty()) return readCube(mFile, "its texture", cube);
        const auto bytes = mFile.value(key);
        if (!bytes && key == kIrradianceKey) return {};
        if (!bytes) return damaged(fmt::format("it has no {}", key));
        const Result<Ktx2File> inner = readKtx2(*bytes, key);
        if (!inner) return damaged(fmt::format("its {} is no KTX 2.0 file that can be read", key));
        return readCube(*inner, key, cube);
    }

    Result<void> readCube(Ktx2File const& file, std::string_view what, Image& cube) {
        const auto format = formatOfVkFormat(file.format);
        if (!format || !isEnvironmentFormat(*format))
            return damaged(fmt::format("{} has VkFormat {}", what, file.format));
        if (!file.isCube || file.isArray || !std::has_single_bit(file.width) || file.width > kMaxPackageFace)
            return damaged(
                    fmt::format("{} is no cube with a power of two up to {} texels a side", what, kMaxPackageFace));
        if (file.isFlippedX || file.isFlippedY || file.swizzle != std::array{ 'r', 'g', 'b', 'a' })
            return damaged(fmt::format("{} is flipped or swizzled", what));
        if (file.compression == Ktx2Compression::BasisLz) return damaged(fmt::format("{} is BasisLZ", what));
        const auto levels = static_cast<uint32_t>(file.levels.size());
        Image read{ file.width, file.height, 6, levels, *format, {} };
        for (uint32_t level = 0; level < levels; ++level) {
            if (!checkLevel(file, level, read.levelBytes(level), mName))
                return damaged(fmt::format("level {} of {} has another length", level, what));
        }
        read.data.resize(read.levelOffset(levels));
        std::vector<std::byte> buffer;
        for (uint32_t level = 0; level < levels; ++level) {
            const auto plain = inflatedLevel(file, level, read.levelBytes(level), mName, buffer);
            if (!plain) return damaged(fmt::format("level {} of {} cannot be unpacked", level, what));
            std::ranges::copy(*plain, read.data.begin() + static_cast<std::ptrdiff_t>(read.levelOffset(level)));
        }
        if (!isRadiance(*format, read.data)) return damaged(fmt::format("{} holds numbers that are no light", what));
        cube = std::move(read);
        return {};
    }

    Ktx2File const& mFile;
    std::string_view mName;
    EnvironmentData mData;
    const char* mReason = "";
    std::span<const std::byte> mNothing;
};

} // namespace

bool isEnvironmentPackage(Ktx2File const& file) { return file.value(kLayoutKey).has_value(); }

std::vector<std::byte> encodeEnvironmentPackage(EnvironmentData const& data) {
    FILAMENT_ASSERT(data.worldFromCube == float3x3(1.0f), "an environment package holds no rotation");
    const std::string sh = shText(data.irradianceSh), picture = pictureText(data.statistics);
    const auto mapping = std::ranges::find(kMappingNames, data.mapping, [](auto const& pair) { return pair.first; });
    FILAMENT_ASSERT(mapping != kMappingNames.end(), "an environment has one of the known mappings");
    const std::vector<std::byte> skybox = encodeKtx2(data.sky);
    const bool hasLights = data.lights.search != SunSearch::Off;
    const std::string lights = lightsText(data.lights);
    std::vector<Ktx2Value> values{ ktx2Text("KTXwriter", "filament_core cmgen"),
                                   ktx2Text(kLayoutKey, hasLights ? kLayoutWithLights : kLayoutVersion),
                                   ktx2Text(kMappingKey, mapping->second),
                                   ktx2Text(kShKey, sh.c_str()),
                                   ktx2Text(kPictureKey, picture.c_str()),
                                   { kSkyboxKey, skybox } };
    if (hasLights) values.push_back(ktx2Text(kLightsKey, lights.c_str()));
    std::vector<std::byte> irradiance;
    if (!data.irradiance.data.empty()) {
        irradiance = encodeKtx2(data.irradiance);
        values.push_back({ kIrradianceKey, irradiance });
    }
    return encodeKtx2(data.specular, values);
}

Result<EnvironmentData> decodeEnvironmentPackage(Ktx2File const& file, std::string_view name) {
    return PackageReader(file, name).read();
}

} // namespace filament_core::assets
