// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/ScenePasses.h"

#include "base/Suggest.h"
#include "toolkit/materials/MaterialFile.h"

namespace filament_core::tools {
namespace {

constexpr std::string_view kDrawn = "drawn:";

} // namespace

Result<ScenePasses> ScenePasses::make(Engine& engine, std::filesystem::path const& folder,
                                      std::span<const SceneFilePass> passes) {
    ScenePasses made;
    for (SceneFilePass const& pass : passes) {
        const Result<MaterialInstance> instance = made.add(engine, folder / pass.material, pass.values);
        if (!instance) return instance.error();
        made.mPasses.push_back({ *instance, pass.place });
    }
    return made;
}

Result<MaterialInstance> ScenePasses::add(Engine& engine, std::filesystem::path const& path, Values values) {
    const Result<std::shared_ptr<const MaterialFile>> file = readMaterialFile(path);
    if (!file) return file.error();
    shader::MaterialPackage const& package = (*file)->package;
    Result<std::vector<MaterialConstant>> constants = materialConstants(package, { values.begin(), values.end() });
    if (!constants) return constants.error();
    Result<Material> material =
            engine.create(MaterialDesc{ .package = (*file)->bytes, .constants = std::move(*constants) });
    if (!material) return material.error();
    mMaterials.push_back(engine.own(*material));
    mInstances.push_back(engine.own(engine.createInstance(*material, (*file)->name)));
    const MaterialInstance instance = mInstances.back();
    for (auto const& [name, words] : values) {
        shader::Parameter const* parameter = package.findParameter(name);
        if (!parameter && package.findConstant(name)) continue;
        if (!parameter)
            return fail(ErrorCode::NotFound, "material '{}' has no parameter or constant '{}'{}", (*file)->name, name,
                        suggestion(name, namesOf(package.parameters)));
        if (!shader::isTexture(parameter->type)) {
            if (Result<void> set = setMaterialValue(engine, instance, *parameter, words); !set) return set.error();
            continue;
        }
        Result<MaterialPicture> made = picture(engine, path.parent_path(), words);
        if (!made) return made.error();
        mPictures.push_back(std::move(*made));
        Result<void> set = engine.set(instance, name, mPictures.back().texture, mPictures.back().sampler);
        if (!set) return set.error();
    }
    return instance;
}

Result<MaterialPicture> ScenePasses::picture(Engine& engine, std::filesystem::path const& folder,
                                             std::string const& name) {
    if (!name.starts_with(kDrawn)) return makeMaterialPicture(engine, name);
    return drawn(engine, folder / name.substr(kDrawn.size()));
}

Result<MaterialPicture> ScenePasses::drawn(Engine& engine, std::filesystem::path const& path) {
    const Result<DrawnTexture> file = readDrawnTexture(path);
    if (!file) return file.error();
    const size_t first = mPictures.size();
    std::vector<Texture> colors;
    for (uint32_t i = 0; i < file->colors; ++i) {
        mPictures.push_back({ .texture = engine.own(engine.create(TextureDesc{ .kind = file->kind,
                                                                               .format = file->format,
                                                                               .width = file->size,
                                                                               .height = file->size,
                                                                               .layers = file->layers,
                                                                               .levels = file->levels,
                                                                               .renderable = true,
                                                                               .name = path.filename() })) });
        colors.push_back(mPictures.back().texture);
    }
    for (DrawnPart const& part : file->draws) {
        const Result<MaterialInstance> material = add(engine, path.parent_path() / part.material, part.values);
        if (!material) return material.error();
        mTargets.push_back(engine.own(engine.create(RenderTargetDesc{ .color = colors[0],
                                                                      .level = part.level,
                                                                      .layer = part.layer,
                                                                      .others = { colors.begin() + 1, colors.end() },
                                                                      .name = path.filename() })));
        MeshPass pass{ .material = *material,
                       .contents = part.keeps ? TargetContents::Keep : TargetContents::Clear,
                       .keepsHoles = part.keepsHoles };
        pass.clearColors.fill(part.clear);
        mDraws.push_back({ mTargets.back(), pass, part.drawsMeshes, static_cast<Layers>(part.layers) });
    }
    MaterialPicture shown = std::move(mPictures[first + file->shown]);
    mPictures.erase(mPictures.begin() + static_cast<std::ptrdiff_t>(first + file->shown));
    shown.sampler = kUnfilteredSampler;
    shown.sampler.mipFilter = MipFilter::Nearest;
    return shown;
}

void ScenePasses::drawTextures(Renderer& renderer, Scene const& scene, View const& view) const {
    for (Draw const& draw : mDraws) {
        View seen = view;
        seen.visibleLayers = draw.layers;
        if (draw.drawsMeshes)
            renderer.render(scene, draw.pass, draw.target, seen);
        else
            renderer.render(draw.pass.material, draw.target, view);
    }
}

} // namespace filament_core::tools
