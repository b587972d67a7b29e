// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ModelCopy.h>

#include "base/OutOfMemory.h"
#include "base/Suggest.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/TextureStreamer.h"
#include "filament_core/engine/gltf/ModelParts.h"
#include "filament_core/scene/SceneSkins.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace filament_core {
namespace engine {
namespace {

/// The same parameters, textures and states; nothing of the device is shared.
MaterialInstance cloneInstance(Engine::Impl& engine, MaterialInstance source) {
    Draft draft(engine.instances);
    scene::MaterialInstance& copy = draft.state();
    copy = engine.instances.get(source);
    copy.buffer = {};
    copy.groups = {};
    copy.parametersDirty = copy.texturesDirty = true;
    engine.dirtyInstances.push_back(draft.handle()); // the last call that can fail
    copy.id = engine.nextInstanceId++;
    if (engine.streamer) engine.streamer->addClone(engine.instances.get(source).id, copy.id);
    ++copy.material->instanceCount;
    return draft.keep();
}

} // namespace

OwnMaterial::OwnMaterial(Engine::Impl& engine, MaterialInstance ofModel)
        : shared(ofModel), instance(cloneInstance(engine, ofModel)), mEngine(&engine), mLink(engine) {}

OwnMaterial::~OwnMaterial() {
    if (mLink.isAlive()) mEngine->destroy(instance);
}

MaterialInstance CopyOfModel::shown(MaterialInstance sharedOne) const {
    const auto found = std::ranges::find(own, sharedOne, &OwnMaterial::shared);
    return found == own.end() ? sharedOne : found->instance;
}

} // namespace engine

namespace {

using engine::CopyOfModel;
using PartRenderable = Model::Impl::PartRenderable;

/// A function of a copy, from its first line to its last.
class CopyCall {
public:
    CopyCall(std::weak_ptr<Scene::Impl> const& ofScene, Node root, const char* function, std::string_view object = {})
            : CopyCall(ofScene.lock(), root, function, object) {}

private:
    CopyCall(std::shared_ptr<Scene::Impl> const& ofScene, Node root, const char* function, std::string_view object)
            : mCall(function, object), mOfScene(existing(ofScene), function), scene(*ofScene),
              copy(existing(ofScene->copies.find(root))) {}

    static std::shared_ptr<Scene::Impl> const& existing(std::shared_ptr<Scene::Impl> const& scene) {
        if (!scene) misused("its scene is gone");
        return scene;
    }
    static CopyOfModel& existing(CopyOfModel* copy) {
        if (!copy) misused("the copy of the model was removed from its scene");
        return *copy;
    }

