// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Scene.h>

#include "filament_core/engine/LightRecords.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/passes/SplatPass.h"
#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"

#include <filament_core/Environment.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace filament_core {
namespace {

using engine::PublicCall;

scene::Deformation deformationOf(Scene::Impl const& scene, RenderableDesc const& desc,
                                 scene::MinMax const& restBounds) {
    engine::VertexBufferState const& vertices = scene.engine.vertexBuffers.get(desc.vertices);
    scene::Deformation deformation{ .skin = desc.skin, .restBounds = restBounds };
    if (desc.skin) {
        FILAMENT_ASSERT(scene.data.deformations.skin(desc.skin).node == desc.node,
                        "a renderable hangs at the node of its skin");
        deformation.jointSets = engine::jointSetsOf(vertices.layout);
        for (Box const& bounds : desc.boneBounds)
            deformation.boneBounds.push_back(bounds.empty() ? scene::MinMax{}
                                                            : scene::MinMax{ float3(bounds.min), float3(bounds.max) });
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

Renderable addSplatsTo(Scene::Impl& scene, RenderableDesc const& desc) {
    scene::SplatData const& splats = *desc.splats.data();
    const scene::RenderableInput input{ .geometry = { .layout = scene.engine.layouts.intern(passes::splatLayout()) },
                                        .material = &scene.engine.instances.get(scene.engine.splatInstance()),
                                        .boundsMin = splats.bounds.min,
                                        .boundsMax = splats.bounds.max,
                                        .worldFromObject = desc.worldFromObject,
                                        .culled = desc.culled,
                                        .castsShadows = false,
                                        .layers = desc.layers };
    return scene::addSplats(scene.changed(), input, desc.splats.data());
}

/// A dome that does not enclose the panorama's camera and the ground would have no inside.
scene::BackgroundGround groundOf(EnvironmentSettings const& settings) {
    return { .heightMeters = std::max(settings.groundHeightMeters, 0.0f),
             .levelMeters = settings.groundLevelMeters,
             .radiusMeters = std::max(settings.groundRadiusMeters, 1.001f * settings.groundHeightMeters) };
}

} // namespace

Scene::Scene(Engine& engine) : mImpl(std::make_shared<Impl>(engine)) {}
Scene::~Scene() {
    if (mImpl && mImpl->link.isAlive()) const PublicCall call(mImpl, "Scene::~Scene()");
}

Renderable Scene::add(RenderableDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(RenderableDesc)", desc.name);
    FILAMENT_ASSERT(!desc.node || desc.worldFromObject == double4x4(1.0),
                    "a renderable of a node stands where the node stands: its worldFromObject stays the identity");
    if (desc.splats) {
        const Renderable splats = addSplatsTo(*mImpl, desc);
        if (desc.node) scene::attach(mImpl->changed(), splats, desc.node);
        mImpl->follow(splats, { .bounds = Box{} });
        return splats;
    }
    const GeometryDesc shape{ desc.vertices,   desc.indices, desc.primitive, desc.firstIndex,
                              desc.indexCount, desc.bounds,  desc.occluder,  desc.levels };
    scene::MaterialInstance const& material = mImpl->engine.instances.get(desc.material);
    const scene::Geometry geometry = mImpl->geometryOf(shape, *material.material);
    const scene::MinMax bounds = mImpl->boundsOf(shape);
    const scene::RenderableInput input{ .geometry = geometry,
                                        .material = &material,
                                        .boundsMin = bounds.min,
                                        .boundsMax = bounds.max,
                                        .worldFromObject = desc.worldFromObject,
                                        .culled = desc.culled,
                                        .instanceIndex = desc.instanceIndex,
                                        .castsShadows = desc.castsShadows,
                                        .properties = { .receivesShadows = desc.receivesShadows,
                                                        .lightChannels = desc.lightChannels },
                                        .layers = desc.layers,
                                        .place = desc.drawOrder,
                                        .levels = desc.levels };
    // Vertices outside object space cannot have bones in it.
    const bool isDeformed = (desc.skin || desc.morphTargets) &&
                            input.material->material->package.vertexDomain == shader::VertexDomain::Object;
    const Renderable renderable =
            isDeformed ? scene::addDeformed(mImpl->changed(), input, deformationOf(*mImpl, desc, bounds))
                       : scene::addRenderable(mImpl->changed(), input);
    if (desc.node) scene::attach(mImpl->changed(), renderable, desc.node);
    mImpl->follow(renderable, shape);
    return renderable;
}

Light Scene::add(LightDesc const& desc, Node node) {
    const PublicCall call(mImpl, "Scene::add(LightDesc, Node)");
    const Light light = scene::addLight(mImpl->changed(), engine::recordOf(mImpl->engine, desc));
    if (node) scene::attach(mImpl->data, light, node);
    engine::updateLightShape(*mImpl, light);
    return light;
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
    engine::placeLightShapes(mImpl->engine, mImpl->data);
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

void Scene::setDrawOrder(Renderable renderable, DrawOrder place) {
    const PublicCall call(mImpl, "Scene::setDrawOrder(Renderable, DrawOrder)");
    scene::setDrawOrder(mImpl->changed().renderables, renderable, place);
}

void Scene::setDrawOrder(Node node, DrawOrder place) {
    const PublicCall call(mImpl, "Scene::setDrawOrder(Node, DrawOrder)");
    scene::setDrawOrder(mImpl->changed(), node, place);
}

DrawOrder Scene::drawOrder(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::drawOrder(Renderable)");
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
    const std::span<const ExtractedLight> suns = environment.lights().found();
    if (suns.size() != mImpl->environmentLights.size()) mImpl->removeEnvironmentLights();
    const std::vector<Light> kept = std::exchange(mImpl->environmentLights, {}); // setIndirectLight() would remove them
    setIndirectLight(environment.indirectLight(), settings.illuminance, settings.rotationRadians);
    setSkybox(settings.skybox ? environment.skybox() : Skybox{}, settings.illuminance, settings.rotationRadians);
    mImpl->changedUses().skybox.ground = groundOf(settings);
    mImpl->environmentLights = kept;
    for (size_t i = 0; i < suns.size(); ++i) {
        const SunLight sun = sunLightOf(suns[i], settings);
        if (i < kept.size()) set(kept[i], sun);
        if (i >= kept.size()) mImpl->environmentLights.push_back(add(sun));
    }
}

void Scene::setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians) {
    const PublicCall call(mImpl, "Scene::setIndirectLight(IndirectLight, Lux, float)");
    mImpl->removeEnvironmentLights();
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
Box Scene::bounds(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::bounds(Renderable)");
    scene::Renderables const& renderables = mImpl->upToDate().renderables;
    return renderables.bounds.at(renderables.index.at(renderable));
}
uint32_t Scene::renderableCount() const {
    const PublicCall call(mImpl, "Scene::renderableCount()");
    return mImpl->data.renderables.count() - static_cast<uint32_t>(mImpl->data.lightShapes.size());
}
uint32_t Scene::lightCount() const {
    const PublicCall call(mImpl, "Scene::lightCount()");
    return mImpl->data.lights.index.size();
}

} // namespace filament_core
