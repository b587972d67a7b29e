// SPDX-License-Identifier: Apache-2.0
// effects_bench [--frames N] [--size WxH] [--only TEXT] [--unseen] [--json FILE]: the cost of effects where they are
// visible, and that invisible ones cost nothing. Both frames of a pair are drawn in turns, first one,
// then the other first, and the ratio is that of each pair: its median, and the interval in which the true median lies
// with 95 % certainty. What cannot be seen must have the same bits, the same draws and the same passes, or the program
// fails. The last line is the time of a pass that fetches one texel a pixel: the lower bound of all full-screen passes.
#include "base/Statistics.h"
#include "bench/effects/Pairs.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

namespace {

using namespace filament_core;
using bench::Moving;
using bench::Pair;
using Clock = std::chrono::steady_clock;

struct Options {
    int frames = 48;
    uint2 size{ 1280, 720 };
    std::filesystem::path assets;
};

struct Measured {
    double median = 0, low = 0, high = 0; ///< of the ratio
    double milliseconds = 0;              ///< of the plain frame
    bool isSame = false;                  ///< bits, draws and passes
};

/// What both frames of a pair show.
struct Subject {
    Model model;
    Environment environment;
    std::optional<tools::MaterialStand> mirror;
};

double4x4 belowModel() {
    return glm::scale(glm::translate(double4x4(1.0), double3(0, -0.52, 0)), double3(1.5, 0.02, 1.5));
}

/// One of the two frames.
class Side {
public:
    Side(Engine& engine, Subject const& subject, Pair const& pair, std::function<void(Scene&, View&)> const& set,
         uint2 size)
            : mEngine(engine), mScene(engine), mRenderer(engine, { .passTimers = pair.name.empty() }),
              mMoving(pair.moving), mPlace(fitToUnitCube(subject.model.bounds())) {
        mRoot = mScene.add(subject.model, mPlace);
        mScene.setEnvironment(subject.environment);
        if (subject.mirror) subject.mirror->addTo(mScene, belowModel());
        mView.size = size;
        lookFrom({ 0.9, 0.6, 1.5 });
        set(mScene, mView);
        mTarget = engine.own(engine.create(SwapChainDesc{ .size = size, .name = "bench" }));
    }
    double draw() {
        ++mDrawn;
        if (mMoving == Moving::Model)
            mScene.setTransform(mRoot, glm::rotate(mPlace, 0.0175 * mDrawn, double3(0, 1, 0)));
        if (mMoving == Moving::Camera) lookFrom({ 0.9 + 0.002 * mDrawn, 0.6, 1.5 });
        const auto begin = Clock::now();
        mRenderer.render(mScene, mView, mTarget);
        mEngine.waitIdle();
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }
    /// With the light of the environment, around the model.
    void addProbe(Environment const& light, float halfSide) {
        mScene.add(ReflectionProbeDesc{ .halfExtentMeters = float3(halfSide), .light = light.indirectLight() });
    }
    Result<Image> picture() { return mRenderer.renderToImage(mScene, mView); }
    Renderer const& renderer() const { return mRenderer; }
    std::vector<FrameTimings> takeTimings() { return mRenderer.takeTimings(); }

private:
    void lookFrom(double3 eye) { mView.camera = Camera::lookAt(eye, { 0, 0, 0 }, { .verticalFovDegrees = 40 }); }

