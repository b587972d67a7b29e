// SPDX-License-Identifier: Apache-2.0
// Photometric files: every type, symmetry and edition against a function that generates the file, fluxes against closed
// forms, and errors that name line and cure.
#include "tests/fuzz/IesFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <sstream>

namespace filament_core::assets {
namespace {

using std::numbers::pi;

struct IesRecipe {
    std::string header = "IESNA:LM-63-2002\n[TEST] generated\n[MANUFAC] none";
    std::string tilt = "TILT=NONE";
    int type = 1; ///< as in the file: 1 is C, 2 is B, 3 is A
    std::vector<double> vertical, horizontal;
    std::function<double(double vertical, double horizontal)> candelas;
    double multiplier = 1, ballast = 1, second = 1;
    std::string lineEnd = "\n", separator = " ";
};

std::string written(IesRecipe const& recipe) {
    std::ostringstream out;
    out.precision(12);
    const auto list = [&](auto const& values) {
        for (size_t i = 0; i < values.size(); ++i) out << values[i] << (i % 7 == 6 ? "\n" : recipe.separator);
        out << '\n';
    };
    out << recipe.header << '\n' << recipe.tilt << '\n';
    out << "1 1000 " << recipe.multiplier << ' ' << recipe.vertical.size() << ' ' << recipe.horizontal.size() << ' '
        << recipe.type << " 2 0.1 -0.2 0\n"
        << recipe.ballast << ' ' << recipe.second << " 60\n";
    list(recipe.vertical);
    list(recipe.horizontal);
    for (const double h : recipe.horizontal) {
        std::vector<double> plane;
        for (const double v : recipe.vertical) plane.push_back(recipe.candelas(v, h));
        list(plane);
    }
    std::string text = out.str();
    if (recipe.lineEnd == "\n") return text;
    std::string changed;
    for (const char c : text) changed += c == '\n' ? recipe.lineEnd : std::string(1, c);
    return changed;
}

Result<IesFile> readText(std::string const& text) { return readIes(std::as_bytes(std::span(text)), "lamp.ies"); }

IesFile fileOf(IesRecipe const& recipe) {
    const auto file = readText(written(recipe));
    EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().message);
    return file.ok() ? *file : IesFile{};
}

std::vector<double> steps(double first, double last, double step) {
    std::vector<double> angles;
    for (int i = 0; first + i * step <= last + 1e-9; ++i) angles.push_back(first + i * step);
    return angles;
}

double3 polar(double degreesFromForward, double around) {
    const double a = glm::radians(degreesFromForward), b = glm::radians(around);
    return { std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a) };
}

/// Even in both angles and with the symmetry of a quarter.
double quarterLamp(double vertical, double horizontal) {
    return 500 + 300 * std::cos(glm::radians(vertical)) + 100 * std::cos(glm::radians(2 * horizontal));
}

TEST(IesFile, TypeCKeepsEveryValueInEverySymmetry) {
    for (const double last : { 90.0, 180.0, 360.0 }) {
        const IesRecipe recipe{ .vertical = steps(0, 180, 7.5),
                                .horizontal = steps(0, last, 15),
                                .candelas = quarterLamp };
        const IesFile file = fileOf(recipe);
        for (double v = 7.5; v < 180; v += 7.5) {
            for (double h = 0; h < 360; h += 15)
                ASSERT_NEAR(file.candelasAt(polar(v, h)), quarterLamp(v, h), 1e-3) << last << ' ' << v << ' ' << h;
        }
    }
}

TEST(IesFile, PlanesFromNinetyTo270AreMirroredAtTheirOwnPlane) {
    // An odd function of cos(horizontal) differs between the half that is given and the other one.
    const auto lamp = [](double v, double h) { return 500 + v + 100 * std::sin(glm::radians(h)); };
    const IesRecipe recipe{ .vertical = steps(0, 90, 5), .horizontal = steps(90, 270, 15), .candelas = lamp };
    const IesFile file = fileOf(recipe);
    for (double h = 0; h < 360; h += 15) EXPECT_NEAR(file.candelasAt(polar(45, h)), lamp(45, h), 1e-3) << h;
}

TEST(IesFile, AFullTurnMayEndBeforeItsFirstPlane) {
    const auto lamp = [](double, double h) { return 100 + h; };
    const IesFile file = fileOf({ .vertical = { 0, 90 }, .horizontal = steps(0, 345, 15), .candelas = lamp });
    EXPECT_NEAR(file.candelasAt(polar(45, 345)), 445, 1e-3);
    EXPECT_NEAR(file.candelasAt(polar(45, 352.5)), (445 + 100) / 2.0, 1e-2);
}

