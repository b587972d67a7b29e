// SPDX-License-Identifier: Apache-2.0
/// buildScene: what a scene file shows, as objects of an engine.
///     Result<BuiltScene> built = buildScene(engine, *file);
///     Renderer renderer(engine);
///     Result<Image> image = renderer.renderToImage(built->scene, built->view);
///   Loads   its models, environments, light profiles, images and grids, one after the other.
///   Fails   errors of the loaders, with the name of the scene; InvalidArgument: more copies than a scene holds, or an
///           animation that the model does not have.
///   Thread  the app thread, which waits for the workers.
///   Life    the engine outlives the result.
#pragma once

#include <filament_core/Engine.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Scene.h>
#include <filament_core/SceneFile.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core {

enum class SceneFileKind : uint8_t { Model, Object, Environment, Profile, Image, Grid, Look };

/// What a scene file names where a file is meant.
struct SceneFileName {
    SceneFileKind kind = SceneFileKind::Model;
    std::string name{}; ///< of a file, as the scene says it; Object: the JSON text of SceneFileModel::object
};

struct SceneBuildOptions {
    std::filesystem::path assets{}; ///< the folder of names that begin with "asset:"; empty: there are none
    /// Gives the path of a file by its name, or nothing: then the name is a path from SceneFile::folder(), and an
    /// object is Unsupported. None: gives nothing.
    std::function<Result<std::optional<std::filesystem::path>>(SceneFileName const& name)> find{};
};

/// A scene, and what must live as long.
struct BuiltScene {
    std::vector<Model> models{};              ///< as in SceneFileContents::models
    std::optional<Environment> environment{}; ///< none: the first model's, if it has one
    std::vector<Environment> probes{};        ///< what the reflection probes see
    Owned<Texture> dirt{};                    ///< of View::effects
    std::unique_ptr<DebugDraw> debug{};       ///< of View::debugDraw
    Scene scene;                              ///< ends before all of these
    std::vector<std::vector<Node>> copies{};  ///< of each model, the roots of its copies
    View view{};                              ///< with its camera, as in the last frame
};

Result<BuiltScene> buildScene(Engine& engine, SceneFile const& file, SceneBuildOptions const& options = {});

} // namespace filament_core
