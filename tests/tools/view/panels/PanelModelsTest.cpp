// SPDX-License-Identifier: Apache-2.0
// The models of the panels without a window: texts, transforms, trees, lights, cameras, demand, keys, columns.
#include "tools/view/panels/CameraModel.h"
#include "tools/view/panels/DemandRows.h"
#include "tools/view/panels/FrameHistory.h"
#include "tools/view/panels/LightFields.h"
#include "tools/view/panels/MaterialRows.h"
#include "tools/view/panels/NodeTransform.h"
#include "tools/view/panels/PanelLayout.h"
#include "tools/view/panels/PanelText.h"
#include "tools/view/panels/SceneTree.h"
#include "tools/view/panels/Shortcuts.h"

#include <glm/ext/matrix_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace filament_core::view {
namespace {

// ---- texts

TEST(PanelText, AFilterAsksForAllOfItsWords) {
    EXPECT_TRUE(matchesFilter("shadowMapSize", ""));
    EXPECT_TRUE(matchesFilter("shadowMapSize", "SIZE map"));
    EXPECT_TRUE(matchesFilter("shadowMapSize", "  size  "));
    EXPECT_FALSE(matchesFilter("shadowMapSize", "size mop"));
    EXPECT_FALSE(matchesFilter("", "a"));
}

TEST(PanelText, WritesFewDigits) {
    EXPECT_EQ(millisecondsText(0.01234), "0.012 ms");
    EXPECT_EQ(millisecondsText(1.234), "1.23 ms");
    EXPECT_EQ(millisecondsText(12.34), "12.3 ms");
    EXPECT_EQ(millisecondsText(1234.4), "1234 ms");
    EXPECT_EQ(millisecondsText(0), "");
    EXPECT_EQ(millisecondsText(std::nan("")), "");
    EXPECT_EQ(differenceText(-0.5), "-0.50 ms");
    EXPECT_EQ(bytesText(999), "999 B");
    EXPECT_EQ(bytesText(1500), "1.5 kB");
    EXPECT_EQ(bytesText(11'059'200), "11.06 MB");
}

// ---- transforms

double largestDifference(double4x4 const& a, double4x4 const& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

struct Numbers {
    double operator()(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine); }
    std::mt19937_64 engine{ 5 };
};

TEST(NodeTransform, SurvivesItsNumbers) {
    Numbers random;
    for (int i = 0; i < 2000; ++i) {
        const NodeTransform transform{ .translation = { random(-9, 9), random(-9, 9), random(-9, 9) },
                                       .degrees = { random(-89.9, 89.9), random(-180, 180), random(-180, 180) },
                                       .scale = { random(0.1, 4) * (i % 2 ? 1 : -1), random(0.1, 4), random(0.1, 4) } };
        const NodeTransform read = transformOf(matrixOf(transform));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(read.translation[c], transform.translation[c], 1e-12);
            EXPECT_NEAR(read.degrees[c], transform.degrees[c], 1e-6);
            EXPECT_NEAR(read.scale[c], transform.scale[c], 1e-12);
        }
    }
}

TEST(NodeTransform, AtThePoleTheMatrixIsTheSame) {
    for (const double x : { 90.0, -90.0 }) {
        const double4x4 matrix = matrixOf({ .degrees = { x, 30, 50 }, .scale = { 1, 2, 3 } });
        EXPECT_LT(largestDifference(matrixOf(transformOf(matrix)), matrix), 1e-6);
    }
}

TEST(NodeTransform, AnEditOfOnePartLeavesTheOthersAlone) {
    Numbers random;
    for (int i = 0; i < 200; ++i) {
        double4x4 sheared(1);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) sheared[c][r] = random(-2, 2);
        const double4x4 there = moved(sheared, { 7, 8, 9 });
        EXPECT_EQ(double3(there[3]), double3(7, 8, 9));
        for (int c = 0; c < 3; ++c) EXPECT_EQ(there[c], sheared[c]) << "the axes, bit by bit";
        const NodeTransform before = transformOf(sheared);
        const double4x4 larger = scaled(sheared, before.scale * 2.0);
        EXPECT_EQ(larger[3], sheared[3]);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) EXPECT_NEAR(larger[c][r], 2 * sheared[c][r], 1e-9);
        const NodeTransform turnedNumbers = transformOf(turned(sheared, { 10, 20, 30 }));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(turnedNumbers.scale[c], before.scale[c], 1e-9);
        EXPECT_NEAR(turnedNumbers.degrees.y, 20, 1e-6);
    }
}