TEST(IesFile, AnglesMayLieAtAnyDistances) {
    const std::vector<double> angles{ 0, 0.3, 1.1, 4, 17, 17.25, 60, 88.5, 90 };
    const auto lamp = [](double v, double) { return 1 + v * v; };
    const IesFile file = fileOf({ .vertical = angles, .horizontal = { 0 }, .candelas = lamp });
    for (size_t i = 0; i < angles.size(); ++i) {
        EXPECT_NEAR(file.candelasAt(polar(angles[i], 77)), lamp(angles[i], 0), 0.1 + 1e-5 * lamp(angles[i], 0));
        if (i == 0) continue;
        const double middle = (angles[i - 1] + angles[i]) / 2;
        EXPECT_NEAR(file.candelasAt(polar(middle, 5)), (lamp(angles[i - 1], 0) + lamp(angles[i], 0)) / 2, 0.1);
    }
    EXPECT_EQ(file.candelasAt(polar(90.1, 0)), 0) << "beyond the last angle there is no light";
}

TEST(IesFile, TypesAAndBNameDirectionsByLatitudeAndLongitude) {
    const auto lamp = [](double v, double h) { return 1000 + 3 * v + 5 * h; };
    const std::vector<double> angles = steps(-90, 90, 10);
    const IesFile a = fileOf({ .type = 3, .vertical = angles, .horizontal = angles, .candelas = lamp });
    const IesFile b = fileOf({ .type = 2, .vertical = angles, .horizontal = angles, .candelas = lamp });
    for (double v = -80; v <= 80; v += 10) {
        for (double h = -80; h <= 80; h += 10) {
            const double sv = std::sin(glm::radians(v)), cv = std::cos(glm::radians(v));
            const double sh = std::sin(glm::radians(h)), ch = std::cos(glm::radians(h));
            EXPECT_NEAR(a.candelasAt({ sv, -cv * sh, -cv * ch }), lamp(v, h), 1e-2) << v << ' ' << h;
            EXPECT_NEAR(b.candelasAt({ ch * sv, -sh, -ch * cv }), lamp(v, h), 1e-2) << v << ' ' << h;
        }
    }
    EXPECT_EQ(a.candelasAt({ 0, 0, 1 }), 0) << "nothing shines backwards";
    EXPECT_EQ(b.candelasAt({ 0, 0, 1 }), 0);
    const IesFile half = fileOf({ .type = 2, .vertical = angles, .horizontal = steps(0, 90, 10), .candelas = lamp });
    EXPECT_NEAR(half.candelasAt({ 0, std::sin(0.3), -std::cos(0.3) }),
                half.candelasAt({ 0, -std::sin(0.3), -std::cos(0.3) }), 1e-9);
}

TEST(IesFile, FactorsMultiplyAndTheSecondOneCountsInOldEditionsOnly) {
    IesRecipe recipe{ .vertical = { 0, 90 }, .horizontal = { 0 }, .candelas = [](double, double) { return 10; } };
    recipe.multiplier = 2.5, recipe.ballast = 0.9, recipe.second = 0.5;
    EXPECT_NEAR(fileOf(recipe).peak, 22.5f, 1e-4f);
    for (const char* old : { "IESNA91\n[TEST] x", "A label of 1986", "" }) {
        recipe.header = old;
        EXPECT_NEAR(fileOf(recipe).peak, 11.25f, 1e-4f) << old;
    }
    for (const char* later : { "IESNA:LM-63-1995", "IES:LM-63-2019" }) {
        recipe.header = later;
        EXPECT_NEAR(fileOf(recipe).peak, 22.5f, 1e-4f) << later;
    }
}

TEST(IesFile, InlineTiltDataIsReadAndTheFactorOfAnUntiltedLampCounts) {
    IesRecipe recipe{ .vertical = { 0, 90 }, .horizontal = { 0 }, .candelas = [](double, double) { return 10; } };
    recipe.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n0.8 0.95 1.0";
    EXPECT_NEAR(fileOf(recipe).peak, 8, 1e-5f);
    recipe.tilt = "TILT=INCLUDE\n1\n2\n45 90\n0.95 1.0";
    EXPECT_NEAR(fileOf(recipe).peak, 10, 1e-5f);
}

