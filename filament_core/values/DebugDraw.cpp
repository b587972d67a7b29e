// SPDX-License-Identifier: Apache-2.0
#include <filament_core/DebugDraw.h>

#include "base/Assert.h"
#include "base/math/Elementary.h"

#include <array>
#include <cmath>
#include <numbers>

namespace filament_core {
namespace {

/// Corner i of a box: bits 0, 1, 2 choose the upper end along x, y, z.
double3 cornerOf(Box const& box, uint32_t i) {
    return { i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z };
}

void check(DebugStyle const& style) {
    FILAMENT_ASSERT(style.widthPixels > 0 && style.widthPixels <= 64, "a debug line is up to 64 pixels wide");
}

} // namespace

void DebugDraw::line(double3 fromWorld, double3 toWorld, DebugStyle const& style) {
    check(style);
    mLines.push_back({ fromWorld, toWorld, style, false });
}

void DebugDraw::corners(std::span<const double3, 8> corners, DebugStyle const& style) {
    for (uint32_t i = 0; i < 8; ++i) {
        for (uint32_t axis = 1; axis < 8; axis *= 2) {
            if ((i & axis) == 0) line(corners[i], corners[i | axis], style);
        }
    }
}

void DebugDraw::box(Box const& world, DebugStyle const& style) { box(world, double4x4(1.0), style); }

void DebugDraw::box(Box const& box, double4x4 const& worldFromBox, DebugStyle const& style) {
    if (!(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z)) return;
    std::array<double3, 8> ends;
    for (uint32_t i = 0; i < 8; ++i) ends[i] = double3(worldFromBox * double4(cornerOf(box, i), 1));
    corners(ends, style);
}

void DebugDraw::frustum(Camera const& camera, float aspect, double farMeters, DebugStyle const& style) {
    std::array<double3, 8> ends;
    for (uint32_t i = 0; i < 8; ++i) {
        const double distance = i & 4 ? farMeters : static_cast<double>(camera.lens.nearMeters);
        const double2 corner(i & 1 ? 1 : -1, i & 2 ? -1 : 1); // +y is row 0
        const double3 view = camera.viewFromPicture(corner, distance, static_cast<double>(aspect));
        ends[i] = double3(camera.worldFromView * double4(view, 1));
    }
    corners(ends, style);
}

void DebugDraw::sphere(double3 centerWorld, double radiusMeters, DebugStyle const& style, uint32_t segments) {
    FILAMENT_ASSERT(segments >= 3 && segments <= 256, "a circle of debug lines has 3 to 256 of them");
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](uint32_t i) {
            const double angle = 2 * std::numbers::pi * (i % segments) / segments;
            double3 point(0.0);
            point[(axis + 1) % 3] = elementary::cos(angle), point[(axis + 2) % 3] = elementary::sin(angle);
            return centerWorld + point * radiusMeters;
        };
        for (uint32_t i = 0; i < segments; ++i) line(at(i), at(i + 1), style);
    }
}

void DebugDraw::axes(double4x4 const& worldFromAxes, double lengthMeters, float widthPixels, DebugDepth depth) {
    const double3 origin(worldFromAxes[3]);
    for (int axis = 0; axis < 3; ++axis) {
        float4 color(0.1f, 0.1f, 0.1f, 1);
        color[axis] = 1;
        line(origin, origin + double3(worldFromAxes[axis]) * lengthMeters, { color, widthPixels, depth });
    }
}

void DebugDraw::text(double3 atWorld, std::string_view text, DebugTextStyle const& style) {
    FILAMENT_ASSERT(style.pixels >= 1 && style.pixels <= 16, "a pixel of debug text is 1 to 16 pixels wide");
    mTexts.push_back(
            { atWorld, style, static_cast<uint32_t>(mCharacters.size()), static_cast<uint32_t>(text.size()), false });
    mCharacters += text;
}

void DebugDraw::screenLine(float2 from, float2 to, DebugStyle const& style) {
    check(style);
    mLines.push_back({ double3(double2(from), 0), double3(double2(to), 0), style, true });
}

void DebugDraw::screenBox(float2 from, float2 to, DebugStyle const& style) {
    screenLine(from, { to.x, from.y }, style);
    screenLine({ to.x, from.y }, to, style);
    screenLine(to, { from.x, to.y }, style);
    screenLine({ from.x, to.y }, from, style);
}

void DebugDraw::screenText(float2 at, std::string_view text, DebugTextStyle const& style) {
    this->text(double3(double2(at), 0), text, style);
    mTexts.back().isOnScreen = true;
}

void DebugDraw::clear() {
    mLines.clear();
    mTexts.clear();
    mCharacters.clear();
}

} // namespace filament_core
