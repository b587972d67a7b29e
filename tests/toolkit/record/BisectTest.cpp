// SPDX-License-Identifier: Apache-2.0
// Frames of which one device merges the passes are compared by what attachments of the same name hold.
#include "toolkit/record/Bisect.h"

#include <gmock/gmock.h>

namespace filament_core::tools {
namespace {

using backend::CapturedAttachment;
using backend::CapturedFrame;

CapturedAttachment attachment(std::string name, uint8_t value) {
    return { .name = std::move(name),
             .format = Format::RGBA8,
             .width = 1,
             .height = 1,
             .bytes = std::vector<std::byte>(4, std::byte{ value }) };
}

/// Two draws in one pass.
CapturedFrame merged(uint8_t light, uint8_t shown) {
    CapturedFrame frame;
    frame.passes = { { .name = "light + finish",
                       .drawCount = 2,
                       .attachments = { attachment("light", light), attachment("shown", shown) } } };
    frame.draws.resize(2);
    return frame;
}

/// A draw each in two passes.
CapturedFrame apart(uint8_t light, uint8_t shown) {
    CapturedFrame frame;
    frame.passes = {
        { .name = "light", .drawCount = 1, .attachments = { attachment("light", light) } },
        { .name = "finish", .firstDraw = 1, .drawCount = 1, .attachments = { attachment("shown", shown) } }
    };
    frame.draws.resize(2);
    return frame;
}

TEST(Bisect, FramesThatAreMergedOtherwiseMayHoldTheSame) {
    const auto found = compareFrames(merged(1, 2), apart(1, 2));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_FALSE(found->has_value());
}

TEST(Bisect, AttachmentsOfFramesThatAreMergedOtherwiseAreFoundByName) {
    for (CapturedFrame const& frame : { apart(7, 2), merged(7, 2) }) {
        const auto found =
                frame.passes.size() == 2 ? compareFrames(merged(1, 2), frame) : compareFrames(apart(1, 2), frame);
        ASSERT_TRUE(found && *found);
        EXPECT_EQ((*found)->attachment, "light");
        EXPECT_FALSE((*found)->hasDraw);
    }
}

TEST(Bisect, ATextureThatIsUsedAgainHoldsTheSameAfterOneOfItsPasses) {
    CapturedFrame again = apart(1, 2);
    again.passes.push_back({ .name = "blur", .attachments = { attachment("light", 9) } });
    for (const auto& found : { compareFrames(merged(1, 2), again), compareFrames(again, merged(1, 2)) }) {
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_FALSE(found->has_value());
    }
    EXPECT_TRUE(compareFrames(merged(3, 2), again)->has_value());
}

TEST(Bisect, FramesWithOtherDrawsAreNotCompared) {
    CapturedFrame more = apart(1, 2);
    more.draws.resize(3);
    const auto found = compareFrames(merged(1, 2), more);
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().message, testing::HasSubstr("1 and 2 passes, 2 and 3 draws"));
}

TEST(Bisect, LooksForNoDrawWherePassesAreMergedOtherwise) {
    const FrameSource a = [](uint32_t) { return Result<CapturedFrame>(merged(1, 2)); };
    const FrameSource b = [](uint32_t) { return Result<CapturedFrame>(apart(1, 3)); };
    const auto found = bisect(a, b);
    ASSERT_TRUE(found && *found);
    EXPECT_EQ((*found)->attachment, "shown");
    EXPECT_THAT((*found)->line(), testing::HasSubstr("pass 'light + finish'"));
}

} // namespace
} // namespace filament_core::tools
