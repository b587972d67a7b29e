// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Renderables.h"

#include <cmath>
#include <utility>

namespace filament_core::scene {
namespace {

Placement placementOf(Affine const& world, float indexAndOne) {
    Placement placement;
    for (size_t row = 0; row < 3; ++row) placement.rows[row] = float3(world.linearRow(row));
    placement.side = glm::determinant(linearPart(world)) < 0 ? -indexAndOne : indexAndOne;
    placement.translation = world.translation();
    return placement;
}

// Arvo 1990, "Transforming axis-aligned bounding boxes", Graphics Gems; by rows.
float3 worldHalfExtent(Affine const& world, float3 halfExtent) {
    const double3 half(halfExtent);
    return { glm::dot(glm::abs(world.linearRow(0)), half), glm::dot(glm::abs(world.linearRow(1)), half),
             glm::dot(glm::abs(world.linearRow(2)), half) };
}

int castingFlag(MaterialInstance const& instance) {
    Material const& material = *instance.material;
    const shader::VertexDomain domain = material.package.vertexDomain;
    const bool isInWorld = domain == shader::VertexDomain::Object || domain == shader::VertexDomain::World;
    return isInWorld && (!material.isBlended() || material.package.transparentShadow) ? 0 : kCannotCast;
}

/// kNeverDrawn by what the renderable is now.
void updateNeverDrawn(Renderables& renderables, uint32_t at) {
    uint8_t& flags = renderables.flags[at];
    Geometry const& geometry = renderables.drawables[renderables.drawable[at]].geometry;
    const bool isDrawn = geometry.indexCount > 0 && renderables.layers[at] != 0 && !(flags & kHidden);
    flags = static_cast<uint8_t>((flags & ~kNeverDrawn) | (isDrawn ? 0 : kNeverDrawn));
}

DrawOrder checked(DrawOrder place) {
    FILAMENT_ASSERT(place.priority <= DrawOrder::kLastPriority, "a priority is one of 0 to 7");
    return place;
}

bool isPoint(Placement const& placement) {
    return placement.rows[0] == float3(0) && placement.rows[1] == float3(0) && placement.rows[2] == float3(0);
}

/// Everything that depends on the transform.
void write(Renderables& renderables, uint32_t at, Affine const& worldFromObject) {
    CenteredBox const& bounds = renderables.objectBounds[at];
    const Placement placement = placementOf(worldFromObject, std::abs(renderables.placement[at].side));
    renderables.placement[at] = placement;
    renderables.bounds.set(at, transformPoint(worldFromObject, double3(bounds.center)),
                           worldHalfExtent(worldFromObject, bounds.halfExtent));
    const int kept = renderables.flags[at] & ~(kMirrored | kCollapsed);
    const bool mirrored = (placement.side < 0) != ((kept & kBonesMirror) != 0);
    const int changed = (mirrored ? kMirrored : 0) | (isPoint(placement) ? kCollapsed : 0);
    renderables.flags[at] = static_cast<uint8_t>(kept | changed);
}

/// Of the last renderable. A scene without deformations has no such column.
void addDeformation(Renderables& renderables, uint32_t deformation) {
    std::vector<uint32_t>& column = renderables.deformation;
    if (column.empty() && deformation == kNotDeformed) return;
    if (column.empty()) column.resize(renderables.count() - 1, kNotDeformed);
    append(column, deformation);
}

} // namespace

Renderable add(Renderables& renderables, RenderableInput const& input) {
    const uint32_t drawable = renderables.drawables.acquire(
            { input.geometry, input.material, input.deformedAs, input.properties, checked(input.place) }, input.levels);
    const Renderable handle = renderables.index.add();
    const int flags =
            (input.culled ? kCulled : 0) | (input.castsShadows ? 0 : kCastsNoShadows) | castingFlag(*input.material);
    renderables.bounds.add();
    append(renderables.flags, static_cast<uint8_t>(flags));
    append(renderables.layers, input.layers);
    append(renderables.drawable, drawable);
    addDeformation(renderables, input.deformation);
    FILAMENT_ASSERT(input.instanceIndex < 1u << 24, "an instance index is below 2^24, where floats are whole numbers");
    append(renderables.placement, { .side = static_cast<float>(input.instanceIndex + 1) });
    append(renderables.objectBounds, boxFromMinMax(input.boundsMin, input.boundsMax));
    renderables.blocks.add();
    updateNeverDrawn(renderables, renderables.count() - 1);
    write(renderables, renderables.count() - 1, affineFrom(input.worldFromObject));
    return handle;
}

void remove(Renderables& renderables, Renderable renderable) {
    const uint32_t gap = renderables.index.remove(renderable);
    renderables.drawables.release(renderables.drawable[gap]);
    renderables.bounds.remove(gap);
    closeGap(renderables.flags, gap);
    closeGap(renderables.layers, gap);
    closeGap(renderables.drawable, gap);
    if (!renderables.deformation.empty()) closeGap(renderables.deformation, gap);
    closeGap(renderables.placement, gap);
    closeGap(renderables.objectBounds, gap);
    renderables.blocks.remove(gap);
}

namespace {

/// Gives a renderable the drawable that `change` makes of its own.
template <class Change>
void changeDrawable(Renderables& renderables, uint32_t at, Change&& change) {
    uint32_t& drawable = renderables.drawable[at];
    Drawable changed = renderables.drawables[drawable];
    change(changed);
    const uint32_t before = drawable;
    // The new one is acquired before the old one is released: levels of detail that both have stay, and without memory
    // the renderable remains as it was.
    drawable = renderables.drawables.acquire(changed);
    renderables.drawables.release(before);
}

} // namespace

void setMaterial(Renderables& renderables, Renderable renderable, MaterialInstance const& material) {
    const uint32_t at = renderables.index.at(renderable);
    changeDrawable(renderables, at, [&](Drawable& changed) { changed.material = &material; });
    uint8_t& flags = renderables.flags[at];
    flags = static_cast<uint8_t>((flags & ~kCannotCast) | castingFlag(material));
}

void setGeometry(Renderables& renderables, Renderable renderable, Geometry const& geometry,
                 std::span<const GeometryLevel> levels) {
    const uint32_t at = renderables.index.at(renderable);
    uint32_t& drawable = renderables.drawable[at];
    Drawable changed = renderables.drawables[drawable];
    changed.geometry = geometry;
    const uint32_t before = std::exchange(drawable, renderables.drawables.acquire(changed, levels));
    renderables.drawables.release(before);
    updateNeverDrawn(renderables, at);
}

void setVisible(Renderables& renderables, Renderable renderable, bool isVisible) {
    const uint32_t at = renderables.index.at(renderable);
    uint8_t& flags = renderables.flags[at];
    flags = static_cast<uint8_t>((flags & ~kHidden) | (isVisible ? 0 : kHidden));
    updateNeverDrawn(renderables, at);
}

void setLightChannels(Renderables& renderables, Renderable renderable, uint8_t channels) {
    changeDrawable(renderables, renderables.index.at(renderable),
                   [&](Drawable& changed) { changed.properties.lightChannels = channels; });
}

void setDrawOrder(Renderables& renderables, Renderable renderable, DrawOrder place) {
    changeDrawable(renderables, renderables.index.at(renderable),
                   [&](Drawable& changed) { changed.place = checked(place); });
}

void setLayers(Renderables& renderables, Renderable renderable, uint8_t select, uint8_t layers) {
    const uint32_t at = renderables.index.at(renderable);
    uint8_t& own = renderables.layers[at];
    own = static_cast<uint8_t>((own & ~select) | (layers & select));
    updateNeverDrawn(renderables, at);
}

void place(Renderables& renderables, uint32_t at, Affine const& worldFromObject) {
    if (renderables.restPlaces.isAsked() && !renderables.blocks.isMoving(at))
        renderables.restPlaces.save(at, renderables.placement[at]);
    write(renderables, at, worldFromObject);
    renderables.blocks.noteMoved(at);
}

void place(Renderables& renderables, uint32_t at, double4x4 const& worldFromObject) {
    place(renderables, at, affineFrom(worldFromObject));
}

void setObjectBounds(Renderables& renderables, uint32_t at, CenteredBox const& bounds, bool bonesMirror) {
    renderables.objectBounds[at] = bounds;
    const int others = renderables.flags[at] & ~kBonesMirror;
    renderables.flags[at] = static_cast<uint8_t>(others | (bonesMirror ? kBonesMirror : 0));
}

Affine worldFromObject(Renderables const& renderables, uint32_t at) {
    Placement const& placement = renderables.placement[at];
    double4x4 world(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            world[column][row] = static_cast<double>(placement.rows[static_cast<size_t>(row)][column]);
        }
    }
    world[3] = double4(placement.translation, 1);
    return affineFrom(world);
}

void settle(Renderables& renderables) {
    const uint64_t pass = renderables.blocks.pass();
    renderables.blocks.settle(renderables.bounds, renderables.flags);
    if (pass == renderables.blocks.pass() || !renderables.restPlaces.isAsked()) return;
    const std::span<const RestingBlocks::Word> words = renderables.blocks.words();
    for (size_t i = 0; i < words.size(); ++i) renderables.restPlaces.drop(i, words[i].moving());
}

} // namespace filament_core::scene
