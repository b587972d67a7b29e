// SPDX-License-Identifier: Apache-2.0
// World transforms of 100 000 nodes, in turns with the obvious implementation: nodes that own their children, one
// recursion over full matrices with a dirty flag. Times are medians of single updates; "workers" counts the threads
// besides the caller. The counters:
//   us            one update
//   ns_per_node   the same, per node that had to be computed
//   computed      the number of those nodes
//   vs_naive      time divided by that of the recursion; below 1 is faster
#include "filament_core/prepare/UpdateTransforms.h"

#include "filament_core/scene/SceneNodes.h"

#include <benchmark/benchmark.h>

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

namespace filament_core::prepare {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kNodes = 100'000;

enum Shape : int64_t { kChain, kWide, kTenAry };
enum Change : int64_t { kRoot, kEveryNode, kOnePercent, kNothing };
constexpr const char* kShapeNames[] = { "chain", "wide", "ten-ary" };
constexpr const char* kChangeNames[] = { "the root moved", "every node moved", "1 % moved", "nothing moved" };

uint32_t parentOf(Shape shape, uint32_t i) { return shape == kChain ? i - 1 : shape == kWide ? 0 : (i - 1) / 10; }

double4x4 nearIdentity(uint32_t seed) {
    const double angle = seed % 97 * 0.01;
    double4x4 matrix(1.0);
    matrix[0] = { std::cos(angle), std::sin(angle), 0, 0 };
    matrix[1] = { -std::sin(angle), std::cos(angle), 0, 0 };
    matrix[3] = double4(seed % 7 * 0.1 - 0.3, seed % 5 * 0.1 - 0.2, 0.01, 1);
    return matrix;
}

struct NaiveNode {
    double4x4 parentFromNode{ 1.0 }, worldFromNode{ 1.0 };
    bool isDirty = true;
    std::vector<std::unique_ptr<NaiveNode>> children;
    Renderable renderable;
};

void updateNaively(scene::SceneData& scene, NaiveNode& node, double4x4 const& worldFromParent, bool isParentDirty) {
    const bool isDirty = isParentDirty || node.isDirty;
    if (isDirty) {
        node.worldFromNode = worldFromParent * node.parentFromNode;
        if (node.renderable) scene::setTransform(scene, node.renderable, node.worldFromNode);
        node.isDirty = false;
    }
    for (auto const& child : node.children) updateNaively(scene, *child, node.worldFromNode, isDirty);
}

/// The same forest twice. Children of a node are created consecutively, parents in order, as a loader does.
struct Forest {
    Forest(Shape shape, bool withRenderables) {
        for (uint32_t i = 0; i < kNodes; ++i) {
            const double4x4 matrix = nearIdentity(i);
            nodes.push_back(scene.transforms.add(i ? nodes[parentOf(shape, i)] : Node{}, matrix, {}));
            auto naive = std::make_unique<NaiveNode>();
            naive->parentFromNode = matrix;
            naiveNodes.push_back(naive.get());
            if (withRenderables) {
                scene::attach(scene, addBox(scene), nodes.back());
                naive->renderable = addBox(naiveScene);
            }
            i ? naiveNodes[parentOf(shape, i)]->children.push_back(std::move(naive)) : void(root = std::move(naive));
        }
    }

    ~Forest() { // last children first: a chain would overflow the stack otherwise
        for (size_t i = naiveNodes.size(); i-- > 0;) naiveNodes[i]->children.clear();
    }

    Renderable addBox(scene::SceneData& to) {
        return scene::addRenderable(to, { .material = &instance, .boundsMin = float3(-1), .boundsMax = float3(1) });
    }

    void set(uint32_t i, uint32_t seed) {
        naiveNodes[i]->parentFromNode = nearIdentity(seed);
        naiveNodes[i]->isDirty = true;
        scene.transforms.setTransform(nodes[i], naiveNodes[i]->parentFromNode);
    }

    void change(Change change, uint32_t round) {
        if (change == kRoot) set(0, round);
        if (change == kEveryNode) {
            for (uint32_t i = 0; i < kNodes; ++i) set(i, i + round);
        }
        if (change == kOnePercent) {
            for (uint32_t i = 0; i < kNodes / 100; ++i) set((i * 7919u + round * 104729u) % kNodes, round);
        }
    }

