// SPDX-License-Identifier: Apache-2.0
/// SceneFile: a scene as a JSON file: models, environment, lights, camera, view and options. docs/scene-files.md
/// describes every key, docs/scene-file.schema.json is its JSON schema, and <filament_core/BuildScene.h> makes the
/// engine's objects.
///     Result<SceneFile> file = SceneFile::load("kitchen.json");
///     file->set("camera.eye", "[0, 1.6, 4]");
///     file->save("kitchen.json");
///   Keys    "camera.eye", "points[0].candela", "effects.fog.density": members of objects, and places in lists, from
///           0. A part of a key names an object or a list of the format only if there is one of that name; options keep
///           their dots.
///   Kept    A file holds what the format knows, and nothing else: an unknown key is an error that names the nearest
///           known one. What is read, edited and saved keeps its order, its units and its numbers; blanks and line
///           breaks become those of save().
///   Version "version": 1; a file without it has version 1.
///   Paths   are relative to the folder of the file that was loaded. save() does not change them.
///   Fails   NotFound, Unreadable: the file, also over 64 MiB. Corrupt: no JSON, with the byte. Unsupported: a newer
///           version. InvalidArgument: file, key and what is valid there. A function that fails changes nothing.
///   Thread  any one at a time; reading functions also several at once.
///   Memory  the tree of the file, and its contents as values.
#pragma once

#include <filament_core/Camera.h>
#include <filament_core/DebugDraw.h>
#include <filament_core/IrradianceGrid.h>
#include <filament_core/Light.h>
#include <filament_core/LoadOptions.h>
#include <filament_core/Objects.h>
#include <filament_core/PostProcess.h>
#include <filament_core/ReflectionProbe.h>
#include <filament_core/Result.h>
#include <filament_core/SkyDesc.h>
#include <filament_core/Stencil.h>
#include <filament_core/View.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core {

/// Raster states that differ from those of a material; none: as the material says.
struct SceneFileRaster {
    std::optional<bool> colorWrite{}, depthWrite{}, depthCulling{};
    std::optional<StencilState> stencil{};
    bool isUsed() const { return colorWrite || depthWrite || depthCulling || stencil; }
};

/// One place of a model.
struct SceneFileCopy {
    double4x4 worldFromModel{ 1.0 };
    bool isFitted = false; ///< first the centre of the model moves to the origin, its largest dimension becomes 1 m
    double3 metersPerFrame{ 0 }; ///< how it moves; in the last frame it is in its place
    LightChannels lightChannels = kDefaultLightChannels;
    Layers layers = kDefaultLayers;
    DrawOrder drawOrder{};
    /// Parameters of a material that differ from the model's, by name, as words: "0.5", "1,0,0.2".
    std::vector<std::pair<std::string, std::string>> values{};
    SceneFileRaster raster{};
};

struct SceneFileModel {
    std::string file{};   ///< as the scene names it; empty: see `object`
    std::string object{}; ///< in the place of a file: a JSON object that a program understands
    GltfLoadOptions options{};
    std::string variant{};                    ///< of KHR_materials_variants; empty: the materials of the file
    std::optional<double> animationSeconds{}; ///< none: the rest pose
    uint32_t animation = 0;                   ///< its place in the file
    std::vector<SceneFileCopy> copies{ SceneFileCopy{} }; ///< one at least
};

struct SceneFileEnvironment {
    std::string file{};           ///< as the scene names it; empty: that of the first model, if it brings one
    std::optional<SkyDesc> sky{}; ///< in the place of a file
    EnvironmentSettings settings{};
    EnvironmentLoadOptions options{ .faceSize = 64, .samples = 128 };
};

struct SceneFileLight {
    LightDesc light{};                                       ///< without its profile and images
    std::string profile{};                                   ///< a photometric file of a point or spot; empty: none
    std::string image{};                                     ///< of a cookie, or of a rectangle; empty: none
    LightImageShape imageShape = LightImageShape::Projected; ///< of `image`
};

struct SceneFileProbe {
    ReflectionProbeDesc place{}; ///< without its light
    std::string file{};          ///< named as an environment's; empty: captured in the scene
};

struct SceneFileGrid {
    IrradianceGridDesc grid{}; ///< without its probes where `file` has them
    std::string file{};        ///< that filament-bake wrote; empty: `grid` has the probes
};

/// How a camera stands: in metres, in the space of SceneFileContents::origin.
struct SceneFileCamera {
    std::optional<double3> eye{}; ///< none: a place from which the whole scene is visible
    double3 at{ 0.0 };            ///< what it looks at
    double3 up{ 0, 1, 0 };        ///< any length except zero
    double3 metersPerFrame{ 0 };  ///< how it moves; in the last frame it is in its place
    Lens lens{ .verticalFovDegrees = 40 };
};

