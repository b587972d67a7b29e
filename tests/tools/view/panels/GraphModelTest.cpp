// SPDX-License-Identifier: Apache-2.0
// The frame graph as boxes and arrows: of texts by hand, and of any text.
#include "tools/view/panels/GraphModel.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::view {
namespace {

constexpr const char* kText = R"(digraph frame {
  rankdir=LR;
  p0 [shape=box, label="shadow \"maps\""];
  p3 [shape=box, label="unused", style=dashed];
  subgraph cluster_1 {
    label="merged";
    p1 [shape=box, label="color"];
    p2 [shape=box, label="tone map"];
  }
  t0 [shape=ellipse, label="maps\n64 x 64 D32F"];
  t1 [shape=ellipse, label="color\n8 x 8 RGBA16F"];
  t2 [shape=ellipse, label="output\n8 x 8 RGBA8", peripheries=2];
  b0 [shape=cylinder, label="pixels\n256 bytes", peripheries=2];
  p0 -> t0;
  t0 -> p1;
  p1 -> t1;
  t1 -> p2 [label="pixel"];
  p2 -> t2;
  b0 -> p3 [label="uniform"];
}
)";

TEST(GraphModel, ReadsPassesAndWhoReadsWhom) {
    using enum EffectDecision::State;
    const FrameGraphModel graph = graphOf(kText, { { .name = "sun", .state = Needed },
                                                   { .name = "shadow maps", .state = Ran, .gpuMilliseconds = 2 },
                                                   { .name = "color", .state = Ran, .attachmentBytes = 9 },
                                                   { .name = "tone map", .state = Ran, .reason = "output" },
                                                   { .name = "unused", .state = Culled } });
    ASSERT_EQ(graph.boxes.size(), 4u);
    EXPECT_EQ(graph.boxes[0].name, "shadow \"maps\"");
    EXPECT_EQ(graph.boxes[0].milliseconds, 2);
    EXPECT_EQ(graph.boxes[1].attachmentBytes, 9u);
    EXPECT_EQ(graph.boxes[2].reason, "output");
    EXPECT_TRUE(graph.boxes[2].runs);
    EXPECT_FALSE(graph.boxes[3].runs);
    ASSERT_EQ(graph.arrows.size(), 2u);
    EXPECT_EQ(graph.arrows[0].from, 0u);
    EXPECT_EQ(graph.arrows[0].to, 1u);
    EXPECT_EQ(graph.arrows[0].resource, "maps, 64 x 64 D32F");
    EXPECT_EQ(graph.arrows[1].resource, "color, 8 x 8 RGBA16F");
    EXPECT_EQ(graph.boxes[2].column, 2u);
    EXPECT_EQ(graph.boxes[3].column, 0u) << "reads nothing that a pass wrote";
    EXPECT_EQ(graph.columns, 3u);
    EXPECT_EQ(graph.rows, 2u);
}

TEST(GraphModel, APassThatContinuesATextureComesAfterTheOneThatBegan) {
    const FrameGraphModel graph =
            graphOf("p0 [label=\"a\"]\np1 [label=\"b\"]\np2 [label=\"c\"]\np0 -> t0\np1 -> t0\nt0 -> p2\n", {});
    ASSERT_EQ(graph.arrows.size(), 2u);
    EXPECT_EQ(graph.arrows[0].from, 0u);
    EXPECT_EQ(graph.arrows[1].from, 1u) << "the last writer";
    EXPECT_EQ(graph.columns, 3u);
}

TEST(GraphModel, OfAnyTextHasArrowsForwardsAndBoxesOfTheirOwnPlace) {
    std::mt19937 random(2);
    const std::string text = kText;
    EXPECT_TRUE(graphOf("", {}).boxes.empty());
    EXPECT_TRUE(graphOf("p4294967295 [label=\"x\"]\np99999999999 -> t0", {}).boxes.empty());
    for (int round = 0; round < 3000; ++round) {
        std::string broken = text;
        for (int i = 0; i < 6; ++i) {
            const size_t place = random() % broken.size();
            if (random() % 2)
                broken[place] = "pt0123-> \"\\\n"[random() % 12];
            else
                broken.erase(place, random() % 9);
            if (broken.empty()) break;
        }
        const FrameGraphModel graph = graphOf(broken, { { .state = EffectDecision::State::Ran } });
        std::vector<std::pair<uint32_t, uint32_t>> places;
        for (GraphBox const& box : graph.boxes) {
            EXPECT_LT(box.column, graph.columns);
            EXPECT_LT(box.row, graph.rows);
            EXPECT_EQ(std::ranges::find(places, std::pair(box.column, box.row)), places.end());
            places.emplace_back(box.column, box.row);
        }
        for (GraphArrow const& arrow : graph.arrows) {
            ASSERT_LT(arrow.to, graph.boxes.size());
            EXPECT_LT(arrow.from, arrow.to);
            EXPECT_LT(graph.boxes[arrow.from].column, graph.boxes[arrow.to].column);
        }
    }
}

} // namespace
} // namespace filament_core::view
