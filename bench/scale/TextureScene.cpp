// SPDX-License-Identifier: Apache-2.0
#include "bench/scale/TextureScene.h"

#include "filament_core/assets/gltf/GltfWriter.h"

#include <fmt/format.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <string>

namespace filament_core::bench {
namespace {

constexpr uint32_t kTexels = 2048;
constexpr double kPanelMeters = 2;
constexpr int kRestFrames = 30, kMovingFrames = 120;

double now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Bytes of a line of /proc/self/status, such as "VmHWM:".
double statusBytes(std::string const& key) {
    std::ifstream file("/proc/self/status");
    std::string word;
    while (file >> word) {
        double kilobytes = 0;
        if (word == key && file >> kilobytes) return kilobytes * 1024;
    }
    return 0;
}

void resetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Stripes of different widths: compresses well, and no two levels are alike.
std::vector<std::byte> const& pngOfPanel() {
    static const std::vector<std::byte> file = [] {
        std::vector<std::byte> texels(size_t{ kTexels } * kTexels * 4);
        for (uint32_t y = 0; y < kTexels; ++y) {
            for (uint32_t x = 0; x < kTexels; ++x) {
                std::byte* const texel = &texels[(size_t{ y } * kTexels + x) * 4];
                texel[0] = static_cast<std::byte>(64 + ((x >> 3 ^ y >> 6) & 1) * 128);
                texel[1] = static_cast<std::byte>(64 + ((x >> 5 ^ y >> 4) & 1) * 128);
                texel[2] = static_cast<std::byte>(64 + ((x >> 7 ^ y >> 2) & 1) * 128);
                texel[3] = std::byte{ 255 };
            }
        }
        Result<assets::GlbImage> image = assets::glbImageFromPixels("panel", kTexels, kTexels, texels);
        return image ? std::move(image->file) : std::vector<std::byte>();
    }();
    return file;
}

/// One quad of 2 x 2 m in the plane x = 0, as a mesh for each texture, and nodes on both sides of the corridor.
std::string gltfOf(uint32_t textures) {
    std::string images, list, materials, meshes, nodes, scene;
    for (uint32_t i = 0; i < textures; ++i) {
        const char* const comma = i > 0 ? "," : "";
        const double side = i % 2 == 0 ? -1 : 1, along = -kPanelMeters * (i / 2);
        images += fmt::format(R"({}{{"uri":"{}.png"}})", comma, i);
        list += fmt::format(R"({}{{"source":{}}})", comma, i);
        materials += fmt::format(
                R"({}{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{}}}}},"doubleSided":true}})", comma, i);
        meshes += fmt::format(
                R"({}{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"material":{}}}]}})",
                comma, i);
        nodes += fmt::format(R"({}{{"mesh":{},"translation":[{},0,{}]}})", comma, i, side, along);
        scene += fmt::format("{}{}", comma, i);
    }
    return fmt::format(
            R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],"meshes":[{}],)"
            R"("materials":[{}],"textures":[{}],"images":[{}],)"
            R"("buffers":[{{"uri":"quad.bin","byteLength":192}}],)"
            R"("bufferViews":[{{"buffer":0,"byteLength":72}},{{"buffer":0,"byteOffset":72,"byteLength":72}},)"
            R"({{"buffer":0,"byteOffset":144,"byteLength":48}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3",)"
            R"("min":[0,-1,-1],"max":[0,1,1]}},)"
            R"({{"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}},)"
            R"({{"bufferView":2,"componentType":5126,"count":6,"type":"VEC2"}}]}})",
            scene, nodes, meshes, materials, list, images);
}

std::vector<std::byte> quadBytes() {
    constexpr std::array<std::array<float, 2>, 6> kCorners{
        { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } }
    };
    std::array<float, 48> numbers{};
    for (size_t i = 0; i < kCorners.size(); ++i) {
        const auto [u, v] = kCorners[i];
        numbers[i * 3 + 1] = 1 - 2 * v, numbers[i * 3 + 2] = 2 * u - 1;
        numbers[18 + i * 3] = 1;
        numbers[36 + i * 2] = u, numbers[36 + i * 2 + 1] = v;
    }
    const auto bytes = std::as_bytes(std::span(numbers));
    return { bytes.begin(), bytes.end() };
}

Result<Model> load(Engine& engine, TextureCase const& size) {
    const std::string json = gltfOf(size.textures);
    const auto resolve = [](std::string_view uri) -> Result<std::vector<std::byte>> {
        return uri == "quad.bin" ? quadBytes() : pngOfPanel();
    };
    return loadGltf(engine, GltfMemory{ .file = std::as_bytes(std::span(json)), .name = "panels", .resolve = resolve },
                    { .textureBudgetMegabytes = size.budgetMegabytes });
}

class Corridor {
public:
    Corridor(Engine& engine, double length)
            : mEngine(engine), mLength(length), mScene(engine), mRenderer(engine),
              mTarget(engine.own(engine.create(SwapChainDesc{ .size = { 320, 180 }, .name = "corridor" }))) {
        mView.size = { 320, 180 };
        mScene.add(SunLight{ .directionWorld = { 0.4f, -1, -0.3f }, .illuminance = Lux{ 60'000 } });
        look(0);
    }

    Node add(Model const& model) { return mScene.add(model); }
    /// From 0, the near end, to 1.
    void look(double share) {
        const double z = 1 - share * mLength;
        mView.camera = Camera::lookAt({ 0, 0, z }, { 0, 0, z - 1 }, { .verticalFovDegrees = 60 });
    }
    /// Milliseconds.
    double frame() {
        const double begin = now();
        mRenderer.render(mScene, mView, mTarget);
        mEngine.waitIdle();
        return (now() - begin) * 1e3;
    }

private:
    Engine& mEngine;
    double mLength;
    View mView;
    Scene mScene;
    Renderer mRenderer;
    Owned<SwapChain> mTarget;
};

} // namespace

Result<TextureFigures> measureTextures(TextureCase const& size) {
    pngOfPanel();
    malloc_trim(0);
    resetPeak();
    const double before = statusBytes("VmRSS:");
    TextureFigures figures;
    auto engine = Engine::create({ .backend = size.backend });
    if (!engine) return engine.error();
    if (size.budgetMegabytes > 0) setTextureStreaming(*engine, { .budgetMegabytes = size.budgetMegabytes });
    const double start = now();
    Corridor corridor(*engine, size.textures / 2 * kPanelMeters);
    Result<Model> model = load(*engine, size);
    if (!model) return model.error();
    figures.loadSeconds = now() - start;
    corridor.add(*model);
    corridor.frame();
    figures.firstFrameSeconds = now() - start;
    do corridor.frame();
    while (waitForTextures(*engine));
    figures.settledSeconds = now() - start;
    figures.peakBytes = statusBytes("VmHWM:") - before;
    for (int i = 0; i < kRestFrames; ++i) figures.restMilliseconds.push_back(corridor.frame());
    malloc_trim(0);
    figures.restBytes = statusBytes("VmRSS:") - before;
    figures.residency = textureResidency(*engine);
    resetPeak();
    for (int i = 1; i <= kMovingFrames; ++i) {
        corridor.look(static_cast<double>(i) / kMovingFrames);
        figures.movingMilliseconds.push_back(corridor.frame());
        figures.movingErrorPixels = std::max(figures.movingErrorPixels, textureResidency(*engine).largestErrorPixels);
    }
    figures.movingPeakBytes = statusBytes("VmHWM:") - before;
    return figures;
}

} // namespace filament_core::bench
