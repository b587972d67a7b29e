// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TexturePacking.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace filament_core::assets {
namespace {

Image image(uint32_t width, uint32_t height, std::initializer_list<int> codes) {
    Image image{ .width = width, .height = height, .data = {} };
    for (const int code : codes) image.data.push_back(static_cast<std::byte>(code));
    return image;
}

int code(Image const& image, uint32_t x, uint32_t y, size_t channel) {
    return static_cast<int>(image.data[(size_t{ y } * image.width + x) * 4 + channel]);
}

TEST(TexturePacking, TakesRedOfTheFirstAndGreenOfTheSecond) {
    const Image packed = packImages(image(2, 1, { 1, 2, 3, 4, 5, 6, 7, 8 }),
                                    image(2, 1, { 11, 12, 13, 14, 15, 16, 17, 18 }), PackLayout::RedGreen);
    EXPECT_EQ(code(packed, 0, 0, 0), 1);
    EXPECT_EQ(code(packed, 0, 0, 1), 12);
    EXPECT_EQ(code(packed, 1, 0, 0), 5);
    EXPECT_EQ(code(packed, 1, 0, 1), 16);
}

TEST(TexturePacking, TakesTheColourOfTheFirstAndTheAlphaOfTheSecond) {
    const Image packed =
            packImages(image(1, 1, { 1, 2, 3, 4 }), image(1, 1, { 11, 12, 13, 14 }), PackLayout::ColorAlpha);
    EXPECT_EQ(packed.data, image(1, 1, { 1, 2, 3, 14 }).data);
}

TEST(TexturePacking, GrowsBothToTheLargerSizeOfEachDirection) {
    const Image packed = packImages(image(4, 1, { 10, 0, 0, 0, 20, 0, 0, 0, 30, 0, 0, 0, 40, 0, 0, 0 }),
                                    image(1, 2, { 0, 100, 0, 0, 0, 200, 0, 0 }), PackLayout::RedGreen);
    ASSERT_EQ(packed.width, 4u);
    ASSERT_EQ(packed.height, 2u);
    ASSERT_EQ(packed.data.size(), 32u);
    for (uint32_t x = 0; x < 4; ++x) {
        for (uint32_t y = 0; y < 2; ++y) {
            EXPECT_EQ(code(packed, x, y, 0), 10 * static_cast<int>(x + 1));
            EXPECT_EQ(code(packed, x, y, 1), y == 0 ? 100 : 200);
        }
    }
}

// Texel i of 4 lies at (i + 0.5) / 2 - 0.5 = -0.25, 0.25, 0.75, 1.25 of 2.
TEST(TexturePacking, NumbersAreInterpolatedBetweenTheCentresOfTexels) {
    const Image packed =
            packImages(image(2, 1, { 0, 0, 0, 0, 200, 0, 0, 0 }),
                       image(4, 1, { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }), PackLayout::RedGreen);
    EXPECT_EQ(code(packed, 0, 0, 0), 0);
    EXPECT_EQ(code(packed, 1, 0, 0), 50);
    EXPECT_EQ(code(packed, 2, 0, 0), 150);
    EXPECT_EQ(code(packed, 3, 0, 0), 200);
}

// Black and white in equal parts give 188 in sRGB, and 128 in alpha.
TEST(TexturePacking, ColoursAreInterpolatedInLinearLightAndAlphaIsNot) {
    const Image wide = image(3, 1, { 0, 0, 0, 7, 0, 0, 0, 7, 0, 0, 0, 7 });
    const Image narrow = image(2, 1, { 0, 0, 0, 0, 255, 255, 255, 255 });
    EXPECT_EQ(code(packImages(narrow, wide, PackLayout::ColorAlpha), 1, 0, 0), 188);
    EXPECT_EQ(code(packImages(wide, narrow, PackLayout::ColorAlpha), 1, 0, 3), 128);
}

} // namespace
} // namespace filament_core::assets
