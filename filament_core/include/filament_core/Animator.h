// SPDX-License-Identifier: Apache-2.0
/// Animator: plays the animations of a model on one copy of it in a scene. It moves the nodes of the copy and sets its
/// morph weights; skins follow in the next frame.
///   In      a model, a scene, and the root that Scene::add(model) returned. Create the animator right after that,
///           before nodes of the copy are reparented or removed.
///   Time    seconds from the start of the animation; times outside its range use the first or last key. To loop, pass
///           std::fmod(seconds, model.animationSeconds(i)).
///   Thread  the app thread, between frames.
///   Memory  one handle per node of the model, and the pose.   Cost: proportional to the channels of the animation.
///   Life    the animator keeps the model; the scene may be moved. It is used only while the nodes of the copy are
///           there.
///   Fails   an animation index that the model lacks, or a copy whose nodes differ from the model's, is an assertion.
#pragma once

#include <filament_core/Gltf.h>
#include <filament_core/Scene.h>

#include <cstdint>
#include <memory>

namespace filament_core {

class Animator {
public:
    Animator(Model const& model, Scene& scene, Node root);
    Animator(Animator&&) noexcept = default;
    Animator& operator=(Animator&&) noexcept = default;

    /// Poses everything that the animation moves as it is at that time; everything else stays unchanged.
    void apply(uint32_t animation, double seconds);

    /// Blends two animations: `weight` 0 is the first, 1 the second. Anything that only one of them moves blends with
    /// its rest pose.
    void crossFade(uint32_t first, double firstSeconds, uint32_t second, double secondSeconds, double weight);

    /// Restores everything that any animation moves to its pose in the file.
    void rest();

    struct Impl;

private:
    std::shared_ptr<Impl> mImpl; ///< not shared
};

} // namespace filament_core
