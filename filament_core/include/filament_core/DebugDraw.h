// SPDX-License-Identifier: Apache-2.0
/// DebugDraw: lines, shapes and text that a program draws over a view to see what it computes. Fill it, give it to
/// View::debugDraw, render, clear it.
///   Space   Functions with `World` shapes take metres of the world and doubles. Those named screen... take pixels of
///           the view, from its left and its top.
///   Colour  as displays take it (sRGB), alpha not multiplied in: drawn after the tone mapper, so exposure and grading
///           do not change it. In targets of light it is written as it is.
///   Lines   are rectangles of constant width on the screen: both APIs draw the same pixels. Ends are cut off squarely.
///   Text    is a font of 5 x 7 pixels in cells of 6 x 9, of the characters 32 to 126; others are drawn as a box. '\n'
///           begins a line. Text in the world has its upper left corner where the point is seen.
///   Fails   std::bad_alloc. What is not finite is not drawn.
///   Memory  72 B a line, 1 B a character; kept by clear().
///   Thread  any one at a time; not while Renderer::render() reads it.
#pragma once

#include <filament_core/Box.h>
#include <filament_core/Camera.h>
#include <filament_core/Math.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

/// Whether items in the world are depth-tested against the scene. Transparent surfaces hide nothing.
enum class DebugDepth : uint8_t { Tested, Through };

struct DebugStyle {
    float4 color{ 1, 1, 1, 1 };
    float widthPixels = 1; ///< of lines, (0, 64]
    DebugDepth depth = DebugDepth::Tested;
};

struct DebugTextStyle {
    float4 color{ 1, 1, 1, 1 };
    float4 background{ 0, 0, 0, 0 }; ///< of the cells
    uint32_t pixels = 1;             ///< a side of each pixel of the font, [1, 16]
    DebugDepth depth = DebugDepth::Through;
};

struct DebugLine {
    double3 from{ 0 }, to{ 0 }; ///< metres of the world, or pixels in xy
    DebugStyle style{};
    bool isOnScreen = false;
};

struct DebugText {
    double3 at{ 0 }; ///< as DebugLine::from
    DebugTextStyle style{};
    uint32_t first = 0, length = 0; ///< of DebugDraw::characters()
    bool isOnScreen = false;
};

class DebugDraw {
public:
    void line(double3 fromWorld, double3 toWorld, DebugStyle const& style = {});
    void box(Box const& world, DebugStyle const& style = {}); ///< nothing, if it is empty
    void box(Box const& box, double4x4 const& worldFromBox, DebugStyle const& style = {});
    /// What a camera sees between its near plane and `farMeters`.
    void frustum(Camera const& camera, float aspect, double farMeters, DebugStyle const& style = {});
    /// Three great circles of `segments` lines each, [3, 256].
    void sphere(double3 centerWorld, double radiusMeters, DebugStyle const& style = {}, uint32_t segments = 32);
    /// x red, y green, z blue.
    void axes(double4x4 const& worldFromAxes, double lengthMeters = 1, float widthPixels = 2,
              DebugDepth depth = DebugDepth::Through);
    void text(double3 atWorld, std::string_view text, DebugTextStyle const& style = {});

    void screenLine(float2 from, float2 to, DebugStyle const& style = {});
    void screenBox(float2 from, float2 to, DebugStyle const& style = {});
    void screenText(float2 at, std::string_view text, DebugTextStyle const& style = {});

    void clear();
    bool empty() const { return mLines.empty() && mTexts.empty(); }

    std::span<const DebugLine> lines() const { return mLines; } ///< in the order in which they are drawn
    std::span<const DebugText> texts() const { return mTexts; } ///< over the lines
    std::string_view characters(DebugText const& text) const {
        return std::string_view(mCharacters).substr(text.first, text.length);
    }

private:
    void corners(std::span<const double3, 8> corners, DebugStyle const& style);

    std::vector<DebugLine> mLines;
    std::vector<DebugText> mTexts;
    std::string mCharacters;
};

} // namespace filament_core