    ApiCall mCall;
    engine::PublicCall mOfScene; ///< checks engine and thread

public:
    Scene::Impl& scene;
    CopyOfModel& copy;
};

/// NotFound, with similar names. Names that are empty or repeated are no suggestions.
Error unknown(CopyOfModel const& copy, std::string_view what, std::string_view name,
              std::vector<std::string_view> const& known) {
    std::vector<std::string_view> names;
    for (const std::string_view other : known) {
        if (!other.empty() && std::ranges::find(names, other) == names.end()) names.push_back(other);
    }
    std::string among;
    for (size_t i = 0; i < std::min<size_t>(names.size(), 8); ++i)
        among += fmt::format("{}'{}'", i == 0 ? " among " : ", ", names[i]);
    if (names.size() > 8) among += fmt::format(" and {} more", names.size() - 8);
    return fail(ErrorCode::NotFound, "{} has no {} '{}'{}{}", copy.model->name, what, name, among,
                suggestion(name, names));
}

bool isThere(Scene::Impl const& scene, Node node) { return scene.data.transforms.contains(node); }
bool isThere(Scene::Impl const& scene, Renderable renderable) {
    return scene.data.renderables.index.contains(renderable);
}
bool isThere(Scene::Impl const& scene, Light light) { return scene.data.lights.index.contains(light); }

/// The current materials of a renderable.
scene::MaterialInstance const* drawnWith(Scene::Impl const& scene, Renderable renderable) {
    scene::Renderables const& renderables = scene.data.renderables;
    return renderables.drawables[renderables.drawable[renderables.index.at(renderable)]].material;
}

/// The names of a primitive's targets, as many as it has.
std::vector<std::string> targetNamesOf(Scene::Impl const& scene, PartRenderable const& part) {
    if (!part.desc.morphTargets) return {};
    std::vector<std::string> names = part.targetNames;
    names.resize(scene.engine.morphTargets.get(part.desc.morphTargets).targets.targetCount);
    return names;
}

std::string const& nameOf(std::string const& own, Scene::Impl const& scene, Node node) {
    return own.empty() && isThere(scene, node) ? scene.data.transforms.name(node) : own;
}

/// Of length 1; `other` for one without a direction.
double3 directionOr(double3 const& other, double4 const& vector) {
    const double3 v(vector);
    return std::isfinite(glm::dot(v, v)) && glm::dot(v, v) > 0 ? glm::normalize(v) : other;
}

Camera cameraOf(assets::CameraData const& data, double4x4 const& worldFromNode) {
    const Lens lens{ .verticalFovDegrees = glm::degrees(data.verticalFovRadians),
                     .nearMeters = data.nearMeters,
                     .orthographicHeight = data.isParallel ? 2 * data.halfHeightMeters : 0,
                     .farMeters = data.farMeters,
                     .aspect = data.aspect };
    // glTF 2.0, section 3.10.2: the camera is not scaled. Gram-Schmidt keeps its direction.
    const double3 back = directionOr({ 0, 0, 1 }, worldFromNode[2]), up = directionOr({ 0, 1, 0 }, worldFromNode[1]);
    const double3 position(worldFromNode[3]);
    const double3 eye = std::isfinite(glm::dot(position, position)) ? position : double3(0.0);
    return Camera::lookAt(eye, eye - back, lens, {}, up);
}

LightKind kindOf(Model::Impl::PartLight const& part) {
    static_assert(
            std::is_same_v<LightDesc, std::variant<SunLight, PointLight, SpotLight, RectLight, DiscLight, TubeLight>>,
            "LightKind has the order of LightDesc");
    return static_cast<LightKind>(part.light.index());
}

/// All instances of a material of the model, in any variant.
std::vector<MaterialInstance> sharedMaterials(Engine::Impl const& engine, Model::Impl const& model,
                                              std::string_view name) {
    std::vector<MaterialInstance> shared;
    const auto add = [&](MaterialInstance instance) {
        const bool isNew = std::ranges::find(shared, instance) == shared.end();
        if (isNew && engine.instances.get(instance).name == name) shared.push_back(instance);
    };
    for (PartRenderable const& part : model.renderables) {
        add(part.desc.material);
        for (Model::Impl::PartVariant const& variant : part.variants) add(variant.material);
    }
    return shared;
}

std::vector<std::string_view> materialNames(Engine::Impl const& engine, Model::Impl const& model) {
    std::vector<std::string_view> names;
    for (const MaterialInstance instance : model.instances) {
        if (instance) names.push_back(engine.instances.get(instance).name);
    }
    return names;
}

/// The copy's or the model's; none: the program's own, by Scene::setMaterial().
MaterialInstance handleOf(scene::MaterialInstance const& drawn, Engine::Impl const& engine, CopyOfModel const& copy) {
    for (engine::OwnMaterial const& own : copy.own) {
        if (&engine.instances.get(own.instance) == &drawn) return own.instance;
    }
    for (const MaterialInstance instance : copy.model->instances) {
        if (instance && &engine.instances.get(instance) == &drawn) return instance;
    }
    return {};
}

CopyMaterial described(MaterialInstance instance, scene::MaterialInstance const& drawn, Engine::Impl const& engine,
                       CopyOfModel const& copy) {
    const auto material = std::ranges::find_if(copy.model->materials, [&](Material each) {
        return each && &engine.materials.get(each) == drawn.material;
    });
    return { .name = drawn.name,
             .instance = instance,
             .material = material == copy.model->materials.end() ? Material{} : *material,
             .isOwn = std::ranges::count(copy.own, instance, &engine::OwnMaterial::instance) > 0,
             .renderables = 1 };
}

} // namespace