    Engine& mEngine;
    Scene mScene;
    Renderer mRenderer;
    View mView;
    Owned<SwapChain> mTarget;
    Moving mMoving;
    double4x4 mPlace;
    Node mRoot;
    int mDrawn = 0;
};

bool haveSameFrames(Side& a, Side& b) {
    const Result<Image> first = a.picture(), second = b.picture();
    const auto before = a.renderer().statistics(), after = b.renderer().statistics();
    return first && second && first->pixels == second->pixels && before.draws == after.draws &&
           before.passesRun == after.passesRun;
}

Result<tools::MaterialStand> makeMirror(Engine& engine) {
    const auto file = tools::readMaterialFile(tools::sourceDir() / "samples/materials/reflections_screen.mat");
    if (!file) return file.error();
    return tools::MaterialStand::make(engine, **file, {}, "box");
}

Result<Subject> load(Engine& engine, Pair const& pair, Options const& options) {
    auto environment = loadEnvironment(engine, options.assets / "environments" / "studio_small_03_1k.hdr");
    if (!environment) return environment.error();
    auto model = loadGltf(engine, options.assets / "models" / pair.file, { .sectionPlanes = pair.isCut });
    if (!model) return model.error();
    Subject subject{ std::move(*model), std::move(*environment), {} };
    if (pair.hasMirror) {
        auto mirror = makeMirror(engine);
        if (!mirror) return mirror.error();
        subject.mirror.emplace(std::move(*mirror));
    }
    return subject;
}

Result<Measured> measure(Backend backend, Pair const& pair, Options const& options) {
    auto engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    const auto subject = load(*engine, pair, options);
    if (!subject) return subject.error();
    Side plain(*engine, *subject, pair, pair.plain, options.size);
    Side effect(*engine, *subject, pair, pair.effect, options.size);
    for (const float halfSide : pair.probes) effect.addProbe(subject->environment, halfSide);
    Measured measured;
    measured.isSame = haveSameFrames(plain, effect);
    std::vector<double> ratios, times;
    for (int i = -2; i < options.frames; ++i) {
        const bool isPlainFirst = i % 2 == 0;
        const double first = (isPlainFirst ? plain : effect).draw(), second = (isPlainFirst ? effect : plain).draw();
        if (i < 0) continue;
        times.push_back(1e3 * (isPlainFirst ? first : second));
        ratios.push_back(isPlainFirst ? second / first : first / second);
    }
    std::ranges::sort(ratios);
    std::ranges::sort(times);
    const size_t count = ratios.size(), middle = count / 2;
    const auto reach = static_cast<size_t>(std::ceil(0.98 * std::sqrt(static_cast<double>(count)))); // binomial, 95 %
    measured.median = ratios[middle];
    measured.low = ratios[middle > reach ? middle - reach : 0];
    measured.high = ratios[std::min(middle + reach, count - 1)];
    measured.milliseconds = times[middle];
    return measured;
}

/// Device time of the pass that makes distances of depths: one fetch and a few operations a pixel.
Result<double> millisecondsOfOneFetch(Backend backend, Options const& options) {
    const Pair pair{ .file = "FlightHelmet/FlightHelmet.gltf", .hasMirror = true }; // reflections read distances
    auto engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    const auto subject = load(*engine, pair, options);
    if (!subject) return subject.error();
    Side side(*engine, *subject, pair, bench::reflecting(true), options.size);
    for (int i = 0; i < options.frames; ++i) side.draw();
    std::vector<double> times;
    for (FrameTimings const& frame : side.takeTimings()) {
        for (PassTiming const& pass : frame.passes)
            if (pass.name == "distances") times.push_back(pass.gpuMilliseconds);
    }
    if (times.empty()) return Error{ ErrorCode::NotFound, "no frame had a pass 'distances'" };
    return median(std::move(times));
}

void print(Pair const& pair, Backend backend, Measured const& m) {
    std::printf("%-40s %-32s %-7s %8.1f   %6.3f  [%.3f, %.3f]%s\n", pair.name.c_str(), pair.file, toString(backend),
                m.milliseconds, m.median, m.low, m.high,
                !pair.isUnseen ? ""
                : m.isSame     ? "  same"
                               : "  DIFFERENT");
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    filament_core::tools::CommandLine app("What effects cost where they are seen, and where they are not");
    Options options{ .assets = tools::assetDir() };
    std::string size = "1280x720", json, only;
    bool isUnseenOnly = false;
    app.option("--frames", options.frames, "pairs of frames a measurement").inRange(4, 10'000);
    app.option("--size", size, "WxH in pixels");
    app.option("--assets", options.assets, "directory with models/ and environments/");
    app.option("--only", only, "pairs whose names contain this");
    app.flag("--unseen", isUnseenOnly, "only effects that the scene cannot show");
    app.option("--json", json, "also write the figures to this file");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    if (std::sscanf(size.c_str(), "%ux%u", &options.size.x, &options.size.y) != 2 || options.size.x == 0 ||
        options.size.y == 0) {
        std::fprintf(stderr, "effects_bench: error: --size wants WxH, got '%s'\n", size.c_str());
        return 1;
    }
    nlohmann::json report = nlohmann::json::array();
    bool isGood = true;
    std::printf("%-40s %-32s %-7s %8s   %s\n", "effect", "model", "api", "plain ms", "ratio");
    for (Pair const& pair : bench::effectPairs()) {
        if (pair.name.find(only) == std::string::npos) continue;
        if (isUnseenOnly && !pair.isUnseen) continue;
        for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
            const Result<Measured> measured = measure(backend, pair, options);
            if (!measured) {
                std::fprintf(stderr, "effects_bench: error: %s\n", measured.error().message.c_str());
                return 1;
            }
            print(pair, backend, *measured);
            isGood = isGood && (!pair.isUnseen || measured->isSame);
            report.push_back({ { "effect", pair.name },
                               { "model", pair.file },
                               { "api", toString(backend) },
                               { "plainMs", measured->milliseconds },
                               { "ratio", measured->median },
                               { "interval", { measured->low, measured->high } } });
        }
    }
    if (!json.empty()) std::ofstream(json) << report.dump(2) << '\n';
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        const Result<double> floor = millisecondsOfOneFetch(backend, options);
        if (!floor) {
            std::fprintf(stderr, "effects_bench: error: %s\n", floor.error().message.c_str());
            return 1;
        }
        std::printf("one fetch a pixel, %s: %.2f ms\n", toString(backend), *floor);
    }
    return isGood ? 0 : 1;
}
