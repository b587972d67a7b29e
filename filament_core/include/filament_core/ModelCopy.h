// SPDX-License-Identifier: Apache-2.0
/// ModelCopy: what one copy of a model in a scene consists of, by the names of its file, and what can be changed of it
/// without touching other copies.
///   In      the root that Scene::add(model) returned.
///   Names   are those of the file: they may be empty and need not be unique. A name stands for all that have
///           it, or the first one where only one is possible; NotFound lists similar names.
///   Out     existing parts: those that the program removed are omitted. Lists are new at every call.
///   Thread  the app thread, between frames.
///   Life    a plain value that refers to the scene, which may be moved, and to the copy. Using it once one of them is
///           gone ends the process (docs/objects.md).
///   Cost    proportional to the parts of the model. Frames do not pay for unchanged copies.
///
///   Result<ModelCopy> car = ModelCopy::of(scene, root);
///   car->set("paint", "baseColorFactor", float4(0.8f, 0, 0, 1));        // this car only
///   car->setMorphWeight("smile", 0.5f);
///   view.camera = *car->camera("driver");
#pragma once

#include <filament_core/Camera.h>
#include <filament_core/Gltf.h>
#include <filament_core/Scene.h>
#include <filament_core/View.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core {

/// A primitive of a mesh of the file.
struct CopyRenderable {
    Renderable renderable{};
    Node node{};                             ///< the node of the file that has the mesh
    std::string mesh{};                      ///< name of the mesh
    std::string material{};                  ///< name of the material that it is drawn with now
    std::vector<std::string> morphTargets{}; ///< their names, one for each weight; "" where the file has none
};

/// A material that the copy is drawn with now.
struct CopyMaterial {
    std::string name{};
    MaterialInstance instance{};
    Material material{};
    bool isOwn = false; ///< other copies do not have this instance: see ModelCopy::ownMaterials()
    uint32_t renderables = 0;
};

/// The areas are those of FILAMENT_light (docs/gltf.md).
enum class LightKind : uint8_t { Sun, Point, Spot, Rect, Disc, Tube };

struct CopyLight {
    std::string name{}; ///< of the light; that of its node if the light has none
    Light light{};
    Node node{};
    LightKind kind = LightKind::Point;
};

struct CopyCamera {
    std::string name{}; ///< of the camera; that of its node if the camera has none
    Node node{};
    Camera camera{}; ///< where the node is now. Its exposure is the default one: files know none
};

struct CopyMorphTarget {
    std::string name{};
    Renderable renderable{};
    uint32_t target = 0; ///< of the renderable
    float weight = 0;
};

/// A thing in several levels of detail (MSFT_lod), of a model that was loaded with GltfLoadOptions::allLevels.
struct CopyLevels {
    std::vector<Node> nodes{};           ///< the finest first
    std::vector<double> leastCoverage{}; ///< of each: see ModelCopy::chooseLevels()
    std::optional<uint32_t> shown{};     ///< into `nodes`; none: the thing is too small
};

class ModelCopy {
public:
    /// InvalidArgument: the node is not the root of a copy of a model.
    static Result<ModelCopy> of(Scene& scene, Node root);

    Node root() const { return mRoot; }

    /// The nodes of the file, parents first.
    std::vector<Node> nodes() const;
    Result<Node> node(std::string_view name) const;

    std::vector<CopyRenderable> renderables() const;
    /// Of a mesh or of a node with this name.
    Result<std::vector<Renderable>> renderables(std::string_view meshOrNode) const;

    std::vector<CopyMaterial> materials() const;
    /// Of all variants, with instances that this copy shares with no other one, made at the first call; each primitive
    /// of the copy that shows the shared one shows its own from now on. A material has several instances if it is used
    /// with and without vertex colours, by points or lines with and without normals, or by volumes of several scales.
    /// They live as long as the copy: do not destroy them, and give them to nothing else that lives longer.
    Result<std::vector<MaterialInstance>> ownMaterials(std::string_view material);
    /// Engine::set() for those of ownMaterials() that have the parameter. InvalidArgument as there, from the first
    /// instance that refuses; NotFound if none has it.
    Result<void> set(std::string_view material, std::string_view parameter, ParameterValue const& value);
    Result<void> set(std::string_view material, std::string_view parameter, Texture texture, Sampler sampler = {});

    std::vector<CopyLight> lights() const;
    Result<Light> light(std::string_view name) const;

    std::vector<CopyCamera> cameras() const;
    /// For View::camera. A scale of its node does not count.
    Result<Camera> camera(std::string_view name) const;

    std::vector<CopyMorphTarget> morphTargets() const;
    /// Of all morph targets with this name: those of the primitives of a face, say. The other weights stay.
    Result<void> setMorphWeight(std::string_view target, float weight);

    std::vector<CopyLevels> levels() const;
    /// Shows of each thing with levels the first whose `leastCoverage` it reaches in this view, and none if it reaches
    /// none; until the first call, the finest. Coverage is pi R^2 / (A d^2): the fraction of the screen's area A at
    /// distance 1 that the sphere around its finest level has at the distance d of its centre, or pi R^2 / A for a
    /// parallel lens. So turning the camera changes nothing, and nor do frames before: there is no hysteresis. Around
    /// the camera it is infinite. `bias` > 0 multiplies it: 2 shows finer levels up to twice the area.
    ///   Call it before each view that is to have levels of its own; all that is drawn for the view, shadows included,
    ///   has the same ones. What an animation or the file hides stays hidden. A light of another level has no
    ///   intensity.
    void chooseLevels(View const& view, float bias = 1);

    /// What the model has for an Animator and for Scene::setVariant().
    std::vector<std::string> animations() const;
    std::vector<std::string> variants() const;
    /// The one that setVariant() chose; "" for none.
    std::string variant() const;
    /// Scene::setVariant(). Materials of the copy's own stay its own.
    Result<void> setVariant(std::string_view variant);

private:
    ModelCopy(std::weak_ptr<Scene::Impl> scene, Node root) : mScene(std::move(scene)), mRoot(root) {}
    Result<void> setEach(std::string_view material, auto&& set);

    std::weak_ptr<Scene::Impl> mScene;
    Node mRoot;
};

} // namespace filament_core
