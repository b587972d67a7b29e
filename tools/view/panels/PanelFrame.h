// SPDX-License-Identifier: Apache-2.0
/// PanelFrame: what a panel draws from in one frame, and the panels. Each draws into the current ImGui window.
///   Thread  the app thread, with ImGui's context current.
#pragma once

#include "tools/view/panels/Panels.h"
#include "tools/view/stage/Stage.h"

#include <imgui.h>

#include <string>

namespace filament_core::view {

struct PanelFrame {
    Document& document;
    Stage& stage;
    PanelState& state;
    PanelRequests& requests;
    PanelInputs const& inputs;
    std::vector<SceneNode> const& nodes;
    std::vector<OptionGroup> const& options;
    FrameHistory const& history;
    ChangeMeter& changes;
    MaterialCost& materialCost;
    LatencyMeter const& latency;
    PixelReport const& pixel;
    FileDialog& fileDialog;
};

void drawScenePanel(PanelFrame& frame);
void drawMaterialPanel(PanelFrame& frame);
void drawLightPanel(PanelFrame& frame);
void drawProbePanel(PanelFrame& frame);
void drawEnvironmentPanel(PanelFrame& frame);
void drawAnimationPanel(PanelFrame& frame);
void drawPathPanel(PanelFrame& frame);
void drawCameraPanel(PanelFrame& frame);
void drawOptionPanel(PanelFrame& frame);
void drawCostPanel(PanelFrame& frame);
void drawComparePanel(PanelFrame& frame);
void drawDemandPanel(PanelFrame& frame);
void drawGraphPanel(PanelFrame& frame);
void drawTimelinePanel(PanelFrame& frame);
/// Lanes of threads: the part of the timeline panel while jobs are recorded.
void drawJobTimeline(PanelFrame& frame);
void drawStatisticsPanel(PanelFrame& frame);
void drawPixelPanel(PanelFrame& frame);
void drawMessagePanel(PanelFrame& frame);
void drawShortcutList(PanelState& state);
void drawLoadProgress(PanelFrame& frame, PanelRect const& picture);

/// Sets the option and lets the meter see the change; a refusal becomes a message.
void editOption(PanelFrame& frame, Option const& option, std::string_view value);

// ---- widgets that several panels have

inline const ImVec4 kQuietColor{ 0.6f, 0.6f, 0.6f, 1 }, kEditedColor{ 1, 0.8f, 0.4f, 1 },
        kDefectColor{ 1, 0.45f, 0.3f, 1 };

void quietText(std::string const& text);
/// One line of text to filter by.
void filterField(const char* label, std::string& filter);
/// A number in [least, most]: a slider, or for wide ranges a field to drag in. True: changed.
bool numberField(const char* label, float& value, float least, float most, bool isLogarithmic = false);
bool vectorField(const char* label, double3& value, float step);
void tooltip(std::string const& text);

} // namespace filament_core::view
