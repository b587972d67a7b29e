// SPDX-License-Identifier: Apache-2.0
// What the headers of Radiance and OpenEXR files say beside their size: followed, or named in a warning.
#include "base/Log.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"
#include "tests/filament_core/assets/image/PlainExr.h"

#include <gmock/gmock.h>

#include <limits>

namespace filament_core::assets {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Result<HdrImage> decodeText(std::string const& file) { return decodeHdrImage(std::as_bytes(std::span(file)), "a.hdr"); }

HdrImage decodedExr(std::vector<std::byte> const& file) {
    const auto image = decodeHdrImage(file, "a.exr");
    EXPECT_TRUE(image.ok()) << image.error().message;
    return image.ok() ? *image : HdrImage{};
}

float3 gradient(int x, int y) { return { 0.25f * static_cast<float>(x + 40), 0.5f * static_cast<float>(y + 40), 3 }; }

// ---------------------------------------------------------------------------------------------- Radiance

/// One pixel of 1, 0.5, 0.25 behind `header`, which ends with the size.
std::string hdrOf(std::string const& header) { return header + std::string{ char(128), 64, 32, char(129) }; }

TEST(HdrMetadata, EverySpellingOfARadianceHeaderIsTheSamePicture) {
    size_t cases = 0;
    for (const std::string_view magic : { "#?RADIANCE", "#?RGBE", "#?AUTOPANO", "#?RADIANCE  " }) {
        for (const std::string_view format :
             { "FORMAT=32-bit_rle_rgbe", "FORMAT=32-bit_rle_rgbe ", "FORMAT = 32-bit_rle_rgbe\t",
               "FORMAT= 32-bit_rle_rgbe", "# no format" }) {
            for (const std::string_view more : { "", "GAMMA=1.0", "EXPOSURE=1", "EXPOSURE=0", "SOFTWARE=x=y",
                                                 "\tEXPOSURE=9", " COLORCORR= 2 2 2", "rpict -vf a.vf -x 9 a.oct" }) {
                for (const std::string_view end : { "\n", "\r\n", " \n", "  \r\n" }) {
                    for (const std::string_view size : { "-Y 1 +X 1", "-Y  1  +X  1", "-Y\t1 +X 1", " -Y 1 +X 1" }) {
                        std::string text(magic);
                        for (const std::string_view line :
                             { std::string_view(), more, format, std::string_view("\n") }) {
                            if (line == "\n")
                                text += end;
                            else if (!line.empty())
                                (text += end) += line;
                        }
                        (((text += end) += size)) += end;
                        const auto image = decodeText(hdrOf(text));
                        ASSERT_TRUE(image.ok()) << image.error().message << '\n' << text;
                        ASSERT_EQ(image->at(0, 0), float3(1, 0.5f, 0.25f)) << text;
                        ASSERT_THAT(image->warnings, IsEmpty()) << text;
                        ++cases;
                    }
                }
            }
        }
    }
    EXPECT_EQ(cases, 4u * 5 * 8 * 4 * 4);
    EXPECT_TRUE(decodeText(hdrOf("FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n")).ok()) << "without a first line";
    EXPECT_TRUE(decodeText(hdrOf("#?RGBE\nFORMAT=32-bit_rle_rgbe\n-Y 1 +X 1\n")).ok()) << "without the empty line";
    EXPECT_TRUE(decodeText(hdrOf("#?RGBE\n" + std::string(50000, 'c') + "\n\n-Y 1 +X 1\n")).ok()) << "a long command";
}

TEST(HdrMetadata, ExposureAndColourCorrectionAreDividedOut) {
    const auto image = decodeText(hdrOf("#?RADIANCE\nEXPOSURE= 2\nCOLORCORR= 1 2 4\nEXPOSURE=4.0 \nCOLORCORR=2 2 .5\r\n"
                                        "\n-Y 1 +X 1\n"));
    ASSERT_TRUE(image.ok()) << image.error().message;
    const float3 pixel = image->at(0, 0), expected = float3(1, 0.5f, 0.25f) / 8.0f / float3(2, 4, 2);
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(pixel[c], expected[c]);
    EXPECT_THAT(image->warnings, IsEmpty());
}

TEST(HdrMetadata, PrimariesOfARadianceFileAreConverted) {
    const auto with = [](std::string const& primaries) {
        return *decodeText(hdrOf("#?RADIANCE\nPRIMARIES=" + primaries + "\n\n-Y 1 +X 1\n"));
    };
    EXPECT_EQ(with(".64 .33 .3 .6 .15 .06 .3127 .329").at(0, 0), float3(1, 0.5f, 0.25f)) << "those of Rec. 709";
    const float3 wide = with(" 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290").at(0, 0);
    // ITU-R BT.2087: 1.6605 -0.5876 -0.0728; -0.1246 1.1329 -0.0083; -0.0182 -0.1006 1.1187.
    EXPECT_NEAR(wide.x, 1.6605 - 0.5876 * 0.5 - 0.0728 * 0.25, 2e-4);
    EXPECT_NEAR(wide.y, -0.1246 + 1.1329 * 0.5 - 0.0083 * 0.25, 2e-4);
    EXPECT_NEAR(wide.z, -0.0182 - 0.1006 * 0.5 + 1.1187 * 0.25, 2e-4);
}

TEST(HdrMetadata, WhatARadianceHeaderSaysInVainIsNamed) {
    const auto with = [](std::string const& line) {
        return *decodeText(hdrOf("#?RADIANCE\n" + line + "\n\n-Y 1 +X 1\n"));
    };
    EXPECT_THAT(with("PIXASPECT= 0.5").panoramaWarnings, ElementsAre(HasSubstr("PIXASPECT= 0.5 is left out")));
    EXPECT_THAT(with("VIEW= -vtv -vp 0 0 1").panoramaWarnings, ElementsAre(HasSubstr("(VIEW= -vtv -vp 0 0 1)")));
    EXPECT_THAT(with("PIXASPECT=1.0").panoramaWarnings, IsEmpty());
    EXPECT_THAT(with("GAMMA=2.2").warnings, ElementsAre(HasSubstr("export it with a gamma of 1")));
    EXPECT_THAT(with("COLORCORR= 1 2").warnings, ElementsAre(HasSubstr("COLORCORR= 1 2 is not three numbers")));
    EXPECT_THAT(with("COLORCORR= 1 0 2").warnings, ElementsAre(HasSubstr("is not three numbers above zero")));
    EXPECT_THAT(with("PRIMARIES= 1 2").warnings, ElementsAre(HasSubstr("PRIMARIES= 1 2 is not eight numbers")));
    EXPECT_THAT(with("PRIMARIES= 1 1 1 1 1 1 1 1").warnings,
                ElementsAre(HasSubstr("correct PRIMARIES or chromaticities")));
    EXPECT_EQ(with("PRIMARIES= 1 1 1 1 1 1 1 1").at(0, 0), float3(1, 0.5f, 0.25f));
    EXPECT_THAT(with("PRIMARIES=0 0 0 0 0 0 0 0").warnings, IsEmpty()) << "as Photoshop writes it: unknown";
    EXPECT_EQ(with("PRIMARIES=0 0 0 0 0 0 0 0").at(0, 0), float3(1, 0.5f, 0.25f));
}

TEST(HdrMetadata, TheFileWithASpaceBehindItsFormatIsRead) {
    SKIP_WITHOUT_FAULT_FILES();
    const auto image = readHdrImage(faultFile("hdr_format_trailing_space.hdr"));
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image->width, 64u);
}

