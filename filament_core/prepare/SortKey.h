// SPDX-License-Identifier: Apache-2.0
/// SortKey: the drawing order as one number, smaller first. Equal keys keep the order of the scene.
///
///   opaque   63    0
///            55-62 slice      where the renderable's slice of its draw begins, four steps an octave; 0: what changes
///                             stencil values
///            43-54 material   same programs together
///            42    mirrored   same raster state together
///            30-41 instance   same parameters and textures together
///            10-29 drawable   same geometry: makes the draw unique, so that nothing comes between its instances
///             0- 9 depth      front to back inside of the slice, sixteen steps an octave
///   late     63-62 10      drawn after the sky
///            60-61 class      0: opaque without depth writes; 1: refracts what is drawn so far; 2: without depth test
///            41-59 place      of classes 0 and 2, as of blended ones
///            10-40 depth      the same: the nearest object ends on top
///            29-59 depth      of class 1, front to back where they do not see each other, because they leave depth
///             0    alone      of class 1: a draw call of its own, because those behind it may be seen through it
///   blended  63-62 11
///            43-61 place      priority (3 bits) and blend order (16 bits) of the renderable: DrawOrder
///            41-42 composed   with Quality::transparency: 0: behind all that is composed in any order, 1: that, 2: the
///                             rest; otherwise 0
///            10-40 depth      of the renderable, every bit, inverted: back to front
///
/// A draw is what instances can share: geometry, material instance and side. Its renderables are cut into slices by
/// depth, and the slices of all draws are sorted front to back. A slice is as thin as a quarter of an octave if a draw
/// has many renderables, and as thick as the whole draw if it has few: a draw call of its own pays for about
/// kSliceMembers or more. So n copies of one mesh take ceil(n / window) draw calls, a few copies take one, and near
/// objects hide far ones. If every mesh exists once, the order is front to back by quarters of an octave, and by state
/// within one. bench/filament_core/prepare/DrawOrderBench.cpp counts draws and overdraw and compares other orders.
///
///   Depth   along the view direction, from 2^-16 m to 2^48 m; values outside that range (including behind the camera
///           and NaN) count as its ends. Blended: from 0 on.
#pragma once

#include "filament_core/scene/Drawables.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace filament_core::prepare {

/// A visible renderable and its position in the drawing order.
struct SortItem {
    uint64_t key = 0; ///< from culling until writeKeys(): the bits of its depth
    uint32_t renderable = 0;
    uint32_t draw = 0; ///< drawable << 1 | mirrored, LevelFade, kDrawnTwice: equal draws can be instances of one call
};
static_assert(sizeof(SortItem) == 16, "sorting moves four of them a cache line");

inline constexpr uint64_t kLateKey = 1ull << 63;                  ///< from here on: drawn after the sky
inline constexpr uint64_t kPictureEndKey = kLateKey | 1ull << 60; ///< from here on: not in the copy of the scene colour
inline constexpr uint64_t kRefractingEndKey =
        kLateKey | 2ull << 60; ///< from here on: neither in the copy, nor opaque and refractive
inline constexpr uint64_t kBlendedKey = 3ull << 62;

/// Set by writeKeys(): the two passes of an object follow each other, so that it shares no draw call.
inline constexpr uint32_t kDrawnTwice = 1u << 31;

/// How far a level of detail has faded into another (ChooseLevels.h), of kFadeFrames: that of the level that appears;
/// negative: of the one that vanishes; 0: none does.
using LevelFade = int8_t;
inline constexpr uint32_t kFadeFrames = 32;
inline constexpr uint32_t kFadeShift = 21, kFadeStepMask = (kFadeFrames - 1) << kFadeShift,
                          kFadeVanishes = kFadeFrames << kFadeShift, kFadeMask = kFadeStepMask | kFadeVanishes;

constexpr uint32_t drawOf(uint32_t drawable, bool mirrored) { return drawable << 1 | (mirrored ? 1 : 0); }
constexpr uint32_t withoutFade(uint32_t draw) { return draw & ~kFadeMask; }
constexpr uint32_t drawableOf(uint32_t draw) { return (withoutFade(draw) & ~kDrawnTwice) >> 1; }
constexpr bool isDrawnTwice(uint32_t draw) { return (draw & kDrawnTwice) != 0; }
constexpr uint32_t fadeBits(LevelFade fade) {
    return fade < 0 ? kFadeVanishes | static_cast<uint32_t>(-fade) << kFadeShift
                    : static_cast<uint32_t>(fade) << kFadeShift;
}
constexpr LevelFade fadeOf(uint32_t draw) {
    const auto step = static_cast<int>((draw & kFadeStepMask) >> kFadeShift);
    return static_cast<LevelFade>((draw & kFadeVanishes) != 0 ? -step : step);
}
constexpr bool isMirrored(uint32_t draw) { return (draw & 1) != 0; }

