// SPDX-License-Identifier: Apache-2.0
/// Scene: everything that can be drawn: renderables, lights, the nodes that carry them, and one environment. Any
/// Renderer of the same engine can draw it.
///   Thread  the app thread, also for const functions: bounds() and Renderer::render() first update transforms. Do not
///           change the scene while Renderer::render runs (it returns once it has read the scene).
///   Memory  one array per field; adding and removing are O(1).
///   Life    objects in the scene may be destroyed: the scene keeps it until it is removed or replaced. Handles of a
///           scene are valid in that scene only.
#pragma once

#include <filament_core/Box.h>
#include <filament_core/Engine.h>
#include <filament_core/GeometryLevel.h>
#include <filament_core/IrradianceGrid.h>
#include <filament_core/Light.h>
#include <filament_core/LoadOptions.h>
#include <filament_core/Node.h>
#include <filament_core/Occluder.h>
#include <filament_core/ReflectionProbe.h>
#include <filament_core/Splats.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

class Model;
class Environment;

/// A skin of any number of bones. Each vertex moves to the weighted mean of the positions that its bones give it;
/// normals and tangents follow. Bones that collapse geometry keep it finite, and bones that mirror it draw the correct
/// faces. Visible in one frame are as many bones as 512 times the rows of the device's largest texture, at least a
/// million; meshes of further ones are drawn at rest.
struct SkinDesc {
    /// The node whose space is object space. Renderables with this skin are attached to it, and removing it removes the
    /// skin. None: world space, for renderables without a node.
    Node node{};
    std::span<const Node> joints{};            ///< nodes that the bones follow; or none
    std::span<const float4x4> jointFromBind{}; ///< one per joint: from the bind pose of the mesh into the joint's space
    uint32_t boneCount = 0;                    ///< without joints: how many, set by Scene::setBones
};

/// What a renderable draws.
struct GeometryDesc {
    VertexBuffer vertices{};
    IndexBuffer indices{};
    PrimitiveType primitive = PrimitiveType::Triangles;
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;                 ///< 0: all
    std::optional<Box> bounds{};             ///< as of RenderableDesc
    Occluder occluder{};                     ///< as of RenderableDesc
    std::span<const GeometryLevel> levels{}; ///< as of RenderableDesc
};

struct RenderableDesc {
    VertexBuffer vertices{};
    IndexBuffer indices{};
    MaterialInstance material{};
    PrimitiveType primitive = PrimitiveType::Triangles;
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0; ///< 0: all
    /// Of the positions, in object space, without skin and morph targets; not empty. Unset: the bounds of all vertices
    /// of the buffer, which follow Engine::update().
    std::optional<Box> bounds{};
    /// Hides what is behind the renderable, if its material is opaque and leaves depth and position alone. None: it
    /// hides nothing from being drawn.
    Occluder occluder{};
    /// Coarser levels of detail, the finest first; of triangles, for renderables that may be culled.
    std::vector<GeometryLevel> levels{};
    double4x4 worldFromObject{ 1.0 }; ///< affine; must stay the identity if there is a node
    Node node{};                      ///< gives the renderable its transform; none: worldFromObject
    uint32_t instanceIndex = 0;       ///< < 2^24; returned by getInstanceIndex() in materials with `instanced`
    Skin skin{};                      ///< needs Attribute::Joints and Weights, optionally Joints1 and Weights1
    /// One per bone, of the vertices that it moves, in the bind pose; an empty box: it moves none. Makes culling exact.
    /// Without boxes every bone has the bounds above.
    std::vector<Box> boneBounds{};
    MorphTargets morphTargets{};       ///< with as many vertices as the vertex buffer
    std::vector<float> morphWeights{}; ///< initial weights; missing ones are 0
    bool culled = true;                ///< false: drawn even when its box is out of view
    bool castsShadows = true;          ///< if its material is opaque or masked
    bool receivesShadows = true;
    LightChannels lightChannels = kDefaultLightChannels; ///< lights of these channels shine on it
    Layers layers = kDefaultLayers;                      ///< views of these layers show it; none: no view does
    DrawOrder drawOrder{};                               ///< among what is drawn in an order
    /// Instead of all that draws above: of the other members only transform, node, culled, layers and name count.
    SplatCloud splats{};
    std::string name{};
};

