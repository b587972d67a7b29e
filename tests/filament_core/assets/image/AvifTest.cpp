// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/assets/image/AvifFile.h"

#include "filament_core/assets/image/AvifMirror.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/ImageSize.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"

#include <gmock/gmock.h>

#include <cstring>

namespace filament_core::assets {
namespace {

using test::AvifFile;
using testing::HasSubstr;

Image decodedAvif(AvifFile const& file) {
    Result<Image> image = decodeImage(file.file(), "a.avif");
    EXPECT_TRUE(image) << image.error().message;
    return image ? std::move(*image) : Image{};
}

std::string refusedAvif(AvifFile const& file) {
    const Result<Image> image = decodeImage(file.file(), "a.avif");
    EXPECT_FALSE(image);
    if (image) return {};
    EXPECT_EQ(image.error().code, ErrorCode::Unsupported);
    return image.error().message;
}

uint32_t avifCode(Image const& image, uint32_t x, uint32_t y, uint32_t channel) {
    return std::to_integer<uint32_t>(image.data[4 * (size_t{ y } * image.width + x) + channel]);
}

TEST(Avif, TheIdentityMatrixKeepsEveryCode) {
    const AvifFile file{ .width = 7, .height = 5, .hasAlpha = true };
    const Image image = decodedAvif(file);
    ASSERT_EQ(uint2(image.width, image.height), uint2(7, 5));
    EXPECT_EQ(imageSize(file.file()), uint2(7, 5));
    for (uint32_t y = 0; y < 5; ++y) {
        for (uint32_t x = 0; x < 7; ++x) {
            const std::array<uint32_t, 4> planes{ 2, 0, 1, 3 }; // red, green, blue, alpha
            for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(avifCode(image, x, y, c), file.code(planes[c], { x, y }));
        }
    }
}

TEST(Avif, WithoutAlphaItIsOpaqueAndGreyIsCopied) {
    const AvifFile file{ .format = AVIF_PIXEL_FORMAT_YUV400, .matrix = AVIF_MATRIX_COEFFICIENTS_BT601 };
    const Image image = decodedAvif(file);
    for (uint32_t c = 0; c < 3; ++c) EXPECT_EQ(avifCode(image, 2, 3, c), file.code(0, { 2, 3 }));
    EXPECT_EQ(avifCode(image, 2, 3, 3), 255u);
}

/// The conversion that libavif itself has, in single precision.
std::vector<uint8_t> libavifPixels(AvifFile const& file) {
    const AvifFile::Image image = file.image();
    avifRGBImage rgb;
    avifRGBImageSetDefaults(&rgb, image.get());
    rgb.depth = 8, rgb.chromaUpsampling = AVIF_CHROMA_UPSAMPLING_BILINEAR, rgb.avoidLibYUV = AVIF_TRUE;
    std::vector<uint8_t> pixels(size_t{ 4 } * file.width * file.height);
    rgb.pixels = pixels.data(), rgb.rowBytes = 4 * file.width;
    EXPECT_EQ(avifImageYUVToRGB(image.get(), &rgb), AVIF_RESULT_OK);
    return pixels;
}

// A second implementation: ours rounds exactly, libavif's may be one off.
TEST(Avif, EveryMatrixRangeSubsamplingAndDepthIsThatOfLibavif) {
    for (const avifMatrixCoefficients matrix :
         { AVIF_MATRIX_COEFFICIENTS_BT601, AVIF_MATRIX_COEFFICIENTS_BT709, AVIF_MATRIX_COEFFICIENTS_UNSPECIFIED,
           AVIF_MATRIX_COEFFICIENTS_SMPTE240, AVIF_MATRIX_COEFFICIENTS_BT2020_NCL }) {
        for (const avifRange range : { AVIF_RANGE_FULL, AVIF_RANGE_LIMITED }) {
            for (const avifPixelFormat format :
                 { AVIF_PIXEL_FORMAT_YUV444, AVIF_PIXEL_FORMAT_YUV422, AVIF_PIXEL_FORMAT_YUV420 }) {
                for (const uint32_t depth : { 8u, 10u, 12u }) {
                    const AvifFile file{ .width = 9,
                                         .height = 7,
                                         .depth = depth,
                                         .format = format,
                                         .range = range,
                                         .matrix = matrix,
                                         .code = [depth](uint32_t plane, uint2 at) {
                                             const uint32_t code = plane == 0 ? 40 + 17 * at.x + 5 * at.y
                                                                              : 110 + 5 * at.x * plane + at.y;
                                             return code << (depth - 8);
                                         } };
                    const Image image = decodedAvif(file);
                    const std::vector<uint8_t> expected = libavifPixels(file);
                    ASSERT_EQ(image.data.size(), expected.size());
                    for (size_t i = 0; i < expected.size(); ++i)
                        ASSERT_NEAR(std::to_integer<int>(image.data[i]), expected[i], 1)
                                << "matrix " << matrix << " range " << range << " format " << format << " depth "
                                << depth << " byte " << i;
                }
            }
        }
    }
}

TEST(Avif, MoreThan8BitsReachLoadImage) {
    for (const uint32_t depth : { 10u, 12u }) {
        const AvifFile file{ .depth = depth,
                             .code = [](uint32_t plane, uint2 at) { return 300 * plane + at.x + 4 * at.y + 1; } };
        const Result<Image> data = decodePicture(file.file(), "a.avif", { .isColor = false, .isFull = true });
        ASSERT_TRUE(data) << data.error().message;
        EXPECT_EQ(data->format, backend::Format::RGBA32F);
        for (uint32_t i = 0; i < 16; ++i) {
            float green = 0;
            std::memcpy(&green, &data->data[16 * i + 4], sizeof(green));
            const float exact =
                    static_cast<float>(file.code(0, { i % 4, i / 4 })) / static_cast<float>((1 << depth) - 1);
            EXPECT_NEAR(green, exact, 0.5f / 65535) << depth;
        }
    }
}

TEST(Avif, TurnsAndMirrorsAsTheFileSays) {
    // Where the top left pixel of the planes is seen, of 3 x 2 pixels; HEIF: first turned anticlockwise, then mirrored.
    struct Case {
        int angle, mirror; ///< quarter turns; -1, 0: top and bottom change places, 1: left and right
        uint2 size, seen;
    };
    const Case cases[] = { { 0, -1, { 3, 2 }, { 0, 0 } }, { 1, -1, { 2, 3 }, { 0, 2 } }, { 2, -1, { 3, 2 }, { 2, 1 } },
                           { 3, -1, { 2, 3 }, { 1, 0 } }, { 0, 0, { 3, 2 }, { 0, 1 } },  { 0, 1, { 3, 2 }, { 2, 0 } },
                           { 1, 0, { 2, 3 }, { 0, 0 } },  { 1, 1, { 2, 3 }, { 1, 2 } },  { 3, 0, { 2, 3 }, { 1, 2 } } };
    for (Case const& one : cases) {
        const AvifFile file{ .width = 3,
                             .height = 2,
                             .change =
                                     [&](avifImage& image) {
                                         if (one.angle) image.transformFlags |= AVIF_TRANSFORM_IROT;
                                         if (one.mirror >= 0) image.transformFlags |= AVIF_TRANSFORM_IMIR;
                                         image.irot.angle = static_cast<uint8_t>(one.angle);
                                         mirrorOf(image.imir) = static_cast<uint8_t>(std::max(one.mirror, 0));
                                     },
                             .code = [](uint32_t, uint2 at) { return at == uint2(0) ? 200u : 10u; } };
        const Image image = decodedAvif(file);
        ASSERT_EQ(uint2(image.width, image.height), one.size);
        EXPECT_EQ(imageSize(file.file()), one.size);
        for (uint32_t y = 0; y < one.size.y; ++y) {
            for (uint32_t x = 0; x < one.size.x; ++x)
                EXPECT_EQ(avifCode(image, x, y, 0), uint2(x, y) == one.seen ? 200u : 10u)
                        << one.angle << ' ' << one.mirror << ": " << x << ' ' << y;
        }
    }
}

TEST(Avif, WhatIsNotReadSaysSoAndWhatToExport) {
    EXPECT_THAT(refusedAvif({ .primaries = AVIF_COLOR_PRIMARIES_BT2020 }),
                HasSubstr("image 'a.avif' has colour primaries 9 and transfer characteristics 13"));
    EXPECT_THAT(refusedAvif({ .depth = 10, .transfer = AVIF_TRANSFER_CHARACTERISTICS_SMPTE2084 }),
                HasSubstr("transfer characteristics 16, not those of sRGB; export it as sRGB"));
    EXPECT_THAT(refusedAvif({ .hasAlpha = true, .isPremultiplied = true }), HasSubstr("straight alpha"));
    EXPECT_THAT(refusedAvif({ .pictures = 3 }), HasSubstr("is an animation"));
    EXPECT_THAT(refusedAvif({ .change =
                                      [](avifImage& image) {
                                          image.transformFlags |= AVIF_TRANSFORM_CLAP;
                                          image.clap = { 2, 1, 2, 1, 0, 1, 0, 1 };
                                      } }),
                HasSubstr("export it cropped"));
}

TEST(Avif, EveryTruncationIsAnErrorThatNamesThePicture) {
    const std::vector<std::byte> file = AvifFile{ .width = 20, .height = 12, .hasAlpha = true }.file();
    for (size_t length = 32; length < file.size(); ++length) {
        const Result<Image> image = decodeImage(std::span(file).first(length), "a.avif");
        ASSERT_FALSE(image) << length << " of " << file.size();
        EXPECT_THAT(image.error().message, HasSubstr("image 'a.avif' "));
    }
}

TEST(Avif, EverySingleBitOfDamageIsAnErrorOrAPicture) {
    std::vector<std::byte> file = AvifFile{ .hasAlpha = true }.file();
    size_t pictures = 0;
    for (size_t bit = 0; bit < file.size() * 8; ++bit) {
        file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        pictures += test::fuzzImage(file);
        file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    }
    EXPECT_GT(pictures, 0u);
}

// 40000 x 40000 pixels would be 6 GiB; what the header states is refused before anything is decoded.
TEST(Avif, APictureThatIsTooLargeIsRefusedByItsHeader) {
    std::vector<std::byte> file = AvifFile{}.file();
    const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    const size_t ispe = text.find("ispe");
    ASSERT_NE(ispe, std::string::npos);
    for (const size_t at : { ispe + 8, ispe + 12 }) file[at + 2] = std::byte{ 0x9C }; // 4 -> 39940
    const Result<Image> image = decodeImage(file, "a.avif");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("image 'a.avif' "));
}

} // namespace
} // namespace filament_core::assets