/// The bits of a non-negative float grow with its value; everything else, NaN included, counts as 0.
constexpr uint32_t depthBits(float depth) { return std::bit_cast<uint32_t>(depth > 0 ? depth : 0.0f); }

/// Ten bits: exponent and four bits of mantissa, counted from 2^-16.
constexpr uint32_t depthStep(uint32_t bits) {
    constexpr int32_t kFirst = (127 - 16) << 4;
    return static_cast<uint32_t>(std::clamp(static_cast<int32_t>(bits >> 19) - kFirst, 0, 1023));
}

/// Eight bits: four steps an octave. Slices begin and end at these.
constexpr uint32_t coarseStep(uint32_t bits) { return depthStep(bits) >> 2; }

/// The coarse steps between which the visible renderables of a draw lie.
struct DepthSpan {
    uint32_t nearest = 0, farthest = 0;
};

/// Members of a slice, at least, on the average over a draw. A power of two.
inline constexpr uint32_t kSliceMembers = 8;

/// The first step of the slice that holds `step`. Slices are a power of two of steps wide, as narrow as `members`
/// (about as many as are visible) can fill.
constexpr uint32_t sliceStart(DepthSpan span, uint32_t members, uint32_t step) {
    const auto bits = [](uint32_t value) { return static_cast<int>(std::bit_width(value)); };
    const int width = std::clamp(bits(span.farthest - span.nearest) + bits(kSliceMembers) - bits(members), 0, 8);
    return span.nearest + ((step - span.nearest) >> width << width);
}

/// Of opaqueKey(): all that changes stencil values, before the first slice of the others.
inline constexpr uint32_t kStencilSlice = 0, kFirstSlice = 1;

inline constexpr uint32_t kDrawableKeyShift = 10;
inline constexpr uint64_t kDrawableKeyMask = uint64_t{ 0xF'FFFF } << kDrawableKeyShift;

/// `order`: of the draw's drawable (scene::Drawables::Use).
constexpr uint64_t opaqueKey(uint32_t order, uint32_t draw, uint32_t slice, uint32_t depth) {
    using scene::Drawables;
    const uint64_t material = order >> Drawables::kInstanceBits & ((1u << Drawables::kMaterialBits) - 1);
    const uint64_t instance = order & ((1u << Drawables::kInstanceBits) - 1);
    return static_cast<uint64_t>(slice) << 55 | material << 43 | static_cast<uint64_t>(isMirrored(draw)) << 42 |
           instance << 30 | static_cast<uint64_t>(drawableOf(draw)) << kDrawableKeyShift | depthStep(depth);
}

/// `depth`: depthBits(), whose highest bit is 0.
constexpr uint64_t backToFront(uint32_t depth) { return uint64_t{ ~depth & 0x7FFF'FFFFu } << 10; }

/// When Quality::transparency draws transparent objects.
enum class Composed : uint8_t { Behind, InAnyOrder, InOrder };

inline constexpr uint32_t kDefaultPlace = scene::placeOrder({});

/// `place`: scene::placeOrder().
constexpr uint64_t blendedKey(uint32_t depth, uint32_t place = kDefaultPlace, Composed composed = Composed::Behind) {
    return kBlendedKey | uint64_t{ place } << 43 | static_cast<uint64_t>(composed) << 41 | backToFront(depth);
}

/// From here on, up to the end: composed in any order.
inline constexpr uint64_t kAnyOrderKey = kBlendedKey | uint64_t{ kDefaultPlace } << 43 | 1ull << 41;
inline constexpr uint64_t kAnyOrderEndKey = kAnyOrderKey + (1ull << 41);

/// Opaque objects that have to be drawn after the sky.
constexpr uint64_t lateKey(uint32_t depth, bool onTop, uint32_t place = kDefaultPlace) {
    return kLateKey | static_cast<uint64_t>(onTop) << 61 | uint64_t{ place } << 41 | backToFront(depth);
}

/// Opaque objects that refract the scene colour.
constexpr uint64_t refractingKey(uint32_t depth) { return kPictureEndKey | static_cast<uint64_t>(depth) << 29; }

/// The same, back to front: it may show others of its kind.
constexpr uint64_t layeredKey(uint32_t depth) { return refractingKey(~depth & 0x7FFF'FFFFu) | 1; }
constexpr bool isLayered(uint64_t key) { return key >> 60 == kPictureEndKey >> 60 && (key & 1) != 0; }

} // namespace filament_core::prepare
