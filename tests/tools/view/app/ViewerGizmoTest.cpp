// SPDX-License-Identifier: Apache-2.0
// Handles in the viewer: events drag each kind, the document changes and nothing else, and one drag is one step of
// undo.
#include "tests/tools/view/app/HeadlessViewer.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

namespace filament_core::view {
namespace {

constexpr int kLeftControl = 341;

/// With FILAMENT_VIEW_PICTURES the images are kept there, to be looked at.
void keep(Image const& image, std::string const& name) {
    if (const char* folder = std::getenv("FILAMENT_VIEW_PICTURES")) {
        EXPECT_TRUE(savePng(std::filesystem::path(folder) / (name + ".png"), image));
    }
}

struct GizmoViewer : Headless {
    explicit GizmoViewer(Backend backend) : Headless(backend) {
        if (!viewer) return;
        viewer->panels().state.showsPanels = false; // they name the device
        settle();
    }
    void selectNode() {
        click({ 320, 200 });
        settle();
        ASSERT_TRUE(viewer->panels().state.selectedNode.has_value());
    }
    void selectLight(LightDesc const& light) {
        viewer->document().lights.push_back({ .name = "lamp", .light = light });
        viewer->panels().state.selectedLight =
                LightSelection{ false, static_cast<uint32_t>(viewer->document().lights.size() - 1) };
        viewer->redraw();
        settle();
    }
    LightDesc& light() { return viewer->document().lights.back().light; }
    /// The end of an arrow, the middle of an area, a line of a ring.
    float2 pixelOf(GizmoPart part) {
        for (Handle const& handle : viewer->gizmo().handles(viewer->gizmoScene())) {
            if (handle.part != part) continue;
            double2 at(0);
            for (double2 const& point : handle.area) at += point / static_cast<double>(handle.area.size());
            if (handle.area.empty()) at = handle.lines[handle.lines.size() / 3][0];
            return float2(at);
        }
        ADD_FAILURE() << "there is no handle " << toString(part);
        return {};
    }
    double4x4 nodeMatrix() {
        return viewer->stage().scene().parentFromNode(
                viewer->stage().nodes()[viewer->panels().state.selectedNode.value()]);
    }
    double4x4 worldMatrix() {
        return viewer->stage().scene().worldFromNode(
                viewer->stage().nodes()[viewer->panels().state.selectedNode.value()]);
    }
};

class ViewerGizmoTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, ViewerGizmoTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& tested) { return std::string(toString(tested.param)); });

TEST_P(ViewerGizmoTest, EveryHandleOfANodeChangesItsTransformAndUndoIsOneStep) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    const double4x4 camera = hands.viewer->document().view.camera.worldFromView;
    const double4x4 matrix = hands.nodeMatrix();
    for (auto const& [key, mode] : { std::pair{ '1', "move" }, { '2', "rotate" }, { '3', "scale" } }) {
        hands.press(key);
        int dragged = 0;
        for (int part = 1; part <= static_cast<int>(GizmoPart::Screen); ++part) {
            const std::vector<Handle> handles = hands.viewer->gizmo().handles(hands.viewer->gizmoScene());
            if (std::ranges::find(handles, static_cast<GizmoPart>(part), &Handle::part) == handles.end()) continue;
            const std::string what = fmt::format("{} {}", mode, toString(static_cast<GizmoPart>(part)));
            const Document before = hands.viewer->document();
            const float2 from = hands.pixelOf(static_cast<GizmoPart>(part));
            hands.drag(from, from + float2(17, -23), 3);
            EXPECT_FALSE(hands.viewer->gizmo().isDragging());
            Document after = hands.viewer->document();
            ASSERT_EQ(after.nodes.size(), 1u) << what;
            EXPECT_EQ(after.nodes[0].node, hands.viewer->panels().state.selectedNode) << what;
            ASSERT_TRUE(after.nodes[0].parentFromNode.has_value()) << what;
            EXPECT_NE(*after.nodes[0].parentFromNode, matrix) << what;
            EXPECT_EQ(hands.nodeMatrix(), *after.nodes[0].parentFromNode) << what << " is seen";
            EXPECT_EQ(after.view.camera.worldFromView, camera) << what;
            after.nodes = before.nodes;
            EXPECT_EQ(toJson(after), toJson(before)) << what << " changes the node alone";
            hands.press('Z', { .control = true });
            EXPECT_EQ(toJson(hands.viewer->document()), toJson(before)) << what << " is undone";
            hands.viewer->step(0.01);
            EXPECT_EQ(hands.nodeMatrix(), matrix) << what << " is undone";
            ++dragged;
        }
        EXPECT_EQ(dragged, key == '2' ? 4 : 7) << mode << ": every handle is seen from here";
    }
    EXPECT_TRUE(hands.viewer->panels().state.selectedNode.has_value()) << "no drag is a click";
    EXPECT_THAT(hands.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerGizmoTest, AnArrowMovesAlongItsAxisAndFollowsThePointer) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    hands.press('X'); // the axes of the world
    EXPECT_EQ(hands.viewer->gizmo().axes, GizmoAxes::World);
    const Image before = hands.picture();
    const double4x4 world = hands.worldMatrix();
    const float2 from = hands.pixelOf(GizmoPart::AxisY), to = from + float2(0, -40);
    hands.drag(from, to);
    hands.settle();
    const double3 moved = double3(hands.worldMatrix()[3] - world[3]);
    EXPECT_GT(moved.y, 0.01);
    EXPECT_LT(std::abs(moved.x) + std::abs(moved.z), 1e-9);
    EXPECT_LT(glm::length(hands.pixelOf(GizmoPart::AxisY) - to), 4) << "the arrow is under the pointer";
    const Image after = hands.picture();
    EXPECT_NE(after.pixels, before.pixels);
    keep(after, fmt::format("gizmo moved {}", toString(GetParam())));
}