    scene::Material material;
    scene::MaterialInstance instance{ .material = &material };
    scene::SceneData scene, naiveScene;
    std::vector<Node> nodes;
    std::unique_ptr<NaiveNode> root;
    std::vector<NaiveNode*> naiveNodes; // parents before children
};

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct NaiveRun {
    Forest* forest;
    double seconds;
};

/// On a thread with a stack large enough for 100 000 levels.
double runNaively(Forest& forest) {
    NaiveRun run{ &forest, 0 };
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, size_t{ 256 } << 20);
    pthread_t thread{};
    const auto body = [](void* argument) -> void* {
        auto& it = *static_cast<NaiveRun*>(argument);
        const Clock::time_point start = Clock::now();
        updateNaively(it.forest->naiveScene, *it.forest->root, double4x4(1.0), false);
        it.seconds = secondsSince(start);
        return nullptr;
    };
    pthread_create(&thread, &attributes, body, &run);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    return run.seconds;
}

/// The number of nodes that an update computes: the changed ones and all their descendants.
uint32_t countComputed(Forest const& forest, Shape shape) {
    std::vector<bool> changed(kNodes);
    uint32_t count = 0;
    for (uint32_t i = 0; i < kNodes; ++i) {
        changed[i] = forest.naiveNodes[i]->isDirty || (i && changed[parentOf(shape, i)]);
        count += changed[i];
    }
    return count;
}

void updates(benchmark::State& state, bool withRenderables) {
    const auto shape = static_cast<Shape>(state.range(0));
    const auto change = static_cast<Change>(state.range(1));
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(2)) });
    Forest forest(shape, withRenderables);
    updateTransforms(jobs, forest.scene);
    runNaively(forest);
    std::vector<double> ours, naive;
    uint32_t round = 0, computed = 0;
    for (auto _ : state) {
        forest.change(change, ++round);
        computed = countComputed(forest, shape);
        const Clock::time_point start = Clock::now();
        updateTransforms(jobs, forest.scene);
        ours.push_back(secondsSince(start));
        state.SetIterationTime(ours.back());
        naive.push_back(runNaively(forest));
    }
    const double best = *std::min_element(ours.begin(), ours.end());
    state.counters["us"] = best * 1e6;
    state.counters["computed"] = computed;
    if (computed) state.counters["ns_per_node"] = best * 1e9 / computed;
    state.counters["vs_naive"] = best / *std::min_element(naive.begin(), naive.end());
    state.SetLabel(std::string(kShapeNames[shape]) + ", " + kChangeNames[change]);
}

void nodesAlone(benchmark::State& state) { updates(state, false); }
void nodesWithRenderables(benchmark::State& state) { updates(state, true); }

BENCHMARK(nodesAlone)
        ->ArgNames({ "shape", "change", "workers" })
        ->ArgsProduct({ { kChain, kWide, kTenAry }, { kRoot, kEveryNode, kOnePercent, kNothing }, { 0, 1 } })
        ->Iterations(41)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
BENCHMARK(nodesWithRenderables)
        ->ArgNames({ "shape", "change", "workers" })
        ->ArgsProduct({ { kWide, kTenAry }, { kRoot, kOnePercent }, { 0, 1 } })
        ->Iterations(41)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);

/// The app's cost of moving a node.
void setTransforms(benchmark::State& state) {
    jobs::JobSystem jobs({ .workers = 0 });
    Forest forest(kTenAry, false);
    const double4x4 matrix = nearIdentity(3);
    for (auto _ : state) {
        for (const Node node : forest.nodes) forest.scene.transforms.setTransform(node, matrix);
        state.PauseTiming();
        updateTransforms(jobs, forest.scene);
        state.ResumeTiming();
    }
    state.SetItemsProcessed(state.iterations() * kNodes);
}
BENCHMARK(setTransforms)->Unit(benchmark::kMicrosecond);

/// A model of 100 nodes appears and disappears beside 100 000 others: a structural change costs only what it touches.
void addAndRemoveAModel(benchmark::State& state) {
    jobs::JobSystem jobs({ .workers = 0 });
    Forest forest(kTenAry, false);
    updateTransforms(jobs, forest.scene);
    for (auto _ : state) {
        const Node root = forest.scene.transforms.add({}, double4x4(1.0), {});
        for (int i = 0; i < 99; ++i) forest.scene.transforms.add(root, double4x4(1.0), {});
        updateTransforms(jobs, forest.scene);
        scene::removeNode(forest.scene, root);
        updateTransforms(jobs, forest.scene);
    }
}
BENCHMARK(addAndRemoveAModel)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace filament_core::prepare
