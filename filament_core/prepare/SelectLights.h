// SPDX-License-Identifier: Apache-2.0
/// LightSelector: which lights a view shades with: the brightest sun, and the punctual lights whose range reaches into
/// the frustum.
///   Thread  the constructor: whose the arena is. select(): any, once; it runs beside culling.
///   Memory  the arena, all of it in the constructor: 8 B a light and 64 B a light that can be kept.
///   Limits  kMaxPunctualLights; of more, the brightest at the camera are kept (ties by order in the scene).
///   Fails   never. Cost: about 15 ns a light, 60 ns where more reach the view than can be kept (they are sorted).
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"

#include <span>

namespace filament::prepare {

class LightSelector {
public:
    LightSelector(Arena& arena, scene::Lights const& lights);

    /// Writes the sun and the light count into `frame`, and the light counts into `counts`; touches nothing else of
    /// them. Returns the punctual lights.
    std::span<const shader::PunctualLight> select(ViewSpace const& space, shader::FrameUniforms& frame,
                                                  ViewCounts& counts) const;

private:
    struct Candidate {
        uint32_t index = 0;
        float importance = 0; ///< luminance-weighted intensity over squared distance
    };

    uint32_t findCandidates(ViewSpace const& space, ViewCounts& counts) const;

    scene::Lights const& mLights;
    std::span<Candidate> mCandidates;
    std::span<shader::PunctualLight> mChosen;
};

} // namespace filament::prepare
