// SPDX-License-Identifier: Apache-2.0
/// ResolutionController: dynamic resolution by the times of finished frames. Renderer has one for views
/// with Resolution::dynamic; a program that times its frames in its own way can use another.
///   How     the median of the last frames of the same size, assumed proportional to their pixels. Beyond the
///           target the scale shrinks to fit; it grows only as far as the headroom stays free.
///           Between the two nothing changes, so noise below the headroom has no effect.
///   Steps   scales are multiples of 1/32 of Resolution::scale, of both axes or (not `uniform`) of the area, so that
///           few sizes of targets exist.
///   Settles within three changes of `history` frames each, once the load is constant: docs/resolution.md.
///   Memory  none but itself.   Thread: one at a time.   Fails: never; times that are no numbers count as none.
#pragma once

#include <filament_core/Effects.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace filament_core {

class ResolutionController {
public:
    struct FrameCost {
        float2 scale; ///< that the frame was drawn with
        double milliseconds = 0;
    };

    /// A frame has finished. Those of another scale than the next frame's do not count. `options` within their ranges.
    void add(Resolution const& options, FrameCost const& cost);
    /// Of the next frame; options.scale, unless they are dynamic.
    float2 scale(Resolution const& options) const;
    /// As large as the options allow, until frames are added.
    void forget() { *this = {}; }

private:
    static constexpr uint32_t kMostFrames = 32; // Resolution::history

    double median(uint32_t count) const;

    uint32_t mStep = 0;  ///< below the largest scale
    uint32_t mCount = 0; ///< of mTimes
    std::array<double, kMostFrames> mTimes{};
};

} // namespace filament_core
