// SPDX-License-Identifier: Apache-2.0
/// DebugViews: what each DebugView shows, one row a view. What a frame does for a debug view follows from its row.
///   Thread  any; constant data.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/prepare/SceneDemand.h"

namespace filament_core::prepare {

enum class DebugContent : uint8_t {
    Image,     ///< the image itself: DebugView::None
    Shadows,   ///< shadow maps of the lit image
    Lights,    ///< light lists of the lit image
    Effect,    ///< what an effect computes
    Numbers,   ///< of the lit image
    Material,  ///< values that the code of materials gives
    Depth,     ///< of opaque surfaces
    Count,     ///< of fragments
    Edges,     ///< of triangles
    Objects,   ///< what surfaces belong to: numbers of objects or of their materials (NumberObjects.h)
    Triangles, ///< their numbers
    Coverage,  ///< of pixels by surfaces
};

struct DebugViewRow {
    DebugView view = DebugView::None;
    DebugContent content = DebugContent::Image;
    Effect effect = Effect::Count; ///< of DebugContent::Effect
    bool isLit = true;             ///< surfaces are lit, and the sky is drawn
    /// passes::DebugEffectPass draws it, with a material of its own; otherwise passes::DebugViewPass.
    bool isOfEffectPass = true;
};

DebugViewRow const& rowOf(DebugView view);

/// Which view has the numbers of an Aov; None: that of None.
DebugView debugViewOf(Aov aov);

inline bool isOfEffectPass(DebugView view) { return rowOf(view).isOfEffectPass; }
inline bool countsSurfaces(DebugView view) { return rowOf(view).content == DebugContent::Count; }
inline bool showsDepths(DebugView view) { return rowOf(view).content == DebugContent::Depth; }
inline bool numbersObjects(DebugView view) { return rowOf(view).content == DebugContent::Objects; }
inline bool numbersTriangles(DebugView view) { return rowOf(view).content == DebugContent::Triangles; }
inline bool showsCoverage(DebugView view) { return rowOf(view).content == DebugContent::Coverage; }
/// Whether it draws surfaces' own values, or how often their code runs, instead of light.
inline bool showsMaterials(DebugView view) {
    return rowOf(view).content == DebugContent::Material || showsDepths(view) || countsSurfaces(view) ||
           numbersObjects(view) || numbersTriangles(view) || showsCoverage(view);
}
inline bool showsEdges(DebugView view) { return rowOf(view).content == DebugContent::Edges; }
/// Numbers of motion need no light.
inline bool givesMotion(DebugView view, bool givesNumbers) { return givesNumbers && view == DebugView::Motion; }
inline bool showsLight(DebugView view, bool givesNumbers) {
    return rowOf(view).isLit && !givesMotion(view, givesNumbers);
}

} // namespace filament_core::prepare
