// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/HdrReader.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/HdrDecoders.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

namespace filament_core::assets {
namespace {

Result<DecodedHdr> decodeByContent(std::span<const std::byte> bytes, HdrPart part) {
    if (isExr(bytes)) return decodeExr(bytes, part);
    if (isRgbe(bytes)) return decodeRgbe(bytes, part);
    return fail(ErrorCode::Unsupported, "it is neither Radiance .hdr nor OpenEXR");
}

const char* cureOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::Unsupported:
        return "save it as RGBE .hdr or as an .exr of one part";
    case ErrorCode::OutOfMemory:
        return "make it smaller";
    default:
        return "export or copy it again";
    }
}

/// Programs write zeros for what they do not know.
bool isUnknown(Chromaticities const& space) {
    const double2 none(0);
    return space.red == none && space.green == none && space.blue == none && space.white == none;
}

/// Of colours that are not those of Rec. 709 already.
std::optional<double3x3> conversionOf(DecodedHdr& decoded) {
    constexpr double kFourDigits = 5e-4; // as files write them
    if (!decoded.primaries || isRec709(*decoded.primaries, kFourDigits) || isUnknown(*decoded.primaries))
        return std::nullopt;
    const std::optional<double3x3> matrix = rec709FromRgb(*decoded.primaries);
    if (!matrix)
        decoded.image.warnings.emplace_back(
                "its primaries are not those of colours and are taken as those of Rec. 709; "
                "correct PRIMARIES or chromaticities");
    return matrix;
}

float repaired(float value, float largestReal, HdrRepairs& repairs) {
    if (std::isnan(value)) {
        ++repairs.notANumber;
        return 0;
    }
    if (value < 0) {
        ++repairs.negative;
        return 0;
    }
    if (value > kMaxRadiance) {
        ++repairs.infinite;
        return largestReal;
    }
    return value;
}

} // namespace

std::optional<Error> checkHdrSize(int64_t width, int64_t height) {
    if (width >= 1 && height >= 1 && width <= kMaxHdrSide && height <= kMaxHdrSide &&
        static_cast<uint64_t>(width) * static_cast<uint64_t>(height) <= kMaxHdrPixels) {
        return std::nullopt;
    }
    return fail(ErrorCode::Unsupported, "its size {} x {} is not within 1 and {} pixels per side and {} in all", width,
                height, kMaxHdrSide, kMaxHdrPixels);
}

void sanitise(HdrImage& image) {
    float largest = 0;
    for (float3 const& pixel : image.pixels) {
        for (const float value : { pixel.x, pixel.y, pixel.z }) {
            if (value <= kMaxRadiance) largest = std::max(largest, value);
        }
    }
    for (float3& pixel : image.pixels) {
        pixel = { repaired(pixel.x, largest, image.repairs), repaired(pixel.y, largest, image.repairs),
                  repaired(pixel.z, largest, image.repairs) };
    }
}

void convertToRec709(HdrImage& image, double3x3 const& rec709FromFile) {
    for (float3& pixel : image.pixels) {
        const double3 color = rec709FromFile * double3(pixel);
        for (int c = 0; c < 3; ++c) {
            if (color[c] < 0) ++image.repairs.negative;
            pixel[c] = static_cast<float>(std::clamp(color[c], 0.0, static_cast<double>(kMaxRadiance)));
        }
    }
}

bool isHdrImage(std::span<const std::byte> bytes) { return isExr(bytes) || isRgbe(bytes); }

Result<HdrImage> decodeHdrImage(std::span<const std::byte> bytes, std::string_view name) try {
    Result<DecodedHdr> decoded = decodeByContent(bytes, HdrPart::All);
    if (!decoded) {
        const ErrorCode code = decoded.error().code;
        return fail(code, "cannot decode '{}': {}; {}", name, decoded.error().message, cureOf(code));
    }
    sanitise(decoded->image);
    if (const auto matrix = conversionOf(*decoded)) convertToRec709(decoded->image, *matrix);
    return std::move(decoded->image);
} catch (std::bad_alloc const&) {
    return fail(ErrorCode::OutOfMemory, "cannot decode '{}': not enough memory; {}", name,
                cureOf(ErrorCode::OutOfMemory));
} catch (std::exception const& exception) { // thrown by a library's parser: std::out_of_range etc.
    return fail(ErrorCode::Corrupt, "cannot decode '{}': {}; {}", name, exception.what(), cureOf(ErrorCode::Corrupt));
}

HdrImage readHdrHeader(std::span<const std::byte> bytes) {
    Result<DecodedHdr> decoded = decodeByContent(bytes, HdrPart::Header);
    if (!decoded) return {};
    conversionOf(*decoded);
    return std::move(decoded->image);
}

Result<HdrImage> readHdrImage(std::filesystem::path const& path) {
    Result<std::vector<std::byte>> bytes = readFileBytes(path);
    if (!bytes) return bytes.error();
    return decodeHdrImage(*bytes, path.string());
}

} // namespace filament_core::assets
