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

} // namespace
} // namespace filament_core::assets
