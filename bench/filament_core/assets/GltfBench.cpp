// SPDX-License-Identifier: Apache-2.0
// The cost of loading a model, part by part: mip chains, tangents, and a whole generated file with and without workers.
#include "filament_core/assets/geometry/Tangents.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/MipMaps.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace filament_core::assets {
namespace {

/// Smooth with some noise: compresses about as well as a painted texture.
std::vector<std::byte> pixels(uint32_t width, uint32_t height) {
    std::mt19937 random(1);
    std::vector<std::byte> rgba(size_t{ width } * height * 4, std::byte{ 255 });
    for (size_t i = 0; i < size_t{ width } * height; ++i) {
        const auto wave = static_cast<uint32_t>(100 + 60 * std::sin(static_cast<double>(i % width) * 0.02));
        for (size_t c = 0; c < 3; ++c) rgba[i * 4 + c] = static_cast<std::byte>(wave + random() % 8);
    }
    return rgba;
}

void mipMaps(benchmark::State& state, bool isColor) {
    const auto width = static_cast<uint32_t>(state.range(0));
    const Image base{ .width = width, .height = width, .data = pixels(width, width) };
    for (auto _ : state) benchmark::DoNotOptimize(withMipMaps(base, isColor));
    state.SetItemsProcessed(state.iterations() * width * width);
}
BENCHMARK_CAPTURE(mipMaps, color, true)
        ->Arg(1024)
        ->Arg(1023)
        ->Unit(benchmark::kMillisecond); // 1023: odd at every level
BENCHMARK_CAPTURE(mipMaps, data, false)->Arg(1024)->Arg(1023)->Unit(benchmark::kMillisecond);

/// A bumpy sheet of side x side squares.
GlbPrimitive sheet(uint32_t side) {
    GlbPrimitive primitive;
    for (uint32_t y = 0; y <= side; ++y) {
        for (uint32_t x = 0; x <= side; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(side),
                        v = static_cast<float>(y) / static_cast<float>(side);
            primitive.positions.emplace_back(u, v, 0.1f * std::sin(9 * u) * std::sin(7 * v));
            primitive.normals.emplace_back(0, 0, 1);
            primitive.uvs.emplace_back(u, -v);
        }
    }
    for (uint32_t i = 0; i < side * (side + 1); ++i) {
        if (i % (side + 1) == side) continue;
        primitive.indices.insert(primitive.indices.end(), { i, i + 1, i + side + 2, i, i + side + 2, i + side + 1 });
    }
    return primitive;
}

void tangents(benchmark::State& state) {
    const GlbPrimitive primitive = sheet(static_cast<uint32_t>(state.range(0)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(
                generateTangents({ primitive.positions, primitive.normals, primitive.uvs, primitive.indices }));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(primitive.indices.size() / 3));
}
BENCHMARK(tangents)->Arg(32)->Arg(256)->Unit(benchmark::kMillisecond);

/// Eight meshes with a normal map and a base colour each, like a prop of 130 000 triangles.
std::vector<std::byte> prop() {
    GlbScene scene;
    for (uint32_t i = 0; i < 8; ++i) {
        MaterialData material;
        material.baseColor.image = 2 * i;
        material.normal.image = 2 * i + 1;
        scene.materials.push_back(material);
        for (int k = 0; k < 2; ++k) scene.images.push_back(*glbImageFromPixels("image", 512, 512, pixels(512, 512)));
        GlbPrimitive primitive = sheet(90);
        primitive.material = i;
        scene.meshes.push_back({ "sheet", { primitive } });
        scene.nodes.push_back({ .name = "node", .mesh = i });
    }
    return *writeGlb(scene);
}

void loadProp(benchmark::State& state) {
    const std::vector<std::byte> file = prop();
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(0)) });
    for (auto _ : state) benchmark::DoNotOptimize(loadGltfFromMemory(file, ".", jobs));
}
BENCHMARK(loadProp)->Arg(0)->Arg(1)->Arg(3)->ArgName("workers")->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace filament_core::assets
