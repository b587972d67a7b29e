// SPDX-License-Identifier: Apache-2.0
// Draw lists as arrays: the result of each command, and invalid lists.
#include "tools/view/ui/UiGeometry.h"
#include "tools/view/ui/ImGuiVersions.h"
#include "tools/view/ui/UiContext.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace filament_core::view {
namespace {

/// A draw list by hand, and the data that shows it.
struct HandMade {
    explicit HandMade(float2 size = { 100, 50 }) {
        data.Valid = true;
        data.DisplaySize = { size.x, size.y };
        data.FramebufferScale = { 1, 1 };
#if IMGUI_VERSION_NUM >= 18980
        data.CmdLists.push_back(&list);
#else
        data.CmdLists = lists.data();
#endif
        data.CmdListsCount = 1;
    }
    /// Two triangles; their vertices are new.
    void quad(float2 least, float2 most, ImVec4 clip, ImTextureID texture = {}) {
        const auto first = static_cast<ImDrawIdx>(list.VtxBuffer.Size);
        for (const float2 place : { least, float2(most.x, least.y), most, float2(least.x, most.y) })
            list.VtxBuffer.push_back({ { place.x, place.y }, { 0, 0 }, IM_COL32_WHITE });
        ImDrawCmd command;
        command.ClipRect = clip;
        setTexture(command, texture);
        command.IdxOffset = static_cast<unsigned>(list.IdxBuffer.Size);
        command.ElemCount = 6;
        for (const int corner : { 0, 1, 2, 0, 2, 3 }) list.IdxBuffer.push_back(static_cast<ImDrawIdx>(first + corner));
        list.CmdBuffer.push_back(command);
    }
    UiGeometry const& built() {
        geometry.build(data);
        return geometry;
    }

    UiContext context;
    ImDrawList list{ ImGui::GetDrawListSharedData() };
    std::array<ImDrawList*, 1> lists{ &list };
    ImDrawData data;
    UiGeometry geometry;
};

const ImTextureID kOne = textureIdOf(1), kOther = textureIdOf(2);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

TEST(UiGeometry, NeighboursWithTheSameTextureAreOneRunWhateverTheirRectangles) {
    HandMade made;
    made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 }, kOne);
    made.quad({ 0, 0 }, { 10, 10 }, { 2, 3, 4, 5 }, kOne);
    made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 }, kOther);
    made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 }, kOne);
    const std::vector<UiRun> expected{ { kOne, 0, 12 }, { kOther, 12, 6 }, { kOne, 18, 6 } };
    EXPECT_EQ(made.built().runs(), expected);
    EXPECT_EQ(made.geometry.vertices().size(), 16u);
    const std::array<uint16_t, 4> clip{ 2, 3, 4, 5 };
    EXPECT_TRUE(std::equal(clip.begin(), clip.end(), made.geometry.vertices()[4].clipPixels));
}

TEST(UiGeometry, APixelIsInARectangleIfItsCentreIs) {
    HandMade made;
    made.quad({ 0, 0 }, { 10, 10 }, { 1.5f, 1.51f, 4.49f, 4.5f });
    const std::array<uint16_t, 4> clip{ 1, 2, 4,
                                        4 }; // 1.5 and 4.5 are centres; the lower edge is inside, the upper not
    ASSERT_EQ(made.built().vertices().size(), 4u);
    EXPECT_TRUE(std::equal(clip.begin(), clip.end(), made.geometry.vertices()[0].clipPixels));
}

TEST(UiGeometry, LeavesOutWhatNoPixelShows) {
    HandMade made;
    made.quad({ 0, 0 }, { 10, 10 }, { 5, 5, 5, 9 });         // no width
    made.quad({ 0, 0 }, { 10, 10 }, { 9, 9, 5, 5 });         // turned around
    made.quad({ 0, 0 }, { 10, 10 }, { 200, 200, 300, 300 }); // off-screen
    made.quad({ 0, 0 }, { 10, 10 }, { kNan, 0, 100, 50 });   // nowhere
    made.quad({ 20, 20 }, { 30, 30 }, { 0, 0, 10, 10 });     // outside of its rectangle
    EXPECT_TRUE(made.built().indices().empty());
    EXPECT_EQ(made.geometry.skippedTriangles(), 0u);
    EXPECT_TRUE(made.geometry.runs().empty());
}

TEST(UiGeometry, SkipsBrokenTrianglesAndKeepsTheOthers) {
    HandMade made;
    for (const float bad : { kNan, kInfinity, -kInfinity, 3e38f }) {
        made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 });
        made.list.VtxBuffer.back().pos.y = bad; // of the second triangle
        made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 });
        made.list.VtxBuffer.back().uv.x = bad;
    }
    made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 });
    made.list.IdxBuffer.back() = 60000;           // there is no such vertex
    made.list.CmdBuffer.back().ElemCount = 6 + 9; // three triangles that are not there
    EXPECT_EQ(made.built().skippedTriangles(), 8u + 1 + 3);
    EXPECT_EQ(made.geometry.indices().size(), 9u * 3);
}

