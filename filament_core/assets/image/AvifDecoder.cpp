// SPDX-License-Identifier: Apache-2.0
// AVIF: libavif reads the file and AV1 defines the decoded codes bit for bit. Conversion to RGB is our own: that of
// libavif goes through libyuv, whose rounding depends on the processor.
//   Sources  AVIF 1.1; MIAF (ISO/IEC 23000-22), 7.3.6.7: order of transformations; ITU-T H.273, 8.3: coefficients and
//            ranges
#include "filament_core/assets/image/AvifMirror.h"
#include "filament_core/assets/image/ImageDecoder.h"

#include <avif/avif.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace filament_core::assets {
namespace {

/// While decoding, a pixel has up to 8 bytes here and as many in the codec.
constexpr uint32_t kMaxAvifPixels = 1u << 26;

struct AvifDecoderEnds {
    void operator()(avifDecoder* decoder) const { avifDecoderDestroy(decoder); }
};
using AvifDecoderPointer = std::unique_ptr<avifDecoder, AvifDecoderEnds>;

Error avifFailure(avifResult result, std::string_view name) {
    if (result == AVIF_RESULT_OUT_OF_MEMORY)
        return fail(ErrorCode::OutOfMemory, "image '{}' cannot be decoded: out of memory; make it smaller", name);
    return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {}; export it again", name,
                avifResultToString(result));
}

Error avifRefusal(std::string_view name, std::string_view what) {
    return fail(ErrorCode::Unsupported, "image '{}' {}", name, what);
}

