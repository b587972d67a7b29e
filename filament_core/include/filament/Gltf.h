// SPDX-License-Identifier: Apache-2.0
/// loadGltf: a .gltf or .glb file as engine objects, decoded and uploaded by the workers.
///   Errors  NotFound, Unreadable, Corrupt, Unsupported: file, element (accessors[3], images[0]) and reason in one
///   line. Life    the Model owns its buffers, textures and materials; it must outlive the scenes it was added to.
#pragma once

#include <filament/Engine.h>
#include <filament/Scene.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace filament {

/// Stage name, steps done, steps in total. From the loading thread or a worker, never from two at once.
using LoadProgress = std::function<void(std::string_view stage, size_t done, size_t total)>;

struct GltfLoadOptions {
    PositionStorage positions = PositionStorage::AsAuthored;
    TangentStorage tangents = TangentStorage::Snorm16;
    LoadProgress progress{};
};

class Model {
public:
    Model(Model&&) noexcept;
    Model& operator=(Model&&) noexcept;
    ~Model();

    std::string const& name() const;
    Box bounds() const; ///< of all parts, in model space
    size_t renderableCount() const;
    std::vector<std::string> const& warnings() const; ///< unsupported extensions, repaired values

    struct Impl;
    Impl const& impl() const { return *mImpl; }
    explicit Model(std::unique_ptr<Impl> impl);

private:
    std::unique_ptr<Impl> mImpl;
};

Result<Model> loadGltf(Engine& engine, std::filesystem::path const& path, GltfLoadOptions const& options = {});

} // namespace filament
