// SPDX-License-Identifier: Apache-2.0
// The materials of renderables: set one by one, or by the variants of their model.
#include "filament_core/assets/gltf/ModelVariants.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"

#include <algorithm>

namespace filament_core {

using engine::PublicCall;

namespace {

constexpr uint32_t kNoVariant = ~0u;

MaterialInstance materialIn(Model::Impl::PartRenderable const& part, uint32_t variant) {
    const auto found = std::ranges::find(part.variants, variant, &Model::Impl::PartVariant::variant);
    return found == part.variants.end() ? part.desc.material : found->material;
}

Error noVariants(Scene::Impl const& scene, Node root, std::string_view variant) {
    return fail(ErrorCode::InvalidArgument,
                "'{}' has no variants, so there is no '{}'; give the root of a model with KHR_materials_variants",
                scene.data.transforms.name(root), variant);
}

void setMaterial(Scene::Impl& scene, Renderable renderable, MaterialInstance material) {
    scene::Renderables& renderables = scene.changedUses().renderables;
    scene::MaterialInstance const& instance = scene.engine.instances.get(material);
    const uint32_t drawable = renderables.drawable[renderables.index.at(renderable)];
    const uint32_t layout = renderables.drawables[drawable].geometry.layout;
    engine::requireAttributes(*instance.material, scene.engine.layouts[layout].vertices);
    scene::setMaterial(renderables, renderable, instance);
}

} // namespace

Result<void> engine::setVariant(Scene::Impl& scene, CopyOfModel& copy, std::string_view variant) {
    Model::Impl const& model = *copy.model;
    if (model.variants.empty()) return noVariants(scene, copy.root, variant);
    uint32_t index = kNoVariant;
    if (!variant.empty()) {
        const Result<uint32_t> known = assets::findVariant(model.variants, variant, model.name);
        if (!known) return known.error();
        index = *known;
    }
    for (size_t i = 0; i < copy.renderables.size(); ++i) {
        const Renderable renderable = copy.renderables[i];
        if (scene.data.renderables.index.contains(renderable))
            setMaterial(scene, renderable, copy.shown(materialIn(model.renderables[i], index)));
    }
    copy.variant = variant;
    return {};
}

void Scene::setMaterial(Renderable renderable, MaterialInstance material) {
    const PublicCall call(mImpl, "Scene::setMaterial(Renderable, MaterialInstance)");
    filament_core::setMaterial(*mImpl, renderable, material);
}

Result<void> Scene::setVariant(Node copy, std::string_view variant) {
    const PublicCall call(mImpl, "Scene::setVariant(Node, string_view)");
    engine::CopyOfModel* const found = mImpl->copies.find(copy);
    return found ? engine::setVariant(*mImpl, *found, variant) : noVariants(*mImpl, copy, variant);
}

} // namespace filament_core
