// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/SectionModel.h"

namespace filament_core::view {
namespace {

bool isOfWorld(SectionAxis axis) { return axis >= SectionAxis::X && axis <= SectionAxis::Z; }
int componentOf(SectionAxis axis) { return static_cast<int>(axis) - static_cast<int>(SectionAxis::X); }

} // namespace

AxisPlane axisPlaneOf(double4 const& plane) {
    if (!SectionPlanes::isPlane(plane)) return {};
    for (const SectionAxis axis : { SectionAxis::X, SectionAxis::Y, SectionAxis::Z }) {
        double3 others(plane);
        const double along = others[componentOf(axis)];
        others[componentOf(axis)] = 0;
        if (others == double3(0)) return { axis, along > 0, -plane.w / along };
    }
    return { SectionAxis::Other };
}

double4 planeOf(AxisPlane const& plane) {
    if (!isOfWorld(plane.axis)) return double4(0);
    double3 inwards(0), point(0);
    inwards[componentOf(plane.axis)] = plane.keepsAbove ? 1 : -1;
    point[componentOf(plane.axis)] = plane.meters;
    return sectionPlane(point, inwards);
}

void setFirstPlane(Document& document, AxisPlane const& plane) {
    if (plane.axis == SectionAxis::Other) return;
    document.view.section.planes[0] = planeOf(plane);
    if (plane.axis != SectionAxis::None) document.model.options.sectionPlanes = true;
}

AxisPlane throughMiddle(SectionAxis axis, Box const& bounds) {
    if (!isOfWorld(axis)) return { axis };
    return { axis, false, bounds.center()[componentOf(axis)] };
}

} // namespace filament_core::view
