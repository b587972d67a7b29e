// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/AnimationModel.h"
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

void drawPlayback(PanelFrame& frame, std::vector<AnimationRow> const& animations) {
    Playback& playback = frame.document.playback;
    const char* shown = playback.animation && *playback.animation < animations.size()
                                ? animations[*playback.animation].name.c_str()
                                : "rest pose";
    if (ImGui::BeginCombo("animation", shown)) {
        if (ImGui::Selectable("rest pose", !playback.animation)) chooseAnimation(frame.document, std::nullopt);
        for (uint32_t i = 0; i < animations.size(); ++i) {
            const std::string label = fmt::format("{} ({:.2f} s)##{}", animations[i].name, animations[i].seconds, i);
            if (ImGui::Selectable(label.c_str(), playback.animation == i)) chooseAnimation(frame.document, i);
        }
        ImGui::EndCombo();
    }
    if (ImGui::Button(playback.isPlaying ? "stop" : "play")) togglePlaying(frame.document);
    ImGui::SameLine();
    ImGui::Checkbox("again and again", &playback.loops);
    if (playback.animation && *playback.animation < animations.size()) {
        auto seconds = static_cast<float>(playback.seconds);
        const auto end = static_cast<float>(animations[*playback.animation].seconds);
        if (ImGui::SliderFloat("time, s", &seconds, 0, end, "%.3f")) setAnimationTime(frame.document, seconds);
    }
    auto speed = static_cast<float>(playback.speed);
    if (ImGui::DragFloat("speed", &speed, 0.01f, -10, 10, "%.2f", ImGuiSliderFlags_AlwaysClamp)) playback.speed = speed;
}

void drawVariants(PanelFrame& frame) {
    const std::vector<std::string> variants = variantRows(frame.stage);
    if (variants.size() < 2) return quietText("the file has no variants");
    std::string& chosen = frame.document.model.variant;
    if (!ImGui::BeginCombo("variant", chosen.empty() ? "of the file" : chosen.c_str())) return;
    for (std::string const& variant : variants)
        if (ImGui::Selectable(variant.empty() ? "of the file" : variant.c_str(), variant == chosen)) chosen = variant;
    ImGui::EndCombo();
}

void drawMorphs(PanelFrame& frame) {
    const std::vector<MorphRow> rows = morphRows(frame.stage, frame.document);
    if (rows.empty()) return quietText("the file has no morph targets");
    for (size_t i = 0; i < rows.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        float weight = rows[i].weight;
        const std::string label = rows[i].target.empty() ? "(no name)" : rows[i].target;
        if (ImGui::SliderFloat(label.c_str(), &weight, 0, 1, "%.3f")) setMorph(frame.document, rows[i].target, weight);
        if (rows[i].isEdited) {
            ImGui::SameLine();
            if (ImGui::SmallButton("x")) resetMorph(frame.document, rows[i].target);
        }
        ImGui::PopID();
    }
}

} // namespace

void drawAnimationPanel(PanelFrame& frame) {
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 7);
    const std::vector<AnimationRow> animations = animationRows(frame.stage);
    if (animations.empty())
        quietText("the file has no animations");
    else
        drawPlayback(frame, animations);
    ImGui::Separator();
    drawVariants(frame);
    ImGui::Separator();
    drawMorphs(frame);
    ImGui::PopItemWidth();
}

} // namespace filament_core::view
