// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Gltf.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/gltf/DetailLevels.h"
#include "filament_core/assets/gltf/GltfImageStore.h"
#include "filament_core/assets/gltf/ModelBounds.h"
#include "filament_core/engine/gltf/GltfMaterials.h"
#include "filament_core/engine/gltf/ModelUpload.h"
#include "filament_core/scene/OccluderMesh.h"
#include "filament_core/scene/VertexPositions.h"

#include <utility>

namespace filament_core {
namespace engine {

namespace {

assets::GltfBlocks blocksOn(Engine::Impl const& engine) {
    backend::DeviceFeatures const& features = engine.stream->info().features;
    if (!features.blockCompression) return assets::GltfBlocks::None;
    return features.exactSrgbBlocks ? assets::GltfBlocks::All : assets::GltfBlocks::Data;
}

} // namespace

assets::GltfOptions gltfOptions(Engine::Impl const& engine, GltfLoadOptions const& options) {
    assets::GltfOptions loaderOptions{
        .storage = { options.positions, options.tangents },
        .deformation = options.deformable ? assets::GltfDeformation::Kept : assets::GltfDeformation::AtRest,
        .levels = options.allLevels ? assets::GltfLevels::All : assets::GltfLevels::Finest,
        .normals = options.normalMapRoughness ? assets::GltfNormals::WithVariance : assets::GltfNormals::Plain,
        .blocks = options.compressedTextures ? blocksOn(engine) : assets::GltfBlocks::None,
        .simplifies = options.simplified,
        .files = options.filesFromAnywhere ? assets::FilesFrom::Anywhere : assets::FilesFrom::Folder
    };
    if (options.textureBudgetMegabytes > 0) {
        loaderOptions.streams = std::make_shared<assets::GltfImageStore>();
        loaderOptions.streams->budgetMegabytes = options.textureBudgetMegabytes;
    }
    if (options.progress) {
        loaderOptions.progress = [progress = options.progress](assets::GltfStage stage, size_t done, size_t total) {
            progress(stage == assets::GltfStage::Structure ? "reading" : "decoding", done, total);
        };
    }
    return loaderOptions;
}

assets::GltfOptions gltfOptions(Engine::Impl const& engine, GltfMemory const& model, GltfLoadOptions const& options) {
    assets::GltfOptions loaderOptions = gltfOptions(engine, options);
    loaderOptions.name = model.name;
    loaderOptions.resolve = model.resolve;
    if (!loaderOptions.resolve) {
        loaderOptions.resolve = [](std::string_view uri) -> Result<std::vector<std::byte>> {
            return fail(ErrorCode::NotFound, "'{}' is not in the file; give its bytes by GltfMemory::resolve",
                        uri.substr(0, 80));
        };
    }
    return loaderOptions;
}

namespace {

/// Deformed geometry moves away from its triangles.
Occluder occluderOf(assets::PrimitiveData const& primitive, uint32_t firstIndex, uint32_t indexCount) {
    const bool isRigid = !primitive.isSkinned && primitive.morphTargets.empty();
    if (!isRigid || primitive.topology != backend::PrimitiveType::Triangles) return {};
    const size_t bytes = primitive.indexFormat == backend::IndexFormat::UInt16 ? 2 : 4;
    const std::span<const std::byte> indices = primitive.indices;
    return scene::occluderOf(primitive.layout, primitive.vertices, primitive.indexFormat,
                             indices.subspan(firstIndex * bytes, indexCount * bytes));
}

scene::UvDensity uvDensityOf(assets::PrimitiveData const& primitive) {
    return scene::uvDensityOf({ primitive.layout, primitive.topology }, primitive.vertices, primitive.indexFormat,
                              primitive.indices);
}

ReadModel::Shape shapeOf(assets::PrimitiveData& primitive, bool simplifies) {
    ReadModel::Shape shape{ .bounds = scene::boundsOf(primitive.layout, primitive.vertices),
                            .occluder = occluderOf(primitive, 0, primitive.indexCount) };
    if (!simplifies) return shape;
    for (assets::DetailLevel const& level : assets::addDetailLevels(primitive))
        shape.levels.push_back({ level.firstIndex, level.indexCount, level.error,
                                 occluderOf(primitive, level.firstIndex, level.indexCount) });
    return shape;
}

/// What an upload would otherwise compute between frames.
void prepareUpload(ReadModel& model, jobs::JobSystem& jobs, assets::GltfOptions const& options,
                   GltfMaterialChoice const& choice) {
    if (model.data.imageBasedLight) model.light = assets::environmentFromCube(model.data.imageBasedLight->light, jobs);
    model.materials = readMaterials(model.data, choice, jobs);
    model.hasSections = choice.sectionPlanes;
    model.bounds = assets::boundsOf(model.data);
    std::vector<assets::MeshData>& meshes = model.data.meshes;
    model.shapes.resize(meshes.size());
    const auto isCancelled = [&] { return options.cancellation && options.cancellation->isRequested(); };
    // Simplifying a mesh takes far longer than the rest.
    const size_t meshesOfJob = options.simplifies ? 1 : 8;
    jobs::parallelFor<"shapes">(jobs, meshes.size(), meshesOfJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            for (assets::PrimitiveData& primitive : meshes[i].primitives) {
                model.shapes[i].push_back(shapeOf(primitive, options.simplifies && !isCancelled()));
                if (options.streams) model.shapes[i].back().uvDensity = uvDensityOf(primitive);
            }
    });
}

Result<ReadModel> prepared(Result<assets::ModelData> data, jobs::JobSystem& jobs, assets::GltfOptions const& options,
                           GltfMaterialChoice const& choice) {
    if (!data) return data.error();
    ReadModel model;
    model.data = std::move(*data);
    model.images = options.streams;
    if (options.cancellation && options.cancellation->isRequested()) return model; // it is discarded
    prepareUpload(model, jobs, options, choice);
    return model;
}

} // namespace

Model::Impl::Source sourceAt(std::filesystem::path const& path, assets::FilesFrom files) {
    std::error_code failed;
    Model::Impl::Source source{ .path = std::filesystem::absolute(path, failed), .files = files };
    if (!failed) source.bytes = std::filesystem::file_size(path, failed);
    if (!failed) source.changedAt = std::filesystem::last_write_time(path, failed).time_since_epoch().count();
    if (failed) source.path.clear();
    return source;
}

Result<ReadModel> readModel(std::filesystem::path const& path, jobs::JobSystem& jobs,
                            assets::GltfOptions const& options, GltfMaterialChoice const& choice) {
    Model::Impl::Source source = sourceAt(path, options.files); // first: a later change is noticed
    Result<ReadModel> read = prepared(assets::loadGltf(path, jobs, options), jobs, options, choice);
    if (read) read->source = std::move(source);
    return read;
}

Result<ReadModel> readModel(std::span<const std::byte> file, jobs::JobSystem& jobs, assets::GltfOptions const& options,
                            GltfMaterialChoice const& choice) {
    return prepared(assets::loadGltfFromMemory(file, {}, jobs, options), jobs, options, choice);
}

} // namespace engine

