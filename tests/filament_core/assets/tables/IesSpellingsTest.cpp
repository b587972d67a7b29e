// SPDX-License-Identifier: Apache-2.0
// Photometric files as manufacturers' programs write them: spellings of the first line and of TILT, and types A and B
// with one horizontal angle.
#include "filament_core/assets/files/FileBytes.h"
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/fuzz/IesFuzzBody.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace filament_core::assets {
namespace {

struct Spelling {
    std::string before = "";                  ///< bytes before everything
    std::string first = "IESNA:LM-63-2002\n"; ///< with its line end
    std::string tilt = "TILT=NONE\n";
    int type = 1; ///< as in the file: 1 is C, 2 is B, 3 is A
    std::string vertical = "0 30 60 90", horizontal = "0", candelas = "100 80 40 0";
    int verticals = 4;
};

std::string iesTextOf(Spelling const& s) {
    return fmt::format("{}{}[TEST] x\n{}1 1000 1 {} 1 {} 2 0 0 0\n1 0.5 50\n{}\n{}\n{}\n", s.before, s.first, s.tilt,
                       s.verticals, s.type, s.vertical, s.horizontal, s.candelas);
}

Result<IesFile> readIesText(std::string const& text) { return readIes(std::as_bytes(std::span(text)), "lamp.ies"); }

float peakOf(Spelling const& spelling) {
    const auto file = readIesText(iesTextOf(spelling));
    EXPECT_TRUE(file.ok()) << file.error().message << "\n" << iesTextOf(spelling);
    return file.ok() ? file->peak : 0;
}

double3 directionAt(double degreesFromForward, double around) {
    const double a = glm::radians(degreesFromForward), b = glm::radians(around);
    return { std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a) };
}

TEST(IesSpellings, TiltIsReadInAnyCaseAndWithAnyBlanks) {
    size_t cases = 0;
    for (const std::string_view key : { "TILT", "Tilt", "tilt" }) {
        for (const std::string_view equals : { "=", " =", "= ", " = ", "\t=\t", "  =  " }) {
            for (const std::string_view value : { "NONE", "None", "none", "INCLUDE", "Include", "include" }) {
                for (const std::string_view end : { "\n", " \n", "\t\r\n", "\r" }) {
                    const bool isIncluded = (value[0] | 32) == 'i';
                    Spelling spelling{ .tilt = fmt::format(" {}{}{}{}", key, equals, value, end) };
                    if (isIncluded) spelling.tilt += "1\n3\n0 45 90\n0.8 0.95 1\n";
                    EXPECT_NEAR(peakOf(spelling), isIncluded ? 80 : 100, 1e-4f) << spelling.tilt;
                    ++cases;
                }
            }
        }
    }
    EXPECT_EQ(cases, 3u * 6 * 6 * 4);
}

TEST(IesSpellings, TheEditionIsReadInAnySpelling) {
    for (const std::string_view mark : { "", "\xEF\xBB\xBF" }) {
        for (const std::string_view blank : { "", "\n", " \r\n\n" }) {
            const std::string before = std::string(mark) + std::string(blank);
            for (const char* later :
                 { "IESNA:LM-63-1995\n", "IESNA:LM-63-2002\r\n", "IESNA: LM-63-2002\n", "iesna:lm-63-2002 \n",
                   "IESNA LM-63-2002\n", "IES:LM-63-2019\n", "IESNA:LM63-2002\n" })
                EXPECT_NEAR(peakOf({ .before = before, .first = later }), 100, 1e-4f) << later;
            for (const char* old :
                 { "IESNA91\n", "iesna91\r\n", "IESNA:LM-63-1986\n", "IESNA:LM-63-1991\n", "A lamp of 1986\n" })
                EXPECT_NEAR(peakOf({ .before = before, .first = old }), 50, 1e-4f)
                        << old << ": its second factor counts";
        }
    }
}

// One plane through the axis says the same in all types: the angle from forward, on its two sides.
TEST(IesSpellings, TypesAAndBWithOnePlaneAreOfRevolution) {
    for (const int type : { 2, 3 }) {
        for (const char* plane : { "0", "90", "-90", "12.5" }) {
            const auto file = readIesText(iesTextOf({ .type = type, .horizontal = plane }));
            ASSERT_TRUE(file.ok()) << file.error().message;
            const auto asC = readIesText(iesTextOf({ .type = 1 }));
            for (double v = 0; v <= 180; v += 7.5) {
                for (double h = 0; h < 360; h += 30)
                    EXPECT_NEAR(file->candelasAt(directionAt(v, h)), asC->candelasAt(directionAt(v, h)), 1e-4)
                            << v << ' ' << h;
            }
        }
        const auto file = readIesText(iesTextOf(
                { .type = type, .vertical = "-80 -40 0 20 90", .candelas = "0 40 100 60 10", .verticals = 5 }));
        ASSERT_TRUE(file.ok()) << file.error().message;
        EXPECT_EQ(file->type, IesType::C);
        EXPECT_NEAR(file->candelasAt({ 0, 0, -1 }), 100, 1e-3);
        EXPECT_NEAR(file->candelasAt(directionAt(20, 0)), 60, 1e-3);
        EXPECT_NEAR(file->candelasAt(directionAt(40, 180)), 40, 1e-3);
        EXPECT_NEAR(file->candelasAt(directionAt(20, 180)), 70, 1e-3) << "between its angles";
        EXPECT_NEAR(file->candelasAt(directionAt(20, 90)), 65, 1e-3) << "between its sides";
        EXPECT_NEAR(file->candelasAt(directionAt(85, 180)), 0, 1e-3) << "beyond its angles";
        EXPECT_NEAR(file->candelasAt(directionAt(90, 0)), 10, 1e-3);
    }
}

TEST(IesSpellings, TypesAAndBMayCoverUnequalSides) {
    const auto file = readIesText("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 2 2 0 0 0\n1 1 50\n-30 30\n-20 0 60\n"
                                  "1 1 3 3 5 5\n");
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_NEAR(file->candelasAt({ 0, -std::sin(glm::radians(30.0)), -std::cos(glm::radians(30.0)) }), 4, 1e-6);
    EXPECT_EQ(file->candelasAt({ 0, std::sin(glm::radians(30.0)), -std::cos(glm::radians(30.0)) }), 0);
}

TEST(IesSpellings, BrokenOnesNameTheLineAndTheCure) {
    const auto errorOf = [](Spelling const& spelling) {
        const auto file = readIesText(iesTextOf(spelling));
        return file.ok() ? std::string("no error") : file.error().message;
    };
    EXPECT_EQ(errorOf({ .tilt = "TILT=\n" }),
              "lamp.ies: line 4: TILT= names nothing; expected TILT=NONE or TILT=INCLUDE");
    EXPECT_EQ(errorOf({ .tilt = "Tilt = lamp.tlt\n" }),
              "lamp.ies: line 4: TILT=lamp.tlt names another file; put its data into this one with TILT=INCLUDE");
    EXPECT_NE(errorOf({ .tilt = "TILTED\n" }).find("there is no line 'TILT='"), std::string::npos);
    EXPECT_NE(errorOf({ .tilt = "TILT=INCLUDE\n1\n2\n90 0\n1 1\n" }).find("not above the 90"), std::string::npos);
}

TEST(IesSpellings, ThoseOfProgramsAreRead) {
    SKIP_WITHOUT_FAULT_FILES();
    for (const char* name : { "ies_tilt_space.ies", "ies_typeB_one_angle.ies" }) {
        const auto bytes = readFileBytes(faultFile(name));
        ASSERT_TRUE(bytes);
        const auto file = readIes(*bytes, name);
        ASSERT_TRUE(file.ok()) << file.error().message;
        EXPECT_NEAR(file->candelasAt(directionAt(30, 200)), 80, 1e-4);
    }
}

TEST(IesSpellings, EveryByteChangedIsAFileOrAnError) {
    const std::string text = iesTextOf({ .before = "\xEF\xBB\xBF\n",
                                         .tilt = "Tilt = Include\n1\n2\n0 90\n1 0.9\n",
                                         .type = 2,
                                         .vertical = "-80 -40 0 20 90",
                                         .candelas = "0 40 100 60 10",
                                         .verticals = 5 });
    size_t taken = 0;
    for (size_t i = 0; i <= text.size(); ++i) {
        fuzzIesOnce({ reinterpret_cast<const uint8_t*>(text.data()), i });
        for (const char replacement : { '0', '9', '-', '.', '=', ' ', '\n', '\xff' }) {
            std::string changed = text;
            if (i < text.size()) changed[i] = replacement;
            taken += fuzzIesOnce({ reinterpret_cast<const uint8_t*>(changed.data()), changed.size() });
        }
    }
    EXPECT_GT(taken, 300u);
}

} // namespace
} // namespace filament_core::assets
