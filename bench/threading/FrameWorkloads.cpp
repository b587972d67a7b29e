// SPDX-License-Identifier: Apache-2.0
// The CPU cost of a frame with many renderables, through the public API, on the backend without a device.
//   cpu Nw    CPU time of the app thread and of N workers during render(), including waiting for work
//   wall Nw   render() from call to return, when the frame has been submitted
// Between frames the engine goes idle outside the measured time, so neither figure contains back-pressure or the driver
// thread's own work.
#include "bench/threading/Clock.h"
#include "bench/threading/WorkerClocks.h"
#include "bench/threading/Workloads.h"
#include "shaders/package/EngineMaterials.h"

#include <filament_core/filament_core.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace filament_core::bench {
namespace {

struct GridSize {
    uint32_t renderables = 1000;
    uint32_t meshes = 1, materials = 1; ///< combined, neighbours differ
};

/// One engine with its grid of boxes, all of them in view.
class Grid {
public:
    static Result<std::shared_ptr<Grid>> create(GridSize const& size, unsigned workers) {
        const std::vector<pid_t> before = workersOfAllEngines(workers);
        auto engine = Engine::create({ .backend = Backend::Null, .workers = static_cast<int>(workers) });
        if (!engine) return engine.error();
        auto grid = std::shared_ptr<Grid>(new Grid(std::move(*engine)));
        if (Result<void> filled = grid->fill(size); !filled) return filled.error();
        const int warmUpFrames = 4; // every ring has wrapped around, nothing is allocated any more
        for (int i = 0; i < warmUpFrames; ++i) grid->frame();
        const FrameStatistics seen = grid->mRenderer.statistics();
        if (seen.visible != size.renderables)
            return fail(ErrorCode::Internal, "the grid shows {} of its {} boxes", seen.visible, size.renderables);
        settle(); // every thread has started, and named itself
        for (const pid_t thread : workersOfAllEngines(workers))
            if (std::ranges::find(before, thread) == before.end()) grid->mWorkers.push_back(thread);
        if (grid->mWorkers.size() != workers)
            return fail(ErrorCode::Internal, "of an engine's {} workers only {} were found by name", workers,
                        grid->mWorkers.size());
        return grid;
    }

    struct Cost {
        double cpuMs = 0, wallMs = 0;
    };
    Cost frame() {
        const int64_t cpu = cpuNow(), wall = wallNow();
        mRenderer.render(mScene, mView, mTarget);
        Cost cost{ .wallMs = static_cast<double>(wallNow() - wall) * 1e-6 };
        cost.cpuMs = static_cast<double>(cpuNow() - cpu) * 1e-6;
        mEngine.waitIdle();
        return cost;
    }

private:
    static std::vector<pid_t> workersOfAllEngines(unsigned count) {
        std::vector<pid_t> threads;
        for (unsigned i = 0; i < count; ++i)
            for (const pid_t thread : threadsNamed(fmt::format("worker {}", i))) threads.push_back(thread);
        return threads;
    }

    int64_t cpuNow() const { return threadCpuNow() + cpuNanosecondsOf(mWorkers); }

