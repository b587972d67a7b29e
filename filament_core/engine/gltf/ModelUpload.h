// SPDX-License-Identifier: Apache-2.0
/// A glTF file becomes a Model in two halves: readModel() decodes it, ModelUpload creates the engine's objects.
///   Thread  readModel(): any, beside frames. ModelUpload: the app thread.
///   Cost    ModelUpload copies no texels and no vertices, unpacks no material and visits no vertex: readModel() did.
///   Fails   readModel(): errors of GltfLoader.h. ModelUpload: std::bad_alloc, after which it can only be destroyed.
#pragma once

#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/engine/gltf/ReadMaterials.h"
#include "filament_core/scene/Deformations.h"
#include "filament_core/scene/UvDensity.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

namespace filament_core::engine {

struct ReadModel {
    assets::ModelData data;
    std::optional<assets::EnvironmentData> light; ///< the image-based light of `data`, baked
    GltfReadyMaterials materials;
    bool hasSections = false; ///< they are those with section planes
    Box bounds;               ///< assets::boundsOf(data)
    /// What follows from the vertices of a primitive.
    struct Shape {
        scene::MinMax bounds;                ///< scene::boundsOf()
        Occluder occluder;                   ///< scene::occluderOf()
        std::vector<GeometryLevel> levels{}; ///< assets::addDetailLevels()
        scene::UvDensity uvDensity{};        ///< of models whose textures are streamed
    };
    std::vector<std::vector<Shape>> shapes;               ///< by mesh and primitive
    std::shared_ptr<const assets::GltfImageStore> images; ///< of textures that are streamed; none: all are whole
    Model::Impl::Source source{};
};

/// What `path` is now. An empty path: the file cannot be asked for.
Model::Impl::Source sourceAt(std::filesystem::path const& path, assets::FilesFrom files);

/// Of the loader, with `progress` of the options. `engine`: the one that will draw the model.
assets::GltfOptions gltfOptions(Engine::Impl const& engine, GltfLoadOptions const& options);
/// The same for a model in memory: what its URIs name comes from the caller.
assets::GltfOptions gltfOptions(Engine::Impl const& engine, GltfMemory const& model, GltfLoadOptions const& options);

/// `choice`: of the engine that will draw it.
Result<ReadModel> readModel(std::filesystem::path const& path, jobs::JobSystem& jobs,
                            assets::GltfOptions const& options, GltfMaterialChoice const& choice);
Result<ReadModel> readModel(std::span<const std::byte> file, jobs::JobSystem& jobs, assets::GltfOptions const& options,
                            GltfMaterialChoice const& choice);

class ModelUpload {
public:
    ModelUpload(Engine::Impl& engine, ReadModel model);
    ~ModelUpload(); ///< destroys what was created, unless finish() was called

    size_t stepCount() const;
    /// Steps 0, 1, 2, ...: an image, a mesh, and the rest, each. Returns the bytes that it gave to the device.
    size_t step(size_t index);
    /// After all steps.
    std::unique_ptr<Model::Impl> finish();

private:
    class Builder;
    std::unique_ptr<Builder> mBuilder;
};

} // namespace filament_core::engine
