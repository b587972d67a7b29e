// SPDX-License-Identifier: Apache-2.0
/// ShareCheck: whether the shares of lights and effects add up to a case's picture (--shares on). docs/conformance.md.
///   In      a scene and a view that can be drawn, and the same scene without its lights.
///   Out     what is wrong, and counts. Left out: debug views, and pixels of which a term is not finite.
///   Why     differences add up to the last frame, whatever a term shows. So the first frame, in which all light is
///           dark, is compared with that of a scene that has none.
///   Cost    a frame for each term of the picture and each explained pixel, and one without light.
#pragma once

#include <filament_core/Shares.h>

#include <string>
#include <vector>

namespace filament_core::conformance {

/// Of a case on one API, or of all of them together.
struct ShareTally {
    uint32_t pictures = 0, leftOut = 0, terms = 0, effects = 0;
    uint64_t pixels = 0, notFinite = 0, wrong = 0;
    uint32_t explained = 0;       ///< pixels that explainPixel() took apart
    uint32_t unlit = 0;           ///< pictures whose emission was compared with a scene without light
    uint64_t lightInEmission = 0; ///< pixels of these that have light
    std::string line() const;
    ShareTally& operator+=(ShareTally const& more);
};

struct ShareVerdict {
    ShareTally tally;
    std::vector<std::string> faults;
    uint64_t hash = 0; ///< of all sums: APIs with the same bits have the same
    Image emission{};  ///< the first sum, RGBA16F; empty: debug views have none
};

Result<ShareVerdict> checkShares(Engine& engine, Scene const& scene, View const& view, uint32_t frames);

/// `unlit`: the scene without its lights, probes, grids and indirect light. Models that bring lights of their own are
/// left out.
Result<void> compareEmission(Engine& engine, Scene const& unlit, View const& view, uint32_t frames,
                             ShareVerdict& verdict);

} // namespace filament_core::conformance
