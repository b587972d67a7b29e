// SPDX-License-Identifier: Apache-2.0
/// ViewCounts: what preparing a view has found and left out. A plain value.
#pragma once

#include <cstdint>

namespace filament_core::prepare {

/// Of one view.
struct ViewCounts {
    uint32_t renderables = 0;
    uint32_t visible = 0;
    uint32_t outOfView = 0;      ///< their box is outside of the frustum
    uint32_t nothingToDraw = 0;  ///< no indices or layers, or a transform that collapses them
    uint32_t inOtherLayers = 0;  ///< of the others: those of layers that the view does not show
    uint32_t tooSmall = 0;       ///< of the others: those that cover no centre of a pixel
    uint32_t occluded = 0;       ///< of the others: opaque ones behind what is drawn (HideOccluded.h)
    uint32_t blendedLeftOut = 0; ///< in view, but the view draws nothing that blends
    uint32_t lights = 0;         ///< punctual lights that reach into the view
    uint32_t areaLights = 0;     ///< of these
    uint32_t lightsOutOfView = 0;
    uint32_t areaLightsLeftOut = 0;     ///< of lightsOutOfView and lightsOverLimit
    uint32_t profiledLights = 0;        ///< of `lights`: those with a profile
    uint32_t profiledLightsLeftOut = 0; ///< of lightsOutOfView and lightsOverLimit
    uint32_t profilesOverLimit = 0;     ///< profiled lights that stay dark: their tables are beyond kMaxProfileWords
    uint32_t imagedLights = 0;          ///< of `lights`: those with an image
    uint32_t imagedLightsLeftOut = 0;   ///< of lightsOutOfView and lightsOverLimit
    uint32_t imagesOverLimit = 0;       ///< lights that stay dark: their images are beyond kMaxImageWords
    uint32_t lightsOfOtherChannels = 0; ///< in view, but on no channel of a lit surface in view; without the sun
    uint32_t lightsOverLimit = 0;       ///< in view, but beyond kMaxPunctualLights: the dimmest
    uint32_t froxels = 0;               ///< cells of the grid; 0: one list for the whole view
    uint32_t froxelEntries = 0;         ///< of all lists
    uint32_t longestFroxel = 0;         ///< lights in one list
    uint32_t fullFroxels = 0;           ///< those that more than kMaxLightsOfFroxel lights may reach
    uint32_t lightsLeftOut = 0;         ///< of full froxels, summed up: the dimmest
    uint32_t suns = 0;
    uint32_t sunsOfOtherChannels = 0;        ///< the brightest, if it is on no channel of a lit surface in view
    uint32_t litDraws = 0, blendedDraws = 0; ///< shaded views: draws whose material is lit; those behind the sky
    uint32_t anyOrderObjects = 0;            ///< that may be composed in any order; 0 if unused
    uint32_t opaqueDraws = 0;                ///< shaded views: those before the sky
    uint32_t opaqueLitDraws = 0;             ///< of these: whose material is lit
    uint32_t refractiveDraws = 0;            ///< refractive: `refractionMode : screenspace`
    uint32_t reflectiveDraws = 0;            ///< reflective: `reflections : screenspace`
    uint32_t stencilDraws = 0;               ///< that test or change stencil values
    uint32_t contactLights = 0;              ///< of the lights in view, the sun among them: those with contact shadows
    uint32_t fadingLevels = 0;               ///< renderables that are drawn by two levels of detail
    uint64_t triangles = 0;
    uint64_t trianglesSaved = 0; ///< by coarser levels of detail of what is in view
};

} // namespace filament_core::prepare
