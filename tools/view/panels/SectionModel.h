// SPDX-License-Identifier: Apache-2.0
/// SectionModel: the first section plane of a view by an axis of the world and a place on it, for the options panel.
///   Thread  any; values.
#pragma once

#include "tools/view/document/Document.h"

#include <array>
#include <cstdint>

namespace filament_core::view {

enum class SectionAxis : uint8_t { None, X, Y, Z, Other };                  ///< Other: a plane of any other direction
inline constexpr std::array kSectionAxes{ "none", "x", "y", "z", "other" }; ///< by SectionAxis

struct AxisPlane {
    SectionAxis axis = SectionAxis::None;
    bool keepsAbove = false; ///< what lies in the axis' direction stays; false: the rest
    double meters = 0;       ///< from the origin, along the axis; [-1e9, 1e9]
    friend bool operator==(AxisPlane const&, AxisPlane const&) = default;
};

AxisPlane axisPlaneOf(double4 const& plane);
/// (0, 0, 0, 0) for SectionAxis::None and Other.
double4 planeOf(AxisPlane const& plane);

/// Sets the first plane of the view. Its model is loaded again, once, if it was loaded so that planes do not cut it.
void setFirstPlane(Document& document, AxisPlane const& plane);

/// The same with another axis: a plane through the middle of what is drawn, which keeps what lies below.
AxisPlane throughMiddle(SectionAxis axis, Box const& bounds);

} // namespace filament_core::view