TEST(UiGeometry, IsNothingForAPictureWithoutPixels) {
    for (const float side : { 0.0f, -5.0f, kNan, kInfinity, 1e9f }) {
        HandMade made({ side, 50 });
        made.quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 });
        EXPECT_TRUE(made.built().indices().empty()) << side;
        EXPECT_EQ(uiPixels(made.data), uint2(0)) << side;
    }
}

struct Random {
    uint32_t operator()() { return static_cast<uint32_t>(engine()); }
    std::mt19937 engine{ 17 };
};

/// Numbers that programs compute by mistake, among others.
float anyNumber(Random& random) {
    constexpr std::array kOdd{ kNan, kInfinity, -kInfinity, 3e38f, -3e38f, 0.0f, -0.0f, 1e-40f, 65535.5f };
    const uint32_t pick = random() % 24;
    return pick < kOdd.size() ? kOdd[pick] : static_cast<float>(random() % 4000) / 16 - 60;
}

TEST(UiGeometry, OfAnyListsStaysInsideItsArraysAndTheirRectanglesInsideThePicture) {
    Random random;
    for (int round = 0; round < 300; ++round) {
        HandMade made({ static_cast<float>(random() % 300), static_cast<float>(random() % 300) });
        if (round % 5 == 0) made.data.FramebufferScale = { anyNumber(random), anyNumber(random) };
        if (round % 7 == 0) made.data.DisplayPos = { anyNumber(random), anyNumber(random) };
        for (uint32_t i = random() % 60; i > 0; --i)
            made.list.VtxBuffer.push_back({ { anyNumber(random), anyNumber(random) },
                                            { anyNumber(random), anyNumber(random) },
                                            static_cast<ImU32>(random()) });
        for (uint32_t i = random() % 200; i > 0; --i)
            made.list.IdxBuffer.push_back(static_cast<ImDrawIdx>(random() % 64));
        for (uint32_t i = random() % 12; i > 0; --i) {
            ImDrawCmd command;
            command.ClipRect = { anyNumber(random), anyNumber(random), anyNumber(random), anyNumber(random) };
            command.IdxOffset = random() % 3 ? static_cast<unsigned>(random() % 200) : static_cast<unsigned>(random());
            command.VtxOffset = random() % 3 ? 0 : static_cast<unsigned>(random() % 70);
            command.ElemCount = random() % 5 ? static_cast<unsigned>(random() % 90) : ~0u;
            setTexture(command, random() % 2 ? kOne : kOther);
            made.list.CmdBuffer.push_back(command);
        }
        UiGeometry const& geometry = made.built();
        const uint2 size = uiPixels(made.data);
        uint32_t end = 0;
        for (UiRun const& run : geometry.runs()) {
            EXPECT_EQ(run.firstIndex, end);
            EXPECT_GT(run.indexCount, 0u);
            end += run.indexCount;
        }
        EXPECT_EQ(end, geometry.indices().size());
        for (const uint32_t index : geometry.indices()) ASSERT_LT(index, geometry.vertices().size());
        for (UiVertex const& vertex : geometry.vertices()) {
            EXPECT_LT(vertex.clipPixels[0], vertex.clipPixels[2]);
            EXPECT_LT(vertex.clipPixels[1], vertex.clipPixels[3]);
            EXPECT_LE(vertex.clipPixels[2], size.x);
            EXPECT_LE(vertex.clipPixels[3], size.y);
            EXPECT_TRUE(std::isfinite(vertex.position.x + vertex.position.y + vertex.uv.x + vertex.uv.y));
        }
        EXPECT_LE(geometry.vertices().size(), geometry.indices().size());
    }
}

TEST(UiGeometry, EqualsTheSameListsAndNoOthers) {
    HandMade a, b;
    for (HandMade* made : { &a, &b }) made->quad({ 0, 0 }, { 10, 10 }, { 0, 0, 100, 50 }, kOne);
    EXPECT_TRUE(a.built() == b.built());
    b.list.VtxBuffer[2].col ^= 1;
    EXPECT_FALSE(a.built() == b.built());
    b.list.VtxBuffer[2].col ^= 1;
    setTexture(b.list.CmdBuffer[0], kOther);
    EXPECT_FALSE(a.built() == b.built());
}

TEST(UiContext, ScalesStyleAndFontsOnlyWhenTheScaleChanges) {
    UiContext context;
    const float padding = ImGui::GetStyle().FramePadding.x;
    EXPECT_FALSE(context.setScale(1));
    EXPECT_TRUE(context.setScale(2));
    EXPECT_EQ(ImGui::GetStyle().FramePadding.x, 2 * padding);
    EXPECT_FALSE(context.fonts().IsBuilt());
    ASSERT_TRUE(context.fonts().Build());
#if IMGUI_VERSION_NUM >= 19200
    EXPECT_EQ(context.fonts().Fonts[0]->LegacySize, 26);
#else
    EXPECT_EQ(context.fonts().Fonts[0]->FontSize, 26);
#endif
    EXPECT_TRUE(context.setScale(1e9f));
    EXPECT_EQ(context.scale(), kMostUiScale);
    EXPECT_TRUE(context.setScale(kNan));
    EXPECT_EQ(context.scale(), 1);
    EXPECT_EQ(ImGui::GetStyle().FramePadding.x, padding) << "sizes are scaled anew, not again";
}

} // namespace
} // namespace filament_core::view
