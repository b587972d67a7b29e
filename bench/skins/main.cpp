// SPDX-License-Identifier: Apache-2.0
// skins_bench: frames with many copies of a skinned model, each in a pose of its own, drawn as instances and one by
// one, in turns. The second scene differs only in its material instances, of which each copy has one.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Assert.h"
#include "base/Statistics.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

namespace filament_core::bench {
namespace {

struct Options {
    std::string model;
    int copies = 256, rounds = 15;
    uint2 size{ 320, 180 };
};

/// A crowd on a grid.
class Crowd {
public:
    Crowd(Engine& engine, Model const& model, int copies, bool sharesMaterials) : mScene(engine), mRenderer(engine) {
        const auto side = static_cast<int>(std::ceil(std::sqrt(copies)));
        const double step = 1.2 * glm::length(model.bounds().max - model.bounds().min);
        for (int i = 0; i < copies; ++i) {
            const Node root = mScene.add(model);
            const double3 place((i % side - side / 2) * step, 0, (i / side - side / 2) * step);
            mScene.setTransform(root, glm::translate(double4x4(1.0), place));
            ModelCopy copy = *ModelCopy::of(mScene, root);
            for (CopyMaterial const& material : copy.materials())
                if (!sharesMaterials)
                    FILAMENT_ASSERT(copy.ownMaterials(material.name).ok(), "a copy has its materials");
            mAnimators.emplace_back(model, mScene, root);
        }
        mScene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
        mView.camera = Camera::lookAt({ 0, 0.8 * side * step, 1.0 * side * step }, { 0, 0, 0 });
    }

    void pose(double seconds, Model const& model) {
        for (size_t i = 0; i < mAnimators.size(); ++i)
            mAnimators[i].apply(0, std::fmod(seconds + 0.037 * static_cast<double>(i), model.animationSeconds(0)));
    }
    void setSize(uint2 size) { mView.size = size; }

    /// Milliseconds until the device has finished.
    double draw(Engine& engine, SwapChain target) {
        const auto begin = std::chrono::steady_clock::now();
        mRenderer.render(mScene, mView, target);
        engine.waitIdle();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    }
    uint32_t draws() const { return mRenderer.statistics().draws; }
    std::optional<FrameTimings> timings() {
        const std::vector<FrameTimings> all = mRenderer.takeTimings();
        return all.empty() ? std::nullopt : std::optional(all.back());
    }

private:
    Scene mScene;
    Renderer mRenderer;
    View mView;
    std::vector<Animator> mAnimators;
};

struct Figures {
    std::vector<double> frame, record, replay;
    uint64_t commands = 0;
};

Result<void> measure(Options const& options, Backend backend) {
    Result<Engine> engine = Engine::create({ .backend = backend, .workers = 0 });
    if (!engine) return engine.error();
    auto model = loadGltf(*engine, options.model);
    if (!model) return model.error();
    if (model->animationCount() == 0) return fail(ErrorCode::InvalidArgument, "{} has no animation", options.model);
    Crowd instances(*engine, *model, options.copies, true), alone(*engine, *model, options.copies, false);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = options.size }));
    std::array<Crowd*, 2> crowds{ &alone, &instances };
    std::array<Figures, 2> figures;
    constexpr int kWarmUp = 3;
    for (int round = 0; round < options.rounds + kWarmUp; ++round) {
        for (size_t i = 0; i < crowds.size(); ++i) {
            crowds[i]->setSize(options.size);
            crowds[i]->pose(0.05 * round, *model);
            const uint64_t before = engine->statistics().commands;
            const double milliseconds = crowds[i]->draw(*engine, target);
            const auto timings = crowds[i]->timings();
            if (round < kWarmUp || !timings) continue;
            figures[i].frame.push_back(milliseconds);
            figures[i].record.push_back(timings->prepareMilliseconds + timings->recordMilliseconds);
            figures[i].replay.push_back(timings->replayMilliseconds);
            figures[i].commands = engine->statistics().commands - before;
        }
    }
    for (size_t i = 0; i < crowds.size(); ++i) {
        std::printf("%-7s %-10s %6u draws %7llu commands  prepare and record %7.3f  replay %8.3f  frame %8.3f ms\n",
                    toString(backend), i == 0 ? "one by one" : "instances", crowds[i]->draws(),
                    static_cast<unsigned long long>(figures[i].commands), median(figures[i].record),
                    median(figures[i].replay), median(figures[i].frame));
    }
    const auto ratio = [&](std::vector<double> Figures::*of) {
        return median(figures[1].*of) / median(figures[0].*of);
    };
    std::printf("%-7s ratio: prepare and record %.2f, replay %.2f, frame %.2f\n", toString(backend),
                ratio(&Figures::record), ratio(&Figures::replay), ratio(&Figures::frame));
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    tools::CommandLine app{ "Frames with many copies of a skinned model, as instances and one by one." };
    app.option("--model", options.model, "glTF file with a skin and an animation").required();
    app.option("--copies", options.copies, "copies of the model").inRange(1, 10'000);
    app.option("--rounds", options.rounds, "rounds; each draws both").inRange(1, 1000);
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        if (const Result<void> measured = bench::measure(options, backend); !measured) {
            std::fprintf(stderr, "skins_bench: error: %s\n", measured.error().message.c_str());
            return 1;
        }
    }
    return 0;
}
