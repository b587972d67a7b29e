// SPDX-License-Identifier: Apache-2.0
/// saveGltf: a scene as a glTF 2.0 file, .glb or .gltf with a .bin beside it, which every viewer can read.
///     const Result<SavedGltf> saved = saveGltf(scene, "kitchen.glb");
///     for (std::string const& warning : saved->warnings) log(warning);
///   Models  are read again from where they were loaded, and their parts are copied as they are: compressed meshes,
///           images, animations, skins, all extensions, extras. So the file loads with the same bits, by the same
///           GltfLoadOptions. What the program changed since is written over it: nodes, visibility, variants,
///           parameters of materials, lights, weights of morph targets; nodes and renderables that were removed are not
///           shown.
///   Meshes  that the program made are read back from the device, with their skins and morph targets and with the
///           frames of their vertices, and with their materials: the built-in ones, and of others the parameters that
///           have the same names.
///   Lights  are those of KHR_lights_punctual; the rest of their values, and areas, are in FILAMENT_light
///           (docs/gltf.md), which loadGltf() reads. Other programs show an area as a point or spot of its candelas.
///   Nodes   have the places of the scene in double precision: the digits of JSON keep millimetres 10^7 metres away for
///           loadGltf(), though other programs may round them to floats.
///   Lost    is what docs/gltf.md lists: each is a warning that names the object.
///   Fails   NotFound, Unreadable: the file of a model is gone, or the target cannot be written; nothing is left then,
///           and an old file stays. InvalidArgument: another ending; a model's file that changed since it was loaded; a
///           model from memory without GltfSaveOptions::source. Unsupported: a .glb beyond 4 GiB. OutOfMemory.
///   Thread  the app thread; waits for the device if meshes or textures are read back.
///   Memory  the files of the models, and twice the result.
#pragma once

#include <filament_core/Camera.h>
#include <filament_core/Gltf.h>
#include <filament_core/Scene.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

struct GltfCamera {
    std::string name{};
    Camera camera{}; ///< without its exposure, which glTF does not have
};

struct GltfSaveOptions {
    /// Gives the file of a model that was loaded from memory, by Model::name(); valid until saveGltf() returns. None:
    /// such models are an error.
    std::function<Result<GltfMemory>(std::string_view name)> source{};
    std::vector<GltfCamera> cameras{}; ///< beside those of the models
    std::string copyright{};           ///< asset.copyright, before those of the models
    /// What lights the scene, for readers: extras.environment of the scene. Empty: none. The image-based light of a
    /// model (EXT_lights_image_based) is written without it.
    std::string environment{};
};

struct SavedGltf {
    std::vector<std::string> warnings{}; ///< one line each: what the file does not have, and what to do about it
    uint64_t bytes = 0;                  ///< of all files that were written
};

/// The ending of `path` chooses: .glb is one file; .gltf has its data in a .bin of the same name beside it.
Result<SavedGltf> saveGltf(Scene const& scene, std::filesystem::path const& path, GltfSaveOptions const& options = {});

} // namespace filament_core