MaterialInstance engine::ownInstance(Scene::Impl& scene, CopyOfModel& copy, MaterialInstance shared) {
    if (const MaterialInstance known = copy.shown(shared); known != shared) return known;
    copy.own.emplace_back(scene.engine, shared);
    scene::MaterialInstance const* before = &scene.engine.instances.get(shared);
    for (const Renderable renderable : copy.renderables) {
        if (isThere(scene, renderable) && drawnWith(scene, renderable) == before)
            scene::setMaterial(scene.changedUses().renderables, renderable,
                               scene.engine.instances.get(copy.own.back().instance));
    }
    return copy.own.back().instance;
}

Result<ModelCopy> ModelCopy::of(Scene& scene, Node root) {
    const std::shared_ptr<Scene::Impl> ofScene = scene.share().lock();
    const engine::PublicCall call(ofScene, "ModelCopy::of(Scene, Node)");
    std::string const& name = ofScene->data.transforms.name(root);
    if (ofScene->copies.find(root)) return ModelCopy(ofScene, root);
    return fail(ErrorCode::InvalidArgument,
                "node '{}' is not the root of a copy of a model; take the node that Scene::add(model) returned", name);
}

std::vector<Node> ModelCopy::nodes() const {
    std::vector<Node> nodes;
    const CopyCall call(mScene, mRoot, "ModelCopy::nodes()");
    for (size_t i = 0; i < call.copy.model->fileNodes; ++i) {
        if (isThere(call.scene, call.copy.nodes[i])) nodes.push_back(call.copy.nodes[i]);
    }
    return nodes;
}

Result<Node> ModelCopy::node(std::string_view name) const {
    const CopyCall call(mScene, mRoot, "ModelCopy::node(string_view)", name);
    std::vector<std::string_view> names;
    for (const Node node : nodes()) {
        names.push_back(call.scene.data.transforms.name(node));
        if (names.back() == name) return node;
    }
    return unknown(call.copy, "node", name, names);
}

std::vector<CopyRenderable> ModelCopy::renderables() const {
    std::vector<CopyRenderable> list;
    const CopyCall call(mScene, mRoot, "ModelCopy::renderables()");
    Scene::Impl const& scene = call.scene;
    for (size_t i = 0; i < call.copy.renderables.size(); ++i) {
        PartRenderable const& part = call.copy.model->renderables[i];
        if (!isThere(scene, call.copy.renderables[i])) continue;
        list.push_back({ .renderable = call.copy.renderables[i],
                         .node = call.copy.nodes[part.ofNode],
                         .mesh = part.desc.name,
                         .material = drawnWith(scene, call.copy.renderables[i])->name,
                         .morphTargets = targetNamesOf(scene, part) });
    }
    return list;
}

Result<std::vector<Renderable>> ModelCopy::renderables(std::string_view meshOrNode) const {
    const CopyCall call(mScene, mRoot, "ModelCopy::renderables(string_view)", meshOrNode);
    std::vector<Renderable> found;
    std::vector<std::string_view> names;
    const std::vector<CopyRenderable> all = renderables();
    for (CopyRenderable const& each : all) {
        std::string const& node = call.scene.data.transforms.name(each.node);
        if (each.mesh == meshOrNode || node == meshOrNode) found.push_back(each.renderable);
        names.insert(names.end(), { each.mesh, node });
    }
    if (found.empty()) return unknown(call.copy, "mesh or node with a mesh", meshOrNode, names);
    return found;
}

std::vector<CopyMaterial> ModelCopy::materials() const {
    std::vector<CopyMaterial> list;
    const CopyCall call(mScene, mRoot, "ModelCopy::materials()");
    for (const Renderable renderable : call.copy.renderables) {
        if (!isThere(call.scene, renderable)) continue;
        scene::MaterialInstance const& drawn = *drawnWith(call.scene, renderable);
        const MaterialInstance instance = handleOf(drawn, call.scene.engine, call.copy);
        if (!instance) continue;
        const auto known = std::ranges::find(list, instance, &CopyMaterial::instance);
        if (known == list.end()) {
            list.push_back(described(instance, drawn, call.scene.engine, call.copy));
        } else {
            ++known->renderables;
        }
    }
    return list;
}

