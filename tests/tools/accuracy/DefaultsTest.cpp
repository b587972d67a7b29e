// SPDX-License-Identifier: Apache-2.0
// The defaults lie on the measured fronts of docs/accuracy/results.json: no other value of a row has a smaller error in
// no more time, unless docs/quality.md says why the default stays.
#include "toolkit/paths/Paths.h"
#include "tools/accuracy/Settings.h"

#include <filament_core/Options.h>
#include <filament_core/Quality.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace filament_core::accuracy {
namespace {

using MeasuredJson = nlohmann::ordered_json;

constexpr double kNoSlower = 1.02;     // of the time of the default: what rounds on a busy machine can tell apart
constexpr double kSmallerError = 0.02; // of the error of the default

MeasuredJson measuredRows() {
    std::ifstream file(tools::sourceDir() / "docs/accuracy/results.json");
    return MeasuredJson::parse(file)["effects"];
}

MeasuredJson const& standardOf(MeasuredJson const& row) {
    return *std::ranges::find_if(row["values"], [&](auto const& value) { return value["value"] == row["standard"]; });
}

/// Beyond the standard error of the reference, which all values of a row share.
bool isNearer(MeasuredJson const& row, MeasuredJson const& value) {
    const double standard = standardOf(row)["ownError"].get<double>();
    const double noise = std::max(row["referenceError"].get<double>(), kSmallerError * standard);
    return value["ownError"].get<double>() < standard - noise;
}

bool dominates(MeasuredJson const& row, MeasuredJson const& value) {
    return isNearer(row, value) && std::ranges::all_of(value["ratio"], [](auto const& ratio) {
               return ratio.template get<double>() <= kNoSlower;
           });
}

/// The table of docs/quality.md: the reason of each row and value.
std::map<std::pair<std::string, std::string>, std::string> reasons() {
    std::ifstream file(tools::sourceDir() / "docs/quality.md");
    std::string line;
    while (std::getline(file, line) && line != "## Defaults that are not the nearest") continue;
    std::map<std::pair<std::string, std::string>, std::string> all;
    while (std::getline(file, line) && !line.starts_with("## ")) {
        if (!line.starts_with("| `")) continue;
        std::istringstream cells(line.substr(1));
        std::string row, values, reason, value;
        std::getline(cells, row, '|'), std::getline(cells, values, '|'), std::getline(cells, reason, '|');
        std::erase_if(row, [](char c) { return c == ' ' || c == '`'; });
        std::istringstream list(values); // `a`, `b`
        while (std::getline(list, value, '`') && std::getline(list, value, '`')) all[{ row, value }] = reason;
    }
    return all;
}

TEST(MeasuredDefaults, AreDominatedOnlyForAReasonInTheDocuments) {
    const auto known = reasons();
    for (MeasuredJson const& row : measuredRows()) {
        for (MeasuredJson const& value : row["values"]) {
            if (!dominates(row, value)) continue;
            const auto reason = known.find({ row["name"], value["value"] });
            ASSERT_TRUE(reason != known.end())
                    << row["name"] << ": " << value["value"] << " has the error " << value["ownError"] << " where "
                    << row["standard"] << ", the default, has " << standardOf(row)["ownError"] << ", and takes "
                    << value["ratio"] << " of its time; make it the default, or give the reason in docs/quality.md";
            EXPECT_GE(std::ranges::count(reason->second, ' '), 5) << row["name"] << ": a sentence, not a word";
        }
    }
}

TEST(MeasuredDefaults, EveryReasonIsOneForAMeasuredValueThatIsNearer) {
    const MeasuredJson rows = measuredRows();
    for (auto const& [key, reason] : reasons()) {
        const bool isNeeded = std::ranges::any_of(rows, [&](MeasuredJson const& row) {
            return row["name"] == key.first && std::ranges::any_of(row["values"], [&](MeasuredJson const& value) {
                       return value["value"] == key.second && isNearer(row, value);
                   });
        });
        EXPECT_TRUE(isNeeded) << key.first << ' ' << key.second << ": its error is not smaller; delete the reason";
    }
}

bool offers(MeasuredJson const& row, std::string const& word) {
    return std::ranges::any_of(row["values"], [&](MeasuredJson const& value) {
        return std::ranges::any_of(value["set"], [&](MeasuredJson const& each) { return each == word; });
    });
}

TEST(MeasuredDefaults, AreTheStandardsOfRowsThatOfferThem) {
    for (MeasuredJson const& row : measuredRows()) {
        for (MeasuredJson const& word : standardOf(row)["set"]) {
            const std::string text = word.get<std::string>(), name = text.substr(0, text.find('='));
            const std::optional<std::string> standard = optionValue(Quality{}, name);
            if (standard && offers(row, name + '=' + *standard))
                EXPECT_EQ(text, name + '=' + *standard) << row["name"] << ": measure it again";
        }
    }
}

TEST(MeasuredDefaults, AreTimedInFramesThatShowTheDifference) {
    const auto differs = [](MeasuredJson const& row, const char* error) {
        return std::ranges::any_of(row["values"],
                                   [&](auto const& value) { return value[error] != row["values"][0][error]; });
    };
    for (MeasuredJson const& row : measuredRows()) {
        EXPECT_TRUE(!differs(row, "ownError") || differs(row, "error"))
                << row["name"] << ": all values draw the same '" << row["frame"].get<std::string>()
                << "'; give the row a frame in which they differ";
    }
}

TEST(MeasuredDefaults, ADominatedOneIsNoticed) {
    MeasuredJson row = MeasuredJson::parse(R"({ "standard": "a", "referenceError": 0.01, "values": [
        { "value": "a", "ownError": 0.1, "ratio": { "vulkan": 1, "gles": 1 } },
        { "value": "b", "ownError": 0.05, "ratio": { "vulkan": 1.01, "gles": 0.9 } },
        { "value": "slower", "ownError": 0.05, "ratio": { "vulkan": 1.01, "gles": 1.1 } },
        { "value": "noise", "ownError": 0.095, "ratio": { "vulkan": 0.5, "gles": 0.5 } } ] })");
    EXPECT_FALSE(dominates(row, row["values"][0]));
    EXPECT_TRUE(dominates(row, row["values"][1]));
    EXPECT_FALSE(dominates(row, row["values"][2]));
    EXPECT_FALSE(dominates(row, row["values"][3]));
}

} // namespace
} // namespace filament_core::accuracy