TEST_P(ViewerGizmoTest, HowManyFramesADragTakesDoesNotMatter) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    hands.press('2');
    std::vector<std::string> documents;
    for (auto const& [moves, seconds] : { std::pair{ 1, 0.5 }, { 9, 0.001 } }) {
        const float2 from = hands.pixelOf(GizmoPart::AxisY);
        hands.drag(from, from + float2(40, 10), moves, seconds);
        documents.push_back(toJson(hands.viewer->document()));
        hands.press('Z', { .control = true });
        hands.viewer->step(0.01);
    }
    EXPECT_EQ(documents[0], documents[1]);
}

TEST_P(ViewerGizmoTest, ControlSnapsAndEscapeCancels) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    const std::string before = toJson(hands.viewer->document());
    const double4x4 world = hands.worldMatrix();
    hands.press('X');
    const float2 from = hands.pixelOf(GizmoPart::AxisY);
    const GizmoFrame frame{ .originWorld = double3(world[3]) };
    const double step = stepsOf(frame, { hands.viewer->document().view.camera, kPictureSize }).meters;
    hands.viewer->handle(MouseMoveEvent{ from });
    hands.viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
    hands.viewer->handle(KeyEvent{ kLeftControl, true, {} });
    hands.viewer->handle(MouseMoveEvent{ from + float2(0, -41) });
    hands.settle();
    EXPECT_TRUE(hands.viewer->gizmo().isDragging());
    const double moved = hands.worldMatrix()[3].y - world[3].y;
    EXPECT_GT(moved, 0);
    EXPECT_NEAR(std::remainder(moved, step), 0, 1e-9);
    hands.viewer->handle(KeyEvent{ kLeftControl, false, {} });
    hands.settle();
    EXPECT_GT(std::abs(std::remainder(hands.worldMatrix()[3].y - world[3].y, step)), 1e-9);
    hands.press(kEscape);
    EXPECT_FALSE(hands.viewer->gizmo().isDragging());
    EXPECT_EQ(toJson(hands.viewer->document()), before);
    EXPECT_TRUE(hands.viewer->panels().state.selectedNode.has_value()) << "Escape ended the drag and nothing else";
    hands.viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
    hands.settle();
    hands.drag(from, from, 2); // grabbed, and not moved
    EXPECT_EQ(toJson(hands.viewer->document()), before);
}

TEST_P(ViewerGizmoTest, AFileThatIsDroppedEndsTheDrag) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    const float2 from = hands.pixelOf(GizmoPart::AxisY);
    hands.viewer->handle(MouseMoveEvent{ from });
    hands.viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
    hands.viewer->handle(MouseMoveEvent{ from + float2(0, -20) });
    ASSERT_EQ(hands.viewer->document().nodes.size(), 1u);
    hands.viewer->handle(DropEvent{ { showcaseFiles().model } });
    EXPECT_FALSE(hands.viewer->gizmo().isDragging());
    hands.viewer->handle(MouseMoveEvent{ from + float2(0, -40) });
    EXPECT_TRUE(hands.viewer->document().nodes.empty()) << "edits of the last document do not come back";
    hands.viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
}

