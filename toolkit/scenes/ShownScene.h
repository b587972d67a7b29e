// SPDX-License-Identifier: Apache-2.0
/// SceneLoader: what a scene file shows, on an engine: its model or material, its environment and its lights, placed in
/// a Scene.
///   In      the scene, and how its files are loaded.   Out: a ShownScene, without view and camera.
///   Memory  loaded files are kept for the next scene that needs them: Keep.
///   Thread  that of the engine, which outlives the loader and all that it shows.
///   Fails   errors of the loaders; InvalidArgument for more copies than a scene holds. For a missing asset see
///           missingFile().
#pragma once

#include "toolkit/scenes/MaterialModel.h"
#include "toolkit/scenes/SceneAssets.h"

#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Scene.h>

#include <map>
#include <memory>
#include <vector>

namespace filament_core::tools {

/// A scene, and what must live as long.
struct ShownScene {
    std::shared_ptr<Model> model{};             ///< or
    std::shared_ptr<MaterialStand> material{};  ///< where the scene's model is a material
    std::shared_ptr<Environment> environment{}; ///< none: the model's, if it has one
    std::vector<std::shared_ptr<Environment>> probes{};
    Scene scene; ///< ends before model, environment and probes
    std::vector<Node> copies{};
};

class SceneLoader {
public:
    enum class Keep : uint8_t {
        Last, ///< one model and one environment: features of a scene load nothing again
        All,  ///< until forgetUnusual()
    };
    SceneLoader(Engine& engine, SceneFolders folders, Keep keep);

    Result<ShownScene> show(SceneSpec const& spec, GltfLoadOptions const& modelOptions,
                            EnvironmentLoadOptions const& environmentOptions);
    /// Drops files that nothing shows and that were loaded with special options: a cube of 2048 takes half a gigabyte.
    void forgetUnusual();

private:
    template <class T>
    struct Loaded {
        std::shared_ptr<T> file;
        bool isUsual = true; ///< with the default options
    };
    template <class T>
    using Files = std::map<std::string, Loaded<T>>; ///< by path and options
    template <class T, class Options, class Load>
    Result<std::shared_ptr<T>> load(Files<T>& files, std::filesystem::path const& path, Options const& options,
                                    Load const& loadFile);
    Result<void> loadModel(ShownScene& shown, SceneSpec const& spec, GltfLoadOptions const& options);
    Result<void> loadSky(ShownScene& shown, SceneSpec const& spec, EnvironmentLoadOptions const& options);
    Result<void> place(ShownScene& shown, SceneSpec const& spec);
    Result<void> placeModel(ShownScene& shown, SceneSpec const& spec);
    Result<void> addProbes(ShownScene& shown, SceneSpec const& spec, EnvironmentLoadOptions const& options);

    Engine& mEngine;
    const SceneFolders mFolders;
    const Keep mKeep;
    Files<Model> mModels;
    Files<Environment> mEnvironments;
};

} // namespace filament_core::tools
