// SPDX-License-Identifier: Apache-2.0
/// FaultStage: an engine with a small scene, for injecting faults anywhere.
///   In      a backend, workers, and the injector of backend/layers/Faulty.   Out: images, or errors.
///   Thread  the app thread.
#pragma once

#include "backend/layers/Faulty.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/materials/LoadMaterial.h"
#include "shaders/package/EngineMaterials.h"
#include "tests/scenes/Sphere.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::test {

/// FILAMENT_STRESS is set: test every place instead of some.
inline bool isStress() { return std::getenv("FILAMENT_STRESS") != nullptr; }

/// The folder for the tests' output.
inline std::filesystem::path faultFolder() { return tools::buildDir() / "faults"; }

struct StageOptions {
    Backend backend = Backend::Null;
    int workers = 0;
    int spheres = 3;
    int materials = 1; ///< spheres take them in turn; equal neighbours are drawn together
    bool validation = true;
};

inline EngineOptions engineOptions(StageOptions const& options, std::shared_ptr<backend::FaultInjector> faults = {}) {
    return { .backend = options.backend,
             .workers = options.workers,
             .validation = options.validation,
             .hashFrames = true,
             .cacheDirectory = faultFolder() / "cache",
             .debug = { .faults = std::move(faults) } };
}

inline Result<Engine> makeEngine(StageOptions const& options, std::shared_ptr<backend::FaultInjector> faults = {}) {
    return Engine::create(engineOptions(options, std::move(faults)));
}

/// The material of the spheres, unpacked once: sweeps make thousands of stages, and inject no faults while they do.
/// Without the variants that no stage draws, of which it would make as many copies.
inline scene::Material const& ballMaterial() {
    static const scene::Material ball = [] {
        constexpr int kNotDrawn = shader::kVariantShadowReceiver | shader::kVariantSkinning | shader::kVariantDebug;
        scene::Material material =
                std::move(*engine::loadMaterial({ .package = shader::engineMaterial("gltf_lit_opaque") }));
        std::erase_if(material.package.variants,
                      [](shader::Variant const& variant) { return (variant.key & kNotDrawn) != 0; });
        return material;
    }();
    return ball;
}

/// Spheres in rows, each at a child of one root, and a sun; images of 32 x 32 pixels.
class FaultStage {
public:
    explicit FaultStage(Engine& engine, StageOptions const& options = {})
            : mEngine(engine), mScene(engine), mSphere(engine, scenes::makeSphere(4, 8)) {
        mMaterial = engine.own(*engine.impl().addMaterial(ballMaterial()));
        for (int i = 0; i < options.materials; ++i) {
            mInstances.push_back(engine.own(engine.createInstance(mMaterial)));
            EXPECT_TRUE(engine.set(mInstances.back(), "baseColorFactor", float4(0.8f, 0.4f, 0.2f, 1)).ok());
            EXPECT_TRUE(engine.set(mInstances.back(), "roughnessFactor", 0.5f).ok());
        }
        mRoot = mScene.add(NodeDesc{ .name = "root" });
        for (int i = 0; i < options.spheres; ++i)
            place({ 0.4 * (i % 3 - 1), 0, -0.5 * (i / 3) }, mInstances[static_cast<size_t>(i % options.materials)]);
        mScene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
        mView.camera = Camera::lookAt({ 0, 0.5, 4 }, { 0, 0, 0 });
        mView.size = { 32, 32 };
        mView.quality.shadows = ShadowFilter::Off; // whether a map is new depends on the frame before
        mRenderer.emplace(engine);
    }

    /// Draws one frame and waits for it.
    Result<Image> draw() { return mRenderer->renderToImage(mScene, mView); }
    /// Makes the next frame place every sphere again.
    void move() {
        double4x4 worldFromRoot(1);
        worldFromRoot[3] = double4(0.1, 0.2, -0.3, 1);
        mScene.setTransform(mRoot, worldFromRoot);
    }
    Renderer& renderer() { return *mRenderer; }
    Scene& scene() { return mScene; }
    View& view() { return mView; }
    /// The packet hash of the last frame; 0 if it was skipped.
    uint64_t packetHash() {
        mEngine.waitIdle();
        uint64_t newest = 0;
        for (FrameTimings const& timings : mRenderer->takeTimings()) newest = timings.packetHash;
        return newest;
    }

private:
    void place(double3 at, MaterialInstance material) {
        double4x4 world(1);
        world[3] = double4(at, 1);
        const Node node = mScene.add(NodeDesc{ .parent = mRoot, .parentFromNode = world });
        RenderableDesc sphere = mSphere.renderable(material);
        sphere.node = node;
        mScene.add(sphere);
    }

    Engine& mEngine;
    Scene mScene;
    View mView;
    Node mRoot;
    scenes::Sphere mSphere;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::optional<Renderer> mRenderer; // ends before what it draws
};

inline bool contains(std::string const& text, const char* part) { return text.find(part) != std::string::npos; }

} // namespace filament_core::test
