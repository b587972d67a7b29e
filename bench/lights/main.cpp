// SPDX-License-Identifier: Apache-2.0
// lights_bench: what a frame costs with 1, 10, 50, 200, ... lamps of half a metre's range above a floor that fills the
// picture, on both APIs.
//   Method  one engine per API; every round draws every number of lamps on each, so that all see the same machine.
//           Milliseconds of a frame from render() until the device is idle; medians of the ratios within rounds.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "tools/materials/MaterialStand.h"
#include "tools/materials/MaterialTerms.h"

#include <filament/filament.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>

namespace filament::bench {
namespace {

struct Options {
    int rounds = 9, frames = 3;
    uint2 size{ 1280, 720 };
    double range = 0.5;
    std::vector<int> lamps{ 0, 1, 10, 50, 200, 1000, 4000 };
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// One engine, and a scene for each number of lamps.
class Device {
public:
    static Result<std::unique_ptr<Device>> open(Backend backend, Options const& options) {
        Result<Engine> engine = Engine::create({ .backend = backend });
        if (!engine) return engine.error();
        const auto file = tools::readMaterialTerm(tools::materialTerms().front());
        if (!file) return file.error();
        Result<tools::MaterialStand> floor = tools::MaterialStand::make(*engine, **file);
        if (!floor) return floor.error();
        std::unique_ptr<Device> device(new Device(std::move(*engine), std::move(*floor), options));
        for (const int lamps : options.lamps) device->addScene(lamps);
        return device;
    }

    /// Milliseconds per frame.
    double measure(size_t scene) {
        using Clock = std::chrono::steady_clock;
        const auto begin = Clock::now();
        for (int i = 0; i < mOptions.frames; ++i) {
            mRenderer.render(*mScenes[scene], mView, mTarget);
            mEngine.waitIdle();
        }
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count() / mOptions.frames;
    }

    const char* name() const { return toString(mEngine.device().backend); }

private:
    Device(Engine engine, tools::MaterialStand floor, Options const& options)
            : mOptions(options), mEngine(std::move(engine)), mFloor(std::move(floor)), mRenderer(mEngine) {
        mView.camera = Camera::lookAt({ 0, -9, 7 }, { 0, 0.5, 0 }, { .verticalFovDegrees = 50 }, {}, { 0, 0, 1 });
        mView.size = options.size;
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "lights_bench" }));
    }

    // Lamps all over what the camera sees of the floor; the first one in the middle.
    void addScene(int lamps) {
        mScenes.push_back(std::make_unique<Scene>(mEngine));
        Scene& scene = *mScenes.back();
        mFloor.addTo(scene,
                     double4x4(double4(80, 0, 0, 0), double4(0, 80, 0, 0), double4(0, 0, 80, 0), double4(0, 0, 0, 1)));
        std::mt19937 random(1);
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int i = 0; i < lamps; ++i) {
            const double y = i ? -5 + 17 * next() : 0.5, width = 6 + 0.55 * (y + 5);
            const double x = i ? (2 * next() - 1) * width : 0;
            scene.add(PointLight{ .positionWorld = { x, y, 0.1 + 0.3 * next() },
                                  .intensity = Candela{ 10'000 },
                                  .rangeMeters = static_cast<float>(mOptions.range) });
        }
        mRenderer.render(scene, mView, mTarget);
        mEngine.waitIdle();
    }

    Options const& mOptions;
    Engine mEngine;
    tools::MaterialStand mFloor;
    std::vector<std::unique_ptr<Scene>> mScenes; // destroyed before the objects that they show
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    View mView;
};

void print(Device const& device, Options const& options, std::vector<std::vector<double>> const& times) {
    const auto one = std::ranges::find(options.lamps, 1);
    for (size_t i = 0; i < options.lamps.size(); ++i) {
        std::vector<double> ratios;
        for (size_t round = 0; one != options.lamps.end() && round < times[i].size(); ++round)
            ratios.push_back(times[i][round] / times[static_cast<size_t>(one - options.lamps.begin())][round]);
        std::printf("| %s | %d | %.1f | %.1f | %.2f |\n", device.name(), options.lamps[i],
                    *std::ranges::min_element(times[i]), median(times[i]), ratios.empty() ? 0 : median(ratios));
    }
}

Result<void> run(Options const& options) {
    std::vector<std::unique_ptr<Device>> devices;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Result<std::unique_ptr<Device>> device = Device::open(backend, options);
        if (!device) return device.error();
        devices.push_back(std::move(*device));
    }
    std::vector times(devices.size(), std::vector<std::vector<double>>(options.lamps.size()));
    for (int round = 0; round < options.rounds; ++round) {
        for (size_t d = 0; d < devices.size(); ++d) {
            for (size_t i = 0; i < options.lamps.size(); ++i) times[d][i].push_back(devices[d]->measure(i));
        }
    }
    std::printf("| API | lamps | minimum ms | median ms | x one lamp |\n|---|---|---|---|---|\n");
    for (size_t d = 0; d < devices.size(); ++d) print(*devices[d], options, times[d]);
    return {};
}

} // namespace
} // namespace filament::bench

int main(int argc, char** argv) {
    using namespace filament;
    bench::Options options;
    CLI::App app{ "Frames with many small lamps, beside a frame with one." };
    app.add_option("--rounds", options.rounds, "rounds; each draws every number of lamps")->check(CLI::Range(1, 1000));
    app.add_option("--frames", options.frames, "frames a measurement")->check(CLI::Range(1, 1000));
    app.add_option("--lamps", options.lamps, "numbers of lamps")->check(CLI::Range(0, 100'000));
    app.add_option("--range", options.range, "metres; 0: unlimited")->check(CLI::Range(0.0, 1e6));
    CLI11_PARSE(app, argc, argv);
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "lights_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
