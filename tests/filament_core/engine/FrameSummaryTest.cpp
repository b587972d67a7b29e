// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameSummary.h"

#include <gmock/gmock.h>

#include <array>

namespace filament_core::engine {
namespace {

using prepare::DrawCall;
using prepare::ViewKind;
using prepare::ViewPacket;
using testing::HasSubstr;
using testing::Not;

const std::array<DrawCall, 10> kDraws{};

ViewPacket view(ViewKind kind, uint32_t visible, size_t draws, uint64_t triangles) {
    ViewPacket packet{ .kind = kind, .opaque = std::span(kDraws).first(draws) };
    packet.counts = { .renderables = 100, .visible = visible, .triangles = triangles };
    return packet;
}

TEST(FrameSummary, CountsWhatTheMainViewSeesAndWhatAllViewsDraw) {
    const std::array views{ view(ViewKind::Color, 40, 7, 1000), view(ViewKind::Shadow, 60, 5, 2000),
                            view(ViewKind::Shadow, 70, 6, 3000), view(ViewKind::Depth, 40, 4, 500) };
    prepare::FramePacket packet{ .views = views,
                                 .settings = { .size = { 1280, 720 } },
                                 .covered = { 400, 100, 300, 200 } };
    packet.demand = prepare::findDemand({ .hasSky = true });
    const FrameSummary summary = summarize(3, packet, {});
    EXPECT_EQ(summary.statistics.renderables, 100u);
    EXPECT_EQ(summary.statistics.visible, 40u);
    EXPECT_EQ(summary.statistics.culled, 60u);
    EXPECT_EQ(summary.statistics.draws, 7u + 5 + 6 + 4 + 1) << "and the sky";
    EXPECT_EQ(summary.statistics.triangles, 6500u);
    const std::string text = explain(summary, {});
    EXPECT_THAT(text, HasSubstr("frame 3: 40 of 100 renderables drawn, 1000 triangles in 8 draws\n"));
    EXPECT_THAT(text, HasSubstr("2 shadow views besides: 130 renderables drawn, 5000 triangles in 11 draws\n"));
    EXPECT_THAT(text, HasSubstr("1 depth view besides: 40 renderables drawn, 500 triangles in 4 draws\n"));
    EXPECT_THAT(text, HasSubstr("objects are within 300 x 200 of 1280 x 720 pixels"));
    EXPECT_THAT(text, testing::ContainsRegex("sky +needed +fills what nothing covers"));
}

TEST(FrameSummary, SaysNothingOfViewsThatAreNotThere) {
    const std::array views{ view(ViewKind::Color, 1, 1, 12) };
    const std::string text = explain(summarize(1, { .views = views }, {}), {});
    EXPECT_THAT(text, Not(HasSubstr("besides")));
    EXPECT_THAT(text, Not(HasSubstr("objects are within")));
    EXPECT_THAT(text, testing::ContainsRegex("sky +not needed +none in the scene"));
}

} // namespace
} // namespace filament_core::engine