class Scene {
public:
    explicit Scene(Engine& engine);
    Scene(Scene&&) noexcept = default;
    ~Scene();

    Renderable add(RenderableDesc const& desc);
    /// Adds copies of one renderable, which getInstanceIndex() numbers from desc.instanceIndex on, below a new node.
    /// Its parent is desc.node, its transform desc.worldFromObject; to remove, hide or move it does so to all copies.
    /// They share their draw call, but each is culled and sorted by itself.
    ///   nodeFromInstance  one transform for each copy, or none: then all lie in one place, the material's vertex block
    ///                     moves each by its number, and desc.bounds contains every position.
    /// Copies have no skin.
    Node addInstances(RenderableDesc const& desc, uint32_t count, std::span<const double4x4> nodeFromInstance = {});
    /// With a node, position and direction are in the node's space, and the light follows the node. Scales do not
    /// change the light's range or intensity.
    Light add(LightDesc const& light, Node node = {});
    void remove(Renderable renderable);
    void remove(Light light);
    /// Replaces the light, of whatever kind it was. Its node stays, and what is given is in the node's space.
    void set(Light light, LightDesc const& desc);
    /// Takes effect with the next frame. A skin needs vertices with joints, morph targets as many vertices as they
    /// have.
    void setGeometry(Renderable renderable, GeometryDesc const& geometry);
    /// In object space, as of RenderableDesc. Vertices outside of the bounds may be missing at the edges of the view,
    /// in shadow maps and in effects that look for objects.
    void setBounds(Renderable renderable, Box const& bounds);
    /// Hidden renderables are not drawn and cast no shadows; they keep everything else. Visible by default.
    void setVisible(Renderable renderable, bool isVisible);
    /// For all renderables attached to the node or below it: a copy of a model, for example.
    void setVisible(Node node, bool isVisible);
    bool isVisible(Renderable renderable) const;
    /// Whether picks of this aim (PickAim::Select or Hover) hit renderables attached to the node or below it; others
    /// pass through to what is behind. A node is hit only if all nodes above it are. glTF files say it at first
    /// (KHR_node_selectability, KHR_node_hoverability).
    void setPickable(Node node, PickAim aim, bool isHit);
    /// With all nodes above.
    bool isPickable(Node node, PickAim aim) const;
    /// Takes effect with the next frame.
    void setMaterial(Renderable renderable, MaterialInstance material);
    /// Takes effect with the next frame. Renderables that differ in their channels share no instanced draw.
    void setLightChannels(Renderable renderable, LightChannels channels);
    void setLightChannels(Light light, LightChannels channels);
    /// For all renderables attached to the node or below it: a copy of a model, for example.
    void setLightChannels(Node node, LightChannels channels);
    /// Gives the layers named by `select` the values that they have in `layers`; the others stay. So a part of a
    /// program can have a layer of its own, and need not know of the rest: setLayers(lamp, kHud, 0) hides the lamp
    /// there.
    void setLayers(Renderable renderable, Layers select, Layers layers);
    /// For all renderables attached to the node or below it: a copy of a model, for example.
    void setLayers(Node node, Layers select, Layers layers);
    Layers layers(Renderable renderable) const;
    /// Takes effect with the next frame.
    void setDrawOrder(Renderable renderable, DrawOrder place);
    /// For all renderables attached to the node or below it: a copy of a model, for example.
    void setDrawOrder(Node node, DrawOrder place);
    DrawOrder drawOrder(Renderable renderable) const;
    /// For a renderable without a node.
    void setTransform(Renderable renderable, double4x4 const& worldFromObject);

