// SPDX-License-Identifier: Apache-2.0
#include <filament/ModelCopy.h>

#include "base/OutOfMemory.h"
#include "base/Suggest.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/scene/SceneSkins.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace filament {
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

CopyOfModel* copyAt(Scene* scene, Node root) { return scene->impl().copies.find(root); }

Error gone() {
    return fail(ErrorCode::InvalidArgument, "the copy of the model was removed from its scene; take the root that "
                                            "Scene::add(model) returned");
}

/// NotFound, with what is near. Names that are empty or repeated are no suggestions.
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

/// What a renderable is drawn with now.
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

Camera cameraOf(assets::CameraData const& data, double4x4 const& worldFromNode) {
    Camera camera;
    camera.lens = { .verticalFovDegrees = glm::degrees(data.verticalFovRadians),
                    .nearMeters = data.nearMeters,
                    .parallelMeters = data.isParallel ? 2 * data.halfHeightMeters : 0,
                    .farMeters = data.farMeters,
                    .aspect = data.aspect };
    // glTF 2.0, section 3.10.2: the camera is not scaled. Gram-Schmidt keeps where it looks.
    const double3 back(worldFromNode[2]), up(worldFromNode[1]), position(worldFromNode[3]);
    const bool looks = std::isfinite(glm::dot(back, back)) && glm::dot(back, back) > 0;
    const double3 eye = std::isfinite(glm::dot(position, position)) ? position : double3(0.0);
    const Camera turned = Camera::lookAt(eye, eye - (looks ? glm::normalize(back) : double3(0, 0, 1)), camera.lens, {},
                                         std::isfinite(glm::dot(up, up)) && glm::dot(up, up) > 0 ? glm::normalize(up)
                                                                                                 : double3(0, 1, 0));
    return turned;
}

LightKind kindOf(Model::Impl::PartLight const& part) {
    return std::visit(
            []<class T>(T const&) {
                return std::is_same_v<T, SunLight>     ? LightKind::Sun
                       : std::is_same_v<T, PointLight> ? LightKind::Point
                                                       : LightKind::Spot;
            },
            part.light);
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

/// Makes the copy's own instance of a shared one, and shows it where that is shown.
void makeOwn(Scene::Impl& scene, CopyOfModel& copy, MaterialInstance shared) {
    if (copy.shown(shared) != shared) return;
    copy.own.emplace_back(scene.engine, shared);
    scene::MaterialInstance const* before = &scene.engine.instances.get(shared);
    for (const Renderable renderable : copy.renderables) {
        if (isThere(scene, renderable) && drawnWith(scene, renderable) == before)
            scene::setMaterial(scene.changed().renderables, renderable,
                               scene.engine.instances.get(copy.own.back().instance));
    }
}

} // namespace

Result<ModelCopy> ModelCopy::of(Scene& scene, Node root) {
    if (copyAt(&scene, root)) return ModelCopy(scene, root);
    if (!isThere(scene.impl(), root)) return gone();
    return fail(ErrorCode::InvalidArgument,
                "node '{}' is not the root of a copy of a model; take the node that Scene::add(model) returned",
                scene.impl().data.transforms.name(root));
}

std::vector<Node> ModelCopy::nodes() const {
    std::vector<Node> nodes;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return nodes;
    for (size_t i = 0; i < copy->model->fileNodes; ++i) {
        if (isThere(mScene->impl(), copy->nodes[i])) nodes.push_back(copy->nodes[i]);
    }
    return nodes;
}

Result<Node> ModelCopy::node(std::string_view name) const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return gone();
    std::vector<std::string_view> names;
    for (const Node node : nodes()) {
        names.push_back(mScene->impl().data.transforms.name(node));
        if (names.back() == name) return node;
    }
    return unknown(*copy, "node", name, names);
}

std::vector<CopyRenderable> ModelCopy::renderables() const {
    std::vector<CopyRenderable> list;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return list;
    Scene::Impl const& scene = mScene->impl();
    for (size_t i = 0; i < copy->renderables.size(); ++i) {
        PartRenderable const& part = copy->model->renderables[i];
        if (!isThere(scene, copy->renderables[i])) continue;
        list.push_back({ .renderable = copy->renderables[i],
                         .node = copy->nodes[part.ofNode],
                         .mesh = part.desc.name,
                         .material = drawnWith(scene, copy->renderables[i])->name,
                         .morphTargets = targetNamesOf(scene, part) });
    }
    return list;
}

Result<std::vector<Renderable>> ModelCopy::renderables(std::string_view meshOrNode) const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return gone();
    std::vector<Renderable> found;
    std::vector<std::string_view> names;
    const std::vector<CopyRenderable> all = renderables();
    for (CopyRenderable const& each : all) {
        std::string const& node = nameOf({}, mScene->impl(), each.node);
        if (each.mesh == meshOrNode || node == meshOrNode) found.push_back(each.renderable);
        names.insert(names.end(), { each.mesh, node });
    }
    if (found.empty()) return unknown(*copy, "mesh or node with a mesh", meshOrNode, names);
    return found;
}