/// The header of the file; nothing is decoded.
Result<AvifDecoderPointer> parseAvif(std::span<const std::byte> bytes, std::string_view name) {
    AvifDecoderPointer decoder(avifDecoderCreate());
    if (!decoder) return avifFailure(AVIF_RESULT_OUT_OF_MEMORY, name);
    decoder->maxThreads = 1; // images are decoded side by side already
    decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
    decoder->imageSizeLimit = kMaxAvifPixels;
    decoder->imageDimensionLimit = kMaxImageSide;
    decoder->imageCountLimit = 1u << 16;
    decoder->strictFlags &= ~static_cast<avifStrictFlags>(AVIF_STRICT_PIXI_REQUIRED); // many writers leave it out
    avifResult result =
            avifDecoderSetIOMemory(decoder.get(), reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
    if (result == AVIF_RESULT_OK) result = avifDecoderParse(decoder.get());
    if (result != AVIF_RESULT_OK) return avifFailure(result, name);
    return decoder;
}

/// The weights of red and blue in luma; nothing for matrices that are not of this kind. H.273, table 4.
std::optional<std::pair<double, double>> lumaWeights(avifMatrixCoefficients matrix) {
    switch (matrix) {
    case AVIF_MATRIX_COEFFICIENTS_BT709:
        return std::pair(0.2126, 0.0722);
    case AVIF_MATRIX_COEFFICIENTS_FCC:
        return std::pair(0.30, 0.11);
    case AVIF_MATRIX_COEFFICIENTS_UNSPECIFIED: // MIAF 7.3.6.4: BT.601
    case AVIF_MATRIX_COEFFICIENTS_BT470BG:
    case AVIF_MATRIX_COEFFICIENTS_BT601:
        return std::pair(0.299, 0.114);
    case AVIF_MATRIX_COEFFICIENTS_SMPTE240:
        return std::pair(0.212, 0.087);
    case AVIF_MATRIX_COEFFICIENTS_BT2020_NCL:
        return std::pair(0.2627, 0.0593);
    default:
        return std::nullopt;
    }
}

/// Reasons in the header to reject an image.
Result<void> checkAvif(avifDecoder const& decoder, std::string_view name) {
    avifImage const& image = *decoder.image;
    if (decoder.imageCount != 1) return avifRefusal(name, "is an animation; export one picture of it");
    if (image.alphaPremultiplied)
        return avifRefusal(name, "has colours that are multiplied by alpha; export it with straight alpha");
    if (image.transformFlags & AVIF_TRANSFORM_CLAP)
        return avifRefusal(name, "is cropped by its clean aperture; export it cropped");
    const int primaries = image.colorPrimaries, transfer = image.transferCharacteristics;
    const bool isSrgb =
            (primaries == AVIF_COLOR_PRIMARIES_BT709 || primaries == AVIF_COLOR_PRIMARIES_UNSPECIFIED) &&
            (transfer == AVIF_TRANSFER_CHARACTERISTICS_SRGB || transfer == AVIF_TRANSFER_CHARACTERISTICS_BT709 ||
             transfer == AVIF_TRANSFER_CHARACTERISTICS_UNSPECIFIED);
    if (!isSrgb)
        return avifRefusal(name, fmt::format("has colour primaries {} and transfer characteristics {}, not those of "
                                             "sRGB; export it as sRGB (CICP 1/13), or light as .exr",
                                             primaries, transfer));
    const int matrix = image.matrixCoefficients;
    if (!lumaWeights(image.matrixCoefficients) && matrix != AVIF_MATRIX_COEFFICIENTS_IDENTITY &&
        matrix != AVIF_MATRIX_COEFFICIENTS_YCGCO)
        return avifRefusal(name, fmt::format("has matrix coefficients {}, which are not read; export it with those of "
                                             "BT.601 or BT.709",
                                             matrix));
    return {};
}

uint2 orientedSize(avifImage const& image) {
    const bool isTurned = (image.transformFlags & AVIF_TRANSFORM_IROT) && image.irot.angle % 2 == 1;
    return isTurned ? uint2(image.height, image.width) : uint2(image.width, image.height);
}

/// The place in the planes that a pixel of the result shows: planes are first turned anticlockwise, then mirrored.
uint2 placeInPlanes(avifImage const& image, uint2 pixel) {
    const uint2 size = orientedSize(image);
    if (image.transformFlags & AVIF_TRANSFORM_IMIR) {
        if (mirrorOf(image.imir) == 0)
            pixel.y = size.y - 1 - pixel.y; // top and bottom change places
        else
            pixel.x = size.x - 1 - pixel.x;
    }
    const uint32_t right = image.width - 1, bottom = image.height - 1;
    switch (image.transformFlags & AVIF_TRANSFORM_IROT ? image.irot.angle : 0) {
    case 1:
        return { right - pixel.y, pixel.x };
    case 2:
        return { right - pixel.x, bottom - pixel.y };
    case 3:
        return { pixel.y, bottom - pixel.x };
    default:
        return pixel;
    }
}

/// Luma and chroma of one decoded image as red, green and blue in [0, 1]. Only additions, multiplications and
/// divisions of doubles: the same bits on every processor.
class AvifColors {
public:
    explicit AvifColors(avifImage const& image)
            : mImage(image), mMatrix(image.matrixCoefficients), mMost((1u << image.depth) - 1.0),
              mHalf(1u << (image.depth - 1)) {
        const double step = 1u << (image.depth - 8);
        const bool isLimited = image.yuvRange == AVIF_RANGE_LIMITED;
        mLumaLeast = isLimited ? 16 * step : 0, mLumaSpan = isLimited ? 219 * step : mMost;
        mChromaSpan = isLimited ? 224 * step : mMost;
        mIsHalfWide = image.yuvFormat == AVIF_PIXEL_FORMAT_YUV420 || image.yuvFormat == AVIF_PIXEL_FORMAT_YUV422;
        mIsHalfHigh = image.yuvFormat == AVIF_PIXEL_FORMAT_YUV420;
        if (const auto weights = lumaWeights(mMatrix)) mRed = weights->first, mBlue = weights->second;
    }

    std::array<double, 3> at(uint2 place) const {
        const double y = (code(AVIF_CHAN_Y, place) - mLumaLeast) / mLumaSpan;
        if (mImage.yuvFormat == AVIF_PIXEL_FORMAT_YUV400) return { y, y, y };
        const uint32_t u = chroma16(AVIF_CHAN_U, place), v = chroma16(AVIF_CHAN_V, place);
        if (mMatrix == AVIF_MATRIX_COEFFICIENTS_IDENTITY) // green, blue, red
            return { (v / 16.0 - mLumaLeast) / mLumaSpan, y, (u / 16.0 - mLumaLeast) / mLumaSpan };
        const double cb = (u / 16.0 - mHalf) / mChromaSpan, cr = (v / 16.0 - mHalf) / mChromaSpan;
        if (mMatrix == AVIF_MATRIX_COEFFICIENTS_YCGCO) return { y - cb + cr, y + cb, y - cb - cr };
        const double red = y + 2 * (1 - mRed) * cr, blue = y + 2 * (1 - mBlue) * cb;
        return { red, (y - mRed * red - mBlue * blue) / (1 - mRed - mBlue), blue };
    }

    /// [0, 1]; 1 without alpha.
    double alphaAt(uint2 place) const {
        return mImage.alphaPlane ? sample(mImage.alphaPlane, mImage.alphaRowBytes, place) / mMost : 1.0;
    }

private:
    uint32_t sample(const uint8_t* plane, size_t rowBytes, uint2 at) const {
        const uint8_t* const row = plane + rowBytes * at.y;
        if (mImage.depth == 8) return row[at.x];
        uint16_t value;
        std::memcpy(&value, row + 2 * size_t{ at.x }, sizeof(value));
        return std::min<uint32_t>(value, (1u << mImage.depth) - 1);
    }
    uint32_t code(avifChannelIndex channel, uint2 at) const {
        return sample(mImage.yuvPlanes[channel], mImage.yuvRowBytes[channel], at);
    }

    /// 16 times the chroma of a pixel. Samples lie in the middle of the pixels that they are for, and are interpolated
    /// with the weights 9, 3, 3 and 1, as libavif and most decoders of JPEG do.
    uint32_t chroma16(avifChannelIndex channel, uint2 at) const {
        const auto [x0, x1] = neighbours(at.x, mIsHalfWide, mImage.width);
        const auto [y0, y1] = neighbours(at.y, mIsHalfHigh, mImage.height);
        return 9 * code(channel, { x0, y0 }) + 3 * code(channel, { x1, y0 }) + 3 * code(channel, { x0, y1 }) +
               code(channel, { x1, y1 });
    }
    static std::pair<uint32_t, uint32_t> neighbours(uint32_t at, bool isHalf, uint32_t size) {
        if (!isHalf) return { at, at };
        const uint32_t own = at / 2, last = (size + 1) / 2 - 1;
        return { own, at % 2 == 1 ? std::min(own + 1, last) : own - std::min(own, 1u) };
    }

    avifImage const& mImage;
    avifMatrixCoefficients mMatrix;
    double mMost, mHalf, mLumaLeast = 0, mLumaSpan = 1, mChromaSpan = 1, mRed = 0, mBlue = 0;
    bool mIsHalfWide = false, mIsHalfHigh = false;
};

/// Calls write(code of red, green, blue, alpha) for each pixel, row by row; `most` stands for 1.
template <class Write>
void forEachAvifPixel(avifImage const& image, double most, Write&& write) {
    const AvifColors colors(image);
    const uint2 size = orientedSize(image);
    const auto code = [&](double share) { return static_cast<uint32_t>(std::clamp(share, 0.0, 1.0) * most + 0.5); };
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const uint2 place = placeInPlanes(image, { x, y });
            const auto [red, green, blue] = colors.at(place);
            for (const double share : { red, green, blue, colors.alphaAt(place) }) write(code(share));
        }
    }
}

