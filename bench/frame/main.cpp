// SPDX-License-Identifier: Apache-2.0
// frame_bench [--frames N] [--size WxH] [--json FILE]: whole frames of real models on both APIs, side by side with the
// figures of a comparable engine on the same software stack (a quiet machine, minimum of 24 frames, 1280x720,
// environment + skybox + ACES, no anti-aliasing). Absolute times drift with the machine: read the ratio between the
// APIs first, then the distance to the published figure.
#include <filament_core/filament_core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "base/Statistics.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

namespace {

using namespace filament_core;
using Clock = std::chrono::steady_clock;

struct Subject {
    const char* file;
    double otherGl, otherVulkan; ///< milliseconds a frame of the other engine
};

constexpr std::array kSubjects{
    Subject{ "FlightHelmet/FlightHelmet.gltf", 59, 77 },
    Subject{ "ClearCoatTest/ClearCoatTest.glb", 36, 169 },
    Subject{ "SheenChair/SheenChair.gltf", 42, 72 },
    Subject{ "LittlestTokyo/LittlestTokyo.glb", 128, 292 },
};

struct Measured {
    double loadSeconds = 0;         ///< engine created, model and environment loaded
    double firstFrameSeconds = 0;   ///< render() until the device is idle
    double minimum = 0, median = 0; ///< milliseconds of a frame, render() until the device is idle
    double pipelined = 0;           ///< milliseconds a frame when frames overlap
    uint64_t draws = 0;
};

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Result<Measured> measure(Backend backend, std::filesystem::path const& assets, Subject const& subject, int frames,
                         uint2 size) {
    Measured measured;
    const auto start = Clock::now();
    auto engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    auto environment = loadEnvironment(*engine, assets / "environments" / "studio_small_03_1k.hdr");
    if (!environment) return environment.error();
    auto model = loadGltf(*engine, assets / "models" / subject.file);
    if (!model) return model.error();
    measured.loadSeconds = secondsSince(start);

    Scene scene(*engine);
    scene.add(*model, fitToUnitCube(model->bounds()));
    scene.setEnvironment(*environment);
    const View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                     .size = size };
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = size, .name = "bench" }));
    Renderer renderer(*engine);

    const auto frame = [&] {
        const auto begin = Clock::now();
        renderer.render(scene, view, target);
        engine->waitIdle();
        return secondsSince(begin);
    };
    measured.firstFrameSeconds = frame();
    std::vector<double> times;
    times.reserve(static_cast<size_t>(frames));
    for (int i = 0; i < frames; ++i) times.push_back(frame() * 1e3);
    measured.minimum = *std::ranges::min_element(times);
    measured.median = median(std::move(times));

    const auto begin = Clock::now();
    for (int i = 0; i < frames; ++i) renderer.render(scene, view, target);
    engine->waitIdle();
    measured.pipelined = secondsSince(begin) * 1e3 / frames;
    measured.draws = renderer.statistics().draws;
    return measured;
}

void print(Subject const& subject, Backend backend, Measured const& m) {
    const double better = std::min(subject.otherGl, subject.otherVulkan);
    std::printf("%-34s %-7s %8.2f %9.3f %8.1f %8.1f %10.1f %6llu   %5.0f  %5.2f x\n", subject.file, toString(backend),
                m.loadSeconds, m.firstFrameSeconds, m.minimum, m.median, m.pipelined,
                static_cast<unsigned long long>(m.draws), better, m.minimum / better);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    filament_core::tools::CommandLine app("Whole frames of real models on both APIs");
    int frames = 24;
    std::string size = "1280x720", json, assets = tools::assetDir();
    app.option("--frames", frames, "frames a measurement").inRange(1, 10'000);
    app.option("--size", size, "WxH in pixels");
    app.option("--assets", assets, "directory with models/ and environments/");
    app.option("--json", json, "also write the figures to this file");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    uint2 pixels{ 0, 0 };
    if (std::sscanf(size.c_str(), "%ux%u", &pixels.x, &pixels.y) != 2 || pixels.x == 0 || pixels.y == 0) {
        std::fprintf(stderr, "frame_bench: error: --size wants WxH, got '%s'\n", size.c_str());
        return 1;
    }

    nlohmann::json report;
    std::printf("%-34s %-7s %8s %9s %8s %8s %10s %6s   %5s  %s\n", "model", "api", "load s", "first s", "min ms",
                "med ms", "overlap ms", "draws", "other", "min / other");
    for (Subject const& subject : kSubjects) {
        for (Backend backend : { Backend::Vulkan, Backend::Gles }) {
            const auto measured = measure(backend, assets, subject, frames, pixels);
            if (!measured) {
                std::fprintf(stderr, "frame_bench: error: %s\n", measured.error().message.c_str());
                return 1;
            }
            print(subject, backend, *measured);
            report[subject.file][toString(backend)] = {
                { "loadSeconds", measured->loadSeconds }, { "firstFrameSeconds", measured->firstFrameSeconds },
                { "minimumMs", measured->minimum },       { "medianMs", measured->median },
                { "overlappedMs", measured->pipelined },  { "draws", measured->draws }
            };
        }
    }
    if (!json.empty()) std::ofstream(json) << report.dump(2) << '\n';
    return 0;
}
