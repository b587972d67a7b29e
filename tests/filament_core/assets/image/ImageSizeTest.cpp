// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageSize.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/PictureFiles.h"

namespace filament_core::assets {
namespace {

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
    std::vector<std::byte> bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

TEST(ImageSize, OfAPngIsThatOfItsHeader) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writePng(folder / "a.png", 31, 17, std::vector<std::byte>(31 * 17 * 4)));
    const std::vector<std::byte> file = readFileBytes(folder / "a.png").value();
    EXPECT_EQ(imageSize(file), uint2(31, 17));
    EXPECT_FALSE(isCutShortPng(file));
    for (size_t size = 8; size + 4 < file.size(); ++size) // the last four bytes are the check sum of the end
        EXPECT_TRUE(isCutShortPng(std::span(file).first(size))) << size;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const std::vector<std::byte> broken = damaged(file, seed);
        imageSize(broken);
        isCutShortPng(broken);
        hasAlphaPng(broken);
    }
}

TEST(ImageSize, APngHasAlphaIfItsColoursHaveOrOneIsTransparent) {
    for (test::PngKind const& kind : test::pngKinds()) {
        const test::PngFile file = test::makePng(kind, 3, 2);
        EXPECT_EQ(hasAlphaPng(file.bytes), kind.colorType == 4 || kind.colorType == 6 || kind.transparentColor)
                << test::pngKindName(kind);
        for (size_t size = 0; size < file.bytes.size(); ++size) hasAlphaPng(std::span(file.bytes).first(size));
    }
    EXPECT_FALSE(hasAlphaPng(test::makeJpeg({}, 8, 8)));
    EXPECT_FALSE(hasAlphaPng({}));
}

TEST(ImageSize, OfAJpegIsThatOfItsFrameBehindAnyOtherSegments) {
    const std::vector<std::byte> file =
            bytesOf({ 0xFF, 0xD8, 0xFF, 0xE0, 0, 6,    0xFF, 0xC0, 1, 2, // a comment with C0 in it
                      0xFF, 0xC4, 0,    3,    9, 0xFF, 0xFF, 0xC2, 0, 11, 8, 1, 2, 3, 4, 1, 0, 0, 0 });
    EXPECT_EQ(imageSize(file), uint2(0x304, 0x102));
    for (size_t size = 0; size < file.size(); ++size) imageSize(std::span(file).first(size));
    EXPECT_EQ(imageSize(bytesOf({ 0xFF, 0xD8, 0xFF, 0xD9, 0, 0 })), uint2(0));
    EXPECT_EQ(imageSize(bytesOf({ 'G', 'I', 'F', '8' })), uint2(0));
    EXPECT_EQ(imageSize({}), uint2(0));
}

} // namespace
} // namespace filament_core::assets
