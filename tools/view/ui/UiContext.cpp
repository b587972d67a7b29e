// SPDX-License-Identifier: Apache-2.0
#include "tools/view/ui/UiContext.h"

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr float kFontPixels = 13;      // of ImGui's own font, whose pixels then are pixels
constexpr float kLeastSeconds = 1e-6f; // ImGui asserts that time passes

ImGuiStyle interfaceStyle() {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 3;
    style.FrameRounding = 2;
    style.Colors[ImGuiCol_WindowBg].w = 0.97f;
    return style;
}

} // namespace

UiContext::UiContext(float scale) : mContext(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(mContext.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendRendererName = "filament_core";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    setScale(scale);
}

bool UiContext::setScale(float scale) {
    const float wanted = std::isnan(scale) ? 1 : std::clamp(scale, kLeastUiScale, kMostUiScale);
    if (wanted == mScale) return false;
    mScale = wanted;
    ImGui::GetStyle() = interfaceStyle();
    ImGui::GetStyle().ScaleAllSizes(wanted);
    fonts().Clear();
    ImFontConfig config;
    config.SizePixels = std::floor(kFontPixels * wanted);
    config.OversampleH = config.OversampleV = 1; // texels are pixels
    config.PixelSnapH = true;
    fonts().AddFontDefault(&config);
    return true;
}

void UiContext::newFrame(uint2 pixels, float seconds) {
    ImGui::SetCurrentContext(mContext.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(pixels.x), static_cast<float>(pixels.y));
    io.DisplayFramebufferScale = ImVec2(1, 1);
    io.DeltaTime = std::max(seconds, kLeastSeconds);
    ImGui::NewFrame();
}

} // namespace filament_core::view