// ---------------------------------------------------------------------------------------------- OpenEXR

constexpr std::array kAcesCg{ 0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f };
constexpr std::array kSrgb{ 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f };

TEST(HdrMetadata, ChromaticitiesAreConvertedAndWhiteStaysWhite) {
    PlainExr file{ .data = { 0, 0, 6, 4 }, .pixel = gradient };
    const HdrImage plain = decodedExr(file.bytes());
    file.chromaticities = kSrgb;
    EXPECT_EQ(decodedExr(file.bytes()).pixels, plain.pixels) << "bit for bit";
    file.chromaticities = kAcesCg;
    file.pixel = [](int x, int y) { return float3(static_cast<float>(x + y)); };
    const HdrImage grey = decodedExr(file.bytes());
    for (float3 const& pixel : grey.pixels)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], pixel.x, 1e-6f * pixel.x);
    EXPECT_FLOAT_EQ(grey.at(6, 4).y, 10);
    // The matrix that ACES publishes for AP1 to Rec. 709 with Bradford's adaptation, first row.
    file.pixel = [](int, int) { return float3(1, 0.5f, 0.25f); };
    EXPECT_NEAR(decodedExr(file.bytes()).at(0, 0).x, 1.70505 - 0.62179 * 0.5 - 0.08326 * 0.25, 1e-4);
    file.isGrey = true;
    EXPECT_EQ(decodedExr(file.bytes()).at(0, 0), float3(0.25f)) << "luminance has no colour";
}

