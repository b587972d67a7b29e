// SPDX-License-Identifier: Apache-2.0
#include <filament/Scene.h>

#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"

#include <filament/Environment.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament {
namespace {

using engine::PublicCall;
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

constexpr float kWidestSunDegrees = 20, kWidestHalo = 1000, kSteepestHalo = 10'000,
                kLargestFloat = std::numeric_limits<float>::max();

// Negative values and NaN become 0.
float clampedOr0(float value, float most) { return value > 0 ? std::min(value, most) : 0.0f; }

void checkLight(LinearColor color, float rangeMeters, double3 const& positionWorld) {
    const auto isFinite = [](auto const& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    FILAMENT_ASSERT(isFinite(color) && color.x >= 0 && color.y >= 0 && color.z >= 0,
                    "a light's color is finite and >= 0");
    FILAMENT_ASSERT(rangeMeters >= 0 && std::isfinite(rangeMeters), "a light's range is finite and >= 0");
    FILAMENT_ASSERT(isFinite(positionWorld), "a light's position is finite");
}

// Across a direction, nearest to `side`; any if that is along the direction or not finite. All unit but `side`.
float3 acrossDirection(float3 direction, float3 side) {
    const double3 axis(direction), other = std::abs(direction.x) < 0.7f ? double3(1, 0, 0) : double3(0, 1, 0);
    const double length = glm::length(double3(side));
    const double3 wanted = length > 0 && std::isfinite(length) ? double3(side) / length : other;
    const double3 across = wanted - axis * glm::dot(wanted, axis);
    if (glm::dot(across, across) > 1e-12) return float3(glm::normalize(across));
    return float3(glm::normalize(other - axis * glm::dot(other, axis)));
}

/// To a record that has a direction; `up` as of PointLight::upWorld.
void setProfile(Engine::Impl const& engine, LightProfile profile, float3 up, LightRecord& record) {
    record.sideWorld = glm::cross(record.directionWorld, acrossDirection(record.directionWorld, up));
    record.profile = engine.lightProfiles.get(profile).words;
}

/// What the areas have in common; the record lacks its shape.
template <class AreaLight>
LightRecord areaRecord(LightRecord::Type type, AreaLight const& light) {
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    const float nits = light.luminance.value;
    return { .type = type,
             .positionWorld = light.positionWorld,
             .color = light.color,
             .intensity = nits > 0 && std::isfinite(nits) ? nits : 0.0f,
             .rangeMeters = light.rangeMeters,
             .castsShadows = light.castsShadows,
             .channels = light.lightChannels };
}

float2 halfExtentOf(float x, float y) {
    FILAMENT_ASSERT(x >= 0 && y >= 0 && std::isfinite(x) && std::isfinite(y),
                    "the sizes of a light are finite and not negative");
    return { x, y };
}

/// Its shadows are as soft as those of a disc that shows as many square metres.
void setExtent(LightRecord& record, float2 halfExtent) {
    const double square = double{ halfExtent.x } * double{ halfExtent.y };
    const double area = record.type == LightRecord::Type::Disc ? std::numbers::pi * square : 4 * square;
    record.halfExtent = halfExtent;
    record.sourceRadius = static_cast<float>(std::sqrt(area / std::numbers::pi));
}

// Adds a light whose record is in world space, or in the space of its node.
Light addLight(scene::SceneData& data, LightRecord const& record, Node node) {
    const Light light = scene::addLight(data, record);
    if (node) scene::attach(data, light, node);
    return light;
}

} // namespace

Scene::Scene(Engine& engine) : mImpl(std::make_shared<Impl>(engine)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() {
    if (mImpl && mImpl->link.isAlive()) const PublicCall call(mImpl, "Scene::~Scene()");
}

Renderable Scene::add(RenderableDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(RenderableDesc)", desc.name);
    FILAMENT_ASSERT(!desc.node || desc.worldFromObject == double4x4(1.0),
                    "a renderable of a node stands where the node stands: its worldFromObject stays the identity");
    Engine::Impl& engine = mImpl->engine;
    engine::VertexBufferState const& vertices = engine.vertexBuffers.get(desc.vertices);
    engine::IndexBufferState const& indices = engine.indexBuffers.get(desc.indices);
    FILAMENT_ASSERT(desc.firstIndex <= indices.indexCount && desc.indexCount <= indices.indexCount - desc.firstIndex,
                    "a renderable's indices lie inside of its index buffer");
    scene::MaterialInstance const& material = engine.instances.get(desc.material);
    engine::requireAttributes(*material.material, vertices.layout);
    const scene::Geometry geometry{ vertices.handle,
                                    indices.handle,
                                    engine.layouts.intern({ vertices.layout, desc.primitive }),
                                    desc.firstIndex,
                                    desc.indexCount ? desc.indexCount : indices.indexCount - desc.firstIndex,
                                    indices.format };
    const scene::RenderableInput input{ .geometry = geometry,
                                        .material = &material,
                                        .boundsMin = desc.boundsMin,
                                        .boundsMax = desc.boundsMax,
                                        .worldFromObject = desc.worldFromObject,
                                        .culled = desc.culled,
                                        .name = desc.name,
                                        .instanceIndex = desc.instanceIndex,
                                        .castsShadows = desc.castsShadows,
                                        .receivesShadows = desc.receivesShadows,
                                        .lightChannels = desc.lightChannels,
                                        .layers = desc.layers,
                                        .place = desc.drawPlace };
    // Vertices outside object space cannot have bones in it.
    const bool isDeformed = (desc.skin || desc.morphTargets) &&
                            input.material->material->package.vertexDomain == shader::VertexDomain::Object;
    const Renderable renderable = isDeformed ? scene::addDeformed(mImpl->changed(), input, deformationOf(*mImpl, desc))
                                             : scene::addRenderable(mImpl->changed(), input);
    if (desc.node) scene::attach(mImpl->changed(), renderable, desc.node);
    return renderable;
}

Light Scene::add(SunLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(SunLight, Node)");
    checkLight(light.color, 0, double3(0.0));
    return addLight(mImpl->changed(),
                    { .type = LightRecord::Type::Sun,
                      .directionWorld = unitDirection(light.directionWorld),
                      .color = light.color,
                      .intensity = light.illuminance.value,
                      .sourceRadius = std::tan(glm::radians(clampedOr0(light.angularRadiusDegrees, kWidestSunDegrees))),
                      .castsShadows = light.castsShadows,
                      .contactShadows = light.contactShadows,
                      .channels = light.lightChannels,
                      .showsDisc = light.showsDisc,
                      .haloSize = std::max(1.0f, clampedOr0(light.haloSize, kWidestHalo)),
                      .haloFalloff = clampedOr0(light.haloFalloff, kSteepestHalo) },
                    node);
}

Light Scene::add(PointLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(PointLight, Node)");
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    LightRecord record{ .type = LightRecord::Type::Point,
                        .positionWorld = light.positionWorld,
                        .color = light.color,
                        .intensity = light.intensity.value,
                        .rangeMeters = light.rangeMeters,
                        .sourceRadius = clampedOr0(light.sourceRadiusMeters, kLargestFloat),
                        .castsShadows = light.castsShadows,
                        .contactShadows = light.contactShadows,
                        .channels = light.lightChannels };
    if (light.profile) {
        record.directionWorld = unitDirection(light.directionWorld);
        setProfile(mImpl->engine, light.profile, light.upWorld, record);
    }
    return addLight(mImpl->changed(), record, node);
}

Light Scene::add(SpotLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(SpotLight, Node)");
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    FILAMENT_ASSERT(light.innerConeRadians >= 0 && light.innerConeRadians < light.outerConeRadians &&
                            light.outerConeRadians <= 1.5707964f,
                    "a spot has 0 <= inner < outer <= pi/2");
    LightRecord record{ .type = LightRecord::Type::Spot,
                        .positionWorld = light.positionWorld,
                        .directionWorld = unitDirection(light.directionWorld),
                        .color = light.color,
                        .intensity = light.intensity.value,
                        .rangeMeters = light.rangeMeters,
                        .innerConeRadians = light.innerConeRadians,
                        .outerConeRadians = light.outerConeRadians,
                        .sourceRadius = clampedOr0(light.sourceRadiusMeters, kLargestFloat),
                        .castsShadows = light.castsShadows,
                        .contactShadows = light.contactShadows,
                        .channels = light.lightChannels };
    if (light.profile) setProfile(mImpl->engine, light.profile, light.upWorld, record);
    return addLight(mImpl->changed(), record, node);
}

Light Scene::add(RectLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(RectLight, Node)");
    LightRecord record = areaRecord(LightRecord::Type::Rect, light);
    record.directionWorld = unitDirection(light.directionWorld);
    const float3 up = acrossDirection(record.directionWorld, light.upWorld);
    record.sideWorld = glm::cross(record.directionWorld, up);
    setExtent(record, halfExtentOf(light.widthMeters / 2, light.heightMeters / 2));
    record.isTwoSided = light.isTwoSided;
    return addLight(mImpl->changed(), record, node);
}

Light Scene::add(DiscLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(DiscLight, Node)");
    LightRecord record = areaRecord(LightRecord::Type::Disc, light);
    record.directionWorld = unitDirection(light.directionWorld);
    record.sideWorld = acrossDirection(record.directionWorld, {});
    setExtent(record, halfExtentOf(light.radiusMeters, light.radiusMeters));
    record.isTwoSided = light.isTwoSided;
    return addLight(mImpl->changed(), record, node);
}

Light Scene::add(TubeLight const& light, Node node) {
    const PublicCall call(mImpl, "Scene::add(TubeLight, Node)");
    LightRecord record = areaRecord(LightRecord::Type::Tube, light);
    record.sideWorld = unitDirection(light.axisWorld);
    setExtent(record, halfExtentOf(light.lengthMeters / 2, light.radiusMeters));
    return addLight(mImpl->changed(), record, node);
}

Skin Scene::add(SkinDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(SkinDesc)");
    FILAMENT_ASSERT(desc.joints.size() == desc.jointFromBind.size(), "a skin has one matrix for each of its joints");
    FILAMENT_ASSERT(desc.joints.empty() != (desc.boneCount == 0), "a skin has joints or a number of bones");
    scene::SkinRecord data{ .node = desc.node, .joints = { desc.joints.begin(), desc.joints.end() } };
    for (float4x4 const& matrix : desc.jointFromBind)
        data.jointFromBind.push_back(scene::affineFrom(double4x4(matrix)));
    data.bones.assign(desc.boneCount, scene::boneFrom(scene::kIdentity));
    return scene::addSkin(mImpl->changed(), std::move(data));
}

void Scene::remove(Skin skin) {
    const PublicCall call(mImpl, "Scene::remove(Skin)");
    scene::removeSkin(mImpl->changedUses(), skin);
}

void Scene::setBones(Skin skin, std::span<const float4x4> objectFromBind) {
    const PublicCall call(mImpl, "Scene::setBones(Skin, span<float4x4>)");
    scene::setBones(mImpl->changed(), skin, objectFromBind);
}

void Scene::setMorphWeights(Renderable renderable, std::span<const float> weights) {
    const PublicCall call(mImpl, "Scene::setMorphWeights(Renderable, span<float>)");
    scene::setMorphWeights(mImpl->changed(), renderable, weights);
}

void Scene::remove(Renderable renderable) {
    const PublicCall call(mImpl, "Scene::remove(Renderable)");
    scene::removeRenderable(mImpl->changedUses(), renderable);
}
void Scene::remove(Light light) {
    const PublicCall call(mImpl, "Scene::remove(Light)");
    scene::removeLight(mImpl->changedUses(), light);
}

void Scene::setLightChannels(Renderable renderable, LightChannels channels) {
    const PublicCall call(mImpl, "Scene::setLightChannels(Renderable, LightChannels)");
    scene::setLightChannels(mImpl->changed().renderables, renderable, channels);
}

void Scene::setLightChannels(Light light, LightChannels channels) {
    const PublicCall call(mImpl, "Scene::setLightChannels(Light, LightChannels)");
    scene::Lights& lights = mImpl->changed().lights;
    lights.records[lights.index.at(light)].channels = channels;
}

void Scene::setLightChannels(Node node, LightChannels channels) {
    const PublicCall call(mImpl, "Scene::setLightChannels(Node, LightChannels)");
    scene::setLightChannels(mImpl->changed(), node, channels);
}

void Scene::setLayers(Renderable renderable, Layers select, Layers layers) {
    const PublicCall call(mImpl, "Scene::setLayers(Renderable, Layers, Layers)");
    scene::setLayers(mImpl->changed().renderables, renderable, select, layers);
}

void Scene::setLayers(Node node, Layers select, Layers layers) {
    const PublicCall call(mImpl, "Scene::setLayers(Node, Layers, Layers)");
    scene::setLayers(mImpl->changed(), node, select, layers);
}

void Scene::setDrawPlace(Renderable renderable, DrawPlace place) {
    const PublicCall call(mImpl, "Scene::setDrawPlace(Renderable, DrawPlace)");
    scene::setDrawPlace(mImpl->changed().renderables, renderable, place);
}

void Scene::setDrawPlace(Node node, DrawPlace place) {
    const PublicCall call(mImpl, "Scene::setDrawPlace(Node, DrawPlace)");
    scene::setDrawPlace(mImpl->changed(), node, place);
}

DrawPlace Scene::drawPlace(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::drawPlace(Renderable)");
    scene::Renderables const& renderables = mImpl->data.renderables;
    return renderables.drawables[renderables.drawable[renderables.index.at(renderable)]].place;
}

Layers Scene::layers(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::layers(Renderable)");
    scene::Renderables const& renderables = mImpl->data.renderables;
    return renderables.layers[renderables.index.at(renderable)];
}

void Scene::setTransform(Renderable renderable, double4x4 const& worldFromObject) {
    const PublicCall call(mImpl, "Scene::setTransform(Renderable, double4x4)");
    scene::setTransform(mImpl->changed(), renderable, worldFromObject);
}

void Scene::setEnvironment(Environment const& environment, EnvironmentSettings const& settings) {
    const PublicCall call(mImpl, "Scene::setEnvironment(Environment, EnvironmentSettings)");
    setIndirectLight(environment.indirectLight(), settings.illuminance, settings.rotationRadians);
    setSkybox(settings.skybox ? environment.skybox() : Skybox{}, settings.illuminance, settings.rotationRadians);
}

void Scene::setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians) {
    const PublicCall call(mImpl, "Scene::setIndirectLight(IndirectLight, Lux, float)");
    scene::IndirectLightRecord state;
    if (light) state = mImpl->engine.indirectLights.get(light).light;
    state.illuminance = illuminance;
    state.rotationRadians = rotationRadians;
    mImpl->changedUses().indirectLight = state;
}

void Scene::setSkybox(Skybox skybox, Lux illuminance, float rotationRadians) {
    const PublicCall call(mImpl, "Scene::setSkybox(Skybox, Lux, float)");
    scene::SkyboxRecord state{ .illuminance = illuminance, .rotationRadians = rotationRadians };
    if (skybox) {
        engine::SkyboxState const& made = mImpl->engine.skyboxes.get(skybox);
        state.cube = made.cube;
        state.isRgbm = made.isRgbm;
        state.worldFromCube = made.worldFromCube;
    }
    mImpl->changedUses().skybox = state;
}

Box Scene::bounds() const {
    const PublicCall call(mImpl, "Scene::bounds()");
    return scene::sceneBounds(mImpl->upToDate());
}
uint32_t Scene::renderableCount() const {
    const PublicCall call(mImpl, "Scene::renderableCount()");
    return mImpl->data.renderables.count();
}
uint32_t Scene::lightCount() const {
    const PublicCall call(mImpl, "Scene::lightCount()");
    return mImpl->data.lights.index.size();
}

} // namespace filament
