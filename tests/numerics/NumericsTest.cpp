// SPDX-License-Identifier: Apache-2.0
// shaders/lib over edge grids: fp32 and fp16 compared with fp64 of the same text, and a row for every function in the
// sources.
#include "toolkit/paths/Paths.h"
#include "tools/numerics/Report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace filament_core::shader::numerics {
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
    for (auto const& file : std::filesystem::directory_iterator(tools::sourceDir() / "shaders/lib")) {
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
            << "add a row to tools/numerics/table/*Rows.cpp for a new function of shaders/lib";
}

TEST(NumericsTable, CallsTheFunctionThatARowNames) {
    for (Row const& row : rows()) {
        const std::string_view name = row.function.substr(0, row.function.find('('));
        EXPECT_NE(row.call.text.find(name), std::string_view::npos) << row.function << " calls " << row.call.text;
    }
}

TEST(NumericsTable, IsInTheDocumentRowByRow) {
    std::set<std::string> documented, rowed;
    std::ifstream document(tools::sourceDir() / "docs/numerics.md");
    for (std::string line; std::getline(document, line);) {
        if (line.starts_with("| `")) documented.insert(line.substr(3, line.find('`', 3) - 3));
    }
    for (Row const& row : rows()) rowed.insert(titleOf(row));
    EXPECT_THAT(documented, ::testing::ContainerEq(rowed)) << "run filament-numerics --write docs/numerics.md";
}

TEST(NumericsTable, AgreesWithTheSourcesWhere16BitsAreNotEnough) {
    for (Row const& row : rows()) {
        if (row.fp32Only.empty()) continue;
        std::ostringstream text;
        text << std::ifstream(tools::sourceDir() / "shaders/lib" / (std::string(row.file) + ".glsl")).rdbuf();
        EXPECT_THAT(text.str(), ::testing::HasSubstr("fp32 only")) << row.function;
    }
}

TEST(NumericsTable, JustifiesEveryLimit) {
    for (Row const& row : rows())
        EXPECT_FALSE(row.limits.why.empty() && row.noError.empty())
                << row.function << ": say why its error is so large";
}

/// Every row in every precision, computed once: devices and their compilers take most of the time.
Result<Study> const& study() {
    static const auto* const result = new Result<Study>(runStudy());
    return *result;
}

class NumericsRow : public ::testing::TestWithParam<std::tuple<size_t, Column>> {
protected:
    void SetUp() override {
        ASSERT_TRUE(study()) << study().error().message;
        if (!isMeasured(row(), column())) GTEST_SKIP() << row().fp32Only;
        if (!all().of(column())) GTEST_SKIP() << "no device: " << ::testing::PrintToString(study()->missing);
    }
    Row const& row() const { return rows()[std::get<0>(GetParam())]; }
    Column column() const { return std::get<1>(GetParam()); }
    RowResult const& all() const { return study()->rows[std::get<0>(GetParam())]; }
    Measurement const& result() const { return *all().of(column()); }
    std::string at(std::optional<Point> const& point) const { return point ? describe(row(), *point) : "nowhere"; }
};

TEST_P(NumericsRow, IsFiniteAndWithinItsRangeForInputsInRange) {
    EXPECT_EQ(result().nan + result().infinite, 0u) << "first at " << at(result().firstNotFinite);
    EXPECT_EQ(result().outOfRange, 0u) << "first at " << at(result().firstOutOfRange);
}

TEST_P(NumericsRow, IsAsCloseToDoublePrecisionAsItsLimit) {
    if (!row().noError.empty()) GTEST_SKIP() << row().noError;
    if (!result().isJudged) GTEST_SKIP() << "this device may round as it likes";
    EXPECT_LE(result().worst, limitOf(row(), column()))
            << "at " << at(result().worstAt) << ": " << result().worstResult << " instead of " << result().worstTruth;
}

TEST_P(NumericsRow, KeepsTheOrderOfItsArguments) {
    if (!result().isJudged) GTEST_SKIP() << "this device may round as it likes";
    EXPECT_EQ(result().notMonotone, 0u) << "first at " << at(result().firstNotMonotone);
}

TEST_P(NumericsRow, GivesANumberForInputsBeyondTheirIntervals) {
    if (!row().openOutside.empty()) GTEST_SKIP() << row().openOutside;
    EXPECT_EQ(result().outside[static_cast<size_t>(OutsideInput::Beyond)].nan, 0u);
}

std::string nameOf(Row const& row, Column column) {
    std::string name = fmt::format("{}_{}_{}", row.function, row.part, toString(column));
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_'; });
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, NumericsRow,
                         ::testing::Combine(::testing::Range(size_t{ 0 }, rows().size()),
                                            ::testing::ValuesIn(kColumns)),
                         [](auto const& each) {
                             return nameOf(rows()[std::get<0>(each.param)], std::get<1>(each.param));
                         });

Row const& rowOf(std::string_view function) {
    return *std::find_if(rows().begin(), rows().end(), [&](Row const& row) { return row.function == function; });
}

