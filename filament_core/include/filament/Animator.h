// SPDX-License-Identifier: Apache-2.0
/// Animator: plays the animations of a model onto one copy of it in a scene, by moving its nodes and setting its morph
/// weights; skins follow with the next frame.
///   In      a model, a scene, and the root that Scene::add(model) returned there: make the animator right after that,
///           before nodes of the copy are moved elsewhere or removed.
///   Time    seconds from the start of the animation; before the first key the first counts, behind the last the last.
///           A program that loops hands in std::fmod(seconds, model.animationSeconds(i)).
///   Thread  the app thread, between frames.
///   Memory  a node handle a node of the model, and the pose.   Cost: in proportion to the channels of the animation.
///   Life    the model, and the nodes of the copy, outlive its use; the scene may be moved.
///   Fails   an animation that the model lacks, or a copy with other nodes than the model's, is an assertion.
#pragma once

#include <filament/Gltf.h>
#include <filament/Scene.h>

#include <cstdint>
#include <memory>

namespace filament {

class Animator {
public:
    Animator(Model const& model, Scene& scene, Node root);
    Animator(Animator&&) noexcept;
    Animator& operator=(Animator&&) noexcept;
    ~Animator();

    /// Poses what the animation moves as it is at that time; what it does not move stays as it is.
    void apply(uint32_t animation, double seconds);

    /// Between two animations: `weight` 0 is the first, 1 the second. What only one of them moves goes from or to rest.
    void crossFade(uint32_t first, double firstSeconds, uint32_t second, double secondSeconds, double weight);

    /// Everything that any animation moves as it was in the file.
    void rest();

    struct Impl;

private:
    std::unique_ptr<Impl> mImpl;
};

} // namespace filament
