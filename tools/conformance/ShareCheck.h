// SPDX-License-Identifier: Apache-2.0
/// ShareCheck: whether the shares of lights and effects add up to a case's picture (--shares on). docs/conformance.md.
///   In      a scene and a view that can be drawn.
///   Out     what is wrong, and counts. Left out: debug views, and pixels of which a term is not finite.
///   Cost    a frame for each term of the picture and each explained pixel.
#pragma once

#include <filament_core/Shares.h>

#include <string>
#include <vector>

namespace filament_core::conformance {

/// Of a case on one API, or of all of them together.
struct ShareTally {
    uint32_t pictures = 0, leftOut = 0, terms = 0, effects = 0;
    uint64_t pixels = 0, notFinite = 0, wrong = 0;
    uint32_t explained = 0; ///< pixels that explainPixel() took apart
    std::string line() const;
    ShareTally& operator+=(ShareTally const& more);
};

struct ShareVerdict {
    ShareTally tally;
    std::vector<std::string> faults;
    uint64_t hash = 0; ///< of all sums: APIs with the same bits have the same
};

Result<ShareVerdict> checkShares(Engine& engine, Scene const& scene, View const& view, uint32_t frames);

} // namespace filament_core::conformance
