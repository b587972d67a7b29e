// SPDX-License-Identifier: Apache-2.0
// shaders/lib over edge grids: fp32 against fp64 of the same text, and a row for every function that the sources
// define.
#include "tests/numerics/table/Measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace filament::shader::numerics {
namespace {

/// "const vec4 sh[9]" -> "vec4[9]".
std::string typeOf(std::string parameter) {
    static const std::regex kParameter(R"(\s*(?:const\s+)?(OUT\(\w+\)|\w+)\s+\w+(\[\d+\])?\s*)");
    std::smatch match;
    if (!std::regex_match(parameter, match, kParameter)) return parameter;
    return match[1].str() + match[2].str();
}

std::string signatureOf(std::string const& name, std::string const& parameters) {
    std::string types;
    std::istringstream list(parameters);
    for (std::string each; std::getline(list, each, ',');) types += (types.empty() ? "" : ", ") + typeOf(each);
    return name + "(" + types + ")";
}

/// name(types) of every function that shaders/lib defines.
std::set<std::string> definedFunctions() {
    static const std::regex kFunction(
            R"((?:^|\n)(?:float|vec[234]|bool|int|uint|void|mat[34])\s+(\w+)\(((?:[^()]|\(\w+\))*)\)\s*\{)");
    std::set<std::string> functions;
    for (auto const& file : std::filesystem::directory_iterator(FILAMENT_SOURCE_DIR "/shaders/lib")) {
        if (file.path().extension() != ".glsl") continue;
        std::ostringstream text;
        text << std::ifstream(file.path()).rdbuf();
        const std::string source = text.str();
        for (std::sregex_iterator match(source.begin(), source.end(), kFunction), end; match != end; ++match)
            functions.insert(signatureOf((*match)[1], (*match)[2]));
    }
    return functions;
}

TEST(NumericsTable, HasARowForEveryFunctionAndNoOther) {
    std::set<std::string> rowed;
    for (Row const& row : rows()) rowed.emplace(row.function);
    EXPECT_THAT(rowed, ::testing::ContainerEq(definedFunctions()))
            << "add a row to tests/numerics/table/*Rows.cpp for a new function of shaders/lib";
}

TEST(NumericsTable, CallsTheFunctionThatARowNames) {
    for (Row const& row : rows()) {
        const std::string_view name = row.function.substr(0, row.function.find('('));
        EXPECT_NE(row.call.text.find(name), std::string_view::npos) << row.function << " calls " << row.call.text;
    }
}

TEST(NumericsTable, JustifiesEveryLimit) {
    for (Row const& row : rows())
        EXPECT_FALSE(row.limits.why.empty() && row.noError.empty())
                << row.function << ": say why its error is so large";
}

class NumericsRow : public ::testing::TestWithParam<size_t> {
protected:
    Row const& row() const { return rows()[GetParam()]; }
    Measurement cpp() const {
        const Points points = pointsOf(row(), Format::Single);
        return measure(row(), Column::Cpp, points, evaluateCpp(row(), points.inside),
                       evaluateCpp(row(), points.outside));
    }
    std::string at(std::optional<Point> const& point) const { return point ? describe(row(), *point) : "nowhere"; }
};

TEST_P(NumericsRow, IsFiniteAndWithinItsRangeForInputsInRange) {
    const Measurement result = cpp();
    EXPECT_EQ(result.nan + result.infinite, 0u) << "first at " << at(result.firstNotFinite);
    EXPECT_EQ(result.outOfRange, 0u) << "first at " << at(result.firstOutOfRange);
}

TEST_P(NumericsRow, IsAsCloseToDoublePrecisionAsItsLimit) {
    if (!row().noError.empty()) GTEST_SKIP() << row().noError;
    const Measurement result = cpp();
    EXPECT_LE(result.worst, row().limits.cpp)
            << "at " << at(result.worstAt) << ": " << result.worstResult << " instead of " << result.worstTruth;
}

TEST_P(NumericsRow, KeepsTheOrderOfItsArguments) {
    const Measurement result = cpp();
    EXPECT_EQ(result.notMonotone, 0u) << "first at " << at(result.firstNotMonotone);
}

TEST_P(NumericsRow, GivesANumberForInputsBeyondTheirIntervals) {
    if (row().outside == Outside::Open) GTEST_SKIP() << row().outsideWhy;
    EXPECT_EQ(cpp().outside[static_cast<size_t>(OutsideInput::Beyond)].nan, 0u);
}

INSTANTIATE_TEST_SUITE_P(Of, NumericsRow, ::testing::Range(size_t{ 0 }, rows().size()), [](auto const& each) {
    Row const& row = rows()[each.param];
    std::string name = std::string(row.function) + "_" + std::string(row.part);
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_'; });
    return name;
});

/// The mutation that proves the measurement: a result that is off by one part in a thousand, or NaN, is found.
TEST(Measurement, FindsAWrongResultAndANaN) {
    Row const& row =
            *std::find_if(rows().begin(), rows().end(), [](Row const& r) { return r.function == "sq(float)"; });
    const Points points = pointsOf(row, Format::Single);
    Results inside = evaluateCpp(row, points.inside);
    inside.back() *= 1.001f;
    inside.front().x = std::numeric_limits<float>::quiet_NaN();
    const Measurement result = measure(row, Column::Cpp, points, inside, {});
    EXPECT_NEAR(result.worst, 1e-3, 1e-5);
    EXPECT_EQ(result.nan, 1u);
}

} // namespace
} // namespace filament::shader::numerics