/// All planes, in the size that the header states.
Result<AvifDecoderPointer> decodePlanes(std::span<const std::byte> bytes, std::string_view name) {
    Result<AvifDecoderPointer> decoder = parseAvif(bytes, name);
    if (!decoder) return decoder;
    if (Result<void> checked = checkAvif(**decoder, name); !checked) return checked.error();
    const uint2 stated((*decoder)->image->width, (*decoder)->image->height);
    if (const avifResult result = avifDecoderNextImage(decoder->get()); result != AVIF_RESULT_OK)
        return avifFailure(result, name);
    avifImage const& image = *(*decoder)->image;
    const bool hasColor = image.yuvFormat != AVIF_PIXEL_FORMAT_YUV400;
    const bool isWhole = image.yuvPlanes[AVIF_CHAN_Y] &&
                         (!hasColor || (image.yuvPlanes[AVIF_CHAN_U] && image.yuvPlanes[AVIF_CHAN_V])) &&
                         (image.depth == 8 || image.depth == 10 || image.depth == 12);
    if (!isWhole || uint2(image.width, image.height) != stated)
        return avifFailure(AVIF_RESULT_DECODE_COLOR_FAILED, name);
    return decoder; // the AV1 data may contradict the header: what counts was checked, and is checked again
}

} // namespace

