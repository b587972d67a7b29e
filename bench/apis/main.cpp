// SPDX-License-Identifier: Apache-2.0
// api_bench [--frames N] [--size WxH] [--only TEXT] [--api NAME]: the same frames on Vulkan and OpenGL ES in turns,
// first one, then the other first. The ratio of wall time and that of processor time are medians of the pairs, with the
// interval in which the true median lies with 95 % certainty. With --api only that API draws, for profilers.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Statistics.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::bench {
namespace {

struct Options {
    int frames = 48;
    uint2 size{ 1280, 720 };
    std::string only, api;
    std::filesystem::path assets;
};

struct Seconds {
    double wall = 0, processor = 0;
};

class Device;

struct Subject {
    const char* name;
    std::function<Result<void>(Device&, Scene&, View&)> fill;
};

/// An engine, and what stays loaded for all subjects.
class Device {
public:
    Device(Engine engine, Options const& options) : mOptions(options), mEngine(std::move(engine)) {}

    Result<void> load() {
        Result<Environment> environment =
                loadEnvironment(mEngine, mOptions.assets / "environments" / "studio_small_03_1k.hdr");
        if (!environment) return environment.error();
        mEnvironment.emplace(std::move(*environment));
        Result<Model> model = loadGltf(mEngine, mOptions.assets / "models" / "FlightHelmet" / "FlightHelmet.gltf");
        if (!model) return model.error();
        mModel.emplace(std::move(*model));
        const Mesh box = makeBox().value();
        mVertices = mEngine.own(mEngine.create(box.vertexBuffer()));
        mIndices = mEngine.own(mEngine.create(box.indexBuffer()));
        mMaterial = mEngine.own(createBuiltInMaterial(mEngine, "lit").value());
        mPaint = mEngine.own(mEngine.createInstance(mMaterial));
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mOptions.size, .name = "api_bench" }));
        return {};
    }

    Result<void> show(Subject const& subject) {
        mRenderer.emplace(mEngine);
        mScene = std::make_unique<Scene>(mEngine);
        mScene->setEnvironment(*mEnvironment);
        mView = { .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                  .size = mOptions.size };
        return subject.fill(*this, *mScene, mView);
    }

    Seconds draw() {
        const std::clock_t processor = std::clock();
        const auto begin = std::chrono::steady_clock::now();
        mRenderer->render(*mScene, mView, mTarget);
        mEngine.waitIdle();
        return { std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                 static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC };
    }

    Result<void> addHelmet(Scene& scene) const {
        scene.add(*mModel, fitToUnitCube(mModel->bounds()));
        return {};
    }

    /// 100 x 100 of their own, which share draw calls only as far as the engine merges them.
    void addBoxes(Scene& scene) const {
        for (int x = 0; x < 100; ++x) {
            for (int y = 0; y < 100; ++y)
                scene.add({ .vertices = mVertices,
                            .indices = mIndices,
                            .material = mPaint,
                            .worldFromObject = glm::scale(
                                    glm::translate(double4x4(1), double3(0.02 * (x - 50), 0.02 * (y - 50), 0)),
                                    double3(0.01)) });
        }
    }

private:
    Options const& mOptions;
    Engine mEngine;
    std::optional<Environment> mEnvironment;
    std::optional<Model> mModel;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mPaint;
    Owned<SwapChain> mTarget;
    std::unique_ptr<Scene> mScene;
    std::optional<Renderer> mRenderer;
    View mView;
};

void addSun(Scene& scene) {
    scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
}

std::vector<Subject> subjects() {
    return {
        { "nothing", [](Device&, Scene&, View&) { return Result<void>(); } },
        { "FlightHelmet", [](Device& device, Scene& scene, View&) { return device.addHelmet(scene); } },
        { "its shadow map drawn once",
          [](Device& device, Scene& scene, View&) {
              addSun(scene);
              return device.addHelmet(scene);
          } },
        { "sun, pcf3, sao, bloom, fxaa",
          [](Device& device, Scene& scene, View& view) {
              addSun(scene);
              view.effects.ambientOcclusion.enabled = true;
              view.effects.ambientOcclusion.method = AmbientOcclusionMethod::Sao;
              view.effects.bloom.enabled = true;
              view.quality.antiAliasing = AntiAliasing::Fxaa;
              return device.addHelmet(scene);
          } },
        { "four samples",
          [](Device& device, Scene& scene, View& view) {
              view.samples = 4;
              return device.addHelmet(scene);
          } },
        { "depth of field",
          [](Device& device, Scene& scene, View& view) {
              view.effects.depthOfField = { .enabled = true, .focusMeters = 1.6f, .blurScale = 4 };
              return device.addHelmet(scene);
          } },
        { "10 000 boxes",
          [](Device& device, Scene& scene, View&) {
              device.addBoxes(scene);
              return Result<void>();
          } },
    };
}

