// SPDX-License-Identifier: Apache-2.0
/// Order-independent transparency, composed over the scene colour: Quality::transparency. ColorPass calls these between
/// what it draws before and after.
///   Weighted  two passes over the surfaces: sums of their light by weight, and how much they cover together. One draw
///             over the scene colour. With several samples a pixel both are drawn with them, and composed once a pixel.
///   Peeled    two passes for each layer but the last: the depth of what is nearest behind the layer before it, then
///             the light of what has that depth, under the layers before it. What is farther than they are is drawn
///             into the scene colour, sorted, by ColorPass; the layers come over it. Layers have one sample a pixel.
///   In        ViewPacket::anyOrder: nothing runs if it is empty.
///   Bits      as of other draws: a surface has the same depth in all of its passes, as in the depth prepass.
///   Cost      docs/transparency.md.
#pragma once

#include "filament_core/passes/PassGroup.h"

namespace filament_core::passes {

/// What is drawn so far, and what surfaces read.
struct TransparencyTargets {
    framegraph::TextureId color;      ///< the scene colour, one sample a pixel
    framegraph::TextureId samples;    ///< what is drawn to; `color` itself, if the view has one sample a pixel
    framegraph::TextureId depth;      ///< with as many samples
    framegraph::TextureId sceneDepth; ///< with one sample a pixel; read by peeling
    PassBlock target;
    PassTextures textures;
};

void addWeightedPasses(framegraph::FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets);

struct PeeledLayers {
    framegraph::TextureId light; ///< of all layers, multiplied by how much they cover, which is its alpha
    framegraph::TextureId depth; ///< of the last of them, where there is one: PassTextures::occlusion of what is beyond
};
/// At least one.
PeeledLayers addPeelPasses(framegraph::FrameGraph& graph, FrameContext const& context,
                           TransparencyTargets const& targets);
/// When what is beyond them is drawn.
void addPeeledOver(framegraph::FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets,
                   PeeledLayers const& layers);

} // namespace filament_core::passes