    /// Bones follow nodes, or are set by setBones(); the latter start at the identity. If a joint is removed, its bone
    /// keeps its last pose. The next frame updates bones that follow joints, on the workers.
    Skin add(SkinDesc const& desc);
    /// Remove the renderables that use the skin first.
    void remove(Skin skin);
    /// For a skin without joints: one matrix per bone, into the object space of its renderables. A matrix that is not
    /// finite is treated as a zero scale.
    void setBones(Skin skin, std::span<const float4x4> objectFromBind);
    /// For a renderable with morph targets. Any finite numbers; a target of weight 0 costs nothing.
    void setMorphWeights(Renderable renderable, std::span<const float> weights);

    /// Adds a copy of the model: its nodes, with renderables and lights, below one new root. The root has the transform
    /// `worldFromModel` and the model's name. Moving or removing the root moves or removes the whole copy.
    Node add(Model const& model, double4x4 const& worldFromModel = double4x4(1.0));

    /// Applies a variant of KHR_materials_variants to one copy of a model, given by the root that add() returned.
    /// Renderables that the variant does not name get their own materials; "" gives all of them their own. loadGltf()
    /// created the materials, so this only swaps them. InvalidArgument for a name that is not in Model::variantNames();
    /// nothing changes then.
    Result<void> setVariant(Node copy, std::string_view variant);

    Node add(NodeDesc const& desc);
    /// Removes the node and its descendants, with every renderable, light and skin attached to them. All their handles
    /// become invalid.
    void remove(Node node);
    /// worldFromNode() reflects the change at once; everything attached to the node or below it follows in the next
    /// frame.
    void setTransform(Node node, double4x4 const& parentFromNode);
    /// The node becomes the last child of `parent`; none: a root. A node cannot become its own descendant.
    void setParent(Node node, Node parent, Reparent keep = Reparent::KeepLocal);
    double4x4 parentFromNode(Node node) const;
    double4x4 worldFromNode(Node node) const;
    std::string const& name(Node node) const;
    Node parent(Node node) const;           ///< none: a root
    Node node(Renderable renderable) const; ///< none: it has a transform of its own
    Node node(Light light) const;
    /// Iterate with for (Node child = scene.firstChild(node); child; child = scene.nextSibling(child)). Children are in
    /// the order in which they were added.
    Node firstChild(Node node = {}) const; ///< {}: the first root
    Node nextSibling(Node node) const;
    /// The first node with this name at or below `root` ({}: in the whole scene), parents first; none if there is none.
    Node findNode(std::string_view name, Node root = {}) const;

    /// Its light, background and Environment::lights(), in place of those of the environment before.
    void setEnvironment(Environment const& environment, EnvironmentSettings const& settings = {});
    /// {}: none. The lights that setEnvironment() added leave.
    void setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians = 0);
    void setSkybox(Skybox skybox, Lux illuminance, float rotationRadians = 0); ///< {}: none

    /// Surfaces in its box reflect it from the next frame on.
    ReflectionProbe add(ReflectionProbeDesc const& desc);
    void remove(ReflectionProbe probe);
    void set(ReflectionProbe probe, ReflectionProbeDesc const& desc);

    /// Renderables in its box have its diffuse light from the next frame on.
    IrradianceGrid add(IrradianceGridDesc const& desc);
    void remove(IrradianceGrid grid);
    void set(IrradianceGrid grid, IrradianceGridDesc const& desc);

    Box bounds() const; ///< of all renderables, including deformed ones; may be larger than necessary
    Box bounds(Renderable renderable) const; ///< in world space; conservative, like bounds()
    uint32_t renderableCount() const;
    uint32_t lightCount() const;
    uint32_t nodeCount() const;
    uint32_t reflectionProbeCount() const;
    uint32_t irradianceGridCount() const;

    struct Impl;
    Impl& impl() { return *mImpl; }
    Impl const& impl() const { return *mImpl; }
    std::weak_ptr<Impl> share() { return mImpl; }

private:
    std::shared_ptr<Impl> mImpl; ///< not shared; animators detect its end
};

} // namespace filament_core
