// SPDX-License-Identifier: Apache-2.0
// The nodes of a Scene, and copies of models, which consist of nodes.
#include "filament_core/scene/SceneNodes.h"

#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"

namespace filament {

Node Scene::add(NodeDesc const& desc) {
    return mImpl->changed().transforms.add(desc.parent, desc.parentFromNode, desc.name);
}

Node Scene::add(Model const& model, double4x4 const& worldFromModel) {
    Model::Impl const& parts = model.impl();
    const Node root = add(NodeDesc{ .parentFromNode = worldFromModel, .name = parts.name });
    std::vector<Node> nodes;
    nodes.reserve(parts.nodes.size());
    const auto at = [&](uint32_t index) { return index == Model::Impl::kRoot ? root : nodes[index]; };
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
    for (Model::Impl::PartLight const& part : parts.lights) {
        std::visit([&](auto const& light) { add(light, at(part.node)); }, part.light);
    }
    if (!parts.variants.empty()) mImpl->copies.push_back({ root, &parts, std::move(renderables) });
    return root;
}

void Scene::remove(Node node) {
    scene::removeNode(mImpl->changed(), node);
    std::erase_if(mImpl->copies,
                  [&](Impl::ModelCopy const& copy) { return !mImpl->data.transforms.contains(copy.root); });
}

void Scene::setTransform(Node node, double4x4 const& parentFromNode) {
    mImpl->changed().transforms.setTransform(node, parentFromNode);
}

void Scene::setParent(Node node, Node parent, Reparent keep) {
    scene::Transforms& transforms = mImpl->changed().transforms;
    keep == Reparent::KeepWorld ? transforms.setParentKeepingWorld(node, parent) : transforms.setParent(node, parent);
}

double4x4 Scene::parentFromNode(Node node) const { return mImpl->data.transforms.parentFromNode(node); }
double4x4 Scene::worldFromNode(Node node) const { return mImpl->data.transforms.worldFromNode(node); }
std::string const& Scene::name(Node node) const { return mImpl->data.transforms.name(node); }
Node Scene::parent(Node node) const { return mImpl->data.transforms.parent(node); }
Node Scene::node(Renderable renderable) const { return scene::nodeOf(mImpl->data, renderable); }
Node Scene::node(Light light) const { return scene::nodeOf(mImpl->data, light); }
Node Scene::firstChild(Node node) const { return mImpl->data.transforms.firstChild(node); }
Node Scene::nextSibling(Node node) const { return mImpl->data.transforms.nextSibling(node); }
Node Scene::findNode(std::string_view name, Node root) const { return mImpl->data.transforms.find(name, root); }
uint32_t Scene::nodeCount() const { return mImpl->data.transforms.count(); }

} // namespace filament
