// SPDX-License-Identifier: Apache-2.0
#include <filament/Scene.h>

#include "filament_core/engine/SceneImpl.h"
#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"

#include <filament/Environment.h>

#include <algorithm>
#include <cmath>

namespace filament {
namespace {

using scene::LightRecord;

bool hasAttribute(backend::VertexLayout const& layout, Attribute attribute) {
    const auto attributes = std::span(layout.attributes).first(layout.attributeCount);
    return std::ranges::count(attributes, static_cast<uint8_t>(attribute), &backend::VertexAttribute::location) > 0;
}

uint8_t jointSets(backend::VertexLayout const& layout) {
    FILAMENT_ASSERT(hasAttribute(layout, Attribute::Joints) && hasAttribute(layout, Attribute::Weights),
                    "the vertices of a renderable with a skin have joints and weights");
    return hasAttribute(layout, Attribute::Joints1) && hasAttribute(layout, Attribute::Weights1) ? 2 : 1;
}

scene::Deformation deformationOf(Scene::Impl const& scene, RenderableDesc const& desc) {
    engine::VertexBufferState const& vertices = scene.engine.vertexBuffers.get(desc.vertices);
    scene::Deformation deformation{ .skin = desc.skin, .restBounds = { desc.boundsMin, desc.boundsMax } };
    if (desc.skin) {
        FILAMENT_ASSERT(scene.data.deformations.skin(desc.skin).node == desc.node,
                        "a renderable hangs at the node of its skin");
        deformation.jointSets = jointSets(vertices.layout);
        for (BoneBounds const& bounds : desc.boneBounds) deformation.boneBounds.push_back({ bounds.min, bounds.max });
    }
    if (desc.morphTargets) {
        deformation.morph = &scene.engine.morphTargets.get(desc.morphTargets).targets;
        FILAMENT_ASSERT(deformation.morph->vertexCount == vertices.vertexCount,
                        "morph targets have as many vertices as the vertex buffer that they go with");
        deformation.weights = desc.morphWeights;
        for (float& weight : deformation.weights) weight = std::isfinite(weight) ? weight : 0.0f;
        deformation.weights.resize(deformation.morph->targetCount);
    }
    return deformation;
}

// Floats lose the squares of components above 1.8e19 and below 1e-19; doubles hold those of every float.
float3 unitDirection(float3 direction) {
    const float length = glm::length(direction);
    if (length > 1e-15f && length < 1e18f) return direction / length;
    const double exact = glm::length(double3(direction));
    FILAMENT_ASSERT(exact > 0 && std::isfinite(exact), "a light's direction is finite and not zero");
    return float3(double3(direction) / exact);
}

// Adds a light whose record is in world space, or in the space of its node.
Light addLight(scene::SceneData& data, LightRecord const& record, Node node) {
    const Light light = scene::addLight(data, record);
    if (node) scene::attach(data, light, node);
    return light;
}

} // namespace

Scene::Scene(Engine& engine) : mImpl(new Impl{ engine.impl(), {}, {} }) {}
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() = default;

Renderable Scene::add(RenderableDesc const& desc) {
    Engine::Impl& engine = mImpl->engine;
    engine::VertexBufferState const& vertices = engine.vertexBuffers.get(desc.vertices);
    engine::IndexBufferState const& indices = engine.indexBuffers.get(desc.indices);
    FILAMENT_ASSERT(desc.firstIndex <= indices.indexCount && desc.indexCount <= indices.indexCount - desc.firstIndex,
                    "a renderable's indices lie inside of its index buffer");
    const scene::Geometry geometry{ vertices.handle,
                                    indices.handle,
                                    engine.layouts.intern({ vertices.layout, desc.primitive }),
                                    desc.firstIndex,
                                    desc.indexCount ? desc.indexCount : indices.indexCount - desc.firstIndex,
                                    indices.format };
    FILAMENT_ASSERT(!desc.node || desc.worldFromObject == double4x4(1.0),
                    "a renderable of a node stands where the node stands: its worldFromObject stays the identity");
    const scene::RenderableInput input{ geometry,
                                        &engine.instances.get(desc.material),
                                        desc.boundsMin,
                                        desc.boundsMax,
                                        desc.worldFromObject,
                                        desc.culled,
                                        desc.name,
                                        desc.instanceIndex };
    // Vertices outside object space cannot have bones in it.
    const bool isDeformed = (desc.skin || desc.morphTargets) &&
                            input.material->material->package.vertexDomain == shader::VertexDomain::Object;
    const Renderable renderable = isDeformed ? scene::addDeformed(mImpl->data, input, deformationOf(*mImpl, desc))
                                             : scene::addRenderable(mImpl->data, input);
    if (desc.node) scene::attach(mImpl->data, renderable, desc.node);
    return renderable;
}

Light Scene::add(SunLight const& light, Node node) {
    return addLight(mImpl->data,
                    { .type = LightRecord::Type::Sun,
                      .directionWorld = unitDirection(light.directionWorld),
                      .color = light.color,
                      .intensity = light.illuminance.value },
                    node);
}

Light Scene::add(PointLight const& light, Node node) {
    return addLight(mImpl->data,
                    { .type = LightRecord::Type::Point,
                      .positionWorld = light.positionWorld,
                      .color = light.color,
                      .intensity = light.intensity.value,
                      .rangeMeters = light.rangeMeters },
                    node);
}

Light Scene::add(SpotLight const& light, Node node) {
    FILAMENT_ASSERT(light.innerConeRadians >= 0 && light.innerConeRadians < light.outerConeRadians &&
                            light.outerConeRadians <= 1.5707964f,
                    "a spot has 0 <= inner < outer <= pi/2");
    return addLight(mImpl->data,
                    { .type = LightRecord::Type::Spot,
                      .positionWorld = light.positionWorld,
                      .directionWorld = unitDirection(light.directionWorld),
                      .color = light.color,
                      .intensity = light.intensity.value,
                      .rangeMeters = light.rangeMeters,
                      .innerConeRadians = light.innerConeRadians,
                      .outerConeRadians = light.outerConeRadians },
                    node);
}

Skin Scene::add(SkinDesc const& desc) {
    FILAMENT_ASSERT(desc.joints.size() == desc.jointFromBind.size(), "a skin has one matrix for each of its joints");
    FILAMENT_ASSERT(desc.joints.empty() != (desc.boneCount == 0), "a skin has joints or a number of bones");
    scene::SkinRecord data{ .node = desc.node, .joints = { desc.joints.begin(), desc.joints.end() } };
    for (float4x4 const& matrix : desc.jointFromBind)
        data.jointFromBind.push_back(scene::affineFrom(double4x4(matrix)));
    data.bones.assign(desc.boneCount, scene::boneFrom(scene::kIdentity));
    return scene::addSkin(mImpl->data, std::move(data));
}

void Scene::remove(Skin skin) { scene::removeSkin(mImpl->data, skin); }

void Scene::setBones(Skin skin, std::span<const float4x4> objectFromBind) {
    scene::setBones(mImpl->data, skin, objectFromBind);
}

void Scene::setMorphWeights(Renderable renderable, std::span<const float> weights) {
    scene::setMorphWeights(mImpl->data, renderable, weights);
}

void Scene::remove(Renderable renderable) { scene::removeRenderable(mImpl->data, renderable); }
void Scene::remove(Light light) { scene::removeLight(mImpl->data, light); }

void Scene::setTransform(Renderable renderable, double4x4 const& worldFromObject) {
    scene::setTransform(mImpl->data, renderable, worldFromObject);
}

void Scene::setEnvironment(Environment const& environment, EnvironmentSettings const& settings) {
    setIndirectLight(environment.indirectLight(), settings.illuminance, settings.rotationRadians);
    setSkybox(settings.skybox ? environment.skybox() : Skybox{}, settings.illuminance, settings.rotationRadians);
}

void Scene::setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians) {
    scene::IndirectLightRecord state;
    if (light) state = mImpl->engine.indirectLights.get(light).light;
    state.illuminance = illuminance;
    state.rotationRadians = rotationRadians;
    mImpl->data.indirectLight = state;
}

void Scene::setSkybox(Skybox skybox, Lux illuminance, float rotationRadians) {
    scene::SkyboxRecord state{ .illuminance = illuminance, .rotationRadians = rotationRadians };
    if (skybox) {
        engine::SkyboxState const& made = mImpl->engine.skyboxes.get(skybox);
        state.cube = made.cube;
        state.isRgbm = made.isRgbm;
    }
    mImpl->data.skybox = state;
}

Box Scene::bounds() const { return scene::sceneBounds(mImpl->upToDate()); }
uint32_t Scene::renderableCount() const { return mImpl->data.renderables.count(); }
uint32_t Scene::lightCount() const { return mImpl->data.lights.index.size(); }

} // namespace filament
