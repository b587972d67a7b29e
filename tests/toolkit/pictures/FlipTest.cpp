// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/Flip.h"
#include "tests/toolkit/pictures/Pictures.h"
#include "toolkit/pictures/ImageChecks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace filament_core::tools {
namespace {

TEST(Flip, OfAPictureAndItselfIsZeroAndOfBlackAndWhiteNearlyOne) {
    EXPECT_EQ(flip(grey(77), grey(77)).mean, 0);
    EXPECT_GT(flip(grey(0), grey(255)).mean, 0.9);
    EXPECT_LE(flip(grey(0), grey(255)).mean, 1);
}

TEST(Flip, IsSymmetricAndGrowsWithTheDifference) {
    EXPECT_DOUBLE_EQ(flip(grey(40), grey(90)).mean, flip(grey(90), grey(40)).mean);
    EXPECT_LT(flip(grey(40), grey(50)).mean, flip(grey(40), grey(90)).mean);
}

// The paper's largest distance is that between these two, and its error is 1.
TEST(Flip, OfGreenAndBlueIsOne) { EXPECT_NEAR(flip(flat({ 0, 255, 0 }), flat({ 0, 0, 255 })).mean, 1, 1e-5); }

/// The eye's filters do not change an image of one colour, and it has no features. For two greys only the distance of
/// their lightness (CIE L*), its power and its redistribution remain, computed here in double precision.
double flipOfGreys(double codeA, double codeB) {
    const auto lightness = [](double code) {
        const double v = code / 255;
        const double y = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27;
    };
    // Green against blue: 147.8 in L* a* b* after the Hunt effect, from their colours in the same white point.
    struct Lab {
        double l, a, b;
    };
    const Lab green{ 87.7370, -86.1846, 83.1812 }, blue{ 32.3026, 79.1967, -107.8637 };
    const auto hunt = [](double l, double v) { return 0.01 * l * v; };
    const double largest =
            std::pow(std::abs(green.l - blue.l) + std::hypot(hunt(green.l, green.a) - hunt(blue.l, blue.a),
                                                             hunt(green.l, green.b) - hunt(blue.l, blue.b)),
                     0.7);
    const double error = std::pow(std::abs(lightness(codeA) - lightness(codeB)), 0.7), knee = 0.4 * largest;
    return error < knee ? 0.95 / knee * error : 0.95 + (error - knee) / (largest - knee) * 0.05;
}

TEST(Flip, OfTwoGreysIsTheDistanceOfTheirLightnessRedistributed) {
    for (auto const& [a, b] : { std::pair{ 0, 255 }, { 100, 110 }, { 10, 12 }, { 0, 60 }, { 200, 255 } })
        EXPECT_NEAR(flip(grey(static_cast<uint8_t>(a)), grey(static_cast<uint8_t>(b))).mean, flipOfGreys(a, b), 2e-4)
                << a << " against " << b;
}

TEST(Flip, SeesAHueThatHasTheSameLightness) {
    // L* of both is 50 within 0.3: only a* and b* differ.
    EXPECT_GT(flip(flat({ 197, 68, 68 }), flat({ 82, 130, 72 })).mean, 0.3);
}

TEST(Flip, ForgivesAPatternThatIsTooFineForTheEye) {
    Image fine = grey(100), coarse = grey(100);
    for (uint32_t y = 0; y < 32; ++y) {
        for (uint32_t x = 0; x < 32; ++x) {
            const auto paint = [&](Image& image, bool isLight) {
                for (size_t c = 0; c < 3; ++c) image.pixels[(y * 32 + x) * 4 + c] = std::byte(isLight ? 103 : 97);
            };
            paint(fine, (x + y) % 2 == 0);
            paint(coarse, (x / 16 + y / 16) % 2 == 0);
        }
    }
    EXPECT_LT(flip(grey(100), fine).mean, 0.5 * flip(grey(100), coarse).mean);
}

TEST(Flip, FindsTheOnePixelThatDiffers) {
    Image changed = grey(100);
    for (size_t c = 0; c < 3; ++c) changed.pixels[(16 * 32 + 9) * 4 + c] = std::byte{ 200 };
    const FlipError error = flip(grey(100), changed);
    const auto most = std::ranges::max_element(error.pixels) - error.pixels.begin();
    EXPECT_LE(std::abs(most % 32 - 9), 3) << "within the width of a feature";
    EXPECT_LE(std::abs(most / 32 - 16), 3);
    EXPECT_EQ(error.pixels[0], 0);
}

TEST(ImageChecks, RefuseBlackAndEmptyPicturesAndAcceptOthers) {
    EXPECT_NE(faultOf(grey(0)).find("black"), std::string::npos);
    EXPECT_NE(faultOf(grey(9)).find("nothing was drawn"), std::string::npos);
    Image drawn = grey(9);
    drawn.pixels[40] = std::byte{ 10 };
    EXPECT_EQ(faultOf(drawn), "");
}

TEST(ImageChecks, NameThePixelThatIsNotFinite) {
    Image image{ .width = 2, .height = 1, .format = Format::RGBA16F };
    image.pixels.resize(16);
    image.pixels[9] = std::byte{ 0x7E }; // red of the second pixel: a half NaN
    EXPECT_NE(faultOf(image).find("pixel (1, 0)"), std::string::npos) << faultOf(image);
}

} // namespace
} // namespace filament_core::tools