bool isAvif(std::span<const std::byte> bytes) { // ISO/IEC 14496-12, 4.3: the brand, or one of the compatible ones
    constexpr size_t kFirstBrand = 8, kMinorVersion = 12;
    if (bytes.size() < 16 || std::memcmp(bytes.data() + 4, "ftyp", 4) != 0) return false;
    size_t size = 0;
    for (size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<size_t>(bytes[i]);
    for (size_t at = kFirstBrand; at + 4 <= std::min(size, bytes.size()); at += 4) {
        if (at == kMinorVersion) continue;
        if (std::memcmp(bytes.data() + at, "avif", 4) == 0 || std::memcmp(bytes.data() + at, "avis", 4) == 0)
            return true;
    }
    return false;
}

uint2 avifSize(std::span<const std::byte> bytes) {
    const Result<AvifDecoderPointer> decoder = parseAvif(bytes, "");
    return decoder ? orientedSize(*(*decoder)->image) : uint2(0);
}

std::vector<std::byte> avifProfile(std::span<const std::byte> bytes) {
    const Result<AvifDecoderPointer> decoder = parseAvif(bytes, "");
    if (!decoder) return {};
    avifRWData const& icc = (*decoder)->image->icc;
    auto const* const first = reinterpret_cast<const std::byte*>(icc.data);
    return { first, first + icc.size };
}

bool isDeepAvif(std::span<const std::byte> bytes) {
    if (!isAvif(bytes)) return false;
    const Result<AvifDecoderPointer> decoder = parseAvif(bytes, "");
    return decoder && (*decoder)->image->depth > 8;
}

Result<Image> decodeAvif(std::span<const std::byte> bytes, std::string_view name) {
    const Result<AvifDecoderPointer> decoder = decodePlanes(bytes, name);
    if (!decoder) return decoder.error();
    const uint2 size = orientedSize(*(*decoder)->image);
    Image image;
    image.width = size.x, image.height = size.y;
    image.data.reserve(image.levelBytes(0));
    forEachAvifPixel(*(*decoder)->image, 255,
                     [&](uint32_t code) { image.data.push_back(static_cast<std::byte>(code)); });
    return image;
}

Result<DeepImage> decodeDeepAvif(std::span<const std::byte> bytes, std::string_view name) {
    const Result<AvifDecoderPointer> decoder = decodePlanes(bytes, name);
    if (!decoder) return decoder.error();
    const uint2 size = orientedSize(*(*decoder)->image);
    DeepImage image{ .width = size.x, .height = size.y, .codes = {} };
    image.codes.reserve(size_t{ 4 } * size.x * size.y);
    forEachAvifPixel(*(*decoder)->image, 65535,
                     [&](uint32_t code) { image.codes.push_back(static_cast<uint16_t>(code)); });
    return image;
}

} // namespace filament_core::assets
