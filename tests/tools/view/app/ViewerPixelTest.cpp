// SPDX-License-Identifier: Apache-2.0
// Numbers of the image in the viewer: the pixel panel has the values of both APIs, and the numerics view counts its
// marks.
#include "tests/tools/view/app/HeadlessViewer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace filament_core::view {
namespace {

using testing::HasSubstr;

class ViewerPixelTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, ViewerPixelTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& tested) { return std::string(toString(tested.param)); });

struct PixelViewer : Headless {
    explicit PixelViewer(Backend backend) : Headless(backend) {
        if (!viewer) return;
        viewer->handle(ResizeEvent{ { 1000 + static_cast<uint32_t>(kLeftColumn + kRightColumn), 400 }, 1 });
        settle();
        viewer->panels().state.opensPanel = "Pixel";
        viewer->redraw();
    }
    /// Of the image, which has 1000 x 400 of them.
    PixelReport const& at(float2 pixel) {
        viewer->handle(MouseMoveEvent{ pixel + viewer->panels().layout().picture.position });
        settle();
        return viewer->inspector().report();
    }
};

PixelRow const& row(PixelReport const& report, std::string const& name) {
    for (PixelRow const& each : report.rows)
        if (each.name == name) return each;
    static const PixelRow kNone;
    ADD_FAILURE() << "no row " << name;
    return kNone;
}

std::string codesOf(Image const& image, uint2 at) {
    auto const* code = image.pixels.data() + (size_t{ at.y } * image.width + at.x) * 4;
    return fmt::format("{}, {}, {}, {}", static_cast<int>(code[0]), static_cast<int>(code[1]),
                       static_cast<int>(code[2]), static_cast<int>(code[3]));
}

TEST_P(ViewerPixelTest, ThePixelPanelHasTheValuesOfBothApis) {
    PixelViewer headless(GetParam());
    if (!headless.viewer) return;
    const float2 place(500, 220);
    PixelReport const& report = headless.at(place);
    ASSERT_TRUE(report.isComplete);
    EXPECT_EQ(report.pixel, uint2(place));
    EXPECT_THAT(report.engines[0], HasSubstr(toString(GetParam())));
    EXPECT_NE(report.engines[0], report.engines[1]);
    EXPECT_EQ(report.differing(), 0u);
    EXPECT_GT(report.rows.size(), 6u) << "attachments, too";
    const Image shown = headless.viewer->stage().renderToImage().value();
    EXPECT_EQ(row(report, "displayed").values[0], codesOf(shown, uint2(place)));
    EXPECT_EQ(row(report, "displayed").values[1], codesOf(shown, uint2(place)));
    EXPECT_THAT(row(report, "object").values[0], HasSubstr("node "));
    EXPECT_NE(row(report, "normal").values[0], "-");
    const std::string first = row(report, "position").values[0];
    EXPECT_NE(first, row(headless.at({ 470, 200 }), "position").values[0]) << "it follows the pointer";
    if (const char* folder = std::getenv("FILAMENT_VIEW_PICTURES")) {
        EXPECT_TRUE(savePng(std::filesystem::path(folder) / fmt::format("pixel {}.png", toString(GetParam())),
                            headless.picture()));
    }
    EXPECT_EQ(row(headless.at({ 340, 4 }), "object").values[0], "-") << "nothing is there";
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerPixelTest, ALockedPixelStaysAndFollowsTheDocument) {
    PixelViewer headless(GetParam());
    if (!headless.viewer) return;
    headless.at({ 500, 220 });
    headless.press('L');
    PixelReport const& report = headless.at({ 470, 180 });
    EXPECT_TRUE(report.isLocked);
    EXPECT_EQ(report.pixel, uint2(500, 220));
    const std::string before = row(report, "displayed").values[1];
    headless.viewer->document().view.clearColor = { 0.5f, 0.25f, 0.1f, 1 };
    headless.viewer->document().environment.settings.illuminance.value *= 0.25f;
    headless.viewer->redraw();
    headless.settle();
    EXPECT_NE(row(report, "displayed").values[1], before);
    EXPECT_EQ(report.differing(), 0u);
    headless.press('L');
    EXPECT_EQ(headless.at({ 470, 180 }).pixel, uint2(470, 180));
}

