// SPDX-License-Identifier: Apache-2.0
/// FrameTargets: the textures of a frame, the only thing that its passes hand on to each other. Each pass reads what
/// those before it have put here and puts what it makes.
///   Life    names of one graph, valid until its reset().
#pragma once

#include "framegraph/FrameGraph.h"

namespace filament_core::passes {

struct FrameTargets {
    framegraph::TextureId target;       ///< what the user asked for
    framegraph::TextureId output;       ///< the finished image: `target` itself, unless the view has a place in it
    framegraph::TextureId shadowDepths; ///< the atlas of shadow maps; null: nothing in view is shadowed
    framegraph::TextureId shadows;      ///< what filters read of it: the same, or its moments
    framegraph::TextureId color;        ///< pre-exposed scene-linear light, one sample a pixel; may be `output` itself
    framegraph::TextureId depth; ///< of the main view; null before the depth prepass, or else the colour pass. That
                                 ///< of the prepass has one sample a pixel, that of the colour pass as many as the view
    framegraph::TextureId sceneDepth;       ///< resolved single-sample depth after the colour pass; null if unused
    framegraph::TextureId linearDepth;      ///< of opaque surfaces along the view, in metres, R32F; null if unused
    framegraph::TextureId ambientOcclusion; ///< as kBindingOcclusion says; null if unused
    framegraph::TextureId prepassDepth;     ///< that of the prepass, also when `depth` is another one; null: not drawn
    framegraph::TextureId sectionDepth;     ///< `prepassDepth`, where it has the depths of caps (SectionDepthPass.h)
    framegraph::TextureId motionVectors;    ///< of what moved by itself (MotionPass.h); null: nothing did, or unused
    framegraph::History sceneColorHistory;  ///< `color` of the last frame, and of this one; null if unused
    framegraph::TextureId bloom;            ///< light that bloom scatters, smaller than the image; null if unused
    framegraph::TextureId flare;            ///< ghosts and halo of the lens, by blocks of pixels; null if unused
    framegraph::TextureId historyWeight;    ///< weight of the history (taa.mat), for its debug view
    framegraph::TextureId histogram;        ///< of luminance (histogram.mat); null if unused
    framegraph::TextureId exposure;         ///< one texel: stops by which the image becomes brighter; null if unused
    framegraph::TextureId triangles;        ///< numbers of visible triangles (debug_edges.mat), for their debug view
    framegraph::BufferId fogCells;          ///< FogCells of ShaderInterface.h; null if unused
    framegraph::TextureId sceneColor;       ///< as kBindingPicture says; null if unused
    framegraph::TextureId appDistances;     ///< `depth` and `normals` of AppPass.h; null until one reads them
    framegraph::TextureId appNormals;
};

} // namespace filament_core::passes