TEST(NodeTransform, AScaleOfZeroCanBeUndone) {
    const double4x4 matrix = matrixOf({ .degrees = { 10, 20, 30 }, .scale = { 2, 3, 4 } });
    const double4x4 flat = scaled(matrix, { 2, 0, 4 });
    EXPECT_EQ(transformOf(flat).scale.y, 0);
    EXPECT_LT(largestDifference(scaled(flat, { 2, 3, 4 }), matrix), 1e-9);
    const double4x4 nothing = scaled(matrix, double3(0));
    EXPECT_TRUE(std::isfinite(transformOf(nothing).degrees.x));
}

// ---- the tree

///   0 body (1 arm (2 hand), 3 ""), 4 lamp
std::vector<SceneNode> someNodes() {
    return { { .name = "body" },
             { .name = "arm", .parent = 0 },
             { .name = "hand", .parent = 1 },
             { .name = "", .parent = 0 },
             { .name = "lamp" } };
}

std::string shape(std::vector<TreeRow> const& rows) {
    std::string text;
    for (TreeRow const& row : rows)
        text += std::string(row.depth, '.') + std::to_string(row.node) + (row.isVisible ? "" : "-") +
                (row.isHidden ? "h" : "") + ' ';
    return text;
}

TEST(SceneTree, IsDepthFirstAndClosesWhatIsClosed) {
    Document document;
    TreeState state;
    EXPECT_EQ(shape(treeRows(someNodes(), document, state)), "0 .1 ..2 .3 4 ");
    state.toggle(1);
    EXPECT_EQ(shape(treeRows(someNodes(), document, state)), "0 .1 .3 4 ");
    state.toggle(0);
    EXPECT_EQ(shape(treeRows(someNodes(), document, state)), "0 4 ");
    state.toggle(0);
    state.toggle(1);
    EXPECT_EQ(shape(treeRows(someNodes(), document, state)), "0 .1 ..2 .3 4 ");
    EXPECT_EQ(nodeLabel(someNodes(), 3), "node 3");
}

TEST(SceneTree, AFilterShowsWhatMatchesAndWhatLeadsThere) {
    Document document;
    TreeState state;
    state.toggle(0); // closed, but a filter opens it
    EXPECT_EQ(shape(treeRows(someNodes(), document, state, "HAND")), "0 .1 ..2 ");
    EXPECT_EQ(shape(treeRows(someNodes(), document, state, "node 3")), "0 .3 ");
    EXPECT_EQ(shape(treeRows(someNodes(), document, state, "nobody")), "");
}

TEST(SceneTree, WhatIsBelowAHiddenNodeIsHidden) {
    Document document;
    toggleVisible(document, 1);
    EXPECT_EQ(shape(treeRows(someNodes(), document, {})), "0 .1- ..2h .3 4 ");
    toggleVisible(document, 1);
    EXPECT_TRUE(document.nodes.empty()) << "an edit that changes nothing is none";
}

TEST(SceneTree, IsolatingShowsANodeWithItsFamilyAndThenEverything) {
    Document document;
    setNodeTransform(document, 4, double4x4(2));
    isolate(document, someNodes(), 1);
    EXPECT_EQ(shape(treeRows(someNodes(), document, {})), "0 .1 ..2 .3- 4- ");
    isolate(document, someNodes(), 4);
    EXPECT_EQ(shape(treeRows(someNodes(), document, {})), "0- .1-h ..2-h .3-h 4 ");
    isolate(document, someNodes(), 4);
    EXPECT_EQ(shape(treeRows(someNodes(), document, {})), "0 .1 ..2 .3 4 ");
    ASSERT_EQ(document.nodes.size(), 1u);
    EXPECT_EQ(*document.nodes[0].parentFromNode, double4x4(2)) << "transforms stay";
    resetNodeTransform(document, 4);
    EXPECT_TRUE(document.nodes.empty());
}

