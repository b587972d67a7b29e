// SPDX-License-Identifier: Apache-2.0
/// loadGltf: a .gltf or .glb file as engine objects, decoded and uploaded by the workers. It returns when that is done;
/// loadGltfAsync() of <filament_core/LoadTicket.h> returns at once. By its ending a file may also be an .obj with its
/// .mtl, a .ply or an .stl (docs/gltf.md).
///   Errors  NotFound, Unreadable, Corrupt, Unsupported: one line with file, element (accessors[3], images[0]) and
///           reason.
///   Life    the Model owns its buffers, textures and materials; copies of it in scenes keep what they need of it.
#pragma once

#include <filament_core/Engine.h>
#include <filament_core/LoadOptions.h>
#include <filament_core/Scene.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core {

/// A model in memory, .glb or .gltf; or what the ending of `name` says: .obj, .ply, .stl.
struct GltfMemory {
    std::span<const std::byte> file{}; ///< not needed after the call; loadGltfAsync() copies it
    std::string name = "model";        ///< for Model::name() and messages
    /// Gives the bytes of what the file names by a relative URI (percent-decoded, "textures/wood.png"), or says why
    /// there are none. Called on the loading thread and on workers, also on several at once. None: files
    /// that hold everything, in their binary chunk or in data URIs.
    std::function<Result<std::vector<std::byte>>(std::string_view uri)> resolve{};
};

class Environment;

class Model {
public:
    Model(Model&&) noexcept = default;
    Model& operator=(Model&&) noexcept = default;

    std::string const& name() const;
    Box bounds() const; ///< of all parts in the rest pose, in model space
    size_t renderableCount() const;
    /// The names of KHR_materials_variants, for Scene::setVariant().
    std::vector<std::string> const& variantNames() const;
    /// The image-based light of the file's default scene (EXT_lights_image_based), with its rotation and intensity;
    /// null: it names none. Scene::add() leaves it alone: a scene has one environment, and the program chooses it. The
    /// project's programs take this one unless they are told another:
    ///     if (Environment const* light = model.environment())
    ///         scene.setEnvironment(*light, { .illuminance = Lux{ 30'000 } });
    /// As for every environment, EnvironmentSettings::illuminance says what radiance 1 stands for.
    Environment const* environment() const;
    std::vector<std::string> const& warnings() const; ///< unsupported extensions, repaired values

    // Animations are played by an Animator (<filament_core/Animator.h>).
    uint32_t animationCount() const;
    std::string const& animationName(uint32_t animation) const; ///< may be empty, need not be unique
    double animationSeconds(uint32_t animation) const;          ///< time of its last key
    /// The first animation with this name; NotFound lists the existing names.
    Result<uint32_t> findAnimation(std::string_view name) const;

    struct Impl;
    std::shared_ptr<const Impl> share() const { return mImpl; } ///< for the engine's own files
    explicit Model(std::shared_ptr<Impl> impl) : mImpl(std::move(impl)) {}

private:
    std::shared_ptr<Impl> mImpl; ///< copies in scenes and animators share it
};

Result<Model> loadGltf(Engine& engine, std::filesystem::path const& path, GltfLoadOptions const& options = {});
/// NotFound also for a URI without GltfMemory::resolve. GltfLoadOptions::filesFromAnywhere means nothing here.
Result<Model> loadGltf(Engine& engine, GltfMemory const& model, GltfLoadOptions const& options = {});

} // namespace filament_core
