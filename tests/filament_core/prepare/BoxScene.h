// SPDX-License-Identifier: Apache-2.0
/// BoxScene: boxes with handles made up (prepare never looks behind them), for tests and for
/// bench/filament_core/prepare.
#pragma once

#include "filament_core/prepare/PrepareFrame.h"

#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace filament_core::prepare {

/// Numerical Recipes' quick generator, upper bits.
class Random {
public:
    explicit Random(uint32_t seed) : mState(seed) {}
    uint32_t next() { return (mState = mState * 1664525u + 1013904223u) >> 8; }
    double within(double low, double high) { return low + (high - low) * next() / 16777216.0; }

private:
    uint32_t mState;
};

struct BoxScene {
    std::deque<scene::Material> materials;
    std::deque<scene::MaterialInstance> instances;
    scene::SceneData scene;

    scene::MaterialInstance* material(shader::Blending blending = shader::Blending::Opaque) {
        materials.emplace_back();
        materials.back().id = static_cast<uint32_t>(materials.size());
        materials.back().package.blending = blending;
        instances.push_back({ .id = static_cast<uint32_t>(instances.size()), .material = &materials.back() });
        return &instances.back();
    }

    static scene::RenderableInput box(double4x4 const& world, scene::MaterialInstance const* instance, uint32_t mesh) {
        const scene::Geometry geometry{ .vertices = backend::BufferHandle::make(mesh, 1),
                                        .indices = backend::BufferHandle::make(mesh, 1),
                                        .indexCount = 36 };
        return { .geometry = geometry,
                 .material = instance,
                 .boundsMin = float3(-0.5f),
                 .boundsMax = float3(0.5f),
                 .worldFromObject = world };
    }

    Renderable add(double4x4 const& world, scene::MaterialInstance const* instance, uint32_t mesh = 1) {
        return addRenderable(scene, box(world, instance, mesh));
    }

    Renderable add(double3 at, scene::MaterialInstance const* instance, uint32_t mesh = 1, double scaleX = 1) {
        double4x4 world(1.0);
        world[0][0] = scaleX;
        world[3] = double4(at, 1);
        return add(world, instance, mesh);
    }

    /// `count` boxes distributed over a cube in front of gridView(), all visible; meshes and materials take turns.
    void addCube(uint32_t count, uint32_t materialCount, uint32_t meshCount) {
        std::vector<scene::MaterialInstance*> looks;
        for (uint32_t i = 0; i < materialCount; ++i) looks.push_back(material());
        Random random(count);
        const double side = 1.5 * std::cbrt(static_cast<double>(count));
        for (uint32_t i = 0; i < count; ++i) {
            const double3 at(random.within(-side, side) / 2, random.within(-side, side) / 2, -random.within(0, side));
            add(at, looks[i % materialCount], 1 + i / materialCount % meshCount);
        }
    }

    /// A view that contains all of addCube(count), without shadows.
    static ViewInput cubeView(uint32_t count) {
        const double side = 1.5 * std::cbrt(static_cast<double>(count)) + 2;
        return { .camera = Camera::lookAt({ 0, 0, side }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }),
                 .size = { 1280, 1280 },
                 .quality = { .shadows = ShadowFilter::Off } };
    }
};

/// A frame with that view alone.
inline FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                                ViewInput const& view) {
    return prepareFrame(jobs, arena, scene, std::span(&view, 1));
}

} // namespace filament_core::prepare
