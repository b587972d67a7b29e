// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SceneNodes.h"

#include "filament_core/scene/SceneSkins.h"

#include <cmath>

namespace filament_core::scene {
namespace {

// A direction survives any scale except zero: along an axis that the node flattens, it is not changed. What is a unit
// vector as far as floats are stays as it is: a node that turns nothing changes no bit of it, and a node whose axis has
// the numbers of a direction gives them back, as those of saved scenes do.
float3 turned(Affine const& world, float3 direction) {
    const double3 longer = transformVector(world, double3(direction));
    const double length2 = glm::dot(longer, longer);
    if (std::abs(length2 - 1) < 1e-6) return float3(longer);
    return length2 > 0 && std::isfinite(length2) ? float3(longer / std::sqrt(length2)) : direction;
}

template <class Tag>
Node nodeOf(SceneData const& scene, Attachments<Tag> const& attachments, ObjectHandle<Tag> thing) {
    return attachments.isAttached(thing) ? scene.transforms.nodeAt(attachments.nodeOf(thing)) : Node{};
}

/// Attached to the node or to one below it.
template <class Change>
void forEachRenderable(SceneData& scene, Node node, Change&& change) {
    std::vector<Node> open{ node };
    while (!open.empty()) {
        const Node next = open.back();
        open.pop_back();
        scene.atNodes.renderables.forEach(scene.transforms.slotOf(next), change);
        for (Node child = scene.transforms.firstChild(next); child; child = scene.transforms.nextSibling(child))
            open.push_back(child);
    }
}

} // namespace

void attach(SceneData& scene, Renderable renderable, Node node) {
    scene.renderables.index.at(renderable); // asserts that it is there
    scene.atNodes.renderables.attach(renderable, scene.transforms.slotOf(node));
    scene.transforms.markUnplaced(node);
}

void attach(SceneData& scene, Light light, Node node) {
    LightRecord const& record = scene.lights.records[scene.lights.index.at(light)];
    std::vector<LightPose>& poses = scene.atNodes.lightPoses;
    if (light.index() >= poses.size()) poses.resize(light.index() + 1);
    poses[light.index()] = { record.positionWorld, record.directionWorld, record.sideWorld };
    scene.atNodes.lights.attach(light, scene.transforms.slotOf(node));
    scene.transforms.markUnplaced(node);
}

void setLight(SceneData& scene, Light light, LightRecord const& record) {
    checkIntensity(record);
    scene.lights.records[scene.lights.index.at(light)] = record;
    if (!scene.atNodes.lights.isAttached(light)) return;
    scene.atNodes.lightPoses[light.index()] = { record.positionWorld, record.directionWorld, record.sideWorld };
    scene.transforms.markUnplaced(scene.transforms.nodeAt(scene.atNodes.lights.nodeOf(light)));
}

Node nodeOf(SceneData const& scene, Renderable renderable) {
    scene.renderables.index.at(renderable);
    return nodeOf(scene, scene.atNodes.renderables, renderable);
}

Node nodeOf(SceneData const& scene, Light light) {
    scene.lights.index.at(light);
    return nodeOf(scene, scene.atNodes.lights, light);
}

void setLightChannels(SceneData& scene, Node node, uint8_t channels) {
    forEachRenderable(scene, node,
                      [&](Renderable renderable) { setLightChannels(scene.renderables, renderable, channels); });
}

void setLayers(SceneData& scene, Node node, uint8_t select, uint8_t layers) {
    forEachRenderable(scene, node,
                      [&](Renderable renderable) { setLayers(scene.renderables, renderable, select, layers); });
}

void setDrawOrder(SceneData& scene, Node node, DrawOrder place) {
    forEachRenderable(scene, node, [&](Renderable renderable) { setDrawOrder(scene.renderables, renderable, place); });
}

void setVisible(SceneData& scene, Node node, bool isVisible) {
    forEachRenderable(scene, node,
                      [&](Renderable renderable) { setVisible(scene.renderables, renderable, isVisible); });
}

void setPickable(SceneData& scene, Node node, PickAim aim, bool isHit) {
    scene.atNodes.pickRules.set(scene.transforms.slotOf(node), aim, isHit);
}

bool isPickable(SceneData const& scene, Node node, PickAim aim) {
    PickRules const& rules = scene.atNodes.pickRules;
    if (rules.empty()) return true;
    while (node) {
        const uint32_t slot = scene.transforms.slotOf(node);
        if (rules.passes(slot, aim)) return false;
        const Node followed = rules.followed(slot);
        node = scene.transforms.isAlive(followed) ? followed : scene.transforms.parent(node);
    }
    return true;
}

std::vector<uint32_t> removeNode(SceneData& scene, Node node) {
    std::vector<uint32_t> slots = scene.transforms.remove(node);
    for (const uint32_t slot : slots) {
        scene.atNodes.pickRules.drop(slot);
        while (const Renderable renderable = scene.atNodes.renderables.first(slot)) removeRenderable(scene, renderable);
        while (const Light light = scene.atNodes.lights.first(slot)) removeLight(scene, light);
    }
    for (const uint32_t slot : slots) {
        // After all renderables of the subtree: a skin may move some that hang at other nodes of it.
        while (const Skin skin = scene.atNodes.skins.first(slot)) removeSkin(scene, skin);
    }
    return slots;
}

void placeAttached(SceneData& scene, uint32_t slot) {
    Affine const& world = scene.transforms.worldAt(slot);
    if (scene.deformations.isMoving()) scene.deformations.noteMoved(slot);
    scene.atNodes.renderables.forEach(slot, [&](Renderable renderable) {
        place(scene.renderables, scene.renderables.index.at(renderable), world);
    });
    scene.atNodes.lights.forEach(slot, [&](Light light) {
        LightPose const& pose = scene.atNodes.lightPoses[light.index()];
        LightRecord& record = scene.lights.records[scene.lights.index.at(light)];
        record.positionWorld = transformPoint(world, pose.position);
        record.directionWorld = turned(world, pose.direction);
        if (record.isArea() || record.profile || record.image) record.sideWorld = turned(world, pose.side);
    });
}

} // namespace filament_core::scene
