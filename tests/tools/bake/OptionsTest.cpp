// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Options.h"

#include <gtest/gtest.h>

#include <vector>

namespace filament_core::bake {
namespace {

Result<std::optional<Options>> parse(std::vector<const char*> words) {
    words.insert(words.begin(), "filament-bake");
    return parseOptions(static_cast<int>(words.size()), words.data());
}

TEST(BakeOptions, ThisThreadIsOneOfTheThreads) {
    const auto parsed = parse({ "m.glb", "--threads", "3" });
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ((*parsed)->workers, 2);
}

TEST(BakeOptions, AModelIsNeeded) { EXPECT_FALSE(parse({})); }

} // namespace
} // namespace filament_core::bake