TEST(HdrMetadata, ColoursOutsideOfRec709AreCountedAndCut) {
    const PlainExr file{ .data = { 0, 0, 3, 0 }, .chromaticities = kAcesCg, .pixel = [](int x, int) {
                            return x == 2 ? float3(0, 5, 0) : float3(1);
                        } };
    const HdrImage image = decodedExr(file.bytes());
    EXPECT_EQ(image.repairs, (HdrRepairs{ .negative = 2 }));
    EXPECT_EQ(image.at(2, 0).x, 0);
    EXPECT_GT(image.at(2, 0).y, 5);
}

TEST(HdrMetadata, ChromaticitiesThatAreNoneAreNamed) {
    constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
    for (const auto& bad : { std::array{ 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f },
                             std::array{ kNotANumber, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f },
                             std::array{ 0.64f, 0.33f, 0.64f, 0.33f, 0.15f, 0.06f, 0.3127f, 0.329f },
                             std::array{ 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.0f } }) {
        const HdrImage image = decodedExr(PlainExr{ .chromaticities = bad }.bytes());
        EXPECT_THAT(image.warnings, ElementsAre(HasSubstr("taken as those of Rec. 709")));
        EXPECT_EQ(image.at(0, 0), float3(1));
    }
}

// Of every placement of a data window at a display window: the same pixels where both are, black elsewhere.
TEST(HdrMetadata, PixelsLieInTheDisplayWindow) {
    const ExrBox display{ -3, 2, 8, 9 };
    size_t cases = 0;
    for (const int left : { -9, -4, -3, 0, 5 }) {
        for (const int top : { -5, 1, 2, 5, 8 }) {
            for (const int width : { 1, 7, 14 }) {
                for (const int height : { 1, 5, 9 }) {
                    const ExrBox data{ left, top, left + width - 1, top + height - 1 };
                    const HdrImage image =
                            decodedExr(PlainExr{ .data = data, .display = display, .pixel = gradient }.bytes());
                    ASSERT_EQ(image.width, 12u);
                    ASSERT_EQ(image.height, 8u);
                    bool isSeen = false;
                    for (int y = display[1]; y <= display[3]; ++y) {
                        for (int x = display[0]; x <= display[2]; ++x) {
                            const bool isInside = x >= data[0] && x <= data[2] && y >= data[1] && y <= data[3];
                            isSeen |= isInside;
                            ASSERT_EQ(image.at(static_cast<uint32_t>(x + 3), static_cast<uint32_t>(y - 2)),
                                      isInside ? gradient(x, y) : float3(0));
                        }
                    }
                    EXPECT_EQ(image.warnings.empty(), isSeen) << left << ' ' << top << ' ' << width << ' ' << height;
                    ++cases;
                }
            }
        }
    }
    EXPECT_EQ(cases, 5u * 5 * 3 * 3);
}