TEST(IesFile, LineEndsAndSeparatorsDoNotMatter) {
    IesRecipe recipe{ .vertical = steps(0, 90, 5), .horizontal = steps(0, 90, 15), .candelas = quarterLamp };
    const std::vector<float> expected = fileOf(recipe).candelas;
    for (const char* end : { "\r\n", "\r" }) {
        recipe.lineEnd = end;
        EXPECT_EQ(fileOf(recipe).candelas, expected);
    }
    recipe.separator = ", ";
    EXPECT_EQ(fileOf(recipe).candelas, expected);
}

TEST(IesFile, ErrorsNameTheLineAndWhatIsExpected) {
    const auto expectError = [](std::string const& text, const char* part) {
        const auto file = readText(text);
        ASSERT_FALSE(file.ok()) << part;
        EXPECT_NE(file.error().message.find(part), std::string::npos) << file.error().message;
    };
    IesRecipe good{ .vertical = { 0, 45, 90 }, .horizontal = { 0 }, .candelas = [](double, double) { return 10; } };
    expectError("", "lamp.ies: line 1: there is no line 'TILT='");
    expectError("PNG\n\n", "there is no line 'TILT='");
    expectError("x\nTILT=lamp.tlt\n", "TILT=lamp.tlt names another file; put its data into this one");
    expectError("x\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0 1 1", "the file ends before the input watts; it is truncated");
    const std::string text = written(good);
    expectError(text.substr(0, text.size() - 6), "the file ends before a candela value; it is truncated");
    const auto with = [&](auto change) {
        IesRecipe bad = good;
        change(bad);
        return written(bad);
    };
    expectError(with([](auto& r) {
                    r.vertical = { 0, 90, 45 };
                }),
                "vertical angle 3 of 3 is 45, which is not above the 90 before it");
    expectError(with([](auto& r) { r.vertical = { 0, 45, 45 }; }), "not above the 45");
    expectError(with([](auto& r) {
                    r.horizontal = { 0, 120 };
                }),
                "horizontal angles from 0 to 120 are no symmetry of type C");
    expectError(with([](auto& r) { r.type = 2, r.horizontal = { 10, 80 }; }), "no symmetry of types A and B");
    expectError(with([](auto& r) { r.type = 4; }), "the photometric type is '4', expected a number from 1 to 3");
    expectError(with([](auto& r) { r.candelas = [](double, double) { return -1; }; }), "a candela value is '-1'");
    expectError(with([](auto& r) { r.candelas = [](double, double) { return 0; }; }), "all candelas are zero");
    expectError(with([](auto& r) { r.candelas = [](double, double) { return 1e9; }, r.multiplier = 1e9; }),
                "a candela value times its factors is 1e+18");
    expectError(with([](auto& r) {
                    r.vertical = { 0, 200 };
                }),
                "vertical angle is '200', expected a number from 0 to 180");
    const auto replaced = [&](const char* from, const char* to) {
        std::string changed = text;
        return changed.replace(changed.find(from), std::string_view(from).size(), to);
    };
    expectError(replaced("1 3 1 1 2", "1 3.5 1 1 2"), "the number of vertical angles is 3.5, expected a whole number");
    expectError(replaced("1 3 1 1 2", "1 99999999999 1 1 2"), "expected a number from 2 to 8192");
    expectError(replaced("1 3 1 1 2", "1 8000 8000 1 2"), "8000 x 8000 candelas are more than 1048576");
    for (const char* bad : { "nan", "inf", "1e999", "0x10", "--3", "lm" })
        expectError(replaced("1000 1", (std::string("1000 ") + bad).c_str()), "the candela multiplier is '");
    const std::vector<std::byte> huge((size_t{ 16 } << 20) + 1);
    EXPECT_FALSE(readIes(huge, "lamp.ies").ok());
}

TEST(IesFile, EveryCutAndEveryByteChangedIsAFileOrAnError) {
    const IesRecipe recipe{ .header = "IESNA:LM-63-1995",
                            .tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 0.9",
                            .vertical = steps(0, 90, 15),
                            .horizontal = steps(0, 90, 30),
                            .candelas = quarterLamp };
    const std::string text = written(recipe);
    size_t taken = 0;
    for (size_t i = 0; i <= text.size(); ++i) {
        taken += fuzzIesOnce({ reinterpret_cast<const uint8_t*>(text.data()), i });
        for (const char replacement : { '0', '9', '-', '.', 'e', ' ', '\n', '\xff' }) {
            std::string changed = text;
            if (i < text.size()) changed[i] = replacement;
            taken += fuzzIesOnce({ reinterpret_cast<const uint8_t*>(changed.data()), changed.size() });
        }
    }
    EXPECT_GT(taken, 500u) << "changed numbers are still numbers";
}

