// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/GizmoHands.h"

#include "tools/view/panels/SceneTree.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::view {
namespace {

constexpr int kEscapeKey = 256, kLeftControlKey = 341, kRightControlKey = 345; // of GLFW
constexpr float kLinePixels = 2.5f;
constexpr double kTextPixels = 16; // beside the pointer

PictureView viewOf(Document const& document) { return { document.view.camera, document.view.size }; }

ImU32 colorOf(GizmoPart part, bool isHovered) {
    if (isHovered) return IM_COL32(255, 200, 40, 255);
    constexpr ImU32 kAxes[3] = { IM_COL32(235, 70, 70, 255), IM_COL32(100, 200, 60, 255), IM_COL32(70, 130, 245, 255) };
    if (isAxis(part) || isPlane(part)) return kAxes[axisOf(part)];
    return part == GizmoPart::Screen ? IM_COL32(230, 230, 230, 255) : IM_COL32(250, 240, 150, 255);
}

ImU32 translucent(ImU32 color, uint32_t alpha) { return (color & ~IM_COL32_A_MASK) | alpha << IM_COL32_A_SHIFT; }

ImVec2 imVec(double2 pixel) { return { static_cast<float>(pixel.x), static_cast<float>(pixel.y) }; }

void drawHandle(ImDrawList& list, Handle const& handle, double2 offset, bool isHovered, float scale) {
    const ImU32 color = colorOf(handle.part, isHovered);
    const float width = (handle.part == GizmoPart::None ? 1.5f : kLinePixels) * scale;
    for (auto const& line : handle.lines)
        list.AddLine(imVec(offset + line[0]), imVec(offset + line[1]),
                     handle.part == GizmoPart::None ? translucent(color, 210) : color, width);
    if (handle.area.empty()) return;
    std::vector<ImVec2> points;
    for (double2 const& point : handle.area) points.push_back(imVec(offset + point));
    const auto count = static_cast<int>(points.size());
    list.AddConvexPolyFilled(points.data(), count, isPlane(handle.part) ? translucent(color, 110) : color);
    if (isPlane(handle.part)) list.AddPolyline(points.data(), count, color, ImDrawFlags_Closed, scale);
}

} // namespace

// ---- what is selected

void GizmoHands::followSelection(PanelState const& state) {
    if (mLastLight != state.selectedLight) mIsLight = state.selectedLight.has_value();
    if (mLastNode != state.selectedNode) mIsLight = !state.selectedNode && state.selectedLight;
    mLastLight = state.selectedLight;
    mLastNode = state.selectedNode;
}

std::optional<GizmoHands::Target> GizmoHands::target(GizmoScene const& scene) {
    followSelection(scene.state);
    if (mIsLight && mLastLight) return lightTarget(scene, *mLastLight);
    return mLastNode ? nodeTarget(scene, *mLastNode) : std::nullopt;
}

std::optional<GizmoHands::Target> GizmoHands::nodeTarget(GizmoScene const& scene, uint32_t node) const {
    const std::vector<Node> nodes = scene.stage.nodes();
    if (node >= nodes.size()) return std::nullopt;
    Scene const& drawn = scene.stage.scene();
    const Node parent = drawn.parent(nodes[node]);
    Target target{ .node = node, .parentFromNode = drawn.parentFromNode(nodes[node]) };
    if (parent) target.worldFromParent = drawn.worldFromNode(parent);
    const double4x4 worldFromNode = target.worldFromParent * target.parentFromNode;
    target.frame = { .originWorld = double3(worldFromNode[3]), .pixels = kHandlePixels * scale };
    const bool isLocal = axes == GizmoAxes::Local || mode == GizmoMode::Scale; // a node has only scales of its own axes
    if (isLocal) target.frame.axes = axesOf(worldFromNode);
    return target;
}

std::optional<GizmoHands::Target> GizmoHands::lightTarget(GizmoScene const& scene, LightSelection selection) const {
    Target target{ .selection = selection };
    GizmoLight& light = target.light;
    light.elsewhereWorld = scene.centerWorld;
    if (!selection.isModels) {
        if (selection.light >= scene.document.lights.size()) return std::nullopt;
        DocumentLight const& edited = scene.document.lights[selection.light];
        light.light = edited.light;
        light.hasProfile = !edited.profileFile.empty();
    } else {
        const std::vector<CopyLight> ofFile = scene.stage.modelLights();
        if (selection.light >= ofFile.size()) return std::nullopt;
        const auto edit = std::ranges::find(scene.document.modelLights, selection.light, &ModelLightEdit::light);
        const bool isEdited = edit != scene.document.modelLights.end() && edit->replacement;
        light.light = isEdited ? *edit->replacement : scene.stage.lightOfFile(selection.light);
        if (const Node node = ofFile[selection.light].node)
            light.worldFromLight = scene.stage.scene().worldFromNode(node);
    }
    target.frame = frameOf(light, axes);
    target.frame.pixels = kHandlePixels * scale;
    return target;
}

/// A light has no scale, and a sun no place.
GizmoMode GizmoHands::modeFor(Target const& target) const {
    const bool isSun = std::holds_alternative<SunLight>(target.light.light);
    if (target.node || mode == GizmoMode::Rotate) return mode;
    return mode == GizmoMode::Move && !isSun ? mode : GizmoMode::Off;
}

std::vector<Handle> GizmoHands::handlesOf(Target const& target, PictureView const& view) const {
    if (mode == GizmoMode::Off) return {};
    std::vector<Handle> handles;
    if (!target.node) handles = lightHandles(target.light, target.frame, view);
    for (Handle& handle : view::handlesOf(modeFor(target), target.frame, view)) handles.push_back(std::move(handle));
    return handles;
}

