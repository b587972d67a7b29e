// SPDX-License-Identifier: Apache-2.0
/// CaseStage: an engine with one of everything that a view can see, for generated views.
///   Thread  one.   Memory: the objects of one scene.   Fails: by failing the running test.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/generated/ViewCases.h"

#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace filament_core::test {

class CaseStage {
public:
    explicit CaseStage(Backend backend, int workers = 1);
    ~CaseStage();

    /// The image after so many frames with a renderer of their own, and what the last one counted.
    Image draw(ViewCase const& viewCase, int frames = 3);
    FrameStatistics const& statistics() const { return mStatistics; }
    uint64_t commands() const { return mCommands; } ///< of the frames of the last draw()

    Engine& engine() { return *mEngine; }
    Scene& scene(SeenScene which) { return mScenes.at(which); }

private:
    void makeMaterials();
    void makeScenes();
    void addLights(Scene& scene);
    void addSky(Scene& scene);
    Renderable add(Scene& scene, std::string_view material, double3 at, double scale, float yaw = 0);
    Image drawTo(SwapChain target, ViewCase const& viewCase, View view, int frames);
    Image drawTo(RenderTarget target, ViewCase const& viewCase, View view, int frames);
    template <class Target>
    Image drawFrames(Target target, ViewCase const& viewCase, View view, int frames);

    std::optional<Engine> mEngine;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Owned<Texture> mSky, mDirt;
    Owned<IndirectLight> mLight;
    Owned<Skybox> mSkybox;
    std::map<std::string, Owned<Material>, std::less<>> mMaterials;
    std::map<std::string, Owned<MaterialInstance>, std::less<>> mInstances;
    std::map<SeenScene, Scene> mScenes;
    std::vector<std::pair<Scene*, Renderable>> mMoving;
    FrameStatistics mStatistics;
    uint64_t mCommands = 0;
};

} // namespace filament_core::test
