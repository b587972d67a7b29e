// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DebugQuads.h"

#include "filament_core/prepare/DebugFont.h"
#include "filament_core/prepare/ViewConstants.h"

#include <cmath>
#include <optional>

namespace filament_core::prepare {
namespace {

// A line along a surface has nearly the depth of that surface. Brought nearer by this part of its distance, it is not
// hidden where the two are rounded differently.
constexpr double kNearer = 1.0 / 2048;

/// A point on screen: pixels, and its depth.
struct ScreenPoint {
    double2 pixel{ 0.0 };
    double depth = 0;
};

bool isFinite(double3 const& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isFinite(float4 const& v) { return std::isfinite(v.x + v.y + v.z + v.w); }

float4 premultiplied(float4 const& color) { return { float3(color) * color.w, color.w }; }

class QuadWriter {
public:
    QuadWriter(ViewInput const& view, std::span<DebugVertex> vertices)
            : mSpace(makeViewSpace(view)), mSize(view.size),
              mIsOrdinary(view.quality.depthRange == DepthRange::Ordinary), mVertices(vertices) {}

    void line(DebugLine const& line) {
        if (!isFinite(line.from) || !isFinite(line.to) || !isFinite(line.style.color)) return;
        const double margin = static_cast<double>(line.style.widthPixels);
        std::optional<std::pair<ScreenPoint, ScreenPoint>> ends;
        if (line.isOnScreen)
            ends.emplace(ScreenPoint{ double2(line.from) }, ScreenPoint{ double2(line.to) });
        else
            ends = inFront(line.from, line.to);
        if (ends && clipToPicture(ends->first, ends->second, margin)) ribbon(ends->first, ends->second, line.style);
    }

    void text(DebugText const& text, std::string_view characters) {
        if (!isFinite(text.at) || !isFinite(text.style.color) || !isFinite(text.style.background)) return;
        ScreenPoint at{ double2(text.at) };
        if (!text.isOnScreen) {
            const double4 clip = clipOf(text.at);
            if (!isBeforeNear(clip)) return;
            at = screenOf(clip);
        }
        // Strokes of a glyph are whole pixels wide: they are sharp only if glyphs begin at the border of a pixel.
        at.pixel = glm::floor(at.pixel + 0.5);
        const double most = 1e6; // pixels; beyond, nothing is on screen
        if (std::abs(at.pixel.x) > most || std::abs(at.pixel.y) > most) return;
        const double side = text.style.pixels;
        ScreenPoint pen = at;
        for (const char character : characters) {
            if (character == '\n') {
                pen.pixel = { at.pixel.x, pen.pixel.y + kCellHeight * side };
                continue;
            }
            cell(pen, character, text.style);
            pen.pixel.x += kCellWidth * side;
        }
    }

    size_t count() const { return mCount; }

private:
    double4 clipOf(double3 const& world) const {
        return double4x4(mSpace.clipFromWorld) * double4(world - mSpace.cameraWorld, 1);
    }
    /// The near plane is at depth 1, or 0 of the ordinary range.
    double beforeNear(double4 const& clip) const { return mIsOrdinary ? clip.z : clip.w - clip.z; }
    bool isBeforeNear(double4 const& clip) const { return clip.w > 0 && beforeNear(clip) >= 0; }

    /// Nearer by this share of the distance.
    double broughtNearer(double depth) const {
        float4x4 const& view = mSpace.clipFromView; // parallel: depth = m22 z + m32
        if (view[3][3] != 0) return depth + (static_cast<double>(view[3][2]) - depth) * kNearer;
        return mIsOrdinary ? depth - (1 - depth) * kNearer : depth * (1 + kNearer);
    }

    ScreenPoint screenOf(double4 const& clip) const {
        return { (double2(clip) / clip.w + 1.0) * 0.5 * double2(mSize), broughtNearer(clip.z / clip.w) };
    }

    std::optional<std::pair<ScreenPoint, ScreenPoint>> inFront(double3 const& from, double3 const& to) const {
        // The line ends at the near plane before it is divided by w: behind the camera the quotient has the wrong sign.
        double4 a = clipOf(from), b = clipOf(to);
        const double inA = beforeNear(a), inB = beforeNear(b);
        if (!(inA > 0) && !(inB > 0)) return std::nullopt;
        if (inA < 0) a += (b - a) * (inA / (inA - inB));
        if (inB < 0) b += (a - b) * (inB / (inB - inA));
        if (!(a.w > 0) || !(b.w > 0)) return std::nullopt;
        return std::pair(screenOf(a), screenOf(b));
    }

    /// Liang and Barsky 1984, "A New Concept and Method for Line Clipping": false if nothing is left.
    bool clipToPicture(ScreenPoint& a, ScreenPoint& b, double margin) const {
        const double2 along = b.pixel - a.pixel;
        double first = 0, last = 1;
        for (int axis = 0; axis < 2; ++axis) {
            const double low = -margin, high = static_cast<double>(mSize[axis]) + margin;
            if (along[axis] == 0) {
                if (a.pixel[axis] < low || a.pixel[axis] > high) return false;
                continue;
            }
            const double toLow = (low - a.pixel[axis]) / along[axis], toHigh = (high - a.pixel[axis]) / along[axis];
            first = std::max(first, std::min(toLow, toHigh));
            last = std::min(last, std::max(toLow, toHigh));
        }
        if (!(first <= last)) return false;
        const ScreenPoint whole = a;
        const double deeper = b.depth - a.depth;
        a = { whole.pixel + along * first, whole.depth + deeper * first };
        b = { whole.pixel + along * last, whole.depth + deeper * last };
        return true;
    }

    /// A point becomes a square.
    void ribbon(ScreenPoint a, ScreenPoint b, DebugStyle const& style) {
        const double2 along = b.pixel - a.pixel;
        const double length = glm::length(along), half = static_cast<double>(style.widthPixels) / 2;
        const double2 direction = length > 1e-9 ? along / length : double2(1, 0);
        if (!(length > 1e-9)) a.pixel.x -= half, b.pixel.x += half;
        const double2 side = double2(-direction.y, direction.x) * half;
        const float4 color = premultiplied(style.color);
        vertex(a.pixel + side, a.depth, color);
        vertex(a.pixel - side, a.depth, color);
        vertex(b.pixel - side, b.depth, color);
        vertex(b.pixel + side, b.depth, color);
    }

    void cell(ScreenPoint const& pen, char character, DebugTextStyle const& style) {
        const double side = style.pixels;
        if (style.background.w > 0)
            rectangle(pen, { -side, -side }, { kCellWidth * side - side, (kCellHeight - 1) * side },
                      premultiplied(style.background));
        Glyph const& glyph = glyphOf(character);
        for (uint32_t row = 0; row < kGlyphHeight; ++row) {
            for (GlyphRun run = runOf(glyph[row], 0); run.begin < kGlyphWidth; run = runOf(glyph[row], run.end))
                rectangle(pen, double2(run.begin, row) * side, double2(run.end, row + 1) * side,
                          premultiplied(style.color));
        }
    }

    void rectangle(ScreenPoint const& at, double2 from, double2 to, float4 const& color) {
        vertex(at.pixel + from, at.depth, color);
        vertex(at.pixel + double2(to.x, from.y), at.depth, color);
        vertex(at.pixel + to, at.depth, color);
        vertex(at.pixel + double2(from.x, to.y), at.depth, color);
    }

    void vertex(double2 const& pixel, double depth, float4 const& color) {
        const double2 clip = 2.0 * pixel / double2(mSize) - 1.0;
        mVertices[mCount++] = { float3(float2(clip), static_cast<float>(std::clamp(depth, 0.0, 1.0))), color };
    }

    const ViewSpace mSpace;
    const uint2 mSize;
    const bool mIsOrdinary;
    std::span<DebugVertex> mVertices;
    size_t mCount = 0;
};

/// Rectangles of one character, at most.
size_t quadsOf(char character) {
    size_t count = 1;
    for (const uint8_t row : glyphOf(character)) {
        for (GlyphRun run = runOf(row, 0); run.begin < kGlyphWidth; run = runOf(row, run.end)) ++count;
    }
    return count;
}

bool isTested(DebugLine const& line) { return !line.isOnScreen && line.style.depth == DebugDepth::Tested; }
bool isTested(DebugText const& text) { return !text.isOnScreen && text.style.depth == DebugDepth::Tested; }

} // namespace

DebugQuads debugQuads(Arena& arena, DebugDraw const& draw, ViewInput const& view) {
    size_t most = draw.lines().size();
    for (DebugText const& text : draw.texts()) {
        for (const char character : draw.characters(text)) most += quadsOf(character);
    }
    const auto vertices = arena.arrayForOverwrite<DebugVertex>(4 * most);
    QuadWriter writer(view, vertices);
    DebugQuads quads;
    // The tested quads come first, because the pass draws the others over them in a second draw call.
    for (const bool tested : { true, false }) {
        for (DebugLine const& line : draw.lines()) {
            if (isTested(line) == tested) writer.line(line);
        }
        for (DebugText const& text : draw.texts()) {
            if (isTested(text) == tested) writer.text(text, draw.characters(text));
        }
        if (tested) quads.tested = static_cast<uint32_t>(writer.count() / 4);
    }
    quads.vertices = vertices.first(writer.count());
    return quads;
}

} // namespace filament_core::prepare
