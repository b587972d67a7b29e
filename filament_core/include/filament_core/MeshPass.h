// SPDX-License-Identifier: Apache-2.0
/// Mesh passes of the app: the objects of a scene drawn once more, all with one material of the app, into a render
/// target: masks of chosen objects, thickness, heights, depths of far sides, maps in texture space.
/// Renderer::render(Scene, MeshPass, RenderTarget, View) draws one; docs/own-passes.md explains them.
///   Material  domain surface, shadingModel : unlit, with any blending. Its `outputs` are the colours of the target, in
///             the order of RenderTargetDesc::color, others; without `outputs` it is the one colour that a view would
///             show. Vertex blocks, skins, morph targets and instances work as in views.
///   Objects   those of View::visibleLayers that the camera sees, and those with RenderableDesc::culled off; opaque
///             and masked ones, then those that blend, from back to front. Sky, splats and lines are not drawn.
///   Depth     of the pass alone, empty at its beginning; RenderTargetDesc::depth receives it in metres.
///   Fails     a pass that cannot be drawn is left out; Engine::takeErrors() names the material, the reason and the
///             cure.
#pragma once

#include <filament_core/Objects.h>
#include <filament_core/View.h>

#include <array>

namespace filament_core {

struct MeshPass {
    MaterialInstance material{}; ///< draws every object
    /// What the colours hold before: Clear: `clearColors`. Keep: what was drawn to them, so that passes with other
    /// materials or layers follow each other; `clearColors` where nothing was.
    TargetContents contents = TargetContents::Clear;
    std::array<float4, 4> clearColors{}; ///< of the attachments 0 to 3; finite
    /// False: `material` alone decides where an object is: holes of masked materials are filled, unless `material` is
    /// masked by a texture of its own. True: holes stay open: the depths of opaque and masked objects are drawn first,
    /// with their own materials, and `material` where it meets them. Objects that blend, or whose own vertex block
    /// moves them, are left out then.
    bool keepsHoles = false;
};

} // namespace filament_core
