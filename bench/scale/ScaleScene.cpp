// SPDX-License-Identifier: Apache-2.0
#include "bench/scale/ScaleScene.h"

#include "shaders/package/EngineMaterials.h"

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace filament_core::bench {
namespace {

constexpr int kWarmUpFrames = 300; // rings have wrapped around, and everything has come to rest

double heapBytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

double seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

} // namespace

Result<std::unique_ptr<ScaleScene>> ScaleScene::create(ScaleCase const& size, int workers) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = workers });
    if (!engine) return engine.error();
    std::unique_ptr<ScaleScene> scene(new ScaleScene(std::move(*engine), size));
    if (Result<void> filled = scene->fill(); !filled) return filled.error();
    return scene;
}

ScaleScene::ScaleScene(Engine engine, ScaleCase const& size)
        : mSize(size), mEngine(std::move(engine)), mScene(mEngine), mRenderer(mEngine),
          mTarget(mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "scale" }))) {
    mColumns = static_cast<uint32_t>(std::ceil(std::sqrt(size.renderables)));
    mView.quality.shadows = size.shadowMaps > 0 ? ShadowFilter::Pcf3 : ShadowFilter::Off;
    mView.quality.shadowAtlasMegabytes = 256;
    mView.quality.shadowMapSize = 512;
    if (size.keepsHistory) mView.quality.antiAliasing = AntiAliasing::Taa;
}

Result<void> ScaleScene::fill() {
    addMesh();
    const double before = heapBytes(), start = seconds(CLOCK_MONOTONIC);
    if (Result<void> made = addMaterials(); !made) return made;
    addRenderables();
    addLights();
    mFigures.buildSeconds = seconds(CLOCK_MONOTONIC) - start;
    mFigures.sceneBytes = heapBytes() - before;
    // A field of view of 60 degrees sees a square of twice the tangent of 30 degrees, for each metre of height.
    const double side = mColumns * std::sqrt(mSize.visible);
    const double height = std::max(side, 4.0) / (2 * std::tan(std::numbers::pi / 6));
    mView.camera = Camera::lookAt({ 0, height, 0 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }, {}, { 0, 0, -1 });
    return {};
}

Result<void> ScaleScene::addMaterials() {
    auto material = mEngine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") });
    if (!material) return material.error();
    mMaterial = mEngine.own(*material);
    for (uint32_t i = 0; i < mSize.materials; ++i) {
        mInstances.push_back(mEngine.own(mEngine.createInstance(mMaterial)));
        const float shade = static_cast<float>(i + 1) / static_cast<float>(mSize.materials);
        Result<void> set = mEngine.set(mInstances.back(), "baseColorFactor", float4(shade, shade, shade, 1));
        if (!set) return set;
    }
    return {};
}

void ScaleScene::addMesh() {
    std::array<float, 8 * 7> vertices{}; // position, quaternion of the tangent frame
    for (size_t corner = 0; corner < 8; ++corner) {
        float* const at = &vertices[corner * 7];
        at[0] = corner & 1 ? 0.4f : -0.4f;
        at[1] = corner & 2 ? 0.4f : -0.4f;
        at[2] = corner & 4 ? 0.4f : -0.4f;
        at[6] = 1;
    }
    constexpr std::array<uint16_t, 36> kIndices{ 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
    mVertices = mEngine.own(
            mEngine.create(VertexBufferDesc{ .vertexCount = 8,
                                             .stride = 28,
                                             .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                                             { Attribute::Tangents, VertexFormat::Float4, 12 } },
                                             .data = std::as_bytes(std::span(vertices)),
                                             .name = "box" }));
    mIndices = mEngine.own(mEngine.create(
            IndexBufferDesc{ .indexCount = 36, .data = std::as_bytes(std::span(kIndices)), .name = "box" }));
    mPlaces.resize(mSize.renderables);
    std::iota(mPlaces.begin(), mPlaces.end(), 0u);
    std::ranges::shuffle(mPlaces, mRandom);
    mRenderables.reserve(mSize.renderables);
}

double4x4 ScaleScene::placeOf(uint32_t renderable, double height) const {
    const uint32_t place = mPlaces[renderable];
    double4x4 world(1.0);
    world[3] = double4(place % mColumns - mColumns * 0.5, height, place / mColumns - mColumns * 0.5, 1);
    return world;
}

void ScaleScene::addRenderables() {
    for (uint32_t i = 0; i < mSize.renderables; ++i) {
        mRenderables.push_back(mScene.add({ .vertices = mVertices,
                                            .indices = mIndices,
                                            .material = mInstances[i % mSize.materials],
                                            .bounds = Box{ double3(-0.4), double3(0.4) },
                                            .worldFromObject = placeOf(i, 0) }));
    }
}

void ScaleScene::addLights() {
    const auto next = [&] {
        return (static_cast<double>(mRandom()) / 4294967296.0 - 0.5) * mColumns * std::sqrt(mSize.visible);
    };
    for (uint32_t i = 0; i < mSize.lights; ++i)
        mScene.add(PointLight{ .positionWorld = { next(), 1, next() }, .rangeMeters = 2, .castsShadows = false });
    for (uint32_t i = 0; i < mSize.shadowMaps; ++i)
        mScene.add(SpotLight{ .positionWorld = { next(), 4, next() },
                              .directionWorld = { 0, -1, 0 },
                              .rangeMeters = 8,
                              .castsShadows = true });
}

double ScaleScene::frame() {
    ++mFrame;
    const auto moving = static_cast<uint32_t>(std::llround(mSize.moving * mSize.renderables));
    const double height = 0.1 * std::sin(mFrame);
    const double begin = seconds(CLOCK_THREAD_CPUTIME_ID);
    for (uint32_t i = 0; i < moving; ++i) {
        const auto at = static_cast<uint32_t>(uint64_t{ i } * mSize.renderables / moving);
        mScene.setTransform(mRenderables[at], placeOf(at, height));
    }
    mRenderer.render(mScene, mView, mTarget);
    const double spent = seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
    mEngine.waitIdle();
    return spent * 1e3;
}

ScaleFigures ScaleScene::measure(double measured) {
    constexpr size_t kFewest = 9;
    const double before = heapBytes();
    double spent = 0;
    for (int i = 0; i < kWarmUpFrames && (i < 20 || spent < 5e3); ++i) spent += frame();
    mFigures.frameBytes = heapBytes() - before;
    const double end = seconds(CLOCK_MONOTONIC) + measured;
    while (mFigures.milliseconds.size() < kFewest || seconds(CLOCK_MONOTONIC) < end)
        mFigures.milliseconds.push_back(frame());
    mFigures.statistics = mRenderer.statistics();
    return mFigures;
}

} // namespace filament_core::bench
