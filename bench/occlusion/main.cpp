// SPDX-License-Identifier: Apache-2.0
// occlusion_bench: frames with and without View::occlusionCulling, in turns, on both APIs, of generated scenes:
//   city   10 000 buildings on a grid, seen from a street: boxes and towers with many windows.
//   rooms  20 x 20 rooms with doors and furniture, seen from one of them.
//   field  the city from above, where nearly nothing is hidden: what looking for it costs.
// Images with and without are compared as well: they have the same bits.
//   Status  0: measured, table on standard output; 1: the reason in one line, or images that differ.
#include "base/Assert.h"
#include "base/Statistics.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>

namespace filament_core::bench {
namespace {

struct Options {
    int rounds = 7, frames = 2;
    uint2 size{ 1280, 720 };
    std::vector<std::string> scenes{ "city", "rooms", "field" };
};

enum Shape : size_t { kBox, kTorus, kCylinder, kShapes };

class Device {
public:
    Device(Engine engine, Options const& options) : mOptions(options), mEngine(std::move(engine)), mRenderer(mEngine) {
        mMaterial = mEngine.own(createBuiltInMaterial(mEngine, "lit").value());
        for (const float3 color : { float3(0.7f, 0.65f, 0.6f), float3(0.5f, 0.3f, 0.25f), float3(0.3f, 0.35f, 0.4f) }) {
            mPaints.push_back(mEngine.own(mEngine.createInstance(mMaterial)));
            const Result<void> set = mEngine.set(mPaints.back(), "baseColor", color);
            FILAMENT_ASSERT(set, "the built-in material has a base colour");
        }
        const std::array<Result<Mesh>, kShapes> meshes{ makeBox(), makeTorus(), makeCylinder() };
        for (Result<Mesh> const& mesh : meshes) {
            mVertices.push_back(mEngine.own(mEngine.create(mesh->vertexBuffer())));
            mIndices.push_back(mEngine.own(mEngine.create(mesh->indexBuffer())));
            mOccluders.push_back(mesh->occluder());
        }
        for (std::string const& name : options.scenes) addScene(name);
        mView.size = options.size;
        mView.quality.shadows = ShadowFilter::Off; // maps are drawn once, and kept
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "occlusion_bench" }));
    }

    /// Milliseconds per frame.
    double measure(size_t scene, bool culls) {
        using Clock = std::chrono::steady_clock;
        choose(scene, culls);
        mRenderer.render(*mScenes[scene].scene, mView, mTarget);
        mEngine.waitIdle();
        const auto begin = Clock::now();
        for (int i = 0; i < mOptions.frames; ++i) {
            mRenderer.render(*mScenes[scene].scene, mView, mTarget);
            mEngine.waitIdle();
        }
        mVisible[culls] = mRenderer.statistics().visible;
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count() / mOptions.frames;
    }

    bool hasSameBits(size_t scene) {
        std::array<Image, 2> images;
        for (const bool culls : { false, true }) {
            choose(scene, culls);
            images[culls] = mRenderer.renderToImage(*mScenes[scene].scene, mView).value();
        }
        return images[0].pixels == images[1].pixels;
    }

    uint32_t visible(bool culls) const { return mVisible[culls]; }
    const char* name() const { return toString(mEngine.device().backend); }