/// A column that was computed in 32 bits would be far better than its limit, and tell nothing about fp16.
TEST(NumericsStudy, ReallyRoundsTo16BitsInTheHalfColumns) {
    ASSERT_TRUE(study()) << study().error().message;
    for (RowResult const& row : study()->rows) {
        if (row.row->function != "pow5(float)") continue;
        for (const Column column : { Column::VulkanHalf, Column::GlesHalf }) {
            if (auto const& half = row.of(column); half && half->isJudged) {
                EXPECT_GT(half->worst, 1e-4) << toString(column);
            }
        }
    }
}

TEST(NumericsStudy, HasTheSameBitsOnBothApisIn32Bits) {
    ASSERT_TRUE(study()) << study().error().message;
    if (!study()->promisesSameBits) GTEST_SKIP() << "needs Mesa's CPU drivers for Vulkan and OpenGL ES";
    for (RowResult const& row : study()->rows)
        EXPECT_EQ(row.differing[0], 0u) << row.row->function << " " << row.row->part;
}

TEST(NumericsStudy, SelectsRowsByTheirNames) {
    const Result<Study> some = runStudy("visibilitySmith");
    ASSERT_TRUE(some) << some.error().message;
    EXPECT_EQ(some->rows.size(), 4u);
}

TEST(NumericsReport, HasEveryCountOfEveryColumn) {
    const Result<Study> study = runStudy("pow5");
    ASSERT_TRUE(study) << study.error().message;
    const std::string csv = csvOf(*study);
    const auto& columns = study->rows[0].columns;
    const auto measured = std::count_if(columns.begin(), columns.end(), [](auto const& c) { return c.has_value(); });
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + measured);
    EXPECT_THAT(csv, ::testing::HasSubstr("math,\"pow5(float)\",\"\",C++ fp32,"));
    EXPECT_THAT(jsonOf(*study), ::testing::HasSubstr("\"function\": \"pow5(float)\""));
    EXPECT_THAT(terminalTable(*study), ::testing::HasSubstr("pow5(float)"));
}

TEST(NumericsReport, DoesNotJudgeTheRoundingOfOtherDevices) {
    Result<Study> study = runStudy("pow5");
    ASSERT_TRUE(study) << study.error().message;
    Measurement& result = *study->rows[0].columns[0];
    result.worst = 1;
    EXPECT_EQ(violationCount(*study), 1u);
    result.isJudged = false;
    EXPECT_EQ(violationCount(*study), 0u);
    result.infinite = 1;
    EXPECT_EQ(violationCount(*study), 1u) << "infinity is wrong everywhere";
}

TEST(NumericsReport, NamesABrokenPromiseInEveryTable) {
    Result<Study> study = runStudy("pow5");
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_EQ(violationCount(*study), 0u);
    study->rows[0].columns[0]->nan = 3;
    EXPECT_EQ(violationCount(*study), 1u);
    EXPECT_THAT(terminalTable(*study), ::testing::HasSubstr("! C++ fp32: 3 NaN"));
    EXPECT_THAT(markdownOf(*study), ::testing::HasSubstr("**C++ fp32: 3 NaN"));
}

/// Typical human errors; this table found some of them when it was new.
struct Defect {
    const char* name;
    const char* function;
    Mutation mutation;
};

class NumericsMutation : public ::testing::TestWithParam<Defect> {};

TEST_P(NumericsMutation, IsNoticedOnEveryDevice) {
    const Result<Study> mutant = runStudy(GetParam().function, GetParam().mutation);
    ASSERT_TRUE(mutant) << mutant.error().message;
    ASSERT_FALSE(mutant->rows.empty());
    if (!mutant->promisesSameBits) GTEST_SKIP() << "needs devices whose errors are judged";
    std::array<size_t, kColumns.size()> found{};
    for (RowResult const& row : mutant->rows) {
        for (const Column column : kColumns) {
            if (row.of(column))
                found[static_cast<size_t>(column)] += violations(*row.row, column, *row.of(column)).size();
        }
    }
    const auto of = [&](Column column) { return found[static_cast<size_t>(column)]; };
    EXPECT_EQ(of(Column::Cpp), 0u) << "C++ is not mutated";
    EXPECT_GT(of(Column::VulkanSingle) + of(Column::VulkanHalf), 0u);
    EXPECT_GT(of(Column::GlesSingle) + of(Column::GlesHalf), 0u);
}

