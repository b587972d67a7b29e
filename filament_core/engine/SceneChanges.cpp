// SPDX-License-Identifier: Apache-2.0
// Changes of what a scene has: lights, geometry, bounds, visibility.
#include "filament_core/engine/LightRecords.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/scene/SceneNodes.h"

#include <cmath>

namespace filament_core {

using engine::PublicCall;

namespace {

constexpr const char* kWrongBounds = "the minimum of the bounds is above their maximum, or no number";

scene::MinMax checked(Box const& bounds) {
    if (!glm::all(glm::lessThanEqual(bounds.min, bounds.max))) misused(kWrongBounds);
    return { float3(bounds.min), float3(bounds.max) };
}

/// The deformation of a renderable fits other vertices, too.
void checkDeformation(Engine::Impl const& engine, scene::Deformation const& deformation, VertexBuffer vertices) {
    engine::VertexBufferState const& state = engine.vertexBuffers.get(vertices);
    FILAMENT_ASSERT(!deformation.morph || deformation.morph->vertexCount == state.vertexCount,
                    "morph targets have as many vertices as the vertex buffer that they go with");
    FILAMENT_ASSERT(!deformation.skin || engine::jointSetsOf(state.layout) == deformation.jointSets,
                    "the vertices of a renderable with a skin keep their sets of joints and weights");
}

void checkLevels(GeometryDesc const& desc, uint32_t indexCount) {
    FILAMENT_ASSERT(desc.levels.empty() || desc.primitive == PrimitiveType::Triangles,
                    "levels of detail are made of triangles");
    float last = 0;
    for (GeometryLevel const& level : desc.levels) {
        FILAMENT_ASSERT(level.firstIndex <= indexCount && level.indexCount <= indexCount - level.firstIndex &&
                                level.indexCount > 0,
                        "the indices of a level of detail lie inside of its index buffer");
        FILAMENT_ASSERT(level.errorMeters >= last && std::isfinite(level.errorMeters),
                        "the errors of levels of detail are finite and do not decrease");
        last = level.errorMeters;
    }
}

} // namespace

scene::Geometry Scene::Impl::geometryOf(GeometryDesc const& desc, scene::Material const& material) const {
    engine::VertexBufferState const& vertices = engine.vertexBuffers.get(desc.vertices);
    engine::IndexBufferState const& indices = engine.indexBuffers.get(desc.indices);
    FILAMENT_ASSERT(desc.firstIndex <= indices.indexCount && desc.indexCount <= indices.indexCount - desc.firstIndex,
                    "a renderable's indices lie inside of its index buffer");
    checkLevels(desc, indices.indexCount);
    engine::requireAttributes(material, vertices.layout);
    return { vertices.handle,
             indices.handle,
             engine.layouts.intern({ vertices.layout, desc.primitive }),
             desc.firstIndex,
             desc.indexCount ? desc.indexCount : indices.indexCount - desc.firstIndex,
             indices.format,
             desc.primitive == PrimitiveType::Triangles,
             desc.occluder.get(),
             vertices.streams };
}

scene::MinMax Scene::Impl::boundsOf(GeometryDesc const& desc) const {
    if (desc.bounds) return checked(*desc.bounds);
    scene::MinMax const& bounds = engine.vertexBuffers.get(desc.vertices).bounds;
    return bounds.empty() ? scene::MinMax{ float3(0), float3(0) } : bounds;
}

void Scene::Impl::follow(Renderable renderable, GeometryDesc const& desc) {
    if (renderable.index() >= followed.size() && desc.bounds) return;
    while (renderable.index() >= followed.size()) scene::append(followed, {});
    followed[renderable.index()] = desc.bounds ? FollowedBounds{} : FollowedBounds{ renderable, desc.vertices };
}

void Scene::Impl::followVertices() const {
    for (FollowedBounds const& one : followed) {
        if (!data.renderables.index.contains(one.renderable)) continue; // none, or removed
        engine::VertexBufferState const& state = engine.vertexBuffers.held(one.vertices);
        if (state.boundsVersion > boundsChanges && !state.bounds.empty())
            scene::setBounds(data, one.renderable, state.bounds);
    }
    boundsChanges = engine.boundsChanges;
}

void Scene::set(Light light, LightDesc const& desc) {
    const PublicCall call(mImpl, "Scene::set(Light, LightDesc)");
    scene::setLight(mImpl->changed(), light, engine::recordOf(mImpl->engine, desc));
    engine::updateLightShape(*mImpl, light);
}

void Scene::setGeometry(Renderable renderable, GeometryDesc const& desc) {
    const PublicCall call(mImpl, "Scene::setGeometry(Renderable, GeometryDesc)");
    scene::Renderables& renderables = mImpl->changedUses().renderables;
    const uint32_t at = renderables.index.at(renderable), deformation = scene::deformationAt(renderables, at);
    scene::Drawable const& drawable = renderables.drawables[renderables.drawable[at]];
    if (deformation != scene::kNotDeformed)
        checkDeformation(mImpl->engine, mImpl->data.deformations[deformation], desc.vertices);
    scene::setGeometry(renderables, renderable, mImpl->geometryOf(desc, *drawable.material->material), desc.levels);
    scene::setBounds(mImpl->data, renderable, mImpl->boundsOf(desc));
    mImpl->follow(renderable, desc);
}

void Scene::setBounds(Renderable renderable, Box const& bounds) {
    const PublicCall call(mImpl, "Scene::setBounds(Renderable, Box)");
    scene::setBounds(mImpl->changed(), renderable, checked(bounds));
    mImpl->follow(renderable, { .bounds = bounds });
}

void Scene::setVisible(Renderable renderable, bool isVisible) {
    const PublicCall call(mImpl, "Scene::setVisible(Renderable, bool)");
    scene::setVisible(mImpl->changed().renderables, renderable, isVisible);
}

void Scene::setVisible(Node node, bool isVisible) {
    const PublicCall call(mImpl, "Scene::setVisible(Node, bool)");
    scene::setVisible(mImpl->changed(), node, isVisible);
}

void Scene::setPickable(Node node, PickAim aim, bool isHit) {
    const PublicCall call(mImpl, "Scene::setPickable(Node, PickAim, bool)");
    FILAMENT_ASSERT(aim != PickAim::Anything, "PickAim::Anything hits everything");
    scene::setPickable(mImpl->data, node, aim, isHit);
}

bool Scene::isPickable(Node node, PickAim aim) const {
    const PublicCall call(mImpl, "Scene::isPickable(Node, PickAim)");
    mImpl->data.transforms.slotOf(node); // asserts that it is there
    return scene::isPickable(mImpl->data, node, aim);
}

bool Scene::isVisible(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::isVisible(Renderable)");
    scene::Renderables const& renderables = mImpl->data.renderables;
    return (renderables.flags[renderables.index.at(renderable)] & scene::kHidden) == 0;
}

} // namespace filament_core
