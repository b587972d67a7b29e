// SPDX-License-Identifier: Apache-2.0
/// FrameSettings: a View resolved once a frame: options within their ranges, the debug view applied, and what follows
/// from several options together. Preparing a frame and its passes read this and nothing else of the View.
///   In      viewInput(): a View, before anything is known of its scene. resolve(): what became of it.
///   Thread  any; pure functions of plain values.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/prepare/ViewCounts.h"
#include "filament_core/prepare/ViewInput.h"

namespace filament_core::prepare {

struct FrameSettings {
    Quality quality{};         ///< without choices that only matter where surfaces are lit, if they are not
    Effects effects{};         ///< within their ranges; those that light surfaces are off where nothing is lit
    DisplaySettings display{}; ///< of View::display
    DebugView debugView = DebugView::None;
    bool givesNumbers = false;       ///< of debugView, in full floats, instead of its colours
    uint2 size{ 1, 1 };              ///< pixels that are drawn
    uint2 shownSize{ 1, 1 };         ///< of the image that is made of them
    uint32_t band = 0;               ///< of `size`, on each side, that the image does not show
    uint8_t samples = 1;             ///< a pixel; 1 for debug views, which read depths, except coverage
    uint32_t maxTextureSize = 16384; ///< ViewInput::maxTextureSize
    float4 clearColor{ 0, 0, 0, 1 };
    std::optional<Viewport> viewport{};
    bool accumulatesFrames =
            false; ///< the image is accumulated over frames (temporal anti-aliasing), if there is anything in it
    bool upscalesOverFrames = false; ///< and accumulation, not a filter, makes it as large as it is shown
    bool fadesLevels = false;        ///< of detail, where the depth prepass may say which pixel shows which
    bool composesAnyOrder = false;   ///< transparent objects, if they may overlap
    bool cullsOccluded = false;      ///< hides opaque objects behind others; debug views show what it leaves out
    bool cullsCasters = false;       ///< hides casters behind others from the lights of shadow maps
    bool cutsSlabs = false;          ///< cutsSlabs() of View::section
    bool cutsSections = false;       ///< View::section has a plane: materials with sections show their back faces, too
    bool lightsFog = false;          ///< lamps and shadows of the sun light the fog, if there are any
    bool tracksMotion = false;       ///< an effect of the image looks at the last one, so that it matters what moved
    float mipBias = 0;               ///< of materials' textures, in levels, at most 0

    uint2 insideSize() const { return size - 2u * band; } ///< pixels of the image that are drawn
    /// Whether accumulation makes the image larger than it is drawn.
    bool isUpscaledOverFrames() const { return upscalesOverFrames && insideSize() != shownSize; }
    /// Whether it matters what moved since the last frame: to an effect of the image, or to a surface that reflects it.
    bool readsMotion(ViewCounts const& counts) const {
        return tracksMotion || (effects.screenSpaceReflections.enabled && counts.reflectiveDraws > 0);
    }
    bool isTranslucent() const { return viewport && viewport->blending == ViewBlending::Translucent; }
};

/// `effects`: those of the view, within their ranges, with the share of its pixels that there is time for. `contents`:
/// see ViewInput.
ViewInput viewInput(View const& view, Effects const& effects, uint64_t contents);

FrameSettings resolve(ViewInput const& main);

/// Whether rays may leave what is kept without a surface, so that caps are found by what is cut off: SlabCaps.h.
bool cutsSlabs(SectionPlanes const& section);

} // namespace filament_core::prepare