TEST(HdrMetadata, HugeOrEmptyWindowsAreErrorsWithACure) {
    for (const ExrBox& display : { ExrBox{ 0, 0, 99999, 99999 }, ExrBox{ 5, 0, 2, 9 },
                                   ExrBox{ -2147483647, -2147483647, 2147483647, 2147483647 } }) {
        const auto image = decodeHdrImage(PlainExr{ .display = display }.bytes(), "a.exr");
        ASSERT_FALSE(image.ok());
        EXPECT_THAT(image.error().message, HasSubstr("cannot decode 'a.exr': of its displayWindow: its size"));
    }
}

TEST(HdrMetadata, AttributesThatLightCannotFollowAreNamed) {
    EXPECT_THAT(decodedExr(PlainExr{ .pixelAspectRatio = 2.0f }.bytes()).panoramaWarnings,
                ElementsAre(HasSubstr("pixelAspectRatio of 2 is left out")));
    EXPECT_THAT(decodedExr(PlainExr{ .whiteLuminance = 100.0f }.bytes()).panoramaWarnings,
                ElementsAre(HasSubstr("whiteLuminance of 100 cd/m^2 is left out; set the intensity")));
    const PlainExr usual{
        .display = ExrBox{ 0, 0, 0, 0 }, .chromaticities = kSrgb, .envmap = 0, .pixelAspectRatio = 1.0f
    };
    EXPECT_THAT(decodedExr(usual.bytes()).panoramaWarnings, IsEmpty());
    EXPECT_THAT(decodedExr(usual.bytes()).warnings, IsEmpty());
}

TEST(HdrMetadata, FilesOfProgramsShowTheSameLight) {
    SKIP_WITHOUT_FAULT_FILES();
    const auto stored = [](const char* name) { return readHdrImage(faultFile(name)).value(); };
    const HdrImage aces = stored("exr_acescg.exr"), same = stored("exr_rec709_same_light.exr");
    ASSERT_EQ(aces.pixels.size(), same.pixels.size());
    for (size_t i = 0; i < same.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(aces.pixels[i][c], same.pixels[i][c], 1e-6f) << i;
    EXPECT_EQ(stored("exr_cropped.exr").pixels, stored("exr_full.exr").pixels);
}

TEST(HdrMetadata, APictureLogsTheWarningsOfItsFile) {
    std::vector<std::string> lines;
    const LogSink before = setLogSink([&](Severity, std::string_view line) { lines.emplace_back(line); });
    const std::string file = hdrOf("#?RGBE\nGAMMA=2.2\nVIEW= -vtv\n\n-Y 1 +X 1\n");
    EXPECT_TRUE(decodePicture(std::as_bytes(std::span(file)), "a.hdr").ok());
    setLogSink(before);
    EXPECT_THAT(lines, ElementsAre(HasSubstr("'a.hdr': its GAMMA= 2.2 is left out")));
}

TEST(HdrMetadata, DamagedHeadersKeepEveryPromiseOfTheFuzzer) {
    const std::vector<std::byte> exr = PlainExr{ .data = { -1, 0, 6, 4 },
                                                 .display = ExrBox{ 0, 0, 8, 8 },
                                                 .chromaticities = kAcesCg,
                                                 .envmap = 1,
                                                 .pixelAspectRatio = 1.0f,
                                                 .whiteLuminance = 100.0f,
                                                 .pixel = gradient }
                                               .bytes();
    const std::string text =
            hdrOf("#?RADIANCE\nEXPOSURE= 2\nCOLORCORR= 1 2 4\nPRIMARIES=.64 .33 .3 .6 .15 .06 .31 .33\n"
                  "VIEW= -vtv\nPIXASPECT=2\nGAMMA=2\nFORMAT=32-bit_rle_rgbe \n\n-Y 1 +X 1\n");
    const auto hdr = std::as_bytes(std::span(text));
    size_t pictures = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const bool isExr = seed % 2 == 0;
        const std::vector<std::byte> file =
                damaged(isExr ? exr : std::vector<std::byte>(hdr.begin(), hdr.end()), seed, 2);
        pictures += test::fuzzHdrImage(file);
    }
    EXPECT_GT(pictures, 200u);
}

} // namespace
} // namespace filament_core::assets
