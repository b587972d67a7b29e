// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/fuzz/CubeFuzzBody.h"

#include <gtest/gtest.h>

namespace filament_core::assets {
namespace {

const std::string kCurve = "# of a test\n"
                           "TITLE \"Two lamps\"\r\n"
                           "LUT_1D_SIZE 3\n"
                           "DOMAIN_MIN -1 0 +0.5\n"
                           "DOMAIN_MAX 1\t2   1\n"
                           "\n"
                           "0 0 1\n"
                           "  # between\n"
                           "0.25 1e-1 .5\n"
                           "1 -2.5 0";

std::string cubeOf(std::string_view size, size_t colours) {
    std::string text = fmt::format("LUT_3D_SIZE {}\n", size);
    for (size_t i = 0; i < colours; ++i) text += fmt::format("{} {} {}\n", i, i * 2, i * 3);
    return text;
}

void expectError(std::string const& text, std::string const& message) {
    const auto look = parseLook(text, "look.cube");
    ASSERT_FALSE(look.ok()) << message;
    EXPECT_EQ(look.error().message, "look.cube: " + message);
}

TEST(CubeFile, ACurveIsReadWithItsTitleAndItsDomain) {
    const auto look = parseLook(kCurve, "look.cube");
    ASSERT_TRUE(look.ok()) << look.error().message;
    const Look expected{ .title = "Two lamps",
                         .isCube = false,
                         .size = 3,
                         .domainMin = float3(-1, 0, 0.5f),
                         .domainMax = float3(1, 2, 1),
                         .entries = { float3(0, 0, 1), float3(0.25f, 0.1f, 0.5f), float3(1, -2.5f, 0) } };
    EXPECT_EQ(**look, expected);
}

TEST(CubeFile, ACubeIsReadRedFirst) {
    const auto look = parseLook(cubeOf("2", 8), "look.cube");
    ASSERT_TRUE(look.ok()) << look.error().message;
    EXPECT_EQ(lookedUp(**look, float3(1, 0, 0)), float3(1, 2, 3));
    EXPECT_EQ(lookedUp(**look, float3(0, 1, 0)), float3(2, 4, 6));
    EXPECT_EQ(lookedUp(**look, float3(0, 0, 1)), float3(4, 8, 12));
    EXPECT_EQ((*look)->domainMax, float3(1));
    const auto range = parseLook("LUT_3D_INPUT_RANGE -1 3\n" + cubeOf("2", 8), "look.cube");
    ASSERT_TRUE(range.ok());
    EXPECT_EQ((*range)->domainMin, float3(-1));
    EXPECT_EQ((*range)->domainMax, float3(3));
}

TEST(CubeFile, WhatIsWrittenIsReadAgain) {
    for (std::string const& text : { kCurve, cubeOf("3", 27) }) {
        const auto look = parseLook(text, "look.cube");
        const TemporaryFolder folder;
        ASSERT_TRUE(saveLook(folder / "again.cube", **look));
        const auto again = loadLook(folder / "again.cube");
        ASSERT_TRUE(again.ok()) << again.error().message;
        EXPECT_EQ(**again, **look);
    }
}

TEST(CubeFile, ErrorsNameTheLineAndTheCure) {
    expectError("", "line 0: no LUT_1D_SIZE or LUT_3D_SIZE; it is no .cube file");
    expectError("0 0 0\n", "line 1: '0' comes before LUT_1D_SIZE or LUT_3D_SIZE");
    expectError("\nLUT_3D_SIZE 1\n", "line 2: LUT_3D_SIZE is '1', expected a whole number from 2 to 128");
    expectError("LUT_3D_SIZE 4294967298\n",
                "line 1: LUT_3D_SIZE is '4294967298', expected a whole number from 2 to 128");
    expectError("LUT_3D_SIZE\n", "line 1: LUT_3D_SIZE is '', expected a whole number from 2 to 128");
    expectError("LUT_1D_SIZE 65537\n", "line 1: LUT_1D_SIZE is '65537', expected a whole number from 2 to 65536");
    expectError("LUT_1D_SIZE 2\n0 0 0\n1 1\n", "line 3: a colour has 2 numbers, expected 3");
    expectError("LUT_1D_SIZE 2\n0 0 0\n1 1 1 1\n", "line 3: a colour has 4 numbers, expected 3");
    expectError("LUT_1D_SIZE 2\n0 0 0\n1 1 1\n2 2 2\n", "line 4: more colours than the 2 of its size; remove them");
    expectError("LUT_1D_SIZE 2\n0 0 0\n", "line 2: the file ends after 1 of 2 colours; it is truncated");
    expectError("LUT_1D_SIZE 2\n0 0 0\nTITLE \"a\"\n", "line 3: 'TITLE' comes after colours; move it before them");
    expectError("DOMAIN_MIN 0 0\n", "line 1: DOMAIN_MIN has 2 numbers, expected 3");
    expectError("LUT_1D_SIZE 2\nDOMAIN_MIN 1 0 0\n0 0 0\n1 1 1\n", "line 4: DOMAIN_MIN 1 is not below DOMAIN_MAX 1");
    EXPECT_FALSE(parseLook("GAMMA 2\n", "x").ok());
    for (const char* bad : { "nan", "-inf", "1e11", "1e999", "0x10", "--3", "+-3", "1,5", "lamp" })
        expectError(std::string("LUT_1D_SIZE 2\n0 ") + bad + " 0\n",
                    std::string("line 2: '") + bad + "' is not a number from -1e10 to 1e10");
    EXPECT_EQ(loadLook("/nowhere/look.cube").error().code, ErrorCode::NotFound);
}

TEST(CubeFile, EveryCutAndEveryByteChangedIsALookOrAnError) {
    size_t taken = 0;
    for (std::string const& text : { kCurve, cubeOf("2", 8) }) {
        for (size_t i = 0; i <= text.size(); ++i) {
            taken += fuzzCubeOnce({ reinterpret_cast<const uint8_t*>(text.data()), i });
            for (const char replacement : { '0', '9', '-', '.', 'e', ' ', '\n', '"', '#', '\0', '\xff' }) {
                std::string changed = text;
                if (i < text.size()) changed[i] = replacement;
                taken += fuzzCubeOnce({ reinterpret_cast<const uint8_t*>(changed.data()), changed.size() });
            }
        }
    }
    EXPECT_GT(taken, 500u) << "changed numbers are still numbers";
}

/// Of another program that applies ACEScct to linear Rec. 709 and then the cube.
float3 asElsewhere(Look const& look, float3 light) { return lookedUp(look, shader::lib::gradingLog(light)); }

TEST(CubeFile, ABakedLookShowsWhatTheViewShows) {
    const DisplayTransform agx{ .toneMapper = ToneMapper::Agx, .agxLook = AgxLook::Punchy };
    ColorGrading grading{ .enabled = true, .exposure = 0.5f, .contrast = 1.1f };
    const Look look = bakeLook(agx, grading, 65);
    EXPECT_EQ(look.entries.size(), size_t{ 65 } * 65 * 65);
    const DisplayColor displayColor(agx, &grading);
    for (float3 const& light : { float3(0.02f), float3(0.18f, 0.3f, 0.1f), float3(2, 0.5f, 0.7f), float3(30) }) {
        const float3 shown = asElsewhere(look, light), expected = displayColor(light);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], 0.006f);
    }
    grading.enabled = false;
    EXPECT_NEAR(asElsewhere(bakeLook({}, grading, 65), float3(0.18f)).x, DisplayColor({})(float3(0.18f)).x, 0.002f);
}

} // namespace
} // namespace filament_core::assets
