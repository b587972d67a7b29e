// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Animator.h>

#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/engine/gltf/ModelParts.h"
#include "filament_core/scene/SceneSkins.h"

#include <algorithm>
#include <array>

namespace filament_core {
namespace {

using assets::AnimationChannel;
using assets::AnimationPath;
using assets::NodePose;

/// What animations move: poses and weights of a model's nodes, and properties of KHR_animation_pointer.
struct Pose {
    std::vector<NodePose> nodes;              ///< by node of the model
    std::vector<std::vector<double>> weights; ///< of morph targets; empty where there are none
    std::vector<float4> properties;           ///< parallel to Model::Impl::properties
    std::vector<uint8_t> movesNode, movesWeights, movesProperty;

    Pose(size_t count, size_t propertyCount)
            : nodes(count), weights(count), properties(propertyCount), movesNode(count), movesWeights(count),
              movesProperty(propertyCount) {}
    void forget() {
        std::ranges::fill(movesProperty, uint8_t{ 0 });
        std::ranges::fill(movesNode, uint8_t{ 0 });
        std::ranges::fill(movesWeights, uint8_t{ 0 });
    }
};

Pose restPose(Model::Impl const& model) {
    Pose pose(model.nodes.size(), model.properties.size());
    for (size_t i = 0; i < model.properties.size(); ++i) pose.properties[i] = model.properties[i].rest;
    for (size_t i = 0; i < model.nodes.size(); ++i) pose.nodes[i] = model.nodes[i].pose;
    for (Model::Impl::PartRenderable const& part : model.renderables) {
        if (part.desc.morphTargets)
            pose.weights[part.node].assign(part.desc.morphWeights.begin(), part.desc.morphWeights.end());
    }
    return pose;
}

void apply(AnimationChannel const& channel, assets::AnimationSampler const& sampler, double seconds, Pose& pose) {
    if (channel.path == AnimationPath::Weights && channel.weight == assets::kNone) {
        pose.weights[channel.node].resize(sampler.width);
        pose.movesWeights[channel.node] = 1;
        return assets::sampleAnimation(sampler, seconds, pose.weights[channel.node]);
    }
    std::array<double, 4> v{};
    assets::sampleAnimation(sampler, seconds, std::span(v).first(sampler.width));
    if (channel.path == AnimationPath::Weights) {
        std::vector<double>& weights = pose.weights[channel.node];
        weights.resize(std::max<size_t>(weights.size(), channel.weight + 1));
        pose.movesWeights[channel.node] = 1;
        weights[channel.weight] = v[0];
        return;
    }
    if (channel.path == AnimationPath::Property) {
        pose.properties[channel.node] = float4(v[0], v[1], v[2], v[3]);
        pose.movesProperty[channel.node] = 1;
        return;
    }
    NodePose& node = pose.nodes[channel.node];
    pose.movesNode[channel.node] = 1;
    if (channel.path == AnimationPath::Translation) node.translation = { v[0], v[1], v[2] };
    if (channel.path == AnimationPath::Rotation) node.rotation = { v[0], v[1], v[2], v[3] };
    if (channel.path == AnimationPath::Scale) node.scale = { v[0], v[1], v[2] };
}

/// The node handles of a copy, in the order of the model's nodes, because Scene::add() created children in that order.
std::vector<Node> nodesOfCopy(Model::Impl const& model, scene::Transforms const& transforms, Node root) {
    std::vector<Node> nodes, nextChild;
    Node nextOfRoot = transforms.firstChild(root);
    for (Model::Impl::PartNode const& part : model.nodes) {
        Node& next = part.parent == Model::Impl::kRoot ? nextOfRoot : nextChild[part.parent];
        const Node node = next;
        FILAMENT_ASSERT(node && transforms.name(node) == part.name,
                        "an animator gets the root that Scene::add(model) returned, with its nodes as they were then");
        next = transforms.nextSibling(node);
        nodes.push_back(node);
        nextChild.push_back(transforms.firstChild(node));
    }
    return nodes;
}

} // namespace

struct Animator::Impl {
    Impl(std::shared_ptr<const Model::Impl> ofModel, Scene& inScene, Node root)
            : kept(std::move(ofModel)), model(*kept), scene(inScene.impl()), sceneLink(inScene.share()),
              nodes(nodesOfCopy(model, scene.data.transforms, root)), rest(restPose(model)), pose(rest), other(rest),
              parts(model, scene, root) {}

    void sample(uint32_t animation, double seconds, Pose& into) const {
        FILAMENT_ASSERT(animation < model.animations.size(), "an animation is one of the model's");
        assets::AnimationData const& data = model.animations[animation];
        for (AnimationChannel const& channel : data.channels) {
            startAtRest(channel, into);
            filament_core::apply(channel, data.samplers[channel.sampler], seconds, into);
        }
    }

    /// Of what the channel moves, the rest is as in the file.
    void startAtRest(AnimationChannel const& channel, Pose& into) const {
        if (channel.path == AnimationPath::Property) return;
        if (!into.movesNode[channel.node]) into.nodes[channel.node] = rest.nodes[channel.node];
        if (channel.weight != assets::kNone && !into.movesWeights[channel.node])
            into.weights[channel.node] = rest.weights[channel.node];
    }

