// SPDX-License-Identifier: Apache-2.0
/// Document: everything that filament-view shows, as a plain value: files, edits, animation, lights, the View. Panels
/// edit it and nothing else; a Stage draws it; saved frames keep it.
///   Order    the order of lists is that of the program's calls: it may change bits, as that of a scene does.
///   Edits    lie over what the file says. Without an edit the file's own value holds, so removing an edit undoes it.
///   Invalid  check() says what is out of range. A Stage refuses such documents and keeps the last one.
///   Thread   any.   Memory: what is listed; a shared Look is not part of it, but its path.
#pragma once

#include "base/Result.h"
#include "toolkit/program/SceneOptions.h"
#include "tools/view/document/CameraPath.h"

#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Light.h>
#include <filament_core/Objects.h>
#include <filament_core/View.h>

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace filament_core::view {

/// Of a spot, in radians: its outer cone at most, and the outer one beyond the inner one at least, where a hand sets
/// them.
inline constexpr float kMostCone = std::numbers::pi_v<float> / 2, kLeastCone = 0.001f;

struct DocumentModel {
    std::filesystem::path file{}; ///< .gltf, .glb, .mat or .fmat; empty: nothing
    GltfLoadOptions options{};    ///< without `progress`
    bool fit = true;              ///< centre of the bounding box at the origin, largest dimension 1 m
    std::string variant{};        ///< of KHR_materials_variants; empty: the materials of the file
};

struct DocumentEnvironment {
    std::filesystem::path file{};     ///< .hdr, .exr, .ktx2 or .fenv; empty: none
    bool prefersModels = true;        ///< the environment that the model's file brings, if it does, comes before `file`
    EnvironmentLoadOptions options{}; ///< without `progress`
    EnvironmentSettings settings{};
};

/// Of a node of the model's file.
struct NodeEdit {
    uint32_t node = 0;                         ///< its place in Stage::nodes()
    bool isVisible = true;                     ///< false: nor is what is below it
    std::optional<double4x4> parentFromNode{}; ///< affine; none: that of the file, or of the animation
};

/// Of all materials with this name, in this copy of the model. In a .mat file the material has the name of the file.
struct MaterialEdit {
    std::string material{}, parameter{};
    ParameterValue value = 0.0f;
};

/// An image in the place of a texture of all materials with this name, in this copy of the model. A glTF material
/// reads the maps that its file has; others are set and not seen.
struct TextureEdit {
    std::string material{}, parameter{};
    std::filesystem::path file{}; ///< as loadImage() takes it
    bool isData = false;          ///< numbers themselves, such as normals and roughness; false: colours
};

/// A light that the document adds, in the world. Its `profile` handle means nothing here: `profileFile` does.
struct DocumentLight {
    std::string name{};
    bool isOn = true;
    LightDesc light = PointLight{};
    std::filesystem::path profileFile{}; ///< .ies, of points and spots; empty: none
};

/// A reflection probe that the document adds, in the world, along its axes.
struct DocumentProbe {
    std::string name{};
    bool isOn = true;
    double3 centerWorld{ 0.0 };
    float3 halfExtentMeters{ 1.0f };
    float blendMeters = 0.25f;
    std::filesystem::path file{}; ///< what is seen from its middle, as an environment's; empty: it lights nothing yet
    float intensity = 1;          ///< candela / m2 of a texel of 1
    bool lightsDiffuse = true;
};

/// An irradiance grid that filament-bake wrote, in the world.
struct DocumentGrid {
    std::filesystem::path file{};
    bool isOn = true;
    float intensity = 1; ///< of what the file says
};

/// Of a light of the model's file.
struct ModelLightEdit {
    uint32_t light = 0; ///< its place in Stage::modelLights()
    bool isOn = true;
    std::optional<LightDesc>
            replacement{}; ///< in the space of its node; keeps the profile of the file. None: the file's
};

/// Of all morph targets with this name.
struct MorphEdit {
    std::string target{};
    float weight = 0; ///< finite
};

/// Stage uses `animation` and `seconds`; the others are for the program that moves the time: see advanced().
struct Playback {
    std::optional<uint32_t> animation{}; ///< index in the file; none: the rest pose
    double seconds = 0;                  ///< from its start; finite
    bool isPlaying = false;
    double speed = 1;  ///< seconds of the animation in a second, [-100, 100]
    bool loops = true; ///< false: it stops at its ends
};

struct Bookmark {
    std::string name{};
    Camera camera{};
};

struct Document {
    DocumentModel model{};
    DocumentEnvironment environment{};
    std::vector<NodeEdit> nodes{};         ///< one of a node
    std::vector<MaterialEdit> materials{}; ///< one of a parameter
    std::vector<TextureEdit> textures{};   ///< one of a parameter
    std::vector<DocumentLight> lights{};
    std::vector<DocumentProbe> probes{};
    std::vector<DocumentGrid> grids{};
    std::vector<ModelLightEdit> modelLights{}; ///< one of a light
    Playback playback{};
    std::vector<MorphEdit> morphs{}; ///< one of a target
    /// Without what is not a plain value: `look` and `dirt` below take the place of display.look and
    /// effects.bloom.dirt, and the caller sets viewport and debugDraw.
    View view{};
    std::filesystem::path look{}; ///< a .cube file; empty: none
    std::filesystem::path dirt{}; ///< .png or .jpg, of the lens (Bloom::dirt); empty: none
    std::vector<Bookmark> bookmarks{};
    std::vector<CameraPath> paths{};

    /// All that toJson() writes.
    friend bool operator==(Document const& a, Document const& b);
};

// Parts are equal if all of their fields are.
bool operator==(DocumentModel const& a, DocumentModel const& b);
bool operator==(DocumentEnvironment const& a, DocumentEnvironment const& b);
bool operator==(NodeEdit const& a, NodeEdit const& b);
bool operator==(MaterialEdit const& a, MaterialEdit const& b);
bool operator==(TextureEdit const& a, TextureEdit const& b);
bool operator==(DocumentLight const& a, DocumentLight const& b);
bool operator==(DocumentProbe const& a, DocumentProbe const& b);
bool operator==(DocumentGrid const& a, DocumentGrid const& b);
bool operator==(ModelLightEdit const& a, ModelLightEdit const& b);
bool operator==(MorphEdit const& a, MorphEdit const& b);
bool operator==(Playback const& a, Playback const& b);
bool operator==(Bookmark const& a, Bookmark const& b);
bool isEqual(EnvironmentSettings const& a, EnvironmentSettings const& b);
bool isEqual(Camera const& a, Camera const& b);
bool isEqual(LightDesc const& a, LightDesc const& b);

/// What filament-render would draw with these options. `model` and `environment` are the files that chooseFiles()
/// found for them.
Document makeDocument(tools::SceneOptions const& options, std::filesystem::path const& model,
                      std::filesystem::path const& environment);

/// InvalidArgument: the first field that is out of its range, and the range: "lights[0].light.illuminance: ...".
Result<void> check(Document const& document);

// ---- JSON: a version, then every field by the name of its member; units are those of the members.

std::string toJson(Document const& document);
/// A field that is absent has its default. Unsupported: another version, or over 64 MiB. Corrupt: `name`, the place
/// ("view.camera.lens.nearMeters") and what is expected there; unknown fields, too, with the nearest name. What is
/// returned passes check().
Result<Document> documentFromJson(std::string_view text, std::string_view name);
/// Replaces the file in one step: an error (a full disk) leaves what was there. Unreadable, with the path and the
/// reason.
Result<void> saveDocument(std::filesystem::path const& file, Document const& document);
Result<Document> loadDocument(std::filesystem::path const& file);

// ---- edits, for panels

/// The edit of the node; a new one without effect if there is none. Valid until the list changes.
NodeEdit& nodeEdit(Document& document, uint32_t node);
ModelLightEdit& modelLightEdit(Document& document, uint32_t light);
void setParameter(Document& document, std::string_view material, std::string_view parameter,
                  ParameterValue const& value);
/// Undoes setParameter().
void resetParameter(Document& document, std::string_view material, std::string_view parameter);
void setTexture(Document& document, std::string_view material, std::string_view parameter,
                std::filesystem::path const& file, bool isData);
void resetTexture(Document& document, std::string_view material, std::string_view parameter);
void setMorph(Document& document, std::string_view target, float weight);
/// Removes edits that change nothing.
void removeIdleEdits(Document& document);

/// The playback after `elapsedSeconds`, in an animation that takes `durationSeconds`; it stops or starts again at its
/// ends. Two steps give what one of both lengths gives, to rounding.
Playback advanced(Playback const& playback, double elapsedSeconds, double durationSeconds);

} // namespace filament_core::view
