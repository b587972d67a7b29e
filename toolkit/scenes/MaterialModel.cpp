// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/MaterialModel.h"

#include "shaders/compiler/MaterialDefinition.h"
#include "toolkit/scenes/SceneAssets.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::tools {

namespace {

void applyRaster(Engine& engine, MaterialInstance instance, CopyRaster const& raster) {
    if (raster.colorWrite) engine.setColorWrite(instance, *raster.colorWrite);
    if (raster.depthWrite) engine.setDepthWrite(instance, *raster.depthWrite);
    if (raster.depthCulling) engine.setDepthCulling(instance, *raster.depthCulling);
    if (raster.stencil) engine.setStencil(instance, raster.stencil);
}

} // namespace

bool isMaterialModel(SceneSpec const& spec) { return spec.modelObject && spec.modelObject->contains("material"); }

Result<MaterialModelFile> readMaterialModel(SceneSpec const& spec) {
    std::string path;
    MaterialModelFile model;
    NamedWords edits;
    std::vector<std::string> filters;
    JsonReader reader(*spec.modelObject, spec.name + ": model");
    reader.read("material", path);
    reader.read("mesh", model.mesh);
    reader.read("edits", edits);
    reader.read("values", model.values);
    reader.read("variantFilter", filters);
    if (const Result<void> done = reader.finish(); !done) return done.error();
    const Result<uint16_t> filtered = shader::variantBitsOfFilters(filters);
    if (!filtered) return fail(filtered.error().code, "{}: model: {}", spec.name, filtered.error().message);
    Result<std::shared_ptr<const MaterialFile>> file = readMaterialFile(spec.folder / path, edits, *filtered);
    if (!file) return file.error();
    model.file = std::move(*file);
    return model;
}

Result<MaterialStand> makeMaterialModel(Engine& engine, SceneSpec const& spec) {
    const Result<MaterialModelFile> model = readMaterialModel(spec);
    if (!model) return model.error();
    return MaterialStand::make(engine, *model->file, model->values, model->mesh);
}

MaterialValues valuesOfCopy(MaterialModelFile const& model, SceneSpec const& spec, size_t copy) {
    MaterialValues values = model.file->show.values;
    const auto setAll = [&](MaterialValues const& more) {
        for (auto const& value : more) {
            std::erase_if(values, [&](auto const& old) { return old.first == value.first; });
            values.push_back(value);
        }
    };
    setAll(model.values);
    if (copy < spec.copyValues.size()) setAll(spec.copyValues[copy]);
    return values;
}

Result<std::vector<Node>> addMaterialCopies(Engine& engine, Scene& scene, SceneSpec const& spec, MaterialStand& stand) {
    const Result<MaterialModelFile> model = readMaterialModel(spec);
    if (!model) return model.error();
    const std::vector<double4x4> copies = placedCopies(spec);
    std::vector<Node> roots;
    for (size_t i = 0; i < copies.size(); ++i) {
        const LightChannels channels = i < spec.copyChannels.size() ? spec.copyChannels[i] : kDefaultLightChannels;
        MaterialInstance instance = stand.instance();
        const CopyRaster raster = i < spec.copyRasters.size() ? spec.copyRasters[i] : CopyRaster{};
        if (raster.isUsed() || (i < spec.copyValues.size() && !spec.copyValues[i].empty())) {
            const Result<MaterialInstance> other = stand.vary(engine, *model->file, valuesOfCopy(*model, spec, i));
            if (!other) return other.error();
            instance = *other;
            applyRaster(engine, instance, raster);
        }
        roots.push_back(stand.addTo(scene, copies[i], channels, instance));
    }
    return roots;
}

} // namespace filament_core::tools
