// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/NumericsCounter.h"

#include "toolkit/pictures/Pixels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <utility>

namespace filament_core::view {
namespace {

constexpr std::array<const char*, kNumericsMarks> kLabels{
    "neither",     "denormal (below 2^-14)", "clipped by the display", "beyond half floats (65504)", "infinite",
    "not a number"
};

void drawRow(NumericsMark mark, uint64_t pixels, uint64_t all) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const DebugColor color = mark == NumericsMark::None ? DebugColor{ 90, 90, 90 } : numericsColor(mark);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddRectFilled(at, { at.x + side, at.y + side },
                                              IM_COL32(color[0], color[1], color[2], 255));
    ImGui::Dummy({ side, side });
    ImGui::SameLine();
    ImGui::TextUnformatted(kLabels[static_cast<size_t>(mark)]);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(fmt::format("{:>9}", pixels).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
            fmt::format("{:8.4f} %", 100.0 * static_cast<double>(pixels) / static_cast<double>(all)).c_str());
}

} // namespace

void NumericsCounter::follow(Stage& stage, SwapChain chain, uint2 offset) {
    ++mFrame;
    if (stage.view().debugView != DebugView::Numerics) {
        mCounts.reset();
        return;
    }
    if (mPending) return;
    mPending = stage.renderer().readPixels(chain);
    mPendingFrame = mFrame;
    mOffset = offset;
    mDocument = stage.document();
    mGeneration = stage.generation();
}

bool NumericsCounter::poll(Stage& stage) {
    if (!mPending) return false;
    const std::optional<Image> window = stage.renderer().takePixels(mPending);
    if (!window) return false;
    mPending = {};
    const std::optional<Image> picture = partOf(*window, mOffset, mDocument.view.size);
    if (!picture || mDocument.view.debugView != DebugView::Numerics) return false;
    const bool wasNewest = std::exchange(
            mIsNewest, mFrame == mPendingFrame || (mDocument == stage.document() && mGeneration == stage.generation()));
    const std::optional<NumericsCounts> before = std::exchange(mCounts, countNumerics(picture->pixels));
    return before != mCounts || wasNewest != mIsNewest || !mIsNewest;
}

void NumericsCounter::draw(uint2 offset, uint2 size) const {
    if (!mCounts) return;
    const float2 below = float2(offset) + float2(size) * float2(0.5f, 1);
    ImGui::SetNextWindowPos({ below.x, below.y - 10 }, ImGuiCond_Always, { 0.5f, 1 });
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("numerics", nullptr, kFlags)) {
        uint64_t all = 0;
        for (const uint64_t pixels : *mCounts) all += pixels;
        ImGui::TextUnformatted(mIsNewest ? "pixels of this frame" : "counting ...");
        if (all > 0 && ImGui::BeginTable("marks", 3, ImGuiTableFlags_SizingFixedFit)) {
            for (size_t mark = kNumericsMarks; mark-- > 0;)
                drawRow(static_cast<NumericsMark>(mark), (*mCounts)[mark], all);
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

} // namespace filament_core::view