INSTANTIATE_TEST_SUITE_P(
        Of, NumericsMutation,
        ::testing::Values(
                Defect{ "GrazingDivisionByZero",
                        "visibilitySmithGgxCorrelatedFast",
                        { "nol + nov, alpha), kMinVisibilityDenominator)", "nol + nov, alpha), 0.0f)" } },
                Defect{ "DenominatorThat16BitsRoundToZero", "visibilitySmith", { "6.103515625e-5f", "1e-10f" } },
                Defect{ "HalfVectorBehindTheSurface",
                        "ndfGgxFromVectors",
                        { "dot(n, h) * alpha", "saturate(dot(n, h)) * alpha" } },
                Defect{ "CancellationAtTheHighlight",
                        "ndfGgx(",
                        { "(1.0f - noh) * (1.0f + noh)", "1.0f - noh * noh" } },
                Defect{ "CancellationNextToAMirror",
                        "iorFromF0",
                        { "(1.0f + r) * (1.0f + r) / (1.0f - f0)", "(1.0f + r) / (1.0f - r)" } },
                Defect{ "CancellationOfASmallPower",
                        "oneMinusExp",
                        { "return x < 0.125f ? series : 1.0f - exp(-x);", "return 1.0f - exp(-x);" } },
                Defect{ "GrazingAngleLost",
                        "refractedCosine",
                        { "sqrt(max((ior - 1.0f) * (ior + 1.0f) + nov * nov, 0.0f)) / ior",
                          "sqrt(max(1.0f - (1.0f - nov * nov) / (ior * ior), 0.0f))" } },
                Defect{ "CoatWithoutABound",
                        "visibilityKelemen",
                        { "max(voh * voh, kMinVisibilityDenominator)", "voh * voh" } },
                Defect{ "LambdaBeyond16Bits",
                        "visibilityCharlie",
                        { "exp(charlieLogLambda(nov, alpha) + logProduct)",
                          "exp(charlieLogLambda(nov, alpha)) * nov * nol" } },
                Defect{ "CosineAboveOne",
                        "importanceSampleGgx",
                        { "float length2 = cosTheta2 + sinTheta2;",
                          "float length2 = 1.0f + (alpha + 1.0f) * ((alpha - 1.0f) * u.y);" } },
                Defect{ "FitAboveItsRange",
                        "multiBounceAo",
                        { "min(((visibility * a + b) * visibility + c) * visibility, 1.0f)",
                          "((visibility * a + b) * visibility + c) * visibility" } },
                Defect{ "OverflowOfBrightLight", "toneMap(", { "clamp(color, 0.0f, 1e4f)", "max(color, 0.0f)" } },
                Defect{ "MisplacedJoint", "srgbFromLinear", { "x <= 0.0031308f", "x <= 0.031308f" } },
                Defect{ "NegativeIrradiance", "irradianceSh", { "return max(e, vec3(0.0f));", "return e;" } },
                Defect{ "ThresholdForgotten",
                        "filteredPerceptualRoughness",
                        { "min(2.0f * kernel, threshold)", "2.0f * kernel" } },
                Defect{ "WrongOrderOfTheWindow", "distanceAttenuation", { "1.0f - ratio * ratio", "1.0f - ratio" } }),
        [](auto const& each) { return std::string(each.param.name); });

TEST(NumericsStudy, FailsForAMutationWithoutItsText) {
    const Result<Study> mutant = runStudy("pow5", Mutation{ "no such text", "" });
    ASSERT_FALSE(mutant);
    EXPECT_EQ(mutant.error().code, ErrorCode::NotFound);
}

/// Mutations that prove the measurement: it detects a result that is off by one part in a thousand, NaN, out of range,
/// or in the wrong order.
class MeasurementOf : public ::testing::Test {
protected:
    Row const& row = rowOf("pow5(float)");
    const Points points = pointsOf(row, Format::Single);
    Results inside = evaluateCpp(row, points.inside);
    Measurement measured() const { return measure(row, Column::Cpp, points, inside, {}); }
};

TEST_F(MeasurementOf, RightResultsHasNothingToSay) {
    EXPECT_THAT(violations(row, Column::Cpp, measured()), ::testing::IsEmpty());
}

TEST_F(MeasurementOf, AWrongResultNamesItsError) {
    inside[inside.size() / 2] *= 1.001f;
    EXPECT_NEAR(measured().worst, 1e-3, 1e-5);
    EXPECT_EQ(violations(row, Column::Cpp, measured()).size(), 1u);
}

TEST_F(MeasurementOf, ANaNAndAnInfinityCountsThem) {
    inside.front().x = std::numeric_limits<float>::quiet_NaN();
    inside.back().x = std::numeric_limits<float>::infinity();
    EXPECT_EQ(measured().nan, 1u);
    EXPECT_EQ(measured().infinite, 1u);
    EXPECT_THAT(violations(row, Column::Cpp, measured()), ::testing::Contains(::testing::HasSubstr("1 NaN and 1 inf")));
}

TEST_F(MeasurementOf, AResultAboveTheRangeCountsIt) {
    inside.back().x = 1.0000001f;
    EXPECT_EQ(measured().outOfRange, 1u);
}

TEST_F(MeasurementOf, AStepBackCountsIt) {
    std::swap(inside[inside.size() - 2], inside[inside.size() - 20]);
    EXPECT_GT(measured().notMonotone, 0u);
}

} // namespace
} // namespace filament_core::shader::numerics
