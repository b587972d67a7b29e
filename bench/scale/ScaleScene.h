// SPDX-License-Identifier: Apache-2.0
/// ScaleScene: a scene of a given size, and its frames on the backend without a device.
///   Places  boxes on a square grid of one metre in random order, the last place of a renderable says nothing of its
///           neighbours. The camera looks down on the middle of the grid: on a share of it, or on all of it.
///   Times   of the app thread, which does all work of frames (no workers): from the first change of the scene until
///           render() has submitted the commands. Between frames the engine goes idle outside of the measured time.
///   Memory  bytes of the heap that the scene and its frames took (mallinfo2), all of it counted.
///   Thread  one.   Fails: an engine that cannot be created.
#pragma once

#include <filament_core/filament_core.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace filament_core::bench {

struct ScaleCase {
    uint32_t renderables = 1000;
    double moving = 0;  ///< share of the renderables that move in every frame
    double visible = 1; ///< share of the grid that the camera sees, about
    uint32_t materials = 1;
    uint32_t lights = 0;
    uint32_t shadowMaps = 0;   ///< a spot each
    bool keepsHistory = false; ///< temporal anti-aliasing, for motion vectors
};

struct ScaleFigures {
    std::vector<double> milliseconds; ///< of the app thread, by frame
    double buildSeconds = 0;          ///< to add everything to the scene
    double sceneBytes = 0;            ///< that this took
    double frameBytes = 0;            ///< that frames took on top
    FrameStatistics statistics{};
    uint32_t shadowMaps = 0;
};

class ScaleScene {
public:
    static Result<std::unique_ptr<ScaleScene>> create(ScaleCase const& size, int workers);
    /// Frames until nothing more is set up, then frames for about `seconds`, nine at least.
    ScaleFigures measure(double seconds);

private:
    ScaleScene(Engine engine, ScaleCase const& size);
    Result<void> fill();
    Result<void> addMaterials();
    void addMesh();
    void addRenderables();
    void addLights();
    double4x4 placeOf(uint32_t renderable, double height) const;
    /// Milliseconds.
    double frame();

    ScaleCase mSize;
    std::mt19937 mRandom{ 1 };
    View mView{ .size = { 1024, 1024 } };
    Engine mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Scene mScene;
    Renderer mRenderer;
    Owned<SwapChain> mTarget;
    uint32_t mColumns = 1;
    std::vector<uint32_t> mPlaces;
    std::vector<Renderable> mRenderables;
    uint32_t mFrame = 0;
    ScaleFigures mFigures;
};

} // namespace filament_core::bench
