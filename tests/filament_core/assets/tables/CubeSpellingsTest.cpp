// SPDX-License-Identifier: Apache-2.0
// .cube files as programs write them: titles, byte order marks, line ends, ranges, and a curve before the cube. Every
// spelling is the look that the specification's spelling is.
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/fuzz/CubeFuzzBody.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace filament_core::assets {
namespace {

/// The colours of a cube of `size` entries a side that inverts and tints.
std::string coloursOf(uint32_t size) {
    std::string text;
    const auto share = [&](uint32_t i) { return static_cast<float>(i) / static_cast<float>(size - 1); };
    for (uint32_t b = 0; b < size; ++b)
        for (uint32_t g = 0; g < size; ++g)
            for (uint32_t r = 0; r < size; ++r)
                text += fmt::format("{} {} {}\n", 1 - share(r), share(g) * share(g), 0.25f + share(b) / 2);
    return text;
}

Look lookOf(std::string const& text) {
    const auto look = parseLook(text, "look.cube");
    EXPECT_TRUE(look.ok()) << look.error().message << "\n" << text.substr(0, 200);
    return look.ok() ? **look : Look{};
}

std::string cubeErrorOf(std::string const& text) {
    const auto look = parseLook(text, "look.cube");
    return look.ok() ? "no error" : look.error().message;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

TEST(CubeSpellings, AnyTitleLineEndMarkAndCaseGiveTheSameColours) {
    const std::string rest = "LUT_3D_SIZE 3\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1 1 2\n" + coloursOf(3);
    const Look expected = lookOf(rest);
    size_t cases = 0;
    for (std::string const& title :
         { std::string("TITLE \"a b\""), std::string("TITLE a b"), std::string("TITLE 'a b'"),
           std::string("TITLE\t\"a b\""), std::string("TITLE   a b  "), std::string("TITLE \"a b"),
           std::string("Title \"a b\""), std::string("TITLE"), std::string("TITLE \"\""),
           "TITLE \"" + std::string(300, 'x') + "\"", "TITLE " + std::string(4000, 'y'), std::string("# TITLE") }) {
        for (const std::string_view mark : { "", "\xEF\xBB\xBF" }) {
            for (const std::string_view end : { "\n", "\r\n", "\r", "\n\n" }) {
                for (const std::string_view comment : { "", " # written by a program" }) {
                    for (const bool isLower : { false, true }) {
                        std::string text =
                                replaced(rest, " 0.25\n", std::string(" 0.25") + std::string(comment) + "\n");
                        if (isLower) text = replaced(replaced(text, "LUT_3D_SIZE", "lut_3d_size"), "DOMAIN", "domain");
                        text = std::string(mark) + replaced(title + "\n" + text, "\n", end);
                        Look look = lookOf(text);
                        if (title.find("a b") != std::string::npos) {
                            EXPECT_EQ(look.title, "a b") << title;
                        }
                        EXPECT_LE(look.title.size(), 250u);
                        look.title.clear();
                        ASSERT_EQ(look, expected) << text.substr(0, 80);
                        ++cases;
                    }
                }
            }
        }
    }
    EXPECT_EQ(cases, 12u * 2 * 4 * 2 * 2);
}

TEST(CubeSpellings, ALongTitleIsNotCutWithinALetter) {
    std::string letters;
    for (int i = 0; i < 200; ++i) letters += "\u00e4";
    for (const std::string_view before : { "", "x" }) {
        const Look look = lookOf("TITLE \"" + std::string(before) + letters + "\"\nLUT_3D_SIZE 2\n" + coloursOf(2));
        EXPECT_EQ(look.title.size() % 2, before.size()) << "two bytes a letter";
        EXPECT_GE(look.title.size(), 249u);
    }
}

TEST(CubeSpellings, TheInputRangeBelongsToItsTable) {
    const auto both = [](std::string_view ranges, std::string_view sizes) {
        return lookOf(fmt::format("{}{}0 0 0\n1 1 1\n{}", ranges, sizes, coloursOf(2)));
    };
    for (const std::string_view sizes : { "LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n", "LUT_3D_SIZE 2\nLUT_1D_SIZE 2\n" }) {
        const Look look = both("LUT_1D_INPUT_RANGE -1 3\nLUT_3D_INPUT_RANGE 0.5 4\n", sizes);
        EXPECT_EQ(look.shaperMin, float3(-1));
        EXPECT_EQ(look.shaperMax, float3(3));
        EXPECT_EQ(look.domainMin, float3(0.5f));
        EXPECT_EQ(look.domainMax, float3(4));
        const Look domain = both("DOMAIN_MIN -1 0 0\nDOMAIN_MAX 3 2 1\n", sizes);
        EXPECT_EQ(domain.shaperMin, float3(-1, 0, 0)) << "the domain is that of the file's input";
        EXPECT_EQ(domain.shaperMax, float3(3, 2, 1));
        EXPECT_EQ(domain.domainMax, float3(1));
    }
    const Look alone = lookOf("LUT_1D_INPUT_RANGE -1 3\nLUT_3D_SIZE 2\n" + coloursOf(2));
    EXPECT_EQ(alone.domainMin, float3(-1)) << "LUTCalc before version 4 names the wrong table";
}

// Of every pair of a curve and a cube, in both orders of their sizes and with the cube's size between the tables.
TEST(CubeSpellings, ACurveBeforeTheCubeIsAppliedBeforeIt) {
    for (const uint32_t curve : { 2u, 5u, 33u }) {
        std::string entries;
        Look first{ .isCube = false, .size = curve, .entries = {} };
        for (uint32_t i = 0; i < curve; ++i) {
            const float x = static_cast<float>(i) / static_cast<float>(curve - 1);
            first.entries.push_back(float3(x * x, 1 - x, x / 2));
            entries +=
                    fmt::format("{} {} {}\n", first.entries.back().x, first.entries.back().y, first.entries.back().z);
        }
        const std::string cube = coloursOf(4);
        const Look second = lookOf("LUT_3D_SIZE 4\n" + cube);
        const std::string sizes = fmt::format("LUT_1D_SIZE {}\n", curve);
        for (std::string const& text : { sizes + "LUT_3D_SIZE 4\n" + entries + cube,
                                         "LUT_3D_SIZE 4\n" + sizes + entries + "\n# the cube\n" + cube,
                                         sizes + entries + "LUT_3D_SIZE 4\n" + cube }) {
            const Look look = lookOf(text);
            for (int i = 0; i < 40; ++i) {
                const float3 color(-0.1f + 0.03f * float(i), 1.1f - 0.02f * float(i), 0.5f);
                EXPECT_EQ(lookedUp(look, color), lookedUp(second, lookedUp(first, color)));
            }
            EXPECT_EQ(lookOf(cubeText(look)), look);
        }
    }
}

// Resolve: tables that are made for codes of 64 to 940 in 10 bits are applied to [0, 1].
TEST(CubeSpellings, VideoRangeIsThatOfTheCodes) {
    const auto codes = [](float3 value) { return (value * 876.0f + 64.0f) / 1023.0f; };
    for (const std::string_view sizes : { "LUT_3D_SIZE 3\n", "LUT_1D_SIZE 2\nLUT_3D_SIZE 3\n" }) {
        const std::string tables = std::string(sizes) + (sizes.size() > 14 ? "0 0.5 0\n1 1 0.75\n" : "") + coloursOf(3);
        const Look plain = lookOf(tables);
        for (const bool isIn : { false, true }) {
            for (const bool isOut : { false, true }) {
                const Look look = lookOf((isIn ? "LUT_IN_VIDEO_RANGE\n" : "") +
                                         std::string(isOut ? "LUT_OUT_VIDEO_RANGE\n" : "") + tables);
                for (int i = 0; i < 30; ++i) {
                    const float3 color(float(i) / 29, 1 - float(i) / 29, 0.3f);
                    const float3 shown = lookedUp(look, color);
                    const float3 expected = lookedUp(plain, isIn ? codes(color) : color);
                    EXPECT_LT(glm::distance(isOut ? codes(shown) : shown, expected), 1e-6f) << isIn << isOut << i;
                }
                EXPECT_EQ(lookOf(cubeText(look)), look);
            }
        }
    }
}

TEST(CubeSpellings, BrokenOnesNameTheLineAndTheCure) {
    EXPECT_EQ(cubeErrorOf("\xFF\xFE" + std::string("T\0I\0", 4)),
              "look.cube: line 1: the text is UTF-16; save it as UTF-8");
    EXPECT_EQ(cubeErrorOf("LUT_1D_SIZE 2\nLUT_1D_SIZE 2\n"),
              "look.cube: line 2: a second LUT_1D_SIZE; keep one of them");
    EXPECT_EQ(cubeErrorOf("LUT_IN_VIDEO_RANGE 1\n"),
              "look.cube: line 1: LUT_IN_VIDEO_RANGE has 1 values, expected none");
    EXPECT_EQ(cubeErrorOf("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n" + coloursOf(2) + "0 0 0\n"),
              "look.cube: line 13: more colours than the 10 of its size; remove them");
    EXPECT_EQ(cubeErrorOf("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n0 0 0\n"),
              "look.cube: line 5: the file ends after 3 of 10 colours; it is truncated");
    EXPECT_EQ(cubeErrorOf("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n0 0 0\nTITLE x\n"),
              "look.cube: line 6: 'TITLE' comes after colours; move it before them");
    EXPECT_NE(cubeErrorOf("LUT_4D_SIZE 2\n").find("LUT_OUT_VIDEO_RANGE; put # before a line to leave it out"),
              std::string::npos);
}

TEST(CubeSpellings, ThoseOfProgramsAreRead) {
    SKIP_WITHOUT_FAULT_FILES();
    for (const char* name : { "cube_bom.cube", "cube_titlelong.cube", "cube_titlenoq.cube" }) {
        const auto look = loadLook(faultFile(name));
        ASSERT_TRUE(look.ok()) << look.error().message;
        EXPECT_EQ((*look)->size, 5u);
        EXPECT_EQ((*look)->entries[0], float3(1, 0, 0));
    }
}

TEST(CubeSpellings, EveryCutAndEveryByteChangedIsALookOrAnError) {
    const std::string text = "\xEF\xBB\xBFTitle 'x'\r\nLUT_1D_SIZE 2\nLUT_3D_SIZE 2\nLUT_1D_INPUT_RANGE -1 2\n"
                             "LUT_3D_INPUT_RANGE 0 2\nLUT_IN_VIDEO_RANGE\nLUT_OUT_VIDEO_RANGE\n0 0 0 # a\n1 1e10 1\n" +
                             coloursOf(2);
    size_t taken = 0;
    for (size_t i = 0; i <= text.size(); ++i) {
        fuzzCubeOnce({ reinterpret_cast<const uint8_t*>(text.data()), i });
        for (const char replacement : { '0', '9', '-', 'e', ' ', '\n', '\r', '"', '\'', '#', '\0', '\xff' }) {
            std::string changed = text;
            if (i < text.size()) changed[i] = replacement;
            taken += fuzzCubeOnce({ reinterpret_cast<const uint8_t*>(changed.data()), changed.size() });
        }
    }
    EXPECT_GT(taken, 200u) << "changed numbers are still numbers";
}

} // namespace
} // namespace filament_core::assets
