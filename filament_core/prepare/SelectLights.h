// SPDX-License-Identifier: Apache-2.0
/// LightSelector: the lights that a view shades with: the brightest sun, which has its place in the uniforms, and a list
/// of the others: further suns, and the punctual lights whose range reaches into the frustum.
///   Thread  the constructor: the thread that owns the arena. select(): any, once; it runs beside culling.
///   Memory  the arena, all in the constructor: 8 B per light, and 64 B per light that can be kept.
///   Out     in the order of the scene.
///   Limits  kMaxPunctualLights; if there are more, those brightest at the camera are kept (ties by order in the
///           scene).
///   Fails   never. Cost: about 15 ns per light, 60 ns if more reach the view than can be kept (they are sorted).
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"

#include <span>

namespace filament::prepare {

class LightSelector {
public:
    LightSelector(Arena& arena, scene::Lights const& lights);

    /// Writes the sun and the light count into `frame`, and the light counts into `counts`; changes nothing else in
    /// them. Returns the lights of the list.
    std::span<const shader::PunctualLight> select(ViewSpace const& space, shader::FrameUniforms& frame,
                                                  ViewCounts& counts) const;

private:
    struct Candidate {
        uint32_t index = 0;
        float importance = 0; ///< luminance-weighted intensity over squared distance
    };

    uint32_t findCandidates(ViewSpace const& space, scene::LightRecord const* sun, ViewCounts& counts) const;

    scene::Lights const& mLights;
    std::span<Candidate> mCandidates;
    std::span<shader::PunctualLight> mChosen;
};

} // namespace filament::prepare