/// Medians of ratios, with the interval of the binomial distribution.
struct Ratio {
    double median = 0, low = 0, high = 0;
};

Ratio ratioOf(std::vector<double> values) {
    std::ranges::sort(values);
    const size_t count = values.size(), middle = count / 2;
    const auto reach = static_cast<size_t>(std::ceil(0.98 * std::sqrt(static_cast<double>(count))));
    return { values[middle], values[middle > reach ? middle - reach : 0], values[std::min(middle + reach, count - 1)] };
}

void compare(Subject const& subject, Device& vulkan, Device& gles, int frames) {
    std::vector<double> walls, processors, milliseconds;
    for (int i = -3; i < frames; ++i) {
        const bool isVulkanFirst = i % 2 == 0;
        const Seconds first = (isVulkanFirst ? vulkan : gles).draw(), second = (isVulkanFirst ? gles : vulkan).draw();
        if (i < 0) continue;
        const Seconds ofVulkan = isVulkanFirst ? first : second, ofGles = isVulkanFirst ? second : first;
        milliseconds.push_back(1e3 * ofGles.wall);
        walls.push_back(ofVulkan.wall / ofGles.wall);
        processors.push_back(ofVulkan.processor / ofGles.processor);
    }
    const Ratio wall = ratioOf(walls), processor = ratioOf(processors);
    std::printf("| %s | %.1f | %.3f | %.3f to %.3f | %.3f | %.3f to %.3f |\n", subject.name, median(milliseconds),
                wall.median, wall.low, wall.high, processor.median, processor.low, processor.high);
    std::fflush(stdout);
}

Result<std::unique_ptr<Device>> open(Backend backend, Options const& options) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    auto device = std::make_unique<Device>(std::move(*engine), options);
    if (Result<void> loaded = device->load(); !loaded) return loaded.error();
    return device;
}

Result<void> run(Options const& options) {
    std::vector<std::unique_ptr<Device>> devices;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        if (!options.api.empty() && options.api != toString(backend)) continue;
        Result<std::unique_ptr<Device>> device = open(backend, options);
        if (!device) return device.error();
        devices.push_back(std::move(*device));
    }
    std::printf("| frame | OpenGL ES ms | Vulkan / OpenGL ES | 95 %% | processor time | 95 %% "
                "|\n|---|---|---|---|---|---|\n");
    for (Subject const& subject : subjects()) {
        if (std::string(subject.name).find(options.only) == std::string::npos) continue;
        for (std::unique_ptr<Device> const& device : devices)
            if (Result<void> shown = device->show(subject); !shown) return shown;
        if (devices.size() == 2)
            compare(subject, *devices[0], *devices[1], options.frames);
        else
            for (int i = 0; i < options.frames; ++i) devices[0]->draw();
    }
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options{ .assets = tools::assetDir() };
    std::string size = "1280x720";
    tools::CommandLine app{ "The same frames on Vulkan and OpenGL ES." };
    app.option("--frames", options.frames, "pairs of frames a measurement").inRange(4, 10'000);
    app.option("--size", size, "WxH in pixels");
    app.option("--only", options.only, "frames whose names contain this");
    app.option("--api", options.api, "draw on this one alone").oneOf({ "vulkan", "gles" });
    app.option("--assets", options.assets, "directory with models/ and environments/");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    if (std::sscanf(size.c_str(), "%ux%u", &options.size.x, &options.size.y) != 2 || options.size.x == 0 ||
        options.size.y == 0) {
        std::fprintf(stderr, "api_bench: error: --size wants WxH, got '%s'\n", size.c_str());
        return 1;
    }
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "api_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
