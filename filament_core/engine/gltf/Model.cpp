// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Gltf.h>

#include "base/Suggest.h"
#include "filament_core/engine/gltf/ModelParts.h"

#include <utility>

namespace filament_core {

using engine::PublicCall;

Model::Impl::~Impl() {
    if (!link.isAlive()) return;
    Engine& owner = Engine::of(engine);
    const auto destroyAll = [&](auto const& objects) {
        for (auto object : objects) owner.destroy(object);
    };
    destroyAll(instances);
    destroyAll(materials);
    destroyAll(morphTargets);
    destroyAll(vertexBuffers);
    destroyAll(indexBuffers);
    destroyAll(textures);
    destroyAll(profiles);
    destroyAll(lightImages);
}

std::shared_ptr<const Model::Impl> engine::shareOf(Model const& model, Engine::Impl const& engine) {
    std::shared_ptr<const Model::Impl> shared = model.share();
    if (!shared) misused("the model was moved from; use the one that it was moved to");
    requireSame(engine, shared->engine, "model");
    return shared;
}

std::string const& Model::name() const {
    const PublicCall call(mImpl, "Model::name()");
    return mImpl->name;
}
Box Model::bounds() const {
    const PublicCall call(mImpl, "Model::bounds()");
    return mImpl->bounds;
}
Environment const* Model::environment() const {
    const PublicCall call(mImpl, "Model::environment()");
    return mImpl->environment ? &*mImpl->environment : nullptr;
}
size_t Model::renderableCount() const {
    const PublicCall call(mImpl, "Model::renderableCount()");
    return mImpl->renderables.size();
}
std::vector<std::string> const& Model::variantNames() const {
    const PublicCall call(mImpl, "Model::variantNames()");
    return mImpl->variants;
}
std::vector<std::string> const& Model::warnings() const {
    const PublicCall call(mImpl, "Model::warnings()");
    return mImpl->warnings;
}
uint32_t Model::animationCount() const {
    const PublicCall call(mImpl, "Model::animationCount()");
    return static_cast<uint32_t>(mImpl->animations.size());
}

std::string const& Model::animationName(uint32_t animation) const {
    const PublicCall call(mImpl, "Model::animationName(uint32_t)");
    FILAMENT_ASSERT(animation < animationCount(), "an animation is one of the model's");
    return mImpl->animations[animation].name;
}

double Model::animationSeconds(uint32_t animation) const {
    const PublicCall call(mImpl, "Model::animationSeconds(uint32_t)");
    FILAMENT_ASSERT(animation < animationCount(), "an animation is one of the model's");
    return mImpl->animations[animation].durationSeconds;
}

Result<uint32_t> Model::findAnimation(std::string_view name) const {
    const PublicCall call(mImpl, "Model::findAnimation(string_view)");
    std::vector<std::string_view> names;
    for (assets::AnimationData const& animation : mImpl->animations) {
        if (animation.name == name) return static_cast<uint32_t>(names.size());
        names.push_back(animation.name);
    }
    if (names.empty()) return fail(ErrorCode::NotFound, "{} has no animations, so there is no '{}'", mImpl->name, name);
    std::string known;
    for (const std::string_view other : names) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", other);
    return fail(ErrorCode::NotFound, "{} has no animation '{}' among {}{}", mImpl->name, name, known,
                suggestion(name, names));
}

} // namespace filament_core
