// SPDX-License-Identifier: Apache-2.0
/// GizmoHands: the pointer on the handles of what is selected last, a node or a light. Drags edit the document and
/// nothing else; while one lasts, History makes no step, so that all of it is one.
///   Mouse    left button on a handle; Control: whole steps (GizmoSteps). Escape: as before the drag.
///   Draws    with ImGui, under the panels: images that are compared or saved have no handles.
///   Places   events count pixels of the image.
///   Thread   the main thread.
#pragma once

#include "tools/view/app/InputEvent.h"
#include "tools/view/gizmo/LightHandles.h"
#include "tools/view/panels/Panels.h"

#include <imgui.h>

#include <optional>
#include <string>

namespace filament_core::view {

/// What the handles are in.
struct GizmoScene {
    Document& document;
    Stage& stage;
    PanelState const& state;
    double3 centerWorld{ 0 }; ///< where suns have their handles
};

class GizmoHands {
public:
    GizmoMode mode = GizmoMode::Move;
    GizmoAxes axes = GizmoAxes::Local;
    double scale = 1; ///< of the display

    /// True: the event was meant for a handle.
    bool handle(InputEvent const& event, GizmoScene const& scene);
    /// Handles, and in a drag its numbers. `offset`: where the image begins in the list's pixels. `isOverPanel`:
    /// nothing is hovered.
    void draw(GizmoScene const& scene, ImDrawList& list, uint2 offset, bool isOverPanel);
    bool isDragging() const { return mDrag.has_value(); }
    void letGo() { mDrag.reset(); } ///< what was dragged stays where it is

    /// As drawn now, for tests: none without a selection.
    std::vector<Handle> handles(GizmoScene const& scene);
    GizmoPart hovered() const { return mDrag ? mDrag->drag.part : mHovered; }

private:
    struct Target {
        GizmoFrame frame{};
        std::optional<uint32_t> node{}; ///< else a light
        double4x4 worldFromParent{ 1.0 }, parentFromNode{ 1.0 };
        LightSelection selection{};
        GizmoLight light{};
    };
    struct Drag {
        GizmoDrag drag{};
        Target target{};
        uint64_t generation = 0;       ///< of the stage's handles
        std::vector<NodeEdit> nodes{}; ///< the document's edits before it
        std::vector<DocumentLight> lights{};
        std::vector<ModelLightEdit> modelLights{};
    };

    void followSelection(PanelState const& state);
    std::optional<Target> target(GizmoScene const& scene);
    std::optional<Target> nodeTarget(GizmoScene const& scene, uint32_t node) const;
    std::optional<Target> lightTarget(GizmoScene const& scene, LightSelection selection) const;
    std::vector<Handle> handlesOf(Target const& target, PictureView const& view) const;
    GizmoMode modeFor(Target const& target) const;
    bool press(MouseButtonEvent const& event, GizmoScene const& scene);
    bool key(KeyEvent const& event, GizmoScene const& scene);
    void move(GizmoScene const& scene);
    void restore(Document& document) const;
    GizmoSteps steps() const;
    std::string dragText() const;

    double2 mPointer{ 0 };
    bool mSnaps = false;
    GizmoPart mHovered = GizmoPart::None;
    std::optional<Drag> mDrag;
    std::optional<uint32_t> mLastNode;
    std::optional<LightSelection> mLastLight;
    bool mIsLight = false; ///< was selected last
};

} // namespace filament_core::view
