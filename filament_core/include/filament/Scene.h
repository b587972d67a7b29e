// SPDX-License-Identifier: Apache-2.0
/// Scene: what exists. Renderables, lights, nodes that carry them, and one environment; drawn by any Renderer of the
/// same engine.
///   Thread  the app thread, also for what is const: bounds() and Renderer::render() first bring transforms up to date.
///           Not to be changed while Renderer::render runs (it returns when the scene has been read).
///   Memory  arrays by column; adding and removing is O(1).
///   Life    the scene does not own buffers, materials or models: they must outlive it or be removed first.
#pragma once

#include <filament/Box.h>
#include <filament/Engine.h>
#include <filament/Light.h>
#include <filament/Node.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament {

class Model;
class Environment;

/// Up to 256 bones. A vertex goes to the weighted mean of where its bones put it; normals and tangents follow. Where
/// bones collapse something it stays finite; where they mirror, the right faces are drawn.
struct SkinDesc {
    /// Object space is its space: renderables with this skin hang here, and the skin is removed with it. None: the
    /// world, for renderables without a node.
    Node node{};
    std::span<const Node> joints{};            ///< 1 to 256 nodes, which the bones follow from now on; or none
    std::span<const float4x4> jointFromBind{}; ///< one a joint: from where the mesh was bound into the joint's space
    uint32_t boneCount = 0;                    ///< without joints: 1 to 256, set by Scene::setBones
};

struct RenderableDesc {
    VertexBuffer vertices{};
    IndexBuffer indices{};
    MaterialInstance material{};
    PrimitiveType primitive = PrimitiveType::Triangles;
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;               ///< 0: all
    float3 boundsMin{ 0 }, boundsMax{ 0 }; ///< of the positions, in object space
    double4x4 worldFromObject{ 1.0 };      ///< affine; with a node: stays the identity
    Node node{};                           ///< the renderable stands where this node stands; none: at worldFromObject
    uint32_t instanceIndex = 0;            ///< < 2^24; what getInstanceIndex() of materials with `instanced` gives
    Skin skin{};                           ///< the vertices have Attribute::Joints and Weights, perhaps Joints1 too
    std::vector<BoneBounds> boneBounds{};  ///< one a bone: makes culling exact; empty: the bounds above for all
    MorphTargets morphTargets{};           ///< of as many vertices as the vertex buffer has
    std::vector<float> morphWeights{};     ///< at first; what is missing is 0
    bool culled = true;                    ///< false: drawn even when its box is out of view
    std::string name{};
};

struct EnvironmentSettings {
    Lux illuminance{ 30'000 }; ///< what one unit of the environment's radiance is multiplied by
    float rotationRadians = 0; ///< around +Y
    bool skybox = true;        ///< draw it as background
};

class Scene {
public:
    explicit Scene(Engine& engine);
    Scene(Scene&&) noexcept;
    ~Scene();

    Renderable add(RenderableDesc const& desc);
    /// With a node, position and direction are those in the node's space, and the light follows it. Scales change
    /// neither range nor intensity.
    Light add(SunLight const& light, Node node = {});
    Light add(PointLight const& light, Node node = {});
    Light add(SpotLight const& light, Node node = {});
    void remove(Renderable renderable);
    void remove(Light light);
    /// Seen from the next frame on.
    void setMaterial(Renderable renderable, MaterialInstance material);
    /// Of a renderable without a node.
    void setTransform(Renderable renderable, double4x4 const& worldFromObject);

    /// Bones that follow nodes, or are set by hand: then they start at the identity. A joint that is removed leaves its
    /// bone where it was. What follows joints is brought up to date by the next frame, on the workers.
    Skin add(SkinDesc const& desc);
    /// After the renderables that have it.
    void remove(Skin skin);
    /// Of a skin without joints, one matrix for each of its bones, into the object space of its renderables. What is
    /// not finite counts as a zero scale.
    void setBones(Skin skin, std::span<const float4x4> objectFromBind);
    /// Of a renderable with morph targets. Any finite numbers; a target of weight 0 costs nothing.
    void setMorphWeights(Renderable renderable, std::span<const float> weights);

    /// A copy of the model: its nodes below one new root, which stands at `worldFromModel` and has the model's name,
    /// its renderables and lights at them. Moving or removing the root moves or removes all of it.
    Node add(Model const& model, double4x4 const& worldFromModel = double4x4(1.0));

    /// KHR_materials_variants: gives the renderables of one copy of a model, by the root that add() returned, the
    /// materials that the variant names for them, and those that it does not name their own; "": their own to all.
    /// Materials are made by loadGltf(): this only swaps them. Fails with InvalidArgument for a name that the model
    /// does not have (Model::variantNames()); nothing changes then.
    Result<void> setVariant(Node copy, std::string_view variant);

    Node add(NodeDesc const& desc);
    /// The node and all below it, with every renderable, light and skin that hangs there; their handles end.
    void remove(Node node);
    /// Takes effect at once for worldFromNode(), and for what hangs at or below the node with the next frame.
    void setTransform(Node node, double4x4 const& parentFromNode);
    /// The node becomes the last child of `parent`; none: a root. Below itself it cannot be.
    void setParent(Node node, Node parent, Reparent keep = Reparent::KeepLocal);
    double4x4 parentFromNode(Node node) const;
    double4x4 worldFromNode(Node node) const;
    std::string const& name(Node node) const;
    Node parent(Node node) const;           ///< none: a root
    Node node(Renderable renderable) const; ///< none: it has a transform of its own
    Node node(Light light) const;
    /// for (Node child = scene.firstChild(node); child; child = scene.nextSibling(child)), in the order they were
    /// added.
    Node firstChild(Node node = {}) const; ///< {}: the first root
    Node nextSibling(Node node) const;
    /// The first of this name at or below `root` ({}: in the whole scene), parents first; none if there is none.
    Node findNode(std::string_view name, Node root = {}) const;

    void setEnvironment(Environment const& environment, EnvironmentSettings const& settings = {});
    void setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians = 0); ///< {}: none
    void setSkybox(Skybox skybox, Lux illuminance, float rotationRadians = 0);              ///< {}: none

    Box bounds() const; ///< of all renderables; it holds what bones and morph targets move, and may be larger
    uint32_t renderableCount() const;
    uint32_t lightCount() const;
    uint32_t nodeCount() const;

    struct Impl;
    Impl& impl() { return *mImpl; }
    Impl const& impl() const { return *mImpl; }

private:
    std::unique_ptr<Impl> mImpl;
};

} // namespace filament
