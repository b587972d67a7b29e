// SPDX-License-Identifier: Apache-2.0
// The materials of renderables: set one by one, or by the variants of their model.
#include "filament_core/assets/gltf/ModelVariants.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"

#include <algorithm>

namespace filament {

using engine::PublicCall;

namespace {

constexpr uint32_t kNoVariant = ~0u;

MaterialInstance materialIn(Model::Impl::PartRenderable const& part, uint32_t variant) {
    const auto found = std::ranges::find(part.variants, variant, &Model::Impl::PartVariant::variant);
    return found == part.variants.end() ? part.desc.material : found->material;
}

} // namespace

void Scene::setMaterial(Renderable renderable, MaterialInstance material) {
    const PublicCall call(mImpl, "Scene::setMaterial(Renderable, MaterialInstance)");
    scene::Renderables& renderables = mImpl->changedUses().renderables;
    scene::MaterialInstance const& instance = mImpl->engine.instances.get(material);
    const uint32_t drawable = renderables.drawable[renderables.index.at(renderable)];
    const uint32_t layout = renderables.drawables[drawable].geometry.layout;
    engine::requireAttributes(*instance.material, mImpl->engine.layouts[layout].vertices);
    scene::setMaterial(renderables, renderable, instance);
}

Result<void> Scene::setVariant(Node copy, std::string_view variant) {
    const PublicCall call(mImpl, "Scene::setVariant(Node, string_view)");
    std::string const& name = mImpl->data.transforms.name(copy);
    engine::CopyOfModel* const found = mImpl->copies.find(copy);
    if (!found || found->model->variants.empty()) {
        return fail(ErrorCode::InvalidArgument,
                    "'{}' has no variants, so there is no '{}'; give the root of a model with KHR_materials_variants",
                    name, variant);
    }
    Model::Impl const& model = *found->model;
    uint32_t index = kNoVariant;
    if (!variant.empty()) {
        const Result<uint32_t> known = assets::findVariant(model.variants, variant, model.name);
        if (!known) return known.error();
        index = *known;
    }
    for (size_t i = 0; i < found->renderables.size(); ++i) {
        const Renderable renderable = found->renderables[i];
        if (mImpl->data.renderables.index.contains(renderable))
            setMaterial(renderable, found->shown(materialIn(model.renderables[i], index)));
    }
    found->variant = variant;
    return {};
}

} // namespace filament
