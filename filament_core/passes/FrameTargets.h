// SPDX-License-Identifier: Apache-2.0
/// FrameTargets: the pictures of a frame, the only thing that its passes hand on to each other. Each pass reads what
/// those before it have put here and puts what it makes.
///   Life    names of one graph, valid until its reset().
#pragma once

#include "framegraph/FrameGraph.h"

namespace filament::passes {

struct FrameTargets {
    framegraph::TextureId target;       ///< what the user asked for
    framegraph::TextureId output;       ///< the finished picture: `target` itself, unless the view has a place in it
    framegraph::TextureId shadowDepths; ///< the atlas of shadow maps; none: nothing in view is shadowed
    framegraph::TextureId shadows;      ///< what filters read of it: the same, or its moments
    framegraph::TextureId color;        ///< pre-exposed scene-linear light, one sample a pixel; may be `output` itself
    framegraph::TextureId depth; ///< of the main view; none before the depth prepass, or else the colour pass. That
                                 ///< of the prepass has one sample a pixel, that of the colour pass as many as the view
    framegraph::TextureId solidDepth;   ///< of all that the colour pass drew, one sample a pixel; none: nobody asks
    framegraph::TextureId distances;    ///< of what is opaque along the view, in metres, R32F; none: unread
    framegraph::TextureId occlusion;    ///< as kBindingOcclusion says; none: not needed
    framegraph::TextureId prepassDepth; ///< that of the prepass, also when `depth` is another one; none: not drawn
    framegraph::TextureId motion;       ///< of what moved by itself (MotionPass.h); none: nothing did, or nobody asks
    framegraph::History lastPicture;    ///< the picture of the last frame, and of this one; none: not needed
    framegraph::TextureId spread;       ///< light that bloom scatters, smaller than the picture; none: not needed
    framegraph::TextureId flare;        ///< ghosts and halo of the lens, by blocks of pixels; none: not needed
    framegraph::TextureId historyShare; ///< what is kept of the gathered picture (taa.mat); none: no debug view asks
    framegraph::TextureId histogram;    ///< of luminance (histogram.mat); none: not needed
    framegraph::TextureId exposure;     ///< one texel: stops by which the picture becomes brighter; none: not needed
    framegraph::TextureId triangles;    ///< numbers of those that are seen (debug_edges.mat); none: no debug view asks
    framegraph::TextureId picture;      ///< as kBindingPicture says; none: not needed
};

} // namespace filament::passes
