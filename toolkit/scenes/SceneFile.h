// SPDX-License-Identifier: Apache-2.0
/// SceneSpec: one case of a scene file (<filament_core/SceneFile.h>) for the programs that compare images of scenes.
///   Features  a scene's "features" are named changes of the same file. Each is a separate case: "spheres/msaa" beside
///             "spheres".
///   Fails     as SceneFile; InvalidArgument: a scene without a model, or with several.
///   Thread    any; pure except for reading files.
#pragma once

#include "toolkit/json/JsonReader.h"
#include "toolkit/scenes/ScenePasses.h"

#include <filament_core/Camera.h>
#include <filament_core/DebugDraw.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Light.h>
#include <filament_core/Scene.h>
#include <filament_core/SceneFile.h>
#include <filament_core/SkyDesc.h>
#include <filament_core/View.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::tools {

using ComparatorKind = ImageComparator;
using Comparator = SceneFileComparison;
using ProbeSpec = SceneFileProbe;
using GridSpec = SceneFileGrid;
using CopyRaster = SceneFileRaster;

/// The image of a light.
struct LightImageFile {
    std::filesystem::path file{}; ///< as the scene names it; empty: none
    LightImageShape shape = LightImageShape::Projected;
    friend bool operator==(LightImageFile const&, LightImageFile const&) = default;
};

/// Values by name, as words: "0.5", "1,0,0.2".
using NamedWords = std::vector<std::pair<std::string, std::string>>;

/// A view over the image: of the same scene, in a part of it.
struct OverlaySpec {
    View view{}; ///< without its camera
    double3 eye{ 0, 0, 1 }, at{ 0 };
    Lens lens{ .verticalFovDegrees = 40 };
};

struct SceneSpec {
    std::string name;                        ///< "spheres" or "spheres/msaa"
    std::string modelPath;                   ///< a path, or "asset:PATH" below the asset folder
    std::shared_ptr<const Json> modelObject; ///< instead of a path: objects to build, or a material
    std::filesystem::path folder;            ///< folder of the scene file: paths are relative to it
    std::string environment;                 ///< "sky", "asset:...", a path; empty: that of the model, if it has one
    std::optional<SkyDesc> sky{};            ///< in place of a file
    EnvironmentSettings environmentSettings{};
    EnvironmentLoadOptions environmentOptions{ .faceSize = 64, .samples = 128 };
    std::vector<ProbeSpec> probes;
    std::vector<GridSpec> grids;
    GltfLoadOptions modelOptions{};
    std::optional<double> animationSeconds; ///< none: the rest pose
    uint32_t animation = 0;                 ///< index in the file
    std::vector<LightDesc> lights;
    std::vector<std::string> lightProfiles;  ///< of each light: a photometric file, named as models are; empty: none
    std::vector<LightImageFile> lightImages; ///< of each light; without a file: none
    std::vector<double4x4> copies;           ///< transforms of the model; never empty
    std::vector<LightChannels> copyChannels; ///< one for each copy; missing ones are the default
    std::vector<Layers> copyLayers;          ///< of each copy
    std::vector<DrawOrder> copyPlaces;       ///< of each copy
    std::vector<NamedWords> copyValues;      ///< of each copy: parameters of a material that differ from the model's
    std::vector<CopyRaster> copyRasters;     ///< of each copy: raster states of a material
    std::vector<double3> copyMoves;          ///< of each copy: metres a frame; in the last one it is in its place
    double3 cameraMoves{ 0.0 };              ///< metres per frame
    double secondsPerFrame = 0;              ///< of the view's time and of the animation
    double3 origin{ 0.0 };                   ///< of everything: model, lights, camera
    std::optional<double3> eye;              ///< none: a place from which the whole model is visible
    double3 at{ 0.0 };
    Lens lens{ .verticalFovDegrees = 40 };
    Exposure exposure{};
    View view{};                       ///< without its camera
    uint2 target{ 0 };                 ///< pixels of the target that the view is a part of; 0: its size
    std::vector<OverlaySpec> overlays; ///< over the last frame, in this order
    DebugDraw debugDraw;               ///< over all frames
    std::filesystem::path dirt;        ///< an image for Bloom::dirt; empty: none
    std::vector<SceneFilePass> passes; ///< View::postProcess
    bool linear = false;               ///< scene-linear half floats: no tone mapping
    uint32_t frames = 1;               ///< frames drawn, including the one that is compared
    Comparator comparator{};
    std::vector<std::string> kills; ///< mutations that this case must detect
};

/// A scene as a case. Files of looks are read.
Result<SceneSpec> specOf(SceneFile const& file);

/// The cases of one file: the scene itself, then its features in order.
Result<std::vector<SceneSpec>> readSceneFile(std::filesystem::path const& file);

/// All cases of all .json files of a folder (not its subfolders), ascending by name.
Result<std::vector<SceneSpec>> readScenes(std::filesystem::path const& folder);

} // namespace filament_core::tools
