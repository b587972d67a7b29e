// SPDX-License-Identifier: Apache-2.0
// The nodes of a Scene, and copies of models, which consist of nodes.
#include "filament_core/scene/SceneNodes.h"

#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/engine/gltf/ModelParts.h"

namespace filament_core {

using engine::PublicCall;

Node Scene::add(NodeDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(NodeDesc)", desc.name);
    return mImpl->changed().transforms.add(desc.parent, desc.parentFromNode, desc.name);
}

Node Scene::addInstances(RenderableDesc const& desc, uint32_t count, std::span<const double4x4> nodeFromInstance) {
    const PublicCall call(mImpl, "Scene::addInstances(RenderableDesc, uint32_t, span<double4x4>)", desc.name);
    FILAMENT_ASSERT(nodeFromInstance.empty() || nodeFromInstance.size() == count,
                    "instances have one transform each, or none has");
    FILAMENT_ASSERT(!desc.skin, "instances have no skin: a skin poses renderables of its own node");
    const Node root = add(NodeDesc{ desc.node, desc.worldFromObject, desc.name });
    RenderableDesc copy = desc;
    copy.worldFromObject = double4x4(1.0);
    for (uint32_t i = 0; i < count; ++i) {
        copy.node = nodeFromInstance.empty() ? root : add(NodeDesc{ root, nodeFromInstance[i] });
        copy.instanceIndex = desc.instanceIndex + i;
        add(copy);
    }
    return root;
}

Node Scene::add(Model const& model, double4x4 const& worldFromModel) {
    const PublicCall call(mImpl, "Scene::add(Model, double4x4)");
    const std::shared_ptr<const Model::Impl> shared = engine::shareOf(model, mImpl->engine);
    Model::Impl const& parts = *shared;
    const Node root = add(NodeDesc{ .parentFromNode = worldFromModel, .name = parts.name });
    std::vector<Node> nodes;
    nodes.reserve(parts.nodes.size());
    const auto at = [&](uint32_t index) { return index == Model::Impl::kRoot ? root : nodes[index]; };
    // Nodes, then skins, then renderables: each names those before. The nodes of a file stand behind their parents.
    for (Model::Impl::PartNode const& node : parts.nodes) {
        nodes.push_back(add(NodeDesc{ at(node.parent), node.parentFromNode, node.name }));
    }
    std::vector<Skin> skins;
    std::vector<Node> joints;
    for (Model::Impl::PartSkin const& skin : parts.skins) {
        joints.clear();
        for (const uint32_t joint : skin.joints) joints.push_back(at(joint));
        skins.push_back(add(SkinDesc{ at(skin.node), joints, skin.jointFromBind }));
    }
    std::vector<Renderable> renderables;
    renderables.reserve(parts.renderables.size());
    for (Model::Impl::PartRenderable const& part : parts.renderables) {
        RenderableDesc desc = part.desc;
        desc.node = at(part.node);
        if (part.skin != Model::Impl::kNoSkin) desc.skin = skins[part.skin];
        renderables.push_back(add(desc));
    }
    std::vector<Light> lights;
    lights.reserve(parts.lights.size());
    for (Model::Impl::PartLight const& part : parts.lights) {
        lights.push_back(add(part.light, at(part.node)));
    }
    engine::setPickRules(parts, *mImpl, nodes);
    mImpl->copies.add({ root, shared, std::move(nodes), std::move(renderables), std::move(lights) });
    // After the copy has been added: what it hides is noted there.
    if (!parts.properties.empty() || !parts.levels.empty()) engine::hideAsInFile(parts, *mImpl, root);
    return root;
}

void Scene::remove(Node node) {
    const PublicCall call(mImpl, "Scene::remove(Node)");
    for (const uint32_t removed : scene::removeNode(mImpl->changedUses(), node)) mImpl->copies.remove(removed);
    engine::placeLightShapes(mImpl->engine, mImpl->data);
}

void Scene::setTransform(Node node, double4x4 const& parentFromNode) {
    const PublicCall call(mImpl, "Scene::setTransform(Node, double4x4)");
    mImpl->changed().transforms.setTransform(node, parentFromNode);
}

void Scene::setParent(Node node, Node parent, Reparent keep) {
    const PublicCall call(mImpl, "Scene::setParent(Node, Node, Reparent)");
    scene::Transforms& transforms = mImpl->changed().transforms;
    keep == Reparent::KeepWorld ? transforms.setParentKeepingWorld(node, parent) : transforms.setParent(node, parent);
}

double4x4 Scene::parentFromNode(Node node) const {
    const PublicCall call(mImpl, "Scene::parentFromNode(Node)");
    return mImpl->data.transforms.parentFromNode(node);
}
double4x4 Scene::worldFromNode(Node node) const {
    const PublicCall call(mImpl, "Scene::worldFromNode(Node)");
    return mImpl->data.transforms.worldFromNode(node);
}
std::string const& Scene::name(Node node) const {
    const PublicCall call(mImpl, "Scene::name(Node)");
    return mImpl->data.transforms.name(node);
}
Node Scene::parent(Node node) const {
    const PublicCall call(mImpl, "Scene::parent(Node)");
    return mImpl->data.transforms.parent(node);
}
Node Scene::node(Renderable renderable) const {
    const PublicCall call(mImpl, "Scene::node(Renderable)");
    return scene::nodeOf(mImpl->data, renderable);
}
Node Scene::node(Light light) const {
    const PublicCall call(mImpl, "Scene::node(Light)");
    return scene::nodeOf(mImpl->data, light);
}
Node Scene::firstChild(Node node) const {
    const PublicCall call(mImpl, "Scene::firstChild(Node)");
    return mImpl->data.transforms.firstChild(node);
}
Node Scene::nextSibling(Node node) const {
    const PublicCall call(mImpl, "Scene::nextSibling(Node)");
    return mImpl->data.transforms.nextSibling(node);
}
Node Scene::findNode(std::string_view name, Node root) const {
    const PublicCall call(mImpl, "Scene::findNode(string_view, Node)");
    return mImpl->data.transforms.find(name, root);
}
uint32_t Scene::nodeCount() const {
    const PublicCall call(mImpl, "Scene::nodeCount()");
    return mImpl->data.transforms.count();
}

} // namespace filament_core