std::vector<CopyMaterial> ModelCopy::materials() const {
    std::vector<CopyMaterial> list;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return list;
    Scene::Impl& scene = mScene->impl();
    const auto handleOf = [&](scene::MaterialInstance const* drawn) {
        for (engine::OwnMaterial const& own : copy->own) {
            if (&scene.engine.instances.get(own.instance) == drawn) return own.instance;
        }
        for (const MaterialInstance instance : copy->model->instances) {
            if (instance && &scene.engine.instances.get(instance) == drawn) return instance;
        }
        return MaterialInstance{}; // the program's own, by Scene::setMaterial()
    };
    for (const Renderable renderable : copy->renderables) {
        if (!isThere(scene, renderable)) continue;
        scene::MaterialInstance const* drawn = drawnWith(scene, renderable);
        const MaterialInstance instance = handleOf(drawn);
        if (!instance) continue;
        const auto known = std::ranges::find(list, instance, &CopyMaterial::instance);
        if (known != list.end()) {
            ++known->renderables;
            continue;
        }
        const auto material = std::ranges::find_if(copy->model->materials, [&](Material each) {
            return each && &scene.engine.materials.get(each) == drawn->material;
        });
        list.push_back({ .name = drawn->name,
                         .instance = instance,
                         .material = material == copy->model->materials.end() ? Material{} : *material,
                         .isOwn = std::ranges::count(copy->own, instance, &engine::OwnMaterial::instance) > 0,
                         .renderables = 1 });
    }
    return list;
}

Result<std::vector<MaterialInstance>> ModelCopy::ownMaterials(std::string_view material) {
    return orOutOfMemory("materials of a copy", material, [&]() -> Result<std::vector<MaterialInstance>> {
        CopyOfModel* copy = copyAt(mScene, mRoot);
        if (!copy) return gone();
        Scene::Impl& scene = mScene->impl();
        std::vector<MaterialInstance> instances = sharedMaterials(scene.engine, *copy->model, material);
        if (instances.empty()) return unknown(*copy, "material", material, materialNames(scene.engine, *copy->model));
        copy->own.reserve(copy->own.size() + instances.size());
        for (MaterialInstance& instance : instances) {
            makeOwn(scene, *copy, instance);
            instance = copy->shown(instance);
        }
        return instances;
    });
}

Result<void> ModelCopy::set(std::string_view material, std::string_view parameter, ParameterValue const& value) {
    const Result<std::vector<MaterialInstance>> instances = ownMaterials(material);
    if (!instances) return instances.error();
    Engine& owner = Engine::of(mScene->impl().engine);
    for (const MaterialInstance instance : *instances) {
        if (Result<void> done = owner.set(instance, parameter, value); !done) return done;
    }
    return {};
}

Result<void> ModelCopy::set(std::string_view material, std::string_view parameter, Texture texture, Sampler sampler) {
    const Result<std::vector<MaterialInstance>> instances = ownMaterials(material);
    if (!instances) return instances.error();
    Engine& owner = Engine::of(mScene->impl().engine);
    for (const MaterialInstance instance : *instances) {
        if (Result<void> done = owner.set(instance, parameter, texture, sampler); !done) return done;
    }
    return {};
}

std::vector<CopyLight> ModelCopy::lights() const {
    std::vector<CopyLight> list;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return list;
    Scene::Impl const& scene = mScene->impl();
    for (size_t i = 0; i < copy->lights.size(); ++i) {
        Model::Impl::PartLight const& part = copy->model->lights[i];
        if (!isThere(scene, copy->lights[i])) continue;
        const Node node = copy->nodes[part.node];
        list.push_back({ nameOf(part.name, scene, node), copy->lights[i], node, kindOf(part) });
    }
    return list;
}

Result<Light> ModelCopy::light(std::string_view name) const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return gone();
    const std::vector<CopyLight> all = lights();
    const auto found = std::ranges::find(all, name, &CopyLight::name);
    if (found == all.end()) return unknown(*copy, "light", name, namesOf(all));
    return found->light;
}

std::vector<CopyCamera> ModelCopy::cameras() const {
    std::vector<CopyCamera> list;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return list;
    Scene::Impl const& scene = mScene->impl();
    for (Model::Impl::PartCamera const& part : copy->model->cameras) {
        const Node node = copy->nodes[part.node];
        if (!isThere(scene, node)) continue;
        list.push_back({ nameOf(part.camera.name, scene, node), node,
                         cameraOf(part.camera, scene.data.transforms.worldFromNode(node)) });
    }
    return list;
}

Result<Camera> ModelCopy::camera(std::string_view name) const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return gone();
    const std::vector<CopyCamera> all = cameras();
    const auto found = std::ranges::find(all, name, &CopyCamera::name);
    if (found == all.end()) return unknown(*copy, "camera", name, namesOf(all));
    return found->camera;
}

std::vector<CopyMorphTarget> ModelCopy::morphTargets() const {
    std::vector<CopyMorphTarget> list;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return list;
    scene::SceneData const& data = mScene->impl().data;
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
        CopyOfModel const* copy = copyAt(mScene, mRoot);
        if (!copy) return gone();
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
            if (isChanged) mScene->setMorphWeights(renderable, weights);
            isKnown |= isChanged;
        }
        return isKnown ? Result<void>{} : unknown(*copy, "morph target", target, namesOf(all));
    });
}

std::vector<std::string> ModelCopy::animations() const {
    std::vector<std::string> names;
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    if (!copy) return names;
    for (assets::AnimationData const& animation : copy->model->animations) names.push_back(animation.name);
    return names;
}

std::vector<std::string> ModelCopy::variants() const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    return copy ? copy->model->variants : std::vector<std::string>{};
}

std::string ModelCopy::variant() const {
    CopyOfModel const* copy = copyAt(mScene, mRoot);
    return copy ? copy->variant : std::string();
}

Result<void> ModelCopy::setVariant(std::string_view variant) {
    if (!copyAt(mScene, mRoot)) return gone();
    return mScene->setVariant(mRoot, variant);
}

} // namespace filament