TEST_P(ViewerPixelTest, ALockedPixelIsExplainedByTermsThatAddUp) {
    PixelViewer headless(GetParam());
    if (!headless.viewer) return;
    headless.at({ 500, 220 });
    headless.viewer->panels().requests.togglesPixelExplanation = true;
    headless.viewer->redraw();
    headless.settle();
    PixelReport const& report = headless.viewer->inspector().report();
    const auto ofLight = [&] {
        return std::ranges::count(report.rows, "light, before the tone mapper", &PixelRow::group);
    };
    EXPECT_EQ(ofLight(), 0) << "it may move";
    headless.press('L');
    headless.settle();
    ASSERT_TRUE(report.isComplete);
    EXPECT_GE(ofLight(), 3);
    EXPECT_EQ(report.differing(), 0u);
    EXPECT_NE(row(report, "object id").values[0], "-");
    EXPECT_NE(row(report, "triangle id").values[1], "-");
    double sum = 0, whole = 0; // of red, in six digits
    for (PixelRow const& each : report.rows)
        if (each.group == "light, before the tone mapper")
            (each.name == "sum" ? whole : sum) += std::stod(each.values[0]);
    EXPECT_NEAR(sum, whole, 1e-4 * std::abs(whole) + 1e-5);
    if (const char* folder = std::getenv("FILAMENT_VIEW_PICTURES")) {
        EXPECT_TRUE(savePng(std::filesystem::path(folder) / fmt::format("explained {}.png", toString(GetParam())),
                            headless.picture()));
    }
    headless.viewer->panels().requests.togglesPixelExplanation = true;
    headless.viewer->redraw();
    headless.settle();
    EXPECT_EQ(ofLight(), 0);
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerPixelTest, WithoutItsPanelNothingIsInspected) {
    PixelViewer headless(GetParam());
    if (!headless.viewer) return;
    headless.at({ 500, 220 });
    EXPECT_FALSE(headless.viewer->inspector().report().rows.empty());
    headless.viewer->panels().state.opensPanel = "Log";
    headless.viewer->redraw();
    headless.settle();
    EXPECT_TRUE(headless.viewer->inspector().report().rows.empty()) << "and its engines are gone";
}

TEST_P(ViewerPixelTest, TheNumericsViewCountsItsMarks) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.viewer->panels().state.showsPanels = false;
    headless.settle();
    EXPECT_FALSE(headless.viewer->numerics().counts().has_value());
    headless.viewer->document().view.debugView = DebugView::Numerics;
    for (const float exposure : { 1.0f, 16.0f }) { // the longer, the more of it is clipped
        headless.viewer->document().view.camera.exposure.iso = 100 * exposure;
        headless.viewer->redraw();
        headless.settle();
        ASSERT_TRUE(headless.viewer->numerics().counts().has_value());
        const Image marked = headless.viewer->stage().renderToImage().value();
        EXPECT_EQ(*headless.viewer->numerics().counts(), countNumerics(marked.pixels)) << exposure;
        uint64_t all = 0;
        for (const uint64_t pixels : *headless.viewer->numerics().counts()) all += pixels;
        EXPECT_EQ(all, uint64_t{ kSmallPicture.x } * kSmallPicture.y);
    }
    EXPECT_GT((*headless.viewer->numerics().counts())[static_cast<size_t>(NumericsMark::Clipped)], 0u);
    if (const char* folder = std::getenv("FILAMENT_VIEW_PICTURES")) {
        EXPECT_TRUE(savePng(std::filesystem::path(folder) / fmt::format("numerics {}.png", toString(GetParam())),
                            headless.picture()));
    }
    headless.viewer->document().view.debugView = DebugView::None;
    headless.viewer->redraw();
    headless.settle();
    EXPECT_FALSE(headless.viewer->numerics().counts().has_value());
}

/// The renderer with a pending read and pick ends then.
TEST(ViewerPixels, AFrameMayBeSavedWhilePixelsAreOnTheirWay) {
    Headless headless(Backend::Vulkan);
    if (!headless.viewer) return;
    headless.settle();
    headless.viewer->document().view.debugView = DebugView::Numerics;
    headless.viewer->perform(Action::Compare);
    headless.click({ 320, 200 });
    EXPECT_TRUE(headless.stepUntil([&] { return headless.viewer->numerics().isWaiting(); }));
    headless.viewer->perform(Action::SaveFrame);
    headless.settle();
    EXPECT_THAT(headless.viewer->takeMessages(), testing::Contains(HasSubstr("filament-replay draws it again")));
    EXPECT_EQ(headless.viewer->compared().result()->percentage(), "100.0000 %");
    EXPECT_TRUE(headless.viewer->numerics().counts().has_value());
}

} // namespace
} // namespace filament_core::view
