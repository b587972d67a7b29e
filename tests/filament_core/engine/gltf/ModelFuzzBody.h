// SPDX-License-Identifier: Apache-2.0
/// ModelFuzzBody: shows arbitrary bytes as a model; one body for the fuzzer (tests/fuzz/ModelFuzz.cpp) and the mutation
/// test. What can be loaded can be shown in every way that the file offers: nothing ends the process.
#pragma once

#include <filament_core/filament_core.h>

#include <cstddef>
#include <span>

namespace filament_core::test {

/// Poses of each animation at, before and after its keys; each variant; levels of detail; each camera.
inline void showInEveryWay(Engine& engine, Renderer& renderer, Model const& model) {
    Scene scene(engine);
    const Node root = scene.add(model);
    if (model.environment()) scene.setEnvironment(*model.environment());
    View view{ .camera = Camera::lookAt({ 1, 2, 3 }, { 0, 0, 0 }), .size = { 16, 16 } };
    (void)renderer.renderToImage(scene, view);
    Result<ModelCopy> copy = ModelCopy::of(scene, root);
    Animator animator(model, scene, root);
    for (uint32_t i = 0; i < model.animationCount(); ++i) {
        const double end = model.animationSeconds(i);
        for (const double seconds : { -1.0, end / 2, end, 1e12 }) animator.apply(i, seconds);
        animator.crossFade(0, end / 3, i, end / 4, 0.5);
    }
    copy->chooseLevels(view);
    (void)renderer.renderToImage(scene, view);
    animator.rest();
    for (std::string const& name : copy->variants()) (void)copy->setVariant(name);
    for (CopyMaterial const& material : copy->materials()) (void)copy->set(material.name, "roughnessFactor", 0.5f);
    for (CopyCamera const& camera : copy->cameras()) {
        view.camera = camera.camera;
        (void)renderer.renderToImage(scene, view);
    }
    scene.remove(root);
}

/// Whether it could be loaded.
inline bool fuzzModel(Engine& engine, Renderer& renderer, std::span<const std::byte> file) {
    const Result<Model> model =
            loadGltf(engine, GltfMemory{ .file = file, .name = "fuzzed" }, { .deformable = true, .allLevels = true });
    if (model) showInEveryWay(engine, renderer, *model);
    (void)engine.takeErrors();
    return model.ok();
}

} // namespace filament_core::test