Result<std::vector<MaterialInstance>> ModelCopy::ownMaterials(std::string_view material) {
    return orOutOfMemory("materials of a copy", material, [&]() -> Result<std::vector<MaterialInstance>> {
        const CopyCall call(mScene, mRoot, "ModelCopy::ownMaterials(string_view)", material);
        Scene::Impl& scene = call.scene;
        std::vector<MaterialInstance> instances = sharedMaterials(scene.engine, *call.copy.model, material);
        if (instances.empty())
            return unknown(call.copy, "material", material, materialNames(scene.engine, *call.copy.model));
        call.copy.own.reserve(call.copy.own.size() + instances.size());
        for (MaterialInstance& instance : instances) instance = engine::ownInstance(scene, call.copy, instance);
        return instances;
    });
}

Result<void> ModelCopy::setEach(std::string_view material, auto&& set) {
    const Result<std::vector<MaterialInstance>> instances = ownMaterials(material);
    if (!instances) return instances.error();
    std::optional<Error> missing;
    bool isSet = false;
    for (const MaterialInstance instance : *instances) {
        const Result<void> done = set(instance);
        isSet |= done.ok();
        if (!done && done.error().code != ErrorCode::NotFound) return done.error();
        if (!done) missing = done.error();
    }
    return isSet || !missing ? Result<void>{} : Result<void>(*missing);
}

Result<void> ModelCopy::set(std::string_view material, std::string_view parameter, ParameterValue const& value) {
    const CopyCall call(mScene, mRoot, "ModelCopy::set(string_view, string_view, ParameterValue)", parameter);
    Engine& owner = Engine::of(call.scene.engine);
    return setEach(material, [&](MaterialInstance each) { return owner.set(each, parameter, value); });
}

Result<void> ModelCopy::set(std::string_view material, std::string_view parameter, Texture texture, Sampler sampler) {
    const CopyCall call(mScene, mRoot, "ModelCopy::set(string_view, string_view, Texture, Sampler)", parameter);
    Engine& owner = Engine::of(call.scene.engine);
    return setEach(material, [&](MaterialInstance each) { return owner.set(each, parameter, texture, sampler); });
}

std::vector<CopyLight> ModelCopy::lights() const {
    std::vector<CopyLight> list;
    const CopyCall call(mScene, mRoot, "ModelCopy::lights()");
    Scene::Impl const& scene = call.scene;
    for (size_t i = 0; i < call.copy.lights.size(); ++i) {
        Model::Impl::PartLight const& part = call.copy.model->lights[i];
        if (!isThere(scene, call.copy.lights[i])) continue;
        const Node node = call.copy.nodes[part.node];
        list.push_back({ nameOf(part.name, scene, node), call.copy.lights[i], node, kindOf(part) });
    }
    return list;
}

Result<Light> ModelCopy::light(std::string_view name) const {
    const CopyCall call(mScene, mRoot, "ModelCopy::light(string_view)", name);
    const std::vector<CopyLight> all = lights();
    const auto found = std::ranges::find(all, name, &CopyLight::name);
    if (found == all.end()) return unknown(call.copy, "light", name, namesOf(all));
    return found->light;
}

std::vector<CopyCamera> ModelCopy::cameras() const {
    std::vector<CopyCamera> list;
    const CopyCall call(mScene, mRoot, "ModelCopy::cameras()");
    Scene::Impl const& scene = call.scene;
    for (Model::Impl::PartCamera const& part : call.copy.model->cameras) {
        const Node node = call.copy.nodes[part.node];
        if (!isThere(scene, node)) continue;
        list.push_back({ nameOf(part.camera.name, scene, node), node,
                         cameraOf(call.copy.cameras.empty() ? part.camera : call.copy.cameras[part.source],
                                  scene.data.transforms.worldFromNode(node)) });
    }
    return list;
}

Result<Camera> ModelCopy::camera(std::string_view name) const {
    const CopyCall call(mScene, mRoot, "ModelCopy::camera(string_view)", name);
    const std::vector<CopyCamera> all = cameras();
    const auto found = std::ranges::find(all, name, &CopyCamera::name);
    if (found == all.end()) return unknown(call.copy, "camera", name, namesOf(all));
    return found->camera;
}

