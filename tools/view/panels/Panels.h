// SPDX-License-Identifier: Apache-2.0
/// Panels: two columns of Dear ImGui windows around an image, in which a Document is edited and what a Stage draws is
/// looked into. Left: scene, materials, lights, probes, environment, animation, camera paths. Right: camera, options,
/// costs, comparison, demand, graph, timeline, statistics, pixel, log. Every panel is a thin function over a model of
/// plain functions; the models have tests of their own.
///   Use      panels.draw(document, stage) between ImGui's NewFrame() and Render(); then apply the document to the
///            stage, render, and panels.collect(stage).
///   Times    of passes are those of the device if the stage has RendererOptions::passTimers; else costs are measured
///            by the driver thread alone.
///   Edits    go into the Document, and nowhere else. What a click asks of the program is in `requests`.
///   Thread   the app thread of the stage; ImGui's context is current.
///   Cost     what the visible panels show: the tree is read again only when Stage::generation() changes.
#pragma once

#include "tools/view/compare/PixelReport.h"
#include "tools/view/document/Document.h"
#include "tools/view/panels/CostPlot.h"
#include "tools/view/panels/FileDialog.h"
#include "tools/view/panels/FrameHistory.h"
#include "tools/view/panels/GraphModel.h"
#include "tools/view/panels/JobLanes.h"
#include "tools/view/panels/LatencyMeter.h"
#include "tools/view/panels/MaterialCost.h"
#include "tools/view/panels/OptionCosts.h"
#include "tools/view/panels/OptionTable.h"
#include "tools/view/panels/PanelLayout.h"
#include "tools/view/panels/PathModel.h"
#include "tools/view/panels/ProbeModel.h"
#include "tools/view/panels/SceneTree.h"
#include "tools/view/panels/Shortcuts.h"

#include <filament_core/Renderer.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

class Stage;

/// A light of the document, or of the model's file.
struct LightSelection {
    bool isModels = false;
    uint32_t light = 0;
    friend bool operator==(LightSelection const&, LightSelection const&) = default;
};

/// A texture of a material.
struct TextureTarget {
    std::string material{}, parameter{};
    friend bool operator==(TextureTarget const&, TextureTarget const&) = default;
};

/// What the panels remember: a plain value, which programs may read and set (a click into the image selects a node).
struct PanelState {
    std::optional<uint32_t> selectedNode{};
    std::string selectedMaterial{};
    std::optional<LightSelection> selectedLight{};
    std::optional<TextureTarget> textureTarget{}; ///< of images that are dropped on the window
    TreeState tree{};
    std::string treeFilter{}, materialFilter{}, optionFilter{}, demandFilter{};
    bool onlyChangedOptions = false, onlyActiveDemand = false, onlyPasses = false;
    bool showsPanels = true, showsShortcuts = false;
    std::optional<size_t> selectedProbe{}; ///< of Document::probes
    BakeSettings bake{};
    PathState path{};
    RecordingSettings recording{};
    FrameKind pictureKind = FrameKind::Png;       ///< of saved images; not Video
    std::string injectedDefect{}, defectFilter{}; ///< of PanelInputs::defects, into the other API; empty: none
    std::optional<TimeWindow> jobWindow{};        ///< of the timeline that is looked at; none: the newest frames
    bool recordsJobs = false, holdsJobs = false;  ///< the timeline shows jobs, and stays as it is
    std::string opensPanel{};            ///< one of panelNames(): comes to the front of its column; then empty again
    std::vector<std::string> messages{}; ///< the newest last; what the program adds, and edits that were refused

    void addMessage(std::string message); ///< keeps the last 50
};

/// "Scene", "Materials", ...: those of the left column, then those of the right one.
std::vector<std::string_view> panelNames();

/// What the program is asked to do; it sets them back.
struct PanelRequests {
    bool cancelsLoading = false;
    bool framesSelection = false;
    bool recordsPath = false, stopsRecording = false; ///< PanelState::path, as PanelState::recording says
    bool inspectsPixel = false; ///< the pixel panel is seen: Panels::pixel is to follow the pointer
    bool togglesPixelLock = false, togglesPixelExplanation = false;
    std::optional<size_t> capturesProbe{};        ///< of Document::probes
    bool startsBake = false, cancelsBake = false; ///< as PanelState::bake says
    bool measuresCosts = false, cancelsCosts = false;
    bool readsJobs = false; ///< the timeline is seen, and shows what has been recorded
    std::vector<Action> actions{};
};

/// A mistake that may be injected into the other API's commands.
struct OfferedDefect {
    std::string name{}, what{}; ///< "roughness", "roughness + 1 %"
};

/// What the program knows that a stage does not; it sets it before draw().
struct PanelInputs {
    CostPlot costs{};
    bool isCostOfOther = false; ///< the costs are of another scene, camera or size than those of the document
    JobLanes jobs{};
    RecordingProgress recording{};
    BakeProgress bake{};
    bool isCapturing = false; ///< a probe
    std::vector<OfferedDefect> defects{};
    std::string compareMode{}, comparedWith{}, identical{}; ///< "wipe", "gles: llvmpipe", "100.0000 %"; empty: none
    bool isDefectActive = false;                            ///< the image that is compared has it
};

class Panels {
public:
    Panels();

    void draw(Document& document, Stage& stage);
    /// Takes what was found beside the interface; true: the panels look different now.
    bool poll() { return mMaterialCost.poll(); }
    bool isCompiling() const { return mMaterialCost.isCompiling(); } ///< the report of a material's cost
    /// Takes the timings of finished frames and the statistics of the last one.
    void collect(Stage& stage);

    PanelState state{};
    PanelRequests requests{};
    LatencyMeter latency{}; ///< the program feeds it; the statistics panel shows it
    PixelReport pixel{};    ///< what the program found: the pixel panel shows it
    PanelInputs inputs{};
    FileDialog fileDialog{}; ///< what it has chosen is the program's to take
    PanelLayout const& layout() const { return mLayout; }
    FrameHistory const& history() const { return mHistory; }
    ChangeMeter const& changes() const { return mChanges; }

private:
    void readScene(Stage& stage);

    PanelLayout mLayout{};
    FrameHistory mHistory{};
    ChangeMeter mChanges{};
    MaterialCost mMaterialCost{};
    std::vector<OptionGroup> mOptions;
    std::vector<SceneNode> mNodes{};
    std::optional<uint64_t> mGeneration{};
};

} // namespace filament_core::view