TEST(SceneTree, ManyNodesInAChainNeedNoDeepStack) {
    std::vector<SceneNode> chain(200'000);
    for (size_t i = 1; i < chain.size(); ++i) chain[i].parent = static_cast<int32_t>(i - 1);
    const std::vector<TreeRow> rows = treeRows(chain, {}, {}, "node 199999");
    ASSERT_EQ(rows.size(), chain.size());
    EXPECT_EQ(rows.back().depth, chain.size() - 1);
}

// ---- parameters

TEST(MaterialRows, WidgetsFollowTypesAndNames) {
    EXPECT_EQ(parameterKind({ .name = "baseColorFactor", .type = ParameterType::Float4 }), ParameterKind::Color);
    EXPECT_EQ(parameterKind({ .name = "emissiveFactor", .type = ParameterType::Float3 }), ParameterKind::Color);
    EXPECT_EQ(parameterKind({ .name = "colorStrength", .type = ParameterType::Float }), ParameterKind::Number);
    EXPECT_EQ(parameterKind({ .name = "offset", .type = ParameterType::Float3 }), ParameterKind::Number);
    EXPECT_EQ(parameterKind({ .name = "count", .type = ParameterType::Uint2 }), ParameterKind::Number);
    EXPECT_EQ(parameterKind({ .name = "isOn", .type = ParameterType::Bool3 }), ParameterKind::Switch);
    EXPECT_EQ(parameterKind({ .name = "map", .type = ParameterType::Sampler2D }), ParameterKind::Texture);
    EXPECT_EQ(parameterKind({ .name = "weights", .type = ParameterType::Float, .arraySize = 9 }), ParameterKind::Other);
    EXPECT_EQ(parameterKind({ .name = "uvTransform", .type = ParameterType::Float3x3 }), ParameterKind::Other);
}

TEST(MaterialRows, ComponentsKeepTheTypeOfTheirValue) {
    const std::vector<ParameterValue> values{
        true,          bool2(true, false), 0.5f, float2(1, 2),     float3(1, 2, 3), float4(1, 2, 3, 4),
        int32_t{ -3 }, int2(-1, 2),        7u,   uint4(1, 2, 3, 4)
    };
    for (ParameterValue const& value : values) {
        EXPECT_EQ(withComponents(value, componentsOf(value)), value) << value.index();
        std::vector<double> other = componentsOf(value);
        for (double& number : other) number = number == 0;
        const ParameterValue changed = withComponents(value, other);
        EXPECT_EQ(changed.index(), value.index());
        EXPECT_EQ(componentsOf(changed), other);
    }
    EXPECT_TRUE(componentsOf(float4x4(1)).empty());
    EXPECT_EQ(std::get<uint32_t>(withComponents(1u, { -5.0 })), 0u);
    EXPECT_EQ(std::get<int32_t>(withComponents(int32_t{ 1 }, { 1e30 })), std::numeric_limits<int32_t>::max());
    EXPECT_EQ(std::get<int32_t>(withComponents(int32_t{ 1 }, { std::nan("") })), 0);
    EXPECT_EQ(std::get<int32_t>(withComponents(int32_t{ 1 }, { 2.6 })), 3);
}

TEST(MaterialRows, SayWhatAMaterialPaysFor) {
    MaterialDescription description{ .shading = ShadingModel::Cloth,
                                     .blending = Blending::Masked,
                                     .doubleSided = true };
    description.terms = { "baseColor", "sheenColor" };
    EXPECT_EQ(describeMaterial(description), "cloth, masked, double sided, 0 variants; sets baseColor, sheenColor");
}

// ---- lights

TEST(LightFields, EveryFieldPointsIntoItsLight) {
    for (size_t kind = 0; kind < kLightKinds; ++kind) {
        Document document;
        LightDesc& light = addLight(document, kind, {}).light;
        ASSERT_EQ(light.index(), kind);
        std::set<std::string_view> names;
        for (LightField const& field : lightFields(light)) {
            EXPECT_TRUE(names.insert(field.name).second) << field.name;
            if (field.kind == LightFieldKind::Number) {
                EXPECT_LT(field.least, field.most) << field.name;
                const float value = *std::get<float*>(field.value);
                EXPECT_GE(value, field.least) << field.name;
                EXPECT_LE(value, field.most) << field.name;
            }
            const LightDesc before = light;
            std::visit(
                    [](auto* value) {
                        using T = std::remove_cvref_t<decltype(*value)>;
                        if constexpr (std::is_same_v<T, bool>)
                            *value = !*value;
                        else
                            *value = *value + T(1);
                    },
                    field.value);
            EXPECT_FALSE(isEqual(before, light)) << field.name;
        }
        EXPECT_TRUE(names.contains("colour") && names.contains("casts shadows") && names.contains("channels")) << kind;
    }
}

TEST(LightFields, TheConesOfASpotStayInEachOther) {
    Document document;
    LightDesc& light = addLight(document, 2, {}).light;
    auto& spot = std::get<SpotLight>(light);
    for (const float outer : { 1e-3f, 0.2f, 1.0f, kMostCone }) {
        spot.outerConeRadians = outer;
        spot.innerConeRadians = outer / 2;
        for (const bool isLeast : { false, true })
            for (const std::string_view name : { "inner cone, radians", "outer cone, radians" }) {
                const SpotLight before = spot;
                for (LightField const& field : lightFields(light))
                    if (field.name == name) *std::get<float*>(field.value) = isLeast ? field.least : field.most;
                EXPECT_TRUE(check(document)) << name << " of a spot of " << outer;
                spot = before;
            }
    }
}

TEST(LightFields, NewLightsShineWhereTheCameraLooksUnderNamesOfTheirOwn) {
    Document document;
    const Camera camera = Camera::lookAt({ 1, 2, 3 }, { 1, 2, -9 });
    for (int i = 0; i < 3; ++i) addLight(document, 2, camera);
    EXPECT_EQ(document.lights[0].name, "spot");
    EXPECT_EQ(document.lights[2].name, "spot 3");
    auto const& spot = std::get<SpotLight>(document.lights[1].light);
    EXPECT_EQ(spot.positionWorld, double3(1, 2, 2));
    EXPECT_EQ(spot.directionWorld, float3(0, 0, -1));
    removeLight(document, 1);
    EXPECT_EQ(addLight(document, 2, camera).name, "spot 2");
    EXPECT_EQ(copyLight(document, 0).name, "spot 4");
    removeLight(document, 99);
    EXPECT_EQ(document.lights.size(), 4u);
    EXPECT_TRUE(check(document));
}

TEST(LightFields, AnotherKindKeepsWhatBothHave) {
    SpotLight spot{ .positionWorld = { 1, 2, 3 },
                    .directionWorld = { 1, 0, 0 },
                    .color = { 0.1f, 0.2f, 0.3f },
                    .rangeMeters = 5,
                    .castsShadows = false,
                    .lightChannels = 6 };
    for (size_t kind = 0; kind < kLightKinds; ++kind) {
        LightDesc other = withKind(spot, kind);
        ASSERT_EQ(other.index(), kind);
        for (LightField const& field : lightFields(other)) {
            if (field.kind == LightFieldKind::Place) {
                EXPECT_EQ(*std::get<double3*>(field.value), spot.positionWorld);
            }
            if (field.kind == LightFieldKind::Color) {
                EXPECT_EQ(*std::get<float3*>(field.value), spot.color);
            }
            if (field.kind == LightFieldKind::Channels) {
                EXPECT_EQ(*std::get<LightChannels*>(field.value), 6);
            }
            if (field.name == "direction") {
                EXPECT_EQ(*std::get<float3*>(field.value), spot.directionWorld);
            }
            if (field.name == "range, m") {
                EXPECT_EQ(*std::get<float*>(field.value), 5);
            }
            if (field.name == "casts shadows") {
                EXPECT_FALSE(*std::get<bool*>(field.value));
            }
        }
    }
}

// ---- the camera

TEST(CameraModel, ExposureValuesAreReached) {
    for (const float ev : { -6.0f, 0.0f, 9.5f, 15.0f, 22.0f }) {
        const Exposure exposure = withEv100({ .aperture = 2.8f, .shutterSeconds = 1, .iso = 400 }, ev);
        EXPECT_NEAR(exposure.ev100(), ev, 1e-4f);
        EXPECT_EQ(exposure.aperture, 2.8f);
        EXPECT_EQ(exposure.iso, 400);
    }
}

TEST(CameraModel, BookmarksKeepTheWholeCamera) {
    Document document;
    document.view.camera = Camera::lookAt({ 1, 2, 3 }, {}, { .verticalFovDegrees = 33 }, { .aperture = 4 });
    addBookmark(document);
    const Camera kept = document.view.camera;
    document.view.camera = {};
    addBookmark(document);
    goToBookmark(document, 0);
    EXPECT_TRUE(isEqual(document.view.camera, kept));
    removeBookmark(document, 0);
    addBookmark(document);
    ASSERT_EQ(document.bookmarks.size(), 2u);
    EXPECT_NE(document.bookmarks[0].name, document.bookmarks[1].name);
    goToBookmark(document, 7);
    removeBookmark(document, 7);
    EXPECT_TRUE(isEqual(document.view.camera, kept));
}

TEST(CameraModel, HeadingsAreDegreesToTheRightAndUpwards) {
    const CameraHeading right = headingOf(Camera::lookAt({}, { 1, 0, -1 }));
    EXPECT_NEAR(right.yawDegrees, 45, 1e-9);
    EXPECT_NEAR(right.pitchDegrees, 0, 1e-9);
    EXPECT_NEAR(headingOf(Camera::lookAt({}, { 0, 1, -1 })).pitchDegrees, 45, 1e-9);
}

TEST(CameraModel, AFilesCameraKeepsTheExposure) {
    Document document;
    document.view.camera.exposure.iso = 1600;
    useCamera(document, { .camera = Camera::lookAt({ 4, 5, 6 }, {}, { .verticalFovDegrees = 20 }) });
    EXPECT_EQ(document.view.camera.position(), double3(4, 5, 6));
    EXPECT_EQ(document.view.camera.lens.verticalFovDegrees, 20);
    EXPECT_EQ(document.view.camera.exposure.iso, 1600);
}

// ---- demand

std::vector<EffectDecision> someDecisions() {
    using enum EffectDecision::State;
    return { { .name = "sun", .state = Needed, .reason = "shines" },
             { .name = "fog", .state = NotNeeded, .reason = "switched off" },
             { .name = "color", .state = Ran, .reason = "is read", .gpuMilliseconds = 4, .attachmentBytes = 100 },
             { .name = "copy", .state = Culled, .reason = "nobody reads it" } };
}

TEST(DemandRows, FiltersByStateAndWords) {
    const std::vector<EffectDecision> all = someDecisions();
    EXPECT_EQ(demandRows(all, {}).size(), 4u);
    EXPECT_EQ(demandRows(all, { .onlyActive = true }).size(), 2u);
    EXPECT_EQ(demandRows(all, { .onlyPasses = true }).size(), 2u);
    EXPECT_EQ(demandRows(all, { .onlyActive = true, .onlyPasses = true })[0]->name, "color");
    EXPECT_EQ(demandRows(all, { .words = "read" }).size(), 2u);
    const DemandTotals totals = totalsOf(all);
    EXPECT_EQ(totals.effects, 2u);
    EXPECT_EQ(totals.needed, 1u);
    EXPECT_EQ(totals.passes, 2u);
    EXPECT_EQ(totals.ran, 1u);
    EXPECT_EQ(totals.milliseconds, 4);
    EXPECT_EQ(totals.attachmentBytes, 100u);
}

// ---- history

FrameTimings timing(uint64_t frame) {
    const double begin = 1 + 0.02 * static_cast<double>(frame);
    return { .frame = frame,
             .prepareMilliseconds = 2,
             .recordMilliseconds = 3,
             .replayMilliseconds = 6,
             .beginSeconds = begin,
             .submitSeconds = begin + 0.005,
             .replayBeginSeconds = begin + 0.006,
             .replayEndSeconds = begin + 0.012,
             .passes = { { "color", 4 }, { "tone map", 1 } } };
}

TEST(FrameHistory, KeepsTheNewestFramesInTheirOrder) {
    FrameHistory history;
    EXPECT_TRUE(history.values(FrameNumber::Draws).empty());
    for (uint32_t i = 0; i < 1000; ++i) {
        history.addStatistics({ .draws = i }, i * 1'000'000ull);
        const std::span<const float> draws = history.values(FrameNumber::Draws);
        ASSERT_EQ(draws.size(), std::min<size_t>(i + 1, FrameHistory::kFrames));
        for (size_t k = 0; k < draws.size(); ++k) ASSERT_EQ(draws[k], static_cast<float>(i + 1 - draws.size() + k));
        ASSERT_EQ(history.latest(FrameNumber::DeviceMegabytes), static_cast<float>(i));
    }
}

TEST(FrameHistory, MeasuresFromFrameToFrame) {
    FrameHistory history;
    for (uint64_t i = 0; i < 20; ++i) {
        const FrameTimings frame = timing(i);
        history.addTimings({ &frame, 1 });
    }
    EXPECT_NEAR(history.latest(FrameNumber::FrameMilliseconds), 20, 1e-3);
    EXPECT_NEAR(history.latest(FrameNumber::LatencyMilliseconds), 12, 1e-3);
    EXPECT_EQ(history.timings().size(), 8u);
    EXPECT_EQ(history.timings().back().frame, 19u);
    EXPECT_EQ(history.latestMilliseconds(), 6) << "the device's passes were not timed as a frame";
    history.clear();
    EXPECT_EQ(history.latestMilliseconds(), 0);
}

TEST(FrameHistory, ATimelineHasABarForEachJobWhereItRan) {
    const std::vector<FrameTimings> frames{ timing(3), timing(4) };
    const Timeline timeline = timelineOf(frames);
    ASSERT_EQ(timeline.bars.size(), 2u * 5);
    const auto bar = [&](uint64_t frame, std::string_view name) {
        return *std::ranges::find_if(timeline.bars,
                                     [&](TimelineBar const& b) { return b.frame == frame && b.name == name; });
    };
    EXPECT_NEAR(bar(3, "prepare").begin, 0, 1e-9);
    EXPECT_NEAR(bar(3, "record").begin, 2, 1e-9);
    EXPECT_NEAR(bar(4, "prepare").begin, 20, 1e-9);
    EXPECT_NEAR(bar(4, "replay").begin, 26, 1e-9);
    EXPECT_NEAR(bar(4, "replay").end, 32, 1e-9);
    EXPECT_NEAR(bar(4, "tone map").begin, 30, 1e-9) << "after the pass before";
    EXPECT_NEAR(timeline.milliseconds, 32, 1e-9);
    EXPECT_TRUE(timelineOf({}).bars.empty());
}

// ---- keys and columns

TEST(Shortcuts, EveryActionHasAKeyOfItsOwn) {
    std::set<std::pair<Key, KeyModifiers>> keys;
    std::set<Action> actions;
    for (Shortcut const& shortcut : shortcuts()) {
        EXPECT_TRUE(keys.insert({ shortcut.key, shortcut.modifiers }).second) << labelOf(shortcut);
        EXPECT_TRUE(actions.insert(shortcut.action).second) << shortcut.help;
        EXPECT_EQ(actionOf(shortcut.key, shortcut.modifiers), shortcut.action);
        EXPECT_FALSE(shortcut.help.empty() || shortcut.section.empty());
    }
    EXPECT_EQ(actions.size(), static_cast<size_t>(Action::Count));
    EXPECT_FALSE(actionOf(Key::Y, KeyModifiers::None));
    EXPECT_EQ(labelOf({ .key = Key::Z, .modifiers = KeyModifiers::ControlShift }), "Ctrl+Shift+Z");
    EXPECT_EQ(labelOf({ .key = Key::F12 }), "F12");
}

TEST(PanelLayout, ColumnsTileTheWindowAndLeaveAThirdFree) {
    for (uint32_t width = 1; width < 4000; width += 7) {
        for (const float scale : { 0.5f, 1.0f, 1.5f, 3.0f }) {
            const PanelLayout layout = layOutPanels({ width, 720 }, scale);
            EXPECT_EQ(layout.left.position.x, 0);
            EXPECT_EQ(layout.left.size.x, layout.picture.position.x);
            EXPECT_EQ(layout.picture.end().x, layout.right.position.x);
            EXPECT_EQ(layout.right.end().x, static_cast<float>(width));
            EXPECT_GE(layout.picture.size.x, std::floor(static_cast<float>(width) / 3));
            for (PanelRect const& column : { layout.left, layout.right })
                EXPECT_TRUE(column.size.x == 0 || column.size.x >= kLeastColumn * scale) << width << ' ' << scale;
        }
    }
    const PanelLayout common = layOutPanels({ 1280, 720 }, 1);
    EXPECT_EQ(common.left.size.x, kLeftColumn);
    EXPECT_EQ(common.right.size.x, kRightColumn);
    EXPECT_EQ(layOutPanels({ 1280, 720 }, 1, false).picture.size, float2(1280, 720));
}

} // namespace
} // namespace filament_core::view
