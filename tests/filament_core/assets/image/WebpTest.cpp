// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/ImageSize.h"
#include "filament_core/assets/image/PictureDecoder.h"

#include <gmock/gmock.h>

#include <webp/encode.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace filament_core::assets {
namespace {

using testing::HasSubstr;

/// A smooth image with all kinds of alpha.
std::vector<uint8_t> webpPixels(uint32_t width, uint32_t height) {
    std::vector<uint8_t> pixels;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            for (const uint32_t value : { 3 * x + y, 255 - 2 * y, 128 + x - y, 255 - x * y % 256 })
                pixels.push_back(static_cast<uint8_t>(value & 255));
        }
    }
    return pixels;
}

std::vector<std::byte> webpFile(uint32_t width, uint32_t height, float quality) { // below 0: lossless
    const std::vector<uint8_t> pixels = webpPixels(width, height);
    uint8_t* bytes = nullptr;
    const int w = static_cast<int>(width), h = static_cast<int>(height);
    const size_t size = quality < 0 ? WebPEncodeLosslessRGBA(pixels.data(), w, h, 4 * w, &bytes)
                                    : WebPEncodeRGBA(pixels.data(), w, h, 4 * w, quality, &bytes);
    const auto* const first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> file(first, first + size);
    WebPFree(bytes);
    return file;
}

TEST(Webp, ALosslessPictureHasThePixelsThatWereWritten) {
    const std::vector<std::byte> file = webpFile(19, 13, -1);
    const Result<Image> image = decodeImage(file, "a.webp");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(uint2(image->width, image->height), uint2(19, 13));
    EXPECT_EQ(imageSize(file), uint2(19, 13));
    const std::vector<uint8_t> pixels = webpPixels(19, 13);
    for (size_t i = 0; i < pixels.size(); i += 4) {
        if (pixels[i + 3] == 0) continue; // the encoder drops invisible colours
        EXPECT_EQ(std::memcmp(&image->data[i], &pixels[i], 4), 0) << i / 4;
    }
}

TEST(Webp, ALossyPictureIsCloseToWhatWasWritten) {
    const Result<Image> image = decodeImage(webpFile(64, 48, 95), "a.webp");
    ASSERT_TRUE(image) << image.error().message;
    const std::vector<uint8_t> pixels = webpPixels(64, 48);
    double sum = 0;
    for (size_t i = 0; i < pixels.size(); i += 4) {
        sum += std::abs(std::to_integer<int>(image->data[i + 1]) - pixels[i + 1]);
        EXPECT_EQ(image->data[i + 3], std::byte{ pixels[i + 3] }) << "alpha is lossless";
    }
    EXPECT_LT(sum / (64 * 48), 3);
}

TEST(Webp, LoadImageReadsItAsColoursOrData) {
    const std::vector<std::byte> file = webpFile(5, 4, -1);
    const Result<Image> color = decodePicture(file, "a.webp"),
                        data = decodePicture(file, "a.webp", { .isColor = false });
    ASSERT_TRUE(color && data);
    EXPECT_EQ(color->format, backend::Format::RGBA8Srgb);
    EXPECT_EQ(data->format, backend::Format::RGBA8);
    EXPECT_EQ(color->data, data->data);
}

TEST(Webp, EveryTruncationIsAnErrorThatNamesThePicture) {
    for (const float quality : { -1.0f, 80.0f }) {
        const std::vector<std::byte> file = webpFile(24, 20, quality);
        for (size_t length = 12; length + 1 < file.size(); ++length) { // the last byte may be padding
            const Result<Image> image = decodeImage(std::span(file).first(length), "a.webp");
            ASSERT_FALSE(image) << length << " of " << file.size();
            EXPECT_THAT(image.error().message, HasSubstr("image 'a.webp' cannot be decoded: "));
        }
    }
}

TEST(Webp, EverySingleBitOfDamageIsAnErrorOrAPicture) {
    std::vector<std::byte> file = webpFile(16, 16, 80);
    for (size_t bit = 0; bit < file.size() * 8; ++bit) {
        if (bit / 8 >= 20 && bit / 8 < 40) continue; // sizes: only slow
        file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        if (const Result<Image> image = decodeImage(file, "a.webp"); image)
            EXPECT_EQ(image->data.size(), image->levelBytes(0));
        else
            EXPECT_THAT(image.error().message, HasSubstr("image 'a.webp' "));
        file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    }
}

TEST(Webp, AnimationsAreNotRead) {
    std::vector<std::byte> file = webpFile(8, 8, -1);
    // an extended header (VP8X) whose flags say animation: WebP Container Specification
    const std::array<uint8_t, 18> header{ 'V', 'P', '8', 'X', 10, 0, 0, 0, 2, 0, 0, 0, 7, 0, 0, 7, 0, 0 };
    const auto bytes = std::as_bytes(std::span(header));
    file.insert(file.begin() + 12, bytes.begin(), bytes.end());
    const auto riffSize = static_cast<uint32_t>(file.size() - 8);
    std::memcpy(&file[4], &riffSize, 4);
    const Result<Image> image = decodeImage(file, "a.webp");
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().message, "image 'a.webp' is an animation; export one picture of it");
}

} // namespace
} // namespace filament_core::assets