std::vector<CopyMorphTarget> ModelCopy::morphTargets() const {
    std::vector<CopyMorphTarget> list;
    const CopyCall call(mScene, mRoot, "ModelCopy::morphTargets()");
    scene::SceneData const& data = call.scene.data;
    for (CopyRenderable const& each : renderables()) {
        const uint32_t slot = deformationAt(data.renderables, data.renderables.index.at(each.renderable));
        if (slot == scene::kNotDeformed || !data.deformations.all()[slot].morph) continue;
        std::vector<float> const& weights = data.deformations.all()[slot].weights;
        for (uint32_t i = 0; i < each.morphTargets.size(); ++i)
            list.push_back({ each.morphTargets[i], each.renderable, i, i < weights.size() ? weights[i] : 0.0f });
    }
    return list;
}

Result<void> ModelCopy::setMorphWeight(std::string_view target, float weight) {
    return orOutOfMemory("morph target", target, [&]() -> Result<void> {
        const CopyCall call(mScene, mRoot, "ModelCopy::setMorphWeight(string_view, float)", target);
        const std::vector<CopyMorphTarget> all = morphTargets();
        std::vector<float> weights;
        bool isKnown = false;
        for (size_t i = 0; i < all.size();) { // the targets of a renderable follow each other
            weights.clear();
            bool isChanged = false;
            const Renderable renderable = all[i].renderable;
            for (; i < all.size() && all[i].renderable == renderable; ++i) {
                const bool isMeant = all[i].name == target;
                weights.push_back(isMeant ? weight : all[i].weight);
                isChanged |= isMeant;
            }
            if (isChanged) scene::setMorphWeights(call.scene.changed(), renderable, weights);
            isKnown |= isChanged;
        }
        return isKnown ? Result<void>{} : unknown(call.copy, "morph target", target, namesOf(all));
    });
}

std::vector<CopyLevels> ModelCopy::levels() const {
    const CopyCall call(mScene, mRoot, "ModelCopy::levels()");
    std::vector<CopyLevels> list;
    for (size_t i = 0; i < call.copy.model->levels.size(); ++i) {
        assets::LevelsData const& levels = call.copy.model->levels[i];
        CopyLevels& added = list.emplace_back();
        for (const uint32_t node : levels.nodes) added.nodes.push_back(call.copy.nodes[node]);
        added.leastCoverage = levels.leastCoverage;
        if (const uint32_t shown = call.copy.parts.levels[i]; shown < levels.nodes.size()) added.shown = shown;
    }
    return list;
}

void ModelCopy::chooseLevels(View const& view, float bias) {
    const CopyCall call(mScene, mRoot, "ModelCopy::chooseLevels(View, float)");
    if (!(bias > 0)) misused(fmt::format("the bias is {}; it must be above 0", bias));
    if (view.size.x == 0 || view.size.y == 0) misused("the view has no pixels");
    if (call.copy.model->levels.empty()) return;
    const float aspect = static_cast<float>(view.size.x) / static_cast<float>(view.size.y);
    const prepare::CoverageLens lens = prepare::coverageLens(view.camera.position(), view.camera.clipFromView(aspect));
    engine::chooseLevels(*call.copy.model, call.scene, call.copy, lens, static_cast<double>(bias));
}

std::vector<std::string> ModelCopy::animations() const {
    std::vector<std::string> names;
    const CopyCall call(mScene, mRoot, "ModelCopy::animations()");
    for (assets::AnimationData const& animation : call.copy.model->animations) names.push_back(animation.name);
    return names;
}

std::vector<std::string> ModelCopy::variants() const {
    const CopyCall call(mScene, mRoot, "ModelCopy::variants()");
    return call.copy.model->variants;
}

std::string ModelCopy::variant() const {
    const CopyCall call(mScene, mRoot, "ModelCopy::variant()");
    return call.copy.variant;
}

Result<void> ModelCopy::setVariant(std::string_view variant) {
    const CopyCall call(mScene, mRoot, "ModelCopy::setVariant(string_view)", variant);
    return engine::setVariant(call.scene, call.copy, variant);
}

} // namespace filament_core
