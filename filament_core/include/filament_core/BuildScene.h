// SPDX-License-Identifier: Apache-2.0
/// buildScene: what a scene file shows, as objects of an engine.
///     Result<BuiltScene> built = buildScene(engine, *file);
///     Result<Image> image = renderFrames(engine, *built);
///   Frames  `view` is the last one; "moves", "frames", "secondsPerFrame" and "overlays" are in renderFrames() and
///           drawFrames().
///   Loads   its models, environments, light profiles, images and grids, one after the other.
///   Fails   errors of the loaders, with the name of the scene; InvalidArgument: more copies than a scene holds, or an
///           animation that the model does not have.
///   Thread  the app thread, which waits for the workers.
///   Life    the engine outlives the result.
#pragma once

#include <filament_core/Engine.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Image.h>
#include <filament_core/Renderer.h>
#include <filament_core/Scene.h>
#include <filament_core/SceneFile.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core {

enum class SceneFileKind : uint8_t { Model, Object, Environment, Profile, Image, Grid, Look, Pass };

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
    /// Gives the package of a material's text (.mat) that "postProcess" names. None: only packages of matc are passes.
    std::function<Result<std::vector<std::byte>>(std::filesystem::path const& file)> compile{};
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

    std::vector<View> overlays{};                         ///< over the last frame, with their cameras
    SceneFileContents contents{};                         ///< of the file
    Camera lastCamera{};                                  ///< of the last frame
    std::vector<std::vector<double4x4>> places{};         ///< of `copies` in the last frame
    std::vector<Owned<Material>> passMaterials{};         ///< of View::postProcess
    std::vector<Owned<MaterialInstance>> passInstances{}; ///< of View::postProcess
    std::vector<Owned<Texture>> passTextures{};           ///< of View::postProcess
    std::vector<PostProcessPass> passes{};                ///< of View::postProcess
};

/// Puts what moves where it is so many frames before the last one: copies, camera, animations, the view's time. 0: as
/// it was built.
void setFramesBack(BuiltScene& built, uint32_t framesBack);
/// All frames of the file, then its overlays; waits for streamed textures. The renderer should have drawn nothing
/// before, so that its effects over time see these frames alone. `target`: of SceneFileContents::target pixels, or, if
/// that is 0, as large as the view.
void drawFrames(Engine& engine, Renderer& renderer, BuiltScene& built, SwapChain target);
/// The same with a renderer and a target of its own: RGBA8, or RGBA16F of scene-linear light if the file is linear.
Result<Image> renderFrames(Engine& engine, BuiltScene& built);

Result<BuiltScene> buildScene(Engine& engine, SceneFile const& file, SceneBuildOptions const& options = {});

} // namespace filament_core
