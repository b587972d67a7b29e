// SPDX-License-Identifier: Apache-2.0
// The first section plane of the options panel: an axis, a place on it, and the model that it cuts.
#include "tools/view/panels/SectionModel.h"
#include "tests/tools/view/panels/PanelStage.h"

#include <limits>

namespace filament_core::view {
namespace {

TEST(SectionModel, PlanesAreWhatTheirAxesSay) {
    for (const SectionAxis axis : { SectionAxis::X, SectionAxis::Y, SectionAxis::Z })
        for (const bool keepsAbove : { false, true })
            for (const double meters : { -2.5, 0.0, 1e6 }) {
                const AxisPlane plane{ axis, keepsAbove, meters };
                EXPECT_EQ(axisPlaneOf(planeOf(plane)), plane);
                EXPECT_EQ(axisPlaneOf(4.0 * planeOf(plane)), plane) << "directions of any length";
                double3 above(0);
                above[static_cast<int>(axis) - 1] = meters + 1;
                EXPECT_EQ(glm::dot(planeOf(plane), double4(above, 1)) > 0, keepsAbove);
            }
    EXPECT_EQ(axisPlaneOf(double4(0)).axis, SectionAxis::None);
    EXPECT_EQ(axisPlaneOf({ 0, std::numeric_limits<double>::quiet_NaN(), 0, 1 }).axis, SectionAxis::None);
    EXPECT_EQ(axisPlaneOf({ 1, 0, 1e-9, 1 }).axis, SectionAxis::Other);
    EXPECT_EQ(planeOf({}), double4(0));
}

TEST(SectionModel, FirstPlanesCutTheModel) {
    Document document;
    setFirstPlane(document, { SectionAxis::None });
    EXPECT_FALSE(document.model.options.sectionPlanes) << "nothing to load again for";
    const AxisPlane middle = throughMiddle(SectionAxis::Y, Box{ double3(-1, 2, -1), double3(1, 6, 1) });
    EXPECT_EQ(middle, (AxisPlane{ SectionAxis::Y, false, 4 }));
    setFirstPlane(document, middle);
    EXPECT_TRUE(document.model.options.sectionPlanes);
    EXPECT_EQ(document.view.section.planes[0], double4(0, -1, 0, 4));
    setFirstPlane(document, { SectionAxis::Other });
    EXPECT_EQ(document.view.section.planes[0], double4(0, -1, 0, 4)) << "what hands wrote is kept";
    setFirstPlane(document, {});
    EXPECT_FALSE(document.view.section.isUsed());
}

TEST(SectionModel, APlaneOfThePanelCutsThePicture) {
    test::PanelStage panels(Backend::Vulkan, { 640, 400 });
    const AxisPlane plane = throughMiddle(SectionAxis::Y, panels.stage->bounds());
    setFirstPlane(panels.document, plane);
    panels.open("Options");
    panels.frame();
    panels.stage->finishLoading();
    panels.frame();
    EXPECT_EQ(axisPlaneOf(panels.stage->view().section.planes[0]), plane)
            << "a slider that nobody drags changes nothing";
    const auto hit = [&](double y) {
        View view = panels.stage->view();
        view.camera = Camera::lookAt({ 0, y, 3 }, { 0, y, 0 });
        Renderer renderer(panels.stage->engine());
        const auto ticket = renderer.pick(panels.stage->scene(), view, view.size / 2u);
        return static_cast<bool>(renderer.waitPick(ticket).value());
    };
    const double middle = panels.stage->bounds().center().y;
    EXPECT_TRUE(hit(middle - 0.1));
    EXPECT_FALSE(hit(middle + 0.1));
}

} // namespace
} // namespace filament_core::view
