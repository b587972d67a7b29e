// SPDX-License-Identifier: Apache-2.0
// The shader library in double precision: it is really double, it is the same library, and it is complete.
#include "shaders/lib/LibCppDouble.h"
#include "shaders/lib/LibCpp.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <regex>
#include <set>
#include <string>

namespace filament_core::shader {
namespace {

std::string textOf(std::filesystem::path const& path) {
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

const std::filesystem::path kLibrary = tools::sourceDir() / "shaders/lib";
const std::filesystem::path kCopies = tools::buildDir() / "generated/shaders/lib64";

TEST(LibCppDouble, ConstantsKeepTheDigitsOfTheirText) {
    static_assert(std::is_same_v<decltype(lib64::kPi), const double>);
    EXPECT_NEAR(lib64::kPi, std::numbers::pi, 5e-15); // fp32 is off by 9e-8
    EXPECT_NEAR(lib64::kTwoPi, 2 * std::numbers::pi, 5e-15);
    EXPECT_NEAR(lib64::kInversePi, std::numbers::inv_pi, 5e-16);
    EXPECT_EQ(lib64::kMinPerceptualRoughness, 0.045);
    EXPECT_NE(lib64::kMinPerceptualRoughness, static_cast<double>(lib::kMinPerceptualRoughness));
}

// Walter et al. 2007, eq. 33, in its textbook form a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2), in long double.
TEST(LibCppDouble, TheNormalDistributionIsGoodToTwelveDigitsWhereFp32KeepsSeven) {
    double worst64 = 0, worst32 = 0;
    for (int i = 1; i < 100; ++i) {
        const long double noh = i / 100.0L, alpha = 0.3L;
        const long double d = noh * noh * (alpha * alpha - 1) + 1;
        const long double exact = alpha * alpha / (std::numbers::pi_v<long double> * d * d);
        const double in64 = lib64::ndfGgx(static_cast<double>(noh), static_cast<double>(alpha));
        const double in32 = lib::ndfGgx(static_cast<float>(noh), static_cast<float>(alpha));
        worst64 = std::max(worst64, std::abs(static_cast<double>(in64 / exact - 1)));
        worst32 = std::max(worst32, std::abs(static_cast<double>(in32 / exact - 1)));
    }
    EXPECT_LT(worst64, 1e-12);
    EXPECT_GT(worst32, 1e-8);
}

TEST(LibCppDouble, FunctionsReturnWhatTheSinglePrecisionOnesReturnWithinRounding) {
    const std::array<double, 4> some{ 0.1, 0.35, 0.6, 0.95 };
    const auto close = [](double a, double b, const char* what) {
        EXPECT_NEAR(a, b, 1e-5 * (1 + std::abs(a))) << what;
    };
    const auto f = [](double x) { return static_cast<float>(x); };
    for (const double x : some) {
        for (const double y : some) {
            close(lib64::visibilitySmithGgxCorrelated(x, y, 0.3), lib::visibilitySmithGgxCorrelated(f(x), f(y), 0.3f),
                  "visibility");
            close(lib64::visibilitySmithGgxCorrelatedFast(x, y, 0.3),
                  lib::visibilitySmithGgxCorrelatedFast(f(x), f(y), 0.3f), "fast visibility");
            close(lib64::specularOcclusion(x, y, 0.3), lib::specularOcclusion(f(x), f(y), 0.3f), "occlusion");
            close(lib64::spotAttenuation({ 0, 0, 1 }, { 0, 0, -x }, 2, -y),
                  lib::spotAttenuation({ 0, 0, 1 }, { 0, 0, -f(x) }, 2, -f(y)), "spot");
            close(lib64::importanceSampleGgx({ x, y }, 0.3).z, lib::importanceSampleGgx({ f(x), f(y) }, 0.3f).z, "GGX");
            close(lib64::distanceAttenuation({ x, y, 1 }, 0.2), lib::distanceAttenuation({ f(x), f(y), 1 }, 0.2f),
                  "distance");
        }
        close(lib64::srgbFromLinear(x), lib::srgbFromLinear(f(x)), "sRGB");
        close(lib64::toneMapAces(lib64::vec3(x)).y, lib::toneMapAces(lib::vec3(f(x))).y, "ACES");
        close(lib64::perceptualRoughnessFromLevel(x, 4), lib::perceptualRoughnessFromLevel(f(x), 4), "level");
        close(lib64::energyCompensation(lib64::vec3(x), { 0.1, 0.8 }).x,
              lib::energyCompensation(lib::vec3(f(x)), { 0.1f, 0.8f }).x, "compensation");
        close(lib64::multiBounceAo(x, lib64::vec3(0.7)).x, lib::multiBounceAo(f(x), lib::vec3(0.7f)).x, "multi-bounce");
    }
    close(lib64::radicalInverse(0x12345678u), lib::radicalInverse(0x12345678u), "radical inverse");
}

TEST(LibCppDouble, EveryFileOfTheLibraryHasACopyAndIsIncluded) {
    const std::string all = textOf(kCopies / "all.inl");
    size_t files = 0;
    for (auto const& entry : std::filesystem::directory_iterator(kLibrary)) {
        if (entry.path().extension() != ".glsl") continue;
        ++files;
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::filesystem::exists(kCopies / name)) << name;
        EXPECT_NE(all.find("lib64/" + name + '"'), std::string::npos) << name;
    }
    EXPECT_GE(files, 9u);
}

// Everything except numbers and the word float is the same text: both are removed, and the rest is compared.
TEST(LibCppDouble, CopiesDifferFromTheirSourcesInFloatAndInSuffixesOnly) {
    const std::regex literal(R"(\b(\d+\.\d*|\.\d+|\d+(?=[eE]))([eE][-+]?\d+)?f)");
    for (auto const& entry : std::filesystem::directory_iterator(kLibrary)) {
        if (entry.path().extension() != ".glsl") continue;
        std::string expected = std::regex_replace(textOf(entry.path()), literal, "$1$2");
        expected = std::regex_replace(expected, std::regex(R"(\bfloat\b)"), "double");
        const std::string copy = textOf(kCopies / entry.path().filename());
        EXPECT_EQ(copy, expected) << entry.path();
        EXPECT_FALSE(std::regex_search(copy, std::regex(R"(\bfloat\b)"))) << entry.path();
    }
}

TEST(LibCppDouble, HexadecimalLiteralsSurvive) {
    const std::string copy = textOf(kCopies / "sampling.glsl");
    for (const char* mask : { "0x55555555u", "0x0F0F0F0Fu", "0xF0F0F0F0u", "0x00FF00FFu" }) {
        EXPECT_NE(copy.find(mask), std::string::npos) << mask;
    }
}

} // namespace
} // namespace filament_core::shader