/// A pass of the app over the picture: View::postProcess.
struct SceneFilePass {
    std::string material{}; ///< of domain postprocess, as the scene names it
    PassPlace place = PassPlace::BeforeToneMapping;
    /// Parameters and constants by name, as words: "0.5", "1,0,0.2"; textures by the names of the program.
    std::vector<std::pair<std::string, std::string>> values{};
};

/// A view over the image: of the same scene, in a part of it.
struct SceneFileOverlay {
    View view{}; ///< without its camera
    SceneFileCamera camera{};
};

/// How closely two images of the scene must agree, for programs that compare them.
enum class ImageComparator : uint8_t { Bits, Tolerance, Flip };
template <>
struct EnumNames<ImageComparator> {
    static constexpr std::array<std::string_view, 3> values{ "bits", "tolerance", "flip" };
};
struct SceneFileComparison {
    ImageComparator kind = ImageComparator::Bits;
    uint32_t tolerance = 2;                ///< Tolerance: in 1/255, every component of every pixel
    double flipMean = 0.01, flipP99 = 0.1; ///< Flip: upper bounds, [0, 1]
    std::vector<std::string> kills{};      ///< defects that the comparison must detect
};

/// What a scene file says, as values. Units and ranges are those of the members' types.
struct SceneFileContents {
    std::string description{}; ///< for readers
    std::vector<SceneFileModel> models{};
    SceneFileEnvironment environment{};
    std::vector<SceneFileLight> lights{};
    std::vector<SceneFileProbe> probes{};
    std::vector<SceneFileGrid> grids{};
    double3 origin{ 0.0 }; ///< metres: of everything in the scene
    SceneFileCamera camera{};
    Exposure exposure{};
    View view{};                              ///< without its camera, its look and the dirt of its lens
    std::string look{};                       ///< a .cube file; empty: none
    std::string dirt{};                       ///< an image for Bloom::dirt; empty: none
    uint2 target{ 0 };                        ///< pixels of the target that the view is a part of; 0: its size
    std::vector<SceneFilePass> passes{};      ///< over the picture of the view, in this order
    std::vector<SceneFileOverlay> overlays{}; ///< over the last frame, in this order
    DebugDraw debug{};                        ///< over all frames
    bool isLinear = false;                    ///< scene-linear half floats: no tone mapping
    uint32_t frames = 1;                      ///< [1, 64]
    double secondsPerFrame = 0;               ///< of the view's time and of the animation
    SceneFileComparison comparison{};
};

class SceneFile {
public:
    static constexpr uint32_t kVersion = 1;

    SceneFile(); ///< an empty scene
    static Result<SceneFile> load(std::filesystem::path const& file);
    /// `name` begins the messages; relative paths start at `folder`.
    static Result<SceneFile> parse(std::string_view text, std::string_view name = "scene",
                                   std::filesystem::path const& folder = {});
    /// Replaces the file in one step, so that an error leaves what was there.
    Result<void> save(std::filesystem::path const& file) const;
    std::string text() const; ///< what save() writes

    std::string const& name() const;             ///< of the file without its ending; of a variant "mask/msaa"
    std::filesystem::path const& folder() const; ///< where relative paths start
    SceneFileContents const& contents() const;   ///< valid until the file changes

    /// The value of a key as JSON; nothing if the file does not have it.
    std::optional<std::string> get(std::string_view key) const;
    /// `value` is JSON, or words as on command lines: "on", "0,1.6,4", "kitchen.glb". Missing objects are made; the
    /// place behind the last one of a list appends to it. InvalidArgument if the file would not be valid then.
    Result<void> set(std::string_view key, std::string_view value);
    /// Removes a key or an element of a list. NotFound if the file does not have it.
    Result<void> erase(std::string_view key);

    Result<void> add(LightDesc const& light); ///< without profiles and images: set() names their files
    Result<void> setCamera(Camera const& camera);
    /// Size, samples, options, clear colour, layers, quality and effects; only what differs from the defaults of a
    /// scene file is written. Camera, viewport, materialGlobals and what is no plain value stay as they are.
    Result<void> setView(View const& view);

    /// The named changes of the scene ("features"), in the order of the file.
    std::vector<std::string> featureNames() const;
    /// The scene with one of them applied (RFC 7396, JSON merge patch), without features and without "kills" of its
    /// own. NotFound names those that there are.
    Result<SceneFile> feature(std::string_view name) const;

    /// The JSON schema (draft 2020-12) of all scene files, made of what load() reads.
    static std::string schema();

    /// The same members with the same values, in any order.
    friend bool operator==(SceneFile const& a, SceneFile const& b);

private:
    struct Tree;
    explicit SceneFile(std::shared_ptr<const Tree> tree) : mTree(std::move(tree)) {}
    std::shared_ptr<const Tree> mTree; ///< never changes; copies share it
};

} // namespace filament_core
