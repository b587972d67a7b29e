// SPDX-License-Identifier: Apache-2.0
/// Renderables: everything that can be drawn, by column; each step of a frame reads only the columns it needs.
///   culling      flags (1 B) of every renderable; bounds (36 B) of those in blocks that a view may see, in order;
///                layers (1 B), unless a view has them all
///   sorting      drawable (4 B) of the visible ones
///   object data  placement (64 B, one cache line) of the visible ones, in draw order
///   The rest (objectBounds) is for edits; frames do not read it.
///   Memory  about 165 B a renderable with its handle, and up to a quarter of that in reserve.
///   Thread  the app thread between frames; read-only while a frame is prepared. place() may run on many threads at
///           once, each with its own indices.
#pragma once

#include "base/math/Box.h"
#include "filament_core/scene/Affine.h"
#include "filament_core/scene/BoundsColumns.h"
#include "filament_core/scene/DenseIndex.h"
#include "filament_core/scene/Drawables.h"
#include "filament_core/scene/Placement.h"
#include "filament_core/scene/RestPlaces.h"
#include "filament_core/scene/RestingBlocks.h"

#include <filament_core/Objects.h>

#include <span>
#include <vector>

namespace filament_core::scene {

enum RenderableFlag : uint8_t {
    kCulled = 1,     ///< may be skipped when its box is out of view
    kMirrored = 2,   ///< transform and bones together turn front faces into back faces
    kNeverDrawn = 4, ///< its geometry is empty, it is in no layer, or it is hidden
    kCollapsed = 8,  ///< the transform collapses it to a point, so there is nothing to draw
    kBonesMirror = 16,
    kCastsNoShadows = 32, ///< set by the user
    kCannotCast = 64,     ///< its material blends, or places it in the view of a camera
    kHidden = 128,        ///< set by the user; then kNeverDrawn, too
};

struct Renderables {
    explicit Renderables(uint16_t owner = 0) : index(owner) {}

    DenseIndex<RenderableObject> index;
    BoundsColumns bounds;
    std::vector<uint8_t> flags;        ///< RenderableFlag
    std::vector<uint8_t> layers;       ///< <filament_core/Objects.h>
    std::vector<uint32_t> drawable;    ///< into `drawables`
    std::vector<uint32_t> deformation; ///< slots of Deformations; empty until something is deformed
    std::vector<Placement> placement;
    std::vector<CenteredBox> objectBounds;
    RestingBlocks blocks;          ///< of positions
    mutable RestPlaces restPlaces; ///< by position; renderers ask for them
    Drawables drawables;

    uint32_t count() const { return index.size(); }
};

struct RenderableInput {
    Geometry geometry{};
    MaterialInstance const* material = nullptr;
    float3 boundsMin{ 0.0f }, boundsMax{ 0.0f };
    double4x4 worldFromObject{ 1.0 };
    bool culled = true;
    uint32_t instanceIndex = 0;          ///< < 2^24
    uint32_t deformation = kNotDeformed; ///< a slot of Deformations
    DeformationKind deformedAs{};        ///< of Drawable
    bool castsShadows = true;
    DrawProperties properties{};
    uint8_t layers = kDefaultLayers;
    DrawOrder place{};
    std::span<const GeometryLevel> levels{}; ///< coarser than `geometry`
};

Renderable add(Renderables& renderables, RenderableInput const& input);
void remove(Renderables& renderables, Renderable renderable);
/// Without memory for it, nothing changes.
void setMaterial(Renderables& renderables, Renderable renderable, MaterialInstance const& material);
void setGeometry(Renderables& renderables, Renderable renderable, Geometry const& geometry,
                 std::span<const GeometryLevel> levels = {});
void setVisible(Renderables& renderables, Renderable renderable, bool isVisible);
void setLightChannels(Renderables& renderables, Renderable renderable, uint8_t channels);
void setDrawOrder(Renderables& renderables, Renderable renderable, DrawOrder place);
/// Those of `select` become what they are in `layers`.
void setLayers(Renderables& renderables, Renderable renderable, uint8_t select, uint8_t layers);

/// The slot in Deformations of the renderable at position `at`, or kNotDeformed.
inline uint32_t deformationAt(Renderables const& renderables, uint32_t at) {
    return renderables.deformation.empty() ? kNotDeformed : renderables.deformation[at];
}

/// Sets the input of the next place(): the box in object space, and whether the bones mirror.
void setObjectBounds(Renderables& renderables, uint32_t at, CenteredBox const& bounds, bool bonesMirror);
/// The transform that place() stored: the linear part as floats.
Affine worldFromObject(Renderables const& renderables, uint32_t at);

/// Once a frame, before it is prepared: RestingBlocks::settle(), and forgets places that no frame can ask for any more.
void settle(Renderables& renderables);

/// Writes everything that depends on the transform: placement, bounds and flags of the renderable at position `at`.
void place(Renderables& renderables, uint32_t at, Affine const& worldFromObject);
/// The last row of `worldFromObject` is taken as 0 0 0 1. If the rest is not finite, a zero scale replaces it, which
/// draws nothing.
void place(Renderables& renderables, uint32_t at, double4x4 const& worldFromObject);

} // namespace filament_core::scene
