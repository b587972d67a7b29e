// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Shard.h"
#include "tests/base/ScopedVariable.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace filament_core::tools {
namespace {

TEST(Shard, IsAnIndexBelowACount) {
    EXPECT_EQ(parseShard("2/8").value(), (Shard{ 2, 8 }));
    EXPECT_EQ(parseShard("0/1").value(), Shard{});
    for (const char* word : { "3/3", "one", "1", "-1/2", "1/0", "/", "1/2/3", "0/100001", "" }) {
        const Result<Shard> shard = parseShard(word);
        ASSERT_FALSE(shard.ok()) << word;
        EXPECT_NE(shard.error().message.find("--shard"), std::string::npos) << shard.error().message;
        EXPECT_NE(shard.error().message.find("0 <= I < N"), std::string::npos) << shard.error().message;
    }
}

TEST(Shard, ComesFromTheScheduler) {
    EXPECT_FALSE(parseShard("auto").ok()) << "there is none";
    {
        const test::ScopedVariable task("SLURM_ARRAY_TASK_ID", "5"), first("SLURM_ARRAY_TASK_MIN", "3"),
                count("SLURM_ARRAY_TASK_COUNT", "4");
        EXPECT_EQ(parseShard("auto").value(), (Shard{ 2, 4 })) << "Slurm counts from the first of the array";
    }
    const test::ScopedVariable index("JOB_COMPLETION_INDEX", "1"), count("JOB_COMPLETIONS", "3");
    EXPECT_EQ(parseShard("auto").value(), (Shard{ 1, 3 }));
}

std::string complaintAbout(std::vector<Shard> shards) {
    const Result<void> complete = checkComplete(std::move(shards));
    return complete ? "" : complete.error().message;
}

TEST(Shards, AreCompleteInAnyOrder) {
    EXPECT_EQ(complaintAbout({}), "");
    EXPECT_EQ(complaintAbout({ { 2, 3 }, { 0, 3 }, { 1, 3 } }), "");
}

TEST(Shards, ThatAreMissingOrThereTwiceAreNamed) {
    EXPECT_EQ(complaintAbout({ { 2, 4 } }), "missing: shard 0/4, 1/4, 3/4; run --shard 0/4 and merge again");
    EXPECT_EQ(complaintAbout({ { 0, 2 }, { 1, 2 }, { 1, 2 } }), "shard 1/2 is there twice; merge each shard once");
    EXPECT_EQ(complaintAbout({ { 0, 2 }, { 1, 4 } }), "shard 0/2 and shard 1/4 are of two divisions; merge one");
    EXPECT_EQ(complaintAbout({ { 3, 3 } }), "there is no shard 3/3; run it again");
    EXPECT_EQ(complaintAbout({ { 0, 4000000000 } }), "there is no shard 0/4000000000; run it again");
    const std::string many = complaintAbout({ { 0, 100 } });
    EXPECT_NE(many.find("shard 1/100, 2/100"), std::string::npos) << many;
    EXPECT_NE(many.find("10/100 and 89 more;"), std::string::npos) << many;
}

} // namespace
} // namespace filament_core::tools
