// SPDX-License-Identifier: Apache-2.0
// lod_bench: frames with and without levels of detail (View::lod), in turns, on both APIs: copies of a model on a grid,
// seen from its edge.
//   Also    how long the model loads with and without, and how many pixels of the images differ by more than 2 / 255.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "bench/ChoicesInTurns.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

namespace filament_core::bench {
namespace {

struct Options {
    std::filesystem::path model;
    int rounds = 5, frames = 2;
    uint32_t side = 10; ///< copies
    uint2 size{ 1280, 720 };
    bool shadows = false;
};

/// Percent of the pixels.
double differing(Image const& a, Image const& b) {
    size_t count = 0;
    for (size_t pixel = 0; pixel < a.pixels.size(); pixel += 4) {
        bool differs = false;
        for (size_t i = pixel; i < pixel + 4; ++i)
            differs |= std::abs(std::to_integer<int>(a.pixels[i]) - std::to_integer<int>(b.pixels[i])) > 2;
        count += differs;
    }
    return 400.0 * static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

class Device {
public:
    Device(Engine engine, Options const& options)
            : mOptions(options), mEngine(std::move(engine)), mRenderer(mEngine), mScene(mEngine) {
        mView.size = options.size;
        mView.quality.shadows = options.shadows ? ShadowFilter::Pcf3 : ShadowFilter::Off;
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "lod_bench" }));
    }

    Result<void> load() {
        for (const bool simplified : { false, true }) {
            const auto begin = Clock::now();
            Result<Model> model = loadGltf(mEngine, mOptions.model, { .simplified = simplified });
            if (!model) return model.error();
            mEngine.waitIdle();
            std::printf("%s: loads in %.0f ms %s levels of detail\n", name(), millisecondsSince(begin),
                        simplified ? "with" : "without");
            if (simplified) mModel.emplace(std::move(*model));
        }
        place();
        return {};
    }

    /// Milliseconds per frame.
    double measure(float pixels) {
        mView.lod.pixels = pixels;
        mRenderer.render(mScene, mView, mTarget);
        mEngine.waitIdle();
        return millisecondsPerFrame(mEngine, mOptions.frames, [&] { mRenderer.render(mScene, mView, mTarget); });
    }

    uint32_t triangles() const { return mRenderer.statistics().triangles; }

    Image image(float pixels) {
        mView.lod.pixels = pixels;
        return mRenderer.renderToImage(mScene, mView).value();
    }

    const char* name() const { return toString(mEngine.device().backend); }

private:
    /// Two metres apart, each a metre large.
    void place() {
        const Box bounds = mModel->bounds();
        const double3 size = bounds.max - bounds.min;
        const double scale = 1 / std::max({ size.x, size.y, size.z });
        for (uint32_t x = 0; x < mOptions.side; ++x) {
            for (uint32_t z = 0; z < mOptions.side; ++z) {
                const double3 at(2.0 * x - mOptions.side + 1, 0, -2.0 * z);
                mScene.add(*mModel, glm::translate(glm::scale(glm::translate(double4x4(1), at), double3(scale)),
                                                   -(bounds.min + bounds.max) * 0.5));
            }
        }
        mScene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.3f } });
        mView.camera = Camera::lookAt({ 0, 2, 3.5 }, { 0, 0, -6 }, { .verticalFovDegrees = 50 });
    }

    Options const& mOptions;
    Engine mEngine;
    std::optional<Model> mModel;
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    Scene mScene;
    View mView;
};

Result<void> measureOn(Backend backend, Options const& options) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    Device device(std::move(*engine), options);
    if (Result<void> loaded = device.load(); !loaded) return loaded;
    constexpr std::array choices{ 0.0f, 0.5f, 1.0f, 2.0f };
    std::array<uint32_t, choices.size()> triangles{};
    const ChoicesInTurns<choices.size()> turns(options.rounds, [&](size_t i) {
        const double milliseconds = device.measure(choices[i]);
        triangles[i] = device.triangles();
        return std::array{ milliseconds };
    });
    const Image finest = device.image(0);
    for (size_t i = 0; i < choices.size(); ++i) {
        std::printf("| %s | %g | %u | %.1f | %.2f | %.2f %% |\n", device.name(), static_cast<double>(choices[i]),
                    triangles[i], turns.least(i), turns.ratio(i), differing(finest, device.image(choices[i])));
        std::fflush(stdout);
    }
    return {};
}

Result<void> run(Options const& options) {
    std::printf("| API | lod.pixels | triangles | ms | ratio | pixels that differ |\n|---|---|---|---|---|---|\n");
    for (const Backend backend : { Backend::Vulkan, Backend::Gles })
        if (Result<void> done = measureOn(backend, options); !done) return done;
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    tools::CommandLine app{ "Frames with and without levels of detail." };
    app.option("MODEL", options.model, "a glTF file").required();
    app.option("--rounds", options.rounds, "rounds; each draws with every limit").inRange(1, 1000);
    app.option("--frames", options.frames, "frames a measurement").inRange(1, 1000);
    app.option("--side", options.side, "copies on each side of the grid").inRange(1, 100);
    app.flag("--shadows", options.shadows, "with shadow maps");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "lod_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