namespace {

/// All steps at once.
Result<Model> upload(Engine::Impl& engine, Result<engine::ReadModel> read) {
    if (!read) return read.error();
    engine::ModelUpload upload(engine, std::move(*read));
    for (size_t i = 0; i < upload.stepCount(); ++i) upload.step(i);
    Model model(upload.finish());
    engine.flush(); // the driver thread uploads while the caller continues
    return model;
}

} // namespace

Result<Model> loadGltf(Engine& engine, std::filesystem::path const& path, GltfLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadGltf(Engine, path)", path.native());
    return orOutOfMemory("glTF", path.native(), [&] {
        Engine::Impl& impl = engine.impl();
        return upload(impl, engine::readModel(path, impl.jobs, engine::gltfOptions(impl, options),
                                              GltfMaterials::choiceOf(impl, options.sectionPlanes)));
    });
}

Result<Model> loadGltf(Engine& engine, GltfMemory const& model, GltfLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadGltf(Engine, GltfMemory)", model.name);
    return orOutOfMemory("glTF", model.name, [&] {
        Engine::Impl& impl = engine.impl();
        return upload(impl, engine::readModel(model.file, impl.jobs, engine::gltfOptions(impl, model, options),
                                              GltfMaterials::choiceOf(impl, options.sectionPlanes)));
    });
}

} // namespace filament_core
