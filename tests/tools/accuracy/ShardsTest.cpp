// SPDX-License-Identifier: Apache-2.0
// Rows divided among machines merge to the data of one run; what is no complete run is refused with its file.
#include "tools/accuracy/Shards.h"
#include "toolkit/paths/Paths.h"
#include "tools/accuracy/Page.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <fstream>
#include <functional>
#include <random>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Data as measured, with numbers that are functions of the row.
Results resultsOf(std::vector<std::string> const& rows, std::string const& machine = "a machine") {
    const auto effects = readEffects(tools::sourceDir() / "tools/accuracy/effects.json");
    EXPECT_TRUE(effects) << effects.error().message;
    Results results{ .machine = machine,
                     .commit = "abc",
                     .date = "2000-01-01",
                     .drivers = { { "vulkan", "driver" } },
                     .frame = "frame",
                     .size = { 64, 32 },
                     .rounds = 3 };
    for (std::string const& row : rows) {
        if (row == "absent") {
            results.skipped.push_back({ row, "asset:x.hdr" });
            continue;
        }
        EffectResult result{ .effect = effects->front(), .command = "run " + row };
        result.effect.name = row;
        std::mt19937_64 random(std::hash<std::string>()(row));
        const auto number = [&random] { return std::exp(std::uniform_real_distribution(-20.0, 5.0)(random)); };
        for (Value const& value : result.effect.values) {
            ValueResult one{ .value = value,
                             .own = { number(), number(), number() },
                             .frame = { number(), number(), number() },
                             .total = number() };
            one.timings["vulkan"] = { { number(), number(), number() }, { number(), number(), number() } };
            result.values.push_back(one);
        }
        results.effects.push_back(std::move(result));
    }
    return results;
}

class AccuracyShards : public testing::Test {
protected:
    ~AccuracyShards() override { fs::remove_all(mFolder); }
    /// The folder of a shard of `rows`.
    fs::path write(tools::Shard shard, std::vector<std::string> const& rows, std::string const& machine = "a machine",
                   std::function<void(Results&)> const& edit = {}) {
        const auto mine = rowsOf(shard, rows);
        EXPECT_TRUE(mine);
        Results results = resultsOf(*mine, machine);
        if (edit) edit(results);
        const fs::path folder = mFolder / fmt::format("{}-{}", shard.index, shard.count);
        EXPECT_TRUE(writeShard(results, shard, rows, folder));
        return folder;
    }
    static std::string complaintAbout(std::vector<fs::path> const& files) {
        const auto merged = mergeShards(files);
        return merged ? "merged" : merged.error().message;
    }

    const fs::path mFolder = fs::path(testing::TempDir()) / fmt::format("accuracy-shards-{}", getpid());
    const std::vector<std::string> mRows{ "e", "b", "absent", "d", "a" };
};

TEST_F(AccuracyShards, MergeToTheBytesOfOneRun) {
    const tools::Json whole = jsonOf(resultsOf(mRows));
    for (const uint32_t count : { 1u, 2u, 3u, 5u }) {
        std::vector<fs::path> files;
        for (uint32_t i = 0; i < count; ++i) files.push_back(write({ count - 1 - i, count }, mRows));
        const auto merged = mergeShards(files);
        ASSERT_TRUE(merged) << merged.error().message;
        EXPECT_EQ(merged->dump(1), whole.dump(1)) << count;
        EXPECT_EQ(csvOf(*merged), csvOf(whole)) << count;
    }
}

TEST_F(AccuracyShards, SayWhereAndWhenTheyWereMeasured) {
    const auto later = [](Results& results) { results.date = "2000-01-03"; };
    const auto merged = mergeShards({ write({ 0, 3 }, mRows, "one, load 0.5"), write({ 1, 3 }, mRows, "two", later),
                                      write({ 2, 3 }, mRows, "one, load 0.7") });
    ASSERT_TRUE(merged) << merged.error().message;
    EXPECT_EQ((*merged)["machine"], "one; two") << "the load is that of a shard";
    EXPECT_EQ((*merged)["date"], "2000-01-03");
    EXPECT_FALSE(merged->contains("shard"));
}

TEST_F(AccuracyShards, ThatAreNoCompleteRunAreRefused) {
    const fs::path first = write({ 0, 2 }, mRows);
    EXPECT_THAT(complaintAbout({ first }), HasSubstr("missing: shard 1/2"));
    EXPECT_THAT(complaintAbout({ first, first }), HasSubstr("twice"));
    EXPECT_THAT(complaintAbout({ first, write({ 1, 2 }, mRows, "", [](Results& r) { r.rounds = 4; }) }),
                HasSubstr("differ in their rounds: 4 and 3"));
    EXPECT_THAT(complaintAbout({ first, write({ 1, 2 }, { "e", "b" }) }), HasSubstr("--effect"));
    EXPECT_THAT(complaintAbout({ first, write({ 1, 2 }, mRows, "", [](Results& r) { r.effects.pop_back(); }) }),
                HasSubstr("no shard has row d"));
    EXPECT_THAT(complaintAbout({ mFolder / "none" }), HasSubstr("none"));
    std::ofstream(mFolder / "whole.json") << jsonOf(resultsOf(mRows)).dump();
    EXPECT_THAT(complaintAbout({ mFolder / "whole.json" }), HasSubstr("whole.json: not of a shard"));
    std::ofstream(mFolder / "bad.json") << "[";
    EXPECT_THAT(complaintAbout({ mFolder / "bad.json" }), HasSubstr("bad.json: this is no JSON text"));
    EXPECT_THAT(rowsOf(tools::Shard{ 5, 6 }, mRows).error().message, HasSubstr("at most 5 shards"));
}

} // namespace
} // namespace filament_core::accuracy