    explicit Grid(Engine engine)
            : mEngine(std::move(engine)), mScene(mEngine), mRenderer(mEngine),
              mTarget(mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "grid" }))) {}

    Result<void> fill(GridSize const& size) {
        for (uint32_t i = 0; i < size.meshes; ++i) addMesh(i);
        if (Result<void> made = addMaterials(size.materials); !made) return made;
        const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(size.renderables)));
        for (uint32_t i = 0; i < size.renderables; ++i) {
            const double x = i % columns - columns * 0.5, z = -(i / columns + 1.0);
            double4x4 place(1.0);
            place[3] = double4(x, 0, z, 1);
            mScene.add({ .vertices = mVertices[i % size.meshes],
                         .indices = mIndices,
                         .material = mInstances[i / size.meshes % size.materials],
                         .bounds = Box{ double3(-0.4f), double3(0.4f) },
                         .worldFromObject = place });
        }
        // High above the middle and further back: the whole square is in view.
        const double span = columns;
        mView.camera =
                Camera::lookAt({ 0, span * 1.2, span * 0.8 }, { 0, 0, -span * 0.5 }, { .verticalFovDegrees = 60 });
        return {};
    }

    /// A box; each mesh is slightly flatter than the previous one.
    void addMesh(uint32_t number) {
        const float height = 0.4f - 0.01f * static_cast<float>(number);
        std::array<float, 8 * 7> vertices{}; // position, quaternion of the tangent frame
        for (size_t corner = 0; corner < 8; ++corner) {
            float* const at = &vertices[corner * 7];
            at[0] = corner & 1 ? 0.4f : -0.4f;
            at[1] = corner & 2 ? height : -height;
            at[2] = corner & 4 ? 0.4f : -0.4f;
            at[6] = 1;
        }
        constexpr std::array<uint16_t, 36> kIndices{ 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
        mVertices.push_back(mEngine.own(
                mEngine.create(VertexBufferDesc{ .vertexCount = 8,
                                                 .stride = 28,
                                                 .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                                                 { Attribute::Tangents, VertexFormat::Float4, 12 } },
                                                 .data = std::as_bytes(std::span(vertices)),
                                                 .name = "box" })));
        if (!mIndices.get())
            mIndices = mEngine.own(mEngine.create(
                    IndexBufferDesc{ .indexCount = 36, .data = std::as_bytes(std::span(kIndices)), .name = "box" }));
    }

    Result<void> addMaterials(uint32_t count) {
        auto material = mEngine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") });
        if (!material) return material.error();
        mMaterial = mEngine.own(*material);
        for (uint32_t i = 0; i < count; ++i) {
            mInstances.push_back(mEngine.own(mEngine.createInstance(mMaterial)));
            const float shade = static_cast<float>(i + 1) / static_cast<float>(count);
            if (Result<void> set = mEngine.set(mInstances.back(), "baseColorFactor", float4(shade, shade, shade, 1));
                !set)
                return set;
        }
        return {};
    }

    View mView{ .size = { 1280, 720 } };
    Engine mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::vector<Owned<VertexBuffer>> mVertices;
    Owned<IndexBuffer> mIndices;
    Scene mScene;
    Renderer mRenderer;
    Owned<SwapChain> mTarget;
    std::vector<pid_t> mWorkers;
};

Result<Workload> frames(Settings const& settings, std::string const& name, GridSize const& size, double limitMs) {
    Workload workload{ .name = name,
                       .title = fmt::format("{} renderables, {} material{}", size.renderables, size.materials,
                                            size.materials == 1 ? "" : "s"),
                       .unit = "ms",
                       .kind = "frames",
                       .x = static_cast<double>(size.renderables),
                       .contenders = {},
                       .targets = {} };
    std::vector<unsigned> workerCounts{ 0, 1, 2, settings.workers() };
    std::ranges::sort(workerCounts);
    workerCounts.erase(std::unique(workerCounts.begin(), workerCounts.end()), workerCounts.end());

    const uint32_t framesPerRound = settings.quick ? 1 : std::clamp(20'000u / size.renderables, 1u, 10u);
    std::vector<Contender> walls;
    for (const unsigned workers : workerCounts) {
        auto grid = Grid::create(size, workers);
        if (!grid) return grid.error();
        auto wallMs = std::make_shared<std::vector<double>>();
        workload.contenders.push_back({ fmt::format("cpu {}w", workers), [=, g = *grid](std::vector<double>& figures) {
                                           wallMs->clear();
                                           g->frame(); // warms the caches
                                           for (uint32_t i = 0; i < framesPerRound; ++i) {
                                               const Grid::Cost cost = g->frame();
                                               figures.push_back(cost.cpuMs);
                                               wallMs->push_back(cost.wallMs);
                                           }
                                       } });
        walls.push_back({ fmt::format("wall {}w", workers), [=](std::vector<double>& figures) { figures = *wallMs; } });
    }
    workload.contenders.insert(workload.contenders.end(), walls.begin(), walls.end());
    if (limitMs > 0) workload.targets = { { .contender = "cpu 1w", .limit = limitMs } };
    return workload;
}

} // namespace

void addFrameWorkloads(WorkloadList& list, Settings const& settings) {
    struct Size {
        const char* name;
        uint32_t renderables;
        double limitMs;
    };
    for (const Size size : { Size{ "1k", 1'000, 0 }, Size{ "10k", 10'000, 1.2 }, Size{ "100k", 100'000, 12 } }) {
        const uint32_t count = settings.quick ? size.renderables / 100 : size.renderables;
        const std::string same = fmt::format("frame_{}", size.name), mixed = same + "_mixed";
        list.push_back({ same, [=] { return frames(settings, same, { count, 1, 1 }, size.limitMs); } });
        list.push_back({ mixed, [=] { return frames(settings, mixed, { count, 16, 64 }, size.limitMs); } });
    }
}

} // namespace filament_core::bench