TEST_P(ViewerGizmoTest, HoveredHandlesAreHighlighted) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectNode();
    const float2 tip = hands.pixelOf(GizmoPart::AxisX);
    hands.viewer->handle(MouseMoveEvent{ { 5, 5 } });
    const Image plain = hands.picture();
    hands.viewer->handle(MouseMoveEvent{ tip });
    EXPECT_EQ(hands.viewer->gizmo().hovered(), GizmoPart::AxisX);
    EXPECT_NE(hands.picture().pixels, plain.pixels);
    hands.viewer->handle(MouseMoveEvent{ { 5, 5 } });
    EXPECT_EQ(hands.picture().pixels, plain.pixels);
    hands.press('0');
    EXPECT_TRUE(hands.viewer->gizmo().handles(hands.viewer->gizmoScene()).empty());
    EXPECT_NE(hands.picture().pixels, plain.pixels) << "no handles";
}

TEST_P(ViewerGizmoTest, HandlesOfLightsChangeTheirFields) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectLight(SpotLight{ .positionWorld = { 0.1, 0.2, 0.1 },
                                 .directionWorld = { 0.8f, -0.5f, 0.2f },
                                 .intensity = { 500 },
                                 .rangeMeters = 0.45f,
                                 .innerConeRadians = 0.3f,
                                 .outerConeRadians = 0.6f });
    keep(hands.picture(), fmt::format("gizmo spot {}", toString(GetParam())));
    const auto dragged = [&](GizmoPart part, float2 way) {
        const SpotLight before = std::get<SpotLight>(hands.light());
        const float2 from = hands.pixelOf(part);
        hands.drag(from, from + way, 2);
        EXPECT_FALSE(isEqual(LightDesc(before), hands.light())) << toString(part);
        return std::pair{ before, std::get<SpotLight>(hands.light()) };
    };
    auto [before, after] = dragged(GizmoPart::Direction, { 0, 20 });
    EXPECT_NE(after.directionWorld, before.directionWorld);
    EXPECT_EQ(after.positionWorld, before.positionWorld);
    std::tie(before, after) = dragged(GizmoPart::Range, { 0, -20 });
    EXPECT_GT(after.rangeMeters, before.rangeMeters);
    std::tie(before, after) = dragged(GizmoPart::InnerCone, { 8, 8 });
    EXPECT_NE(after.innerConeRadians, before.innerConeRadians);
    std::tie(before, after) = dragged(GizmoPart::OuterCone, { 9, 9 });
    EXPECT_NE(after.outerConeRadians, before.outerConeRadians);
    std::tie(before, after) = dragged(GizmoPart::Screen, { 20, 10 });
    EXPECT_NE(after.positionWorld, before.positionWorld);
    EXPECT_EQ(after.directionWorld, before.directionWorld);
    hands.press('2');
    std::tie(before, after) = dragged(GizmoPart::Screen, { 10, 30 });
    EXPECT_EQ(after.positionWorld, before.positionWorld);
    EXPECT_NE(after.directionWorld, before.directionWorld);
    for (int i = 0; i < 6; ++i) hands.press('Z', { .control = true });
    EXPECT_EQ(std::get<SpotLight>(hands.light()).rangeMeters, 0.45f) << "six steps";
    EXPECT_THAT(hands.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerGizmoTest, SunsTurnWhereTheCameraLooks) {
    GizmoViewer hands(GetParam());
    if (!hands.viewer) return;
    hands.selectLight(SunLight{ .directionWorld = { -0.4f, -1, -0.3f } });
    const float3 before = std::get<SunLight>(hands.light()).directionWorld;
    const float2 from = hands.pixelOf(GizmoPart::Direction);
    hands.drag(from, from + float2(30, -10), 2);
    EXPECT_GT(glm::length(glm::normalize(std::get<SunLight>(hands.light()).directionWorld) - glm::normalize(before)),
              0.1f);
    hands.settle();
    keep(hands.picture(), fmt::format("gizmo sun {}", toString(GetParam())));
}

TEST(ViewerGizmo, LooksTheSameOnBothApis) {
    std::vector<Image> moving, turning, scaling;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        GizmoViewer hands(backend);
        if (!hands.viewer) return;
        hands.selectNode();
        moving.push_back(hands.picture());
        hands.press('2');
        turning.push_back(hands.picture());
        hands.press('3');
        scaling.push_back(hands.picture());
    }
    EXPECT_EQ(moving[0].pixels, moving[1].pixels);
    EXPECT_EQ(turning[0].pixels, turning[1].pixels);
    EXPECT_EQ(scaling[0].pixels, scaling[1].pixels);
    keep(moving[0], "gizmo move");
    keep(turning[0], "gizmo rotate");
    keep(scaling[0], "gizmo scale");
}

} // namespace
} // namespace filament_core::view
