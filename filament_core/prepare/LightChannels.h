// SPDX-License-Identifier: Apache-2.0
/// LightChannels: which lights of a view shine on which of its draws (<filament_core/Light.h>).
///   How     shaders do not read channels. Draws with equal channels share a light list; where that is not the list
///           of the view, they bind a second copy of its uniforms and are drawn with the variant that their lights
///           select.
///   Demand  if every light shares a channel with every lit draw, as by default, nothing is done: prepareView()
///           compares the channels that all of them have.
///   Shadows dropUnseenLights() runs before maps are fitted: a light that shines on nothing in view has none.
///           separateChannels() runs after that, because a light carries its maps into every list.
///   Bits    lists have the order of the scene. The same for any number of workers.
///   Memory  the arena: for each list that differs, the uniforms, the lights and their froxels; 512 B for all.
///   Fails   std::bad_alloc. Cost: froxels for each list that differs (Froxels.h).
#pragma once

#include "filament_core/prepare/PrepareView.h"

namespace filament_core::prepare {

struct DrawnChannels {
    uint8_t any = 0, inCommon = 0xFF; ///< of the draws that light or shadow reaches
};

DrawnChannels channelsOf(ViewPacket const& view);

/// Removes lights, and the sun, that share no channel with `seen`.
void dropUnseenLights(Arena& arena, scene::Lights const& lights, uint8_t seen, PreparedView& view);

/// Fills in ViewPacket::channels, if PreparedView::hasChannels.
void separateChannels(jobs::JobSystem& jobs, Arena& arena, scene::Lights const& lights, ViewInput const& input,
                      PreparedView& view);

} // namespace filament_core::prepare