// Everything that the fuzzer found or started from, and every cut of it.
TEST(IesFile, TheCorpusOfTheFuzzerIsFilesAndErrors) {
    size_t taken = 0, all = 0;
    for (auto const& entry : std::filesystem::directory_iterator(tools::sourceDir() / "tests/fuzz/corpus/ies")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
        taken += fuzzIesOnce({ reinterpret_cast<const uint8_t*>(text.data()), text.size() });
        for (size_t i = 0; i < text.size(); ++i) fuzzIesOnce({ reinterpret_cast<const uint8_t*>(text.data()), i });
        ++all;
    }
    EXPECT_GE(taken, 4u);
    EXPECT_GE(all, taken + 4);
}

// ---- tables

TEST(LightProfileTable, HoldsWhatAFileWithRegularAnglesSays) {
    const IesFile file =
            fileOf({ .vertical = steps(0, 90, 5), .horizontal = steps(0, 90, 15), .candelas = quarterLamp });
    const LightProfileTable table = makeLightProfileTable(file);
    EXPECT_EQ(table.rows, 19u);
    EXPECT_EQ(table.columns, 24u);
    EXPECT_EQ(table.peak, file.peak);
    for (double v = 0.7; v < 90; v += 1.3) {
        for (double h = 0.2; h < 360; h += 7.7) {
            const double3 direction = polar(v, h);
            EXPECT_NEAR(table.shareAt(direction), file.candelasAt(direction) / static_cast<double>(file.peak), 2e-5)
                    << v << ' ' << h;
        }
    }
    EXPECT_EQ(table.shareAt(polar(91, 0)), 0) << "the light ends where the file does";
}

TEST(LightProfileTable, StaysNearFilesWithOtherAnglesAndTypes) {
    const auto smooth = [](double v, double h) {
        return 100 + 900 * std::pow(std::cos(glm::radians(v)), 2) * std::pow(std::cos(glm::radians(h)), 2);
    };
    for (const int type : { 1, 2, 3 }) {
        const bool isC = type == 1;
        const IesFile file = fileOf({ .type = type,
                                      .vertical = steps(isC ? 0 : -90, 90, 90 / 33.0),
                                      .horizontal = steps(isC ? 0 : -90, isC ? 180 : 90, 90 / 17.0),
                                      .candelas = smooth });
        const LightProfileTable table = makeLightProfileTable(file);
        double worst = 0;
        for (double v = 0; v < 88; v += 1.7) {
            for (double h = 0; h < 360; h += 6.1) {
                const double3 direction = polar(v, h);
                worst = std::max(worst, std::abs(table.shareAt(direction) -
                                                 file.candelasAt(direction) / static_cast<double>(file.peak)));
            }
        }
        EXPECT_LT(worst, 0.01) << type;
    }
}

TEST(LightProfileTable, LumensAreThoseOfClosedForms) {
    const IesFile even =
            fileOf({ .vertical = { 0, 180 }, .horizontal = { 0 }, .candelas = [](double, double) { return 100; } });
    EXPECT_NEAR(makeLightProfileTable(even).lumens, 400 * pi, 0.5) << "4 pi candelas";
    const auto lambert = [](double v, double) { return 100 * std::cos(glm::radians(v)); };
    const IesFile panel = fileOf({ .vertical = steps(0, 90, 1), .horizontal = { 0 }, .candelas = lambert });
    EXPECT_NEAR(makeLightProfileTable(panel).lumens, 100 * pi, 0.1) << "a Lambertian panel: pi candelas";
    const IesFile turned =
            fileOf({ .vertical = steps(0, 90, 1), .horizontal = steps(0, 360, 15), .candelas = [](double v, double h) {
                        return 100 * std::cos(glm::radians(v)) * (1 + std::cos(glm::radians(h)));
                    } });
    EXPECT_NEAR(makeLightProfileTable(turned).lumens, 100 * pi, 0.2) << "the waves around it cancel";
}

} // namespace
} // namespace filament_core::assets