std::vector<Handle> GizmoHands::handles(GizmoScene const& scene) {
    const std::optional<Target> shown = target(scene);
    return shown ? handlesOf(*shown, viewOf(scene.document)) : std::vector<Handle>{};
}

// ---- hands

GizmoSteps GizmoHands::steps() const {
    return mSnaps && mDrag ? stepsOf(mDrag->drag.frame, mDrag->drag.view) : GizmoSteps{};
}

bool GizmoHands::press(MouseButtonEvent const& event, GizmoScene const& scene) {
    mSnaps = event.modifiers.control;
    if (mDrag) {
        if (!event.isDown && event.button == MouseButton::Left) letGo();
        return true;
    }
    if (!event.isDown || event.button != MouseButton::Left) return false;
    const std::optional<Target> grabbed = target(scene);
    if (!grabbed) return false;
    const PictureView view = viewOf(scene.document);
    const GizmoPart part = partAt(handlesOf(*grabbed, view), mPointer, scale);
    if (part == GizmoPart::None) return false;
    mDrag = Drag{ .drag = { modeFor(*grabbed), part, grabbed->frame, view, mPointer },
                  .target = *grabbed,
                  .generation = scene.stage.generation(),
                  .nodes = scene.document.nodes,
                  .lights = scene.document.lights,
                  .modelLights = scene.document.modelLights };
    return true;
}

void GizmoHands::restore(Document& document) const {
    document.nodes = mDrag->nodes;
    document.lights = mDrag->lights;
    document.modelLights = mDrag->modelLights;
}

bool GizmoHands::key(KeyEvent const& event, GizmoScene const& scene) {
    if (event.key == kLeftControlKey || event.key == kRightControlKey) {
        mSnaps = event.isDown;
        move(scene);
        return mDrag.has_value();
    }
    if (!mDrag || !event.isDown) return false; // what is released was pressed before the drag
    if (event.key == kEscapeKey) {
        restore(scene.document);
        letGo();
    }
    return true;
}

/// From the document as it was before the drag: what the pointer did in between leaves nothing.
void GizmoHands::move(GizmoScene const& scene) {
    if (!mDrag) return;
    if (mDrag->generation != scene.stage.generation()) return letGo(); // it is another scene now
    restore(scene.document);
    if (mPointer == mDrag->drag.from) return;
    Target const& target = mDrag->target;
    if (target.node) {
        const auto dragged = draggedNode(mDrag->drag, mPointer, steps(), target.worldFromParent, target.parentFromNode);
        if (dragged) setNodeTransform(scene.document, *target.node, *dragged);
        return;
    }
    const LightDesc light = draggedLight(mDrag->drag, mPointer, steps(), target.light);
    if (target.selection.isModels)
        modelLightEdit(scene.document, target.selection.light).replacement = light;
    else
        scene.document.lights[target.selection.light].light = light;
}

bool GizmoHands::handle(InputEvent const& event, GizmoScene const& scene) {
    if (auto const* button = std::get_if<MouseButtonEvent>(&event)) return press(*button, scene);
    if (auto const* pressed = std::get_if<KeyEvent>(&event)) return key(*pressed, scene);
    if (auto const* focus = std::get_if<FocusEvent>(&event); focus && !focus->hasFocus) letGo();
    if (auto const* moved = std::get_if<MouseMoveEvent>(&event)) {
        mPointer = double2(moved->pixel);
        move(scene);
        if (!mDrag) mHovered = partAt(handles(scene), mPointer, scale);
    }
    return false; // others follow the pointer, too
}

// ---- what is seen

std::string GizmoHands::dragText() const {
    GizmoDrag const& drag = mDrag->drag;
    const std::string part(toString(drag.part));
    if (isAxis(drag.part) || isPlane(drag.part) || drag.part == GizmoPart::Screen) {
        if (drag.mode == GizmoMode::Scale) {
            const double3 factors = scaleChange(drag, mPointer, steps());
            return fmt::format("{}: {:.3g}, {:.3g}, {:.3g}", part, factors.x, factors.y, factors.z);
        }
        const double4x4 change = worldChange(drag, mPointer, steps());
        if (drag.mode == GizmoMode::Move)
            return fmt::format("{}: {:.4g}, {:.4g}, {:.4g} m", part, change[3].x, change[3].y, change[3].z);
        const double cosine = (change[0].x + change[1].y + change[2].z - 1) / 2; // the trace of a rotation
        return fmt::format("{}: {:.1f} degrees", part, glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
    return part;
}

void GizmoHands::draw(GizmoScene const& scene, ImDrawList& list, uint2 offset, bool isOverPanel) {
    const GizmoPart marked = mDrag ? mDrag->drag.part : isOverPanel ? GizmoPart::None : mHovered;
    const std::vector<Handle> shown = handles(scene);
    for (auto handle = shown.rbegin(); handle != shown.rend(); ++handle) // what is grabbed first lies above
        drawHandle(list, *handle, double2(offset), handle->part != GizmoPart::None && handle->part == marked,
                   static_cast<float>(scale));
    if (!mDrag) return;
    const double2 place = double2(offset) + mPointer + double2(kTextPixels * scale);
    list.AddText(imVec(place + double2(1)), IM_COL32(0, 0, 0, 255), dragText().c_str());
    list.AddText(imVec(place), IM_COL32(255, 255, 255, 255), dragText().c_str());
}

} // namespace filament_core::view