private:
    struct Shown {
        std::unique_ptr<Scene> scene;
        Camera camera;
    };

    void choose(size_t scene, bool culls) {
        mView.camera = mScenes[scene].camera;
        mView.occlusionCulling = culls;
    }

    void add(Scene& scene, Shape shape, double3 at, double3 scale, size_t paint) {
        scene.add({ .vertices = mVertices[shape],
                    .indices = mIndices[shape],
                    .material = mPaints[paint % mPaints.size()],
                    .occluder = mOccluders[shape],
                    .worldFromObject = glm::scale(glm::translate(double4x4(1), at), scale) });
    }

    /// Blocks of 20 m, with towers and water tanks on their roofs.
    void addCity(Scene& scene, std::mt19937& random) {
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int x = 0; x < 100; ++x) {
            for (int z = 0; z < 100; ++z) {
                const double height = 12 + 40 * next() * next(), middle = 20 * (x - 49.5);
                add(scene, kBox, { middle, height / 2, -20.0 * z }, { 13, height, 14 }, random());
                add(scene, kTorus, { middle, height + 1, -20.0 * z }, double3(3), random());
                for (int lamp = 0; lamp < 2; ++lamp)
                    add(scene, kCylinder, { middle + 8, 2, -20.0 * z + 6 * lamp }, { 0.2, 4, 0.2 }, random());
            }
        }
        add(scene, kBox, { 0, -0.5, -1000 }, { 3000, 1, 3000 }, 2);
    }

    /// Rooms of 6 x 6 x 3 m; walls leave a door in the middle.
    void addRooms(Scene& scene, std::mt19937& random) {
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int x = 0; x < 20; ++x) {
            for (int z = 0; z < 20; ++z) {
                const double3 at(6.0 * x, 0, -6.0 * z);
                for (const double side : { -1.8, 1.8 }) {
                    add(scene, kBox, at + double3(side, 1.5, -3), { 2.4, 3, 0.2 }, 0);
                    add(scene, kBox, at + double3(3, 1.5, side), { 0.2, 3, 2.4 }, 0);
                }
                add(scene, kBox, at + double3(0, -0.05, 0), { 6, 0.1, 6 }, 1);
                add(scene, kBox, at + double3(0, 3.05, 0), { 6, 0.1, 6 }, 0);
                for (int i = 0; i < 12; ++i)
                    add(scene, i % 2 ? kTorus : kCylinder, at + double3(4 * next() - 2, 0.5, 4 * next() - 2),
                        double3(0.3 + 0.4 * next()), random());
            }
        }
    }

    void addScene(std::string const& name) {
        Shown& shown = mScenes.emplace_back(std::make_unique<Scene>(mEngine));
        std::mt19937 random(1);
        if (name == "rooms") {
            addRooms(*shown.scene, random);
            shown.camera = Camera::lookAt({ 60.5, 1.6, -1 }, { 58, 1.4, -20 }, { .verticalFovDegrees = 60 });
        } else {
            addCity(*shown.scene, random);
            shown.camera = name == "city"
                                   ? Camera::lookAt({ 0.5, 1.7, 15 }, { 3, 6, -100 }, { .verticalFovDegrees = 60 })
                                   : Camera::lookAt({ 0, 700, 300 }, { 0, 0, -800 }, { .verticalFovDegrees = 60 });
        }
        shown.scene->add(SunLight{ .directionWorld = { -0.4f, -1, -0.3f } });
    }

    Options const& mOptions;
    Engine mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mPaints;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;
    std::vector<Occluder> mOccluders;
    std::vector<Shown> mScenes; // destroyed before the objects that they show
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    View mView;
    std::array<uint32_t, 2> mVisible{};
};

Result<void> measureOn(Backend backend, Options const& options) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    Device device(std::move(*engine), options);
    for (size_t scene = 0; scene < options.scenes.size(); ++scene) {
        std::array<std::vector<double>, 2> times;
        std::vector<double> ratios;
        for (int round = 0; round < options.rounds; ++round) {
            for (const bool culls : { false, true }) times[culls].push_back(device.measure(scene, culls));
            ratios.push_back(times[1].back() / times[0].back());
        }
        std::printf("| %s | %s | %u | %u | %.1f | %.1f | %.2f |\n", device.name(), options.scenes[scene].c_str(),
                    device.visible(false), device.visible(true), *std::ranges::min_element(times[0]),
                    *std::ranges::min_element(times[1]), median(ratios));
        std::fflush(stdout);
        if (!device.hasSameBits(scene))
            return fail(ErrorCode::Internal, "scene '{}': the images with and without culling differ",
                        options.scenes[scene]);
    }
    return {};
}

Result<void> run(Options const& options) {
    std::printf("| API | scene | in view | drawn | ms without | ms with | ratio |\n|---|---|---|---|---|---|---|\n");
    for (const Backend backend : { Backend::Vulkan, Backend::Gles })
        if (Result<void> done = measureOn(backend, options); !done) return done;
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    tools::CommandLine app{ "Frames with and without occlusion culling." };
    app.option("--rounds", options.rounds, "rounds; each draws both").inRange(1, 1000);
    app.option("--frames", options.frames, "frames a measurement").inRange(1, 1000);
    app.option("--scenes", options.scenes, "which scenes").oneOf({ "city", "rooms", "field" });
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "occlusion_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
