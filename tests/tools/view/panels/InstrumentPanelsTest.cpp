// SPDX-License-Identifier: Apache-2.0
// The panels of instruments: clicks on points, defects and threads, and their requests to the program.
#include "tests/tools/view/panels/PanelStage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace filament_core {
namespace {

using test::PanelStage;
using test::pixelsOf;
using view::CostPlot;
using view::JobLanes;
using view::MeasuredSetting;

/// Clicks on a grid of places in the right column; `visit` sees what each click did, and puts everything back.
void clickEverywhere(PanelStage& stage, float step, std::function<void()> const& visit) {
    const view::PanelRect column = stage.panels.layout().right;
    for (float y = column.position.y + 30; y < column.end().y; y += step) {
        for (float x = column.position.x + 6; x < column.end().x - 6; x += step) {
            stage.click({ x, y });
            visit();
        }
    }
}

constexpr std::array<uint8_t, 4> kRed{ 255, 115, 77, 255 };

// ---- costs

CostPlot threePoints(View const& view) {
    CostPlot plot{
        .state = CostPlot::State::Finished, .device = "device", .clock = "device time", .reference = "exact"
    };
    const std::pair<const char*, const char*> changes[] = { { "diffuse", "disney" }, { "fresnel", "exact" } };
    plot.points.push_back({ { "as it is", view.quality, 1 }, 10, 0.02, 1 });
    for (auto const& [name, value] : changes) {
        MeasuredSetting point{ { name, view.quality, 1 }, 10.0 + static_cast<double>(plot.points.size()), 0, 1 };
        EXPECT_TRUE(setOption(point.setting.quality, name, value));
        point.error = 0.02 - 0.005 * static_cast<double>(plot.points.size());
        plot.points.push_back(point);
    }
    return plot;
}

TEST(InstrumentPanels, AClickOnAPointMakesItTheDocumentsSetting) {
    PanelStage stage(Backend::Null);
    stage.panels.inputs.costs = threePoints(stage.document.view);
    stage.open("Costs");
    const view::Document before = stage.document;
    std::vector<size_t> found(3);
    clickEverywhere(stage, 8, [&] {
        for (size_t i = 0; i < 3; ++i)
            found[i] += view::hasSetting(stage.document.view, stage.panels.inputs.costs.points[i].setting);
        view::Document expected = before;
        expected.view.quality = stage.document.view.quality;
        EXPECT_TRUE(stage.document == expected) << "nothing else is changed";
        stage.document = before;
        stage.panels.requests = {};
    });
    EXPECT_GT(found[1], 1u) << "in the plot, and in the list of the best";
    EXPECT_GT(found[2], 1u);
}

TEST(InstrumentPanels, CostsAreMeasuredAndCancelledWhenSomebodyAsks) {
    PanelStage stage(Backend::Null);
    stage.open("Costs");
    EXPECT_FALSE(stage.panels.requests.measuresCosts);
    size_t starts = 0, cancels = 0;
    const auto count = [&] {
        starts += stage.panels.requests.measuresCosts;
        cancels += stage.panels.requests.cancelsCosts;
        stage.panels.requests = {};
    };
    clickEverywhere(stage, 12, count);
    EXPECT_GT(starts, 0u);
    EXPECT_EQ(cancels, 0u);
    stage.panels.inputs.costs.state = CostPlot::State::Measuring;
    starts = 0;
    clickEverywhere(stage, 12, count);
    EXPECT_EQ(starts, 0u);
    EXPECT_GT(cancels, 0u);
}

// ---- defects

TEST(InstrumentPanels, DefectsAreChosenAndRemovedAndMarkedWhileTheyAreThere) {
    PanelStage stage(Backend::Vulkan);
    stage.panels.inputs.defects = { { "roughness", "roughness + 1 %" }, { "lightOff", "one light off" } };
    stage.open("Compare");
    const view::Document before = stage.document;
    const auto choicesFrom = [&](std::string const& defect) { // lines appear while one is there
        std::set<std::string> chosen;
        stage.panels.state.injectedDefect = defect;
        clickEverywhere(stage, 10, [&] {
            chosen.insert(std::exchange(stage.panels.state.injectedDefect, defect));
            stage.panels.requests = {};
        });
        return chosen;
    };
    const std::set<std::string> all{ "", "roughness", "lightOff" };
    EXPECT_EQ(choicesFrom(""), all);
    EXPECT_EQ(choicesFrom("roughness"), all) << "a second click, and a button, remove it";
    EXPECT_TRUE(stage.document == before) << "no part of the document";
    ImGui::GetIO().MousePos = { -1000, -1000 };
    for (const char* defect : { "", "roughness" }) {
        stage.panels.state.injectedDefect = defect;
        for (int i = 0; i < 3; ++i) stage.frame();
        EXPECT_EQ(pixelsOf(stage.read(), kRed) > 0, !std::string(defect).empty());
    }
}

// ---- jobs

JobLanes twoThreads() {
    std::vector<JobTrack> tracks{
        { .name = "app thread", .spans = { { "prepare frame", 1, 2, JobSpan::Kind::Phase, 1 } } },
        { .name = "worker 0",
          .spans = { { "cull", 1.2, 1.8, JobSpan::Kind::StolenJob }, { "nodes", 1.3, 1.4, JobSpan::Kind::Job } } }
    };
    return view::layOutJobs(tracks);
}

TEST(InstrumentPanels, JobsAreAskedForOnlyWhileTheyAreRecordedAndSeen) {
    PanelStage stage(Backend::Null);
    const auto asks = [&](std::string_view panel) {
        stage.open(panel);
        stage.panels.requests = {};
        stage.interfaceFrame();
        return stage.panels.requests.readsJobs;
    };
    EXPECT_FALSE(asks("Timeline")) << "not recorded";
    stage.panels.state.recordsJobs = true;
    EXPECT_TRUE(asks("Timeline"));
    EXPECT_FALSE(asks("Numbers")) << "not seen";
    stage.panels.state.holdsJobs = true;
    EXPECT_FALSE(asks("Timeline")) << "held";
}

TEST(InstrumentPanels, TheWheelLooksCloserAndADragMoves) {
    PanelStage stage(Backend::Null);
    stage.panels.inputs.jobs = twoThreads();
    stage.panels.state.recordsJobs = true;
    stage.open("Timeline");
    const view::PanelRect column = stage.panels.layout().right;
    const view::TimeWindow whole = stage.panels.inputs.jobs.whole;
    ImGuiIO& io = ImGui::GetIO();
    std::optional<view::TimeWindow> closer;
    for (float y = column.position.y + 30; y < column.end().y && !closer; y += 8) {
        io.MousePos = { column.end().x - 60, y };
        stage.interfaceFrame();
        io.MouseWheel = 3;
        stage.interfaceFrame();
        io.MouseWheel = 0;
        closer = stage.panels.state.jobWindow;
    }
    ASSERT_TRUE(closer.has_value());
    EXPECT_NEAR(closer->seconds(), whole.seconds() * 0.512, 1e-6) << "three notches";
    io.MouseDown[0] = true;
    stage.interfaceFrame();
    io.MousePos.x += 40;
    stage.interfaceFrame();
    io.MouseDown[0] = false;
    stage.interfaceFrame();
    EXPECT_LT(stage.panels.state.jobWindow->begin, closer->begin) << "earlier moments come from the left";
    EXPECT_NEAR(stage.panels.state.jobWindow->seconds(), closer->seconds(), 1e-9);
}

} // namespace
} // namespace filament_core