    /// Blends `pose` with `other`.
    void mix(double weight) {
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (pose.movesNode[i] || other.movesNode[i]) {
                pose.nodes[i] = assets::blend(posed(pose, i), posed(other, i), weight);
                pose.movesNode[i] = 1;
            }
            if (pose.movesWeights[i] || other.movesWeights[i]) mixWeights(i, weight);
        }
        for (size_t i = 0; i < pose.properties.size(); ++i) {
            if (pose.movesProperty[i] || other.movesProperty[i]) mixProperty(i, weight);
        }
    }

    void mixProperty(size_t i, double weight) {
        const float4 a = pose.movesProperty[i] ? pose.properties[i] : rest.properties[i];
        const float4 b = other.movesProperty[i] ? other.properties[i] : rest.properties[i];
        const bool isStep = assets::isBoolean(model.properties[i].name);
        pose.properties[i] = isStep ? (weight < 0.5 ? a : b) : a + (b - a) * static_cast<float>(weight);
        pose.movesProperty[i] = 1;
    }

    NodePose const& posed(Pose const& of, size_t i) const { return of.movesNode[i] ? of.nodes[i] : rest.nodes[i]; }

    void mixWeights(size_t i, double weight) {
        std::vector<double>& a = pose.weights[i];
        std::vector<double> const& b = other.movesWeights[i] ? other.weights[i] : rest.weights[i];
        if (!pose.movesWeights[i]) a = rest.weights[i];
        a.resize(std::max(a.size(), b.size()));
        for (size_t k = 0; k < a.size(); ++k) a[k] += ((k < b.size() ? b[k] : 0.0) - a[k]) * weight;
        pose.movesWeights[i] = 1;
    }

    void write() {
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (pose.movesNode[i]) scene.data.transforms.setTransform(nodes[i], assets::matrixFrom(pose.nodes[i]));
            if (pose.movesWeights[i]) writeWeights(nodes[i], pose.weights[i]);
        }
        parts.write(pose.properties, pose.movesProperty);
    }

    void writeWeights(Node node, std::vector<double> const& values) {
        weights.assign(values.begin(), values.end());
        scene::SceneData& data = scene.data;
        data.atNodes.renderables.forEach(data.transforms.slotOf(node), [&](Renderable renderable) {
            const uint32_t slot = deformationAt(data.renderables, data.renderables.index.at(renderable));
            if (slot != scene::kNotDeformed && data.deformations[slot].morph)
                scene::setMorphWeights(data, renderable, weights);
        });
    }

    std::shared_ptr<const Model::Impl> kept;
    Model::Impl const& model;
    Scene::Impl& scene; ///< while the link is not expired
    std::weak_ptr<Scene::Impl> sceneLink;
    std::vector<Node> nodes;
    Pose rest, pose, other;
    engine::ModelParts parts;
    std::vector<float> weights;
};

namespace {

/// A function of an animator, from its first line to its last.
class AnimatorCall {
public:
    AnimatorCall(Animator::Impl const* animator, const char* function) : mCall(function) {
        if (!animator) misused("the animator was moved from; use the one that it was moved to");
        if (animator->sceneLink.expired()) misused("its scene is gone");
        const engine::PublicCall checksEngineAndThread(&animator->scene, function);
    }

private:
    ApiCall mCall;
};

} // namespace

Animator::Animator(Model const& model, Scene& scene, Node root) {
    const auto ofScene = scene.share().lock();
    const engine::PublicCall call(ofScene, "Animator::Animator(Model, Scene, Node)");
    mImpl = std::make_shared<Impl>(engine::shareOf(model, ofScene->engine), scene, root);
}

void Animator::apply(uint32_t animation, double seconds) {
    const AnimatorCall call(mImpl.get(), "Animator::apply(uint32_t, double)");
    mImpl->pose.forget();
    mImpl->sample(animation, seconds, mImpl->pose);
    mImpl->write();
}

void Animator::crossFade(uint32_t first, double firstSeconds, uint32_t second, double secondSeconds, double weight) {
    const AnimatorCall call(mImpl.get(), "Animator::crossFade(uint32_t, double, uint32_t, double, double)");
    mImpl->pose.forget();
    mImpl->other.forget();
    mImpl->sample(first, firstSeconds, mImpl->pose);
    mImpl->sample(second, secondSeconds, mImpl->other);
    mImpl->mix(weight);
    mImpl->write();
}

void Animator::rest() {
    const AnimatorCall call(mImpl.get(), "Animator::rest()");
    mImpl->pose = mImpl->rest;
    for (assets::AnimationData const& animation : mImpl->model.animations) {
        for (AnimationChannel const& channel : animation.channels) {
            auto& moves = channel.path == AnimationPath::Weights    ? mImpl->pose.movesWeights
                          : channel.path == AnimationPath::Property ? mImpl->pose.movesProperty
                                                                    : mImpl->pose.movesNode;
            moves[channel.node] = 1;
        }
    }
    mImpl->write();
}

} // namespace filament_core
