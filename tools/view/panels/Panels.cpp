// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/Panels.h"

#include "tools/view/panels/PanelFrame.h"
#include "tools/view/stage/Stage.h"

#include <array>

namespace filament_core::view {
namespace {

constexpr size_t kMostMessages = 50;

struct PanelTab {
    const char* name;
    void (*draw)(PanelFrame& frame);
};
constexpr std::array kLeftTabs{ PanelTab{ "Scene", drawScenePanel },     PanelTab{ "Materials", drawMaterialPanel },
                                PanelTab{ "Lights", drawLightPanel },    PanelTab{ "Probes", drawProbePanel },
                                PanelTab{ "Sky", drawEnvironmentPanel }, PanelTab{ "Motion", drawAnimationPanel },
                                PanelTab{ "Path", drawPathPanel } };
constexpr std::array kRightTabs{ PanelTab{ "Camera", drawCameraPanel },     PanelTab{ "Options", drawOptionPanel },
                                 PanelTab{ "Costs", drawCostPanel },        PanelTab{ "Compare", drawComparePanel },
                                 PanelTab{ "Demand", drawDemandPanel },     PanelTab{ "Graph", drawGraphPanel },
                                 PanelTab{ "Timeline", drawTimelinePanel }, PanelTab{ "Numbers", drawStatisticsPanel },
                                 PanelTab{ "Pixel", drawPixelPanel },       PanelTab{ "Log", drawMessagePanel } };

void drawTabs(const char* name, PanelRect const& place, std::span<const PanelTab> tabs, PanelFrame& frame) {
    if (!place.isThere()) return;
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
    ImGui::SetNextWindowPos({ place.position.x, place.position.y });
    ImGui::SetNextWindowSize({ place.size.x, place.size.y });
    if (ImGui::Begin(name, nullptr, kFlags) && ImGui::BeginTabBar(name, ImGuiTabBarFlags_FittingPolicyScroll)) {
        for (PanelTab const& tab : tabs) {
            const bool isAskedFor = frame.state.opensPanel == tab.name;
            if (!ImGui::BeginTabItem(tab.name, nullptr, isAskedFor ? ImGuiTabItemFlags_SetSelected : 0)) continue;
            if (isAskedFor) frame.state.opensPanel.clear();
            tab.draw(frame);
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::End();
}

} // namespace

void PanelState::addMessage(std::string message) {
    if (messages.size() == kMostMessages) messages.erase(messages.begin());
    messages.push_back(std::move(message));
}

std::vector<std::string_view> panelNames() {
    std::vector<std::string_view> names;
    for (PanelTab const& tab : kLeftTabs) names.emplace_back(tab.name);
    for (PanelTab const& tab : kRightTabs) names.emplace_back(tab.name);
    return names;
}

Panels::Panels() : mOptions(makeOptionGroups()) {}

void Panels::readScene(Stage& stage) {
    if (mGeneration == stage.generation()) return;
    mGeneration = stage.generation();
    mNodes = sceneNodes(stage);
    state.tree.isClosed.clear();
    if (state.selectedNode && *state.selectedNode >= mNodes.size()) state.selectedNode.reset();
}

void Panels::draw(Document& document, Stage& stage) {
    readScene(stage);
    ImGuiIO const& io = ImGui::GetIO();
    const float scale = ImGui::GetFontSize() / 13; // of ImGui's own font
    mLayout = layOutPanels(uint2(float2(io.DisplaySize.x, io.DisplaySize.y)), scale, state.showsPanels);
    PanelFrame frame{ document, stage,    state,         requests, inputs, mNodes,    mOptions,
                      mHistory, mChanges, mMaterialCost, latency,  pixel,  fileDialog };
    drawTabs("left", mLayout.left, kLeftTabs, frame);
    drawTabs("right", mLayout.right, kRightTabs, frame);
    drawLoadProgress(frame, mLayout.picture);
    fileDialog.draw();
    drawShortcutList(state);
}

void Panels::collect(Stage& stage) {
    const std::vector<FrameTimings> timings = stage.renderer().takeTimings();
    for (FrameTimings const& frame : timings) {
        mHistory.addTimings({ &frame, 1 });
        mChanges.frame(mHistory.latestMilliseconds());
    }
    mHistory.addStatistics(stage.renderer().statistics(), stage.engine().statistics().deviceBytes);
}

} // namespace filament_core::view
