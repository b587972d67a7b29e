// SPDX-License-Identifier: Apache-2.0
// Cost tables as JSON: written tables are read back; errors are refused with their place and the reason.
#include "tests/fuzz/QualityCostsFuzzBody.h"

#include <filament_core/QualityCosts.h>

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace filament_core {
namespace {

constexpr const char* kTable = R"({
  "machine": "m", "driver": "d", "commit": "c", "size": [320, 180],
  "effects": [
    { "name": "fresnel", "values": [
      { "value": "schlick", "error": 0.25, "milliseconds": { "vulkan": 2, "gles": 4 } },
      { "value": "exact", "error": 0, "milliseconds": { "vulkan": 3, "gles": 5 },
        "interval": { "vulkan": [1.25, 1.75], "gles": [1.125, 1.5] } } ] },
    { "name": "shBands", "values": [
      { "value": "3", "error": 0, "milliseconds": { "vulkan": 2, "gles": 4 } } ] } ] })";

std::string with(std::string_view before, std::string_view after) {
    std::string text = kTable;
    const size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return text.replace(at, before.size(), after);
}

TEST(QualityCostsFile, ATableIsReadAsItStands) {
    const Result<QualityCosts> costs = readQualityCosts(kTable, "table");
    ASSERT_TRUE(costs) << costs.error().message;
    EXPECT_EQ(costs->machine, "m");
    EXPECT_EQ(costs->driver, "d");
    EXPECT_EQ(costs->commit, "c");
    EXPECT_EQ(costs->size, uint2(320, 180));
    ASSERT_EQ(costs->effects.size(), 2u);
    QualityCost const& exact = costs->effects[0].values[1];
    EXPECT_EQ(exact.value, "exact");
    EXPECT_EQ(exact.vulkan.milliseconds, 3);
    EXPECT_EQ(exact.vulkan.lowRatio, 1.25);
    EXPECT_EQ(exact.gles.highRatio, 1.5);
    EXPECT_EQ(costs->effects[0].values[0].error, 0.25);
    EXPECT_EQ(costs->effects[0].values[0].gles.lowRatio, 1) << "without an interval the ratio itself";
}

TEST(QualityCostsFile, WhatIsWrittenIsReadBack) {
    const Result<QualityCosts> costs = readQualityCosts(kTable, "table");
    ASSERT_TRUE(costs);
    const std::string once = toJson(*costs);
    const Result<QualityCosts> again = readQualityCosts(once, "again");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(toJson(*again), once);
    EXPECT_EQ(again->effects[0].values[1].gles.milliseconds, 5);
}

TEST(QualityCostsFile, TextThatJsonCannotHoldIsReplacedNotThrown) {
    Result<QualityCosts> costs = readQualityCosts(kTable, "table");
    ASSERT_TRUE(costs);
    costs->machine = "\xff\"";
    EXPECT_TRUE(readQualityCosts(toJson(*costs), "table"));
}

struct Refused {
    const char *name, *before, *after, *complaint;
};
void PrintTo(Refused const& refused, std::ostream* out) { *out << refused.name; }
class RefusedTable : public testing::TestWithParam<Refused> {};

TEST_P(RefusedTable, NamesThePlaceAndTheReason) {
    const Result<QualityCosts> costs = readQualityCosts(with(GetParam().before, GetParam().after), "my.json");
    ASSERT_FALSE(costs) << "it was taken";
    std::string const& message = costs.error().message;
    EXPECT_TRUE(message.starts_with("my.json: ")) << message;
    EXPECT_NE(message.find(GetParam().complaint), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

constexpr Refused kRefused[] = {
    { "NegativeError", "0.25", "-0.25", "effects[0].values[0].error: must be a number from 0 to 100" },
    { "ErrorBeyondTheRange", "0.25", "101", "effects[0].values[0].error" },
    { "NegativeTime", "\"vulkan\": 3", "\"vulkan\": -3", "effects[0].values[1].milliseconds.vulkan: must be a number" },
    { "NoTime", "\"vulkan\": 3", "\"vulkan\": 0", "milliseconds.vulkan" },
    { "NotANumber", "\"vulkan\": 3", "\"vulkan\": \"NaN\"", "must be a number" },
    { "NanAsLiteral", "\"vulkan\": 3", "\"vulkan\": NaN", "the JSON is broken at byte" },
    { "InfiniteNumber", "\"vulkan\": 3", "\"vulkan\": 1e999", "number beyond the range of double" },
    { "UnknownChoice", "\"fresnel\"", "\"fresnell\"",
      "there is no quality choice 'fresnell'; did you mean 'fresnel'?" },
    { "UnknownValue", "\"exact\"", "\"exakt\"", "effects[0].values[1].value: option fresnel: 'exakt'" },
    { "ValueTwice", "\"exact\"", "\"schlick\"", "'schlick' is there twice" },
    { "DefaultMissing", "\"value\": \"3\"", "\"value\": \"2\"", "'3', the default that the others are compared with" },
    { "EffectTwice", "\"shBands\"", "\"fresnel\"", "option fresnel: '3'" },
    { "BackendOfSomeOnly", "3, \"gles\": 5", "3", "fresnel=exact: no milliseconds.gles, which others have" },
    { "NoSize", "\"size\": [320, 180],", "", "size: must be width and height in pixels" },
    { "EmptySize", "[320, 180]", "[0, 180]", "size: must be width and height in pixels" },
    { "BackwardInterval", "[1.25, 1.75]", "[1.75, 1.25]", "interval.vulkan: must be the least and the largest ratio" },
    { "NotAnObject", "{ \"value\": \"3\"", "3, { \"value\": \"3\"", "must be an object" },
};
INSTANTIATE_TEST_SUITE_P(All, RefusedTable, testing::ValuesIn(kRefused),
                         [](auto const& test) { return std::string(test.param.name); });

TEST(QualityCostsFile, EmptyTablesAreRefused) {
    for (const char* text : { "", "[]", "{}", R"({"size": [1, 1], "effects": []})" }) {
        const Result<QualityCosts> costs = readQualityCosts(text, "empty");
        ASSERT_FALSE(costs) << text;
        EXPECT_TRUE(costs.error().message.starts_with("empty: ")) << costs.error().message;
    }
    const Result<QualityCosts> untimed = readQualityCosts(
            R"({"size": [1, 1], "effects": [{"name": "shBands", "values": [{"value": "3", "error": 0}]}]})", "untimed");
    ASSERT_FALSE(untimed);
    EXPECT_NE(untimed.error().message.find("no milliseconds of vulkan or gles"), std::string::npos)
            << untimed.error().message;
}

TEST(QualityCostsFile, AMissingFileIsNamed) {
    const Result<QualityCosts> costs = loadQualityCosts("no/such/costs.json");
    ASSERT_FALSE(costs);
    EXPECT_NE(costs.error().message.find("no/such/costs.json"), std::string::npos);
}

TEST(QualityCostsFile, EveryCutAndEveryByteChangedIsATableOrAnError) {
    const std::string table = kTable;
    size_t taken = 0;
    for (size_t i = 0; i < table.size(); ++i) {
        fuzzQualityCostsOnce({ reinterpret_cast<const uint8_t*>(table.data()), i });
        for (const char replacement : { '0', '"', '}', '\xff' }) {
            std::string changed = table;
            changed[i] = replacement;
            taken += fuzzQualityCostsOnce({ reinterpret_cast<const uint8_t*>(changed.data()), changed.size() });
        }
    }
    EXPECT_GT(taken, 50u) << "changed numbers are still numbers";
}

} // namespace
} // namespace filament_core
