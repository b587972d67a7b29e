// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/ScenePasses.h"

#include "base/Suggest.h"
#include "toolkit/materials/MaterialFile.h"

namespace filament_core::tools {

Result<ScenePasses> ScenePasses::make(Engine& engine, std::filesystem::path const& folder,
                                      std::span<const SceneFilePass> passes) {
    ScenePasses made;
    for (SceneFilePass const& pass : passes) {
        if (Result<void> added = made.add(engine, folder, pass); !added) return added.error();
    }
    return made;
}

Result<void> ScenePasses::add(Engine& engine, std::filesystem::path const& folder, SceneFilePass const& pass) {
    const Result<std::shared_ptr<const MaterialFile>> file = readMaterialFile(folder / pass.material);
    if (!file) return file.error();
    shader::MaterialPackage const& package = (*file)->package;
    Result<std::vector<MaterialConstant>> constants = materialConstants(package, pass.values);
    if (!constants) return constants.error();
    Result<Material> material =
            engine.create(MaterialDesc{ .package = (*file)->bytes, .constants = std::move(*constants) });
    if (!material) return material.error();
    mMaterials.push_back(engine.own(*material));
    mInstances.push_back(engine.own(engine.createInstance(*material, (*file)->name)));
    const MaterialInstance instance = mInstances.back();
    for (auto const& [name, words] : pass.values) {
        shader::Parameter const* parameter = package.findParameter(name);
        if (!parameter && package.findConstant(name)) continue;
        if (!parameter)
            return fail(ErrorCode::NotFound, "material '{}' has no parameter or constant '{}'{}", (*file)->name, name,
                        suggestion(name, namesOf(package.parameters)));
        if (!shader::isTexture(parameter->type)) {
            if (Result<void> set = setMaterialValue(engine, instance, *parameter, words); !set) return set;
            continue;
        }
        Result<MaterialPicture> picture = makeMaterialPicture(engine, words);
        if (!picture) return picture.error();
        mPictures.push_back(std::move(*picture));
        Result<void> set = engine.set(instance, name, mPictures.back().texture, mPictures.back().sampler);
        if (!set) return set;
    }
    mPasses.push_back({ instance, pass.place });
    return {};
}

} // namespace filament_core::tools
