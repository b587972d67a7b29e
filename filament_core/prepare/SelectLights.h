// SPDX-License-Identifier: Apache-2.0
/// LightSelector: the lights that a view shades with: the brightest sun, which has its place in the uniforms, and a
/// list of the others: further suns, and the punctual lights whose range reaches into the frustum.
///   Thread  the constructor: the thread that owns the arena. select(): any, once; it runs beside culling.
///   Memory  the arena, all in the constructor: 8 B per light, and 64 B per light that can be kept.
///   Out     in the order of the scene.
///   Lights on no channel count as switched off.
///   Limits  kMaxPunctualLights; if there are more, those brightest at the camera are kept (ties by order in the
///           scene).
///   Fails   never. Cost: about 15 ns per light, 60 ns if more reach the view than can be kept (they are sorted).
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"

#include <optional>
#include <span>

namespace filament_core::prepare {

struct SelectedLights {
    std::span<const shader::PunctualLight> lights;
    std::span<const uint32_t> records; ///< parallel to `lights`: into Lights::records
    std::optional<uint32_t> sun;       ///< into Lights::records: the one of the uniforms
    uint8_t channelsInCommon = 0xFF;   ///< of all of these
};

class LightSelector {
public:
    LightSelector(Arena& arena, scene::Lights const& lights);

    /// Writes the sun and the light count into `frame`, and the light counts into `counts`; changes nothing else in
    /// them.
    SelectedLights select(ViewSpace const& space, shader::FrameUniforms& frame, ViewCounts& counts) const;

private:
    struct Candidate {
        uint32_t index = 0;
        float importance = 0; ///< luminance-weighted intensity over squared distance
    };

    uint32_t findCandidates(ViewSpace const& space, scene::LightRecord const* sun, ViewCounts& counts) const;

    scene::Lights const& mLights;
    std::span<Candidate> mCandidates;
    std::span<shader::PunctualLight> mChosen;
    std::span<uint32_t> mRecords; // of mChosen
};

} // namespace filament_core::prepare
