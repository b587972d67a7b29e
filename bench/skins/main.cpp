// SPDX-License-Identifier: Apache-2.0
// skins_bench: frames with many copies of a model with skins or morph targets, each in a pose of its own, drawn as
// instances and one by one, in turns. The second scene differs only in its material instances, of which each copy has
// one.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Assert.h"
#include "bench/ChoicesInTurns.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace filament_core::bench {
namespace {

struct Options {
    std::string model;
    int copies = 256, rounds = 15;
    uint2 size{ 320, 180 };
    bool hasMotion = false;
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
    void set(Options const& options) {
        mView.size = options.size;
        mView.effects.motionBlur.enabled = options.hasMotion;
    }

    /// Milliseconds: prepare and record, replay, and until the device has finished.
    std::array<double, 3> draw(Engine& engine, SwapChain target) {
        const double whole = millisecondsPerFrame(engine, 1, [&] { mRenderer.render(mScene, mView, target); });
        const std::vector<FrameTimings> all = mRenderer.takeTimings();
        FILAMENT_ASSERT(!all.empty(), "a frame that the device has finished has timings");
        return { all.back().prepareMilliseconds + all.back().recordMilliseconds, all.back().replayMilliseconds, whole };
    }
    uint32_t draws() const { return mRenderer.statistics().draws; }

private:
    Scene mScene;
    Renderer mRenderer;
    View mView;
    std::vector<Animator> mAnimators;
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
    for (Crowd* crowd : crowds) crowd->set(options);
    std::array<uint64_t, 2> commands{};
    double seconds = 0;
    const auto draw = [&](size_t i) {
        if (i == 0) seconds += 0.05;
        crowds[i]->pose(seconds, *model);
        const uint64_t before = engine->statistics().commands;
        const std::array<double, 3> figures = crowds[i]->draw(*engine, target);
        commands[i] = engine->statistics().commands - before;
        return figures;
    };
    using Turns = ChoicesInTurns<2, 3>;
    Turns(3, draw); // without what only first frames do
    const Turns turns(options.rounds, draw);
    for (size_t i = 0; i < crowds.size(); ++i) {
        std::printf("%-7s %-10s %6u draws %7llu commands  prepare and record %7.3f  replay %8.3f  frame %8.3f ms\n",
                    toString(backend), i == 0 ? "one by one" : "instances", crowds[i]->draws(),
                    static_cast<unsigned long long>(commands[i]), turns.median(i, 0), turns.median(i, 1),
                    turns.median(i, 2));
    }
    std::printf("%-7s ratio: prepare and record %.2f, replay %.2f, frame %.2f\n", toString(backend), turns.ratio(1, 0),
                turns.ratio(1, 1), turns.ratio(1, 2));
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    tools::CommandLine app{
        "Frames with many copies of a model with skins or morph targets, as instances and one by one."
    };
    app.option("--model", options.model, "glTF file with an animation of skins or morph targets").required();
    app.option("--copies", options.copies, "copies of the model").inRange(1, 10'000);
    app.option("--rounds", options.rounds, "rounds; each draws both").inRange(1, 1000);
    app.flag("--motion", options.hasMotion, "with motion blur, which draws the motion of the copies");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        if (const Result<void> measured = bench::measure(options, backend); !measured) {
            std::fprintf(stderr, "skins_bench: error: %s\n", measured.error().message.c_str());
            return 1;
        }
    }
    return 0;
}
