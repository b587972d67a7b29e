// SPDX-License-Identifier: Apache-2.0
/// Draw lists with made-up geometry and materials, on a stream whose null driver draws nothing.
#pragma once

#include "backend/null/NullDriver.h"
#include "backend/stream/CommandStream.h"
#include "filament_core/passes/DrawRecorder.h"
#include "framegraph/CompiledGraph.h"
#include "shaders/interface/ShaderInterface.h"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace filament_core::passes {

class DrawFixture {
public:
    DrawFixture(uint32_t materialCount, uint32_t instanceCount, uint32_t geometryCount) {
        auto started = backend::CommandStream::start(
                [](backend::ResultSink& sink) -> Result<std::unique_ptr<backend::Driver>> {
                    return backend::createNullDriver(sink);
                },
                { .ownThread = false });
        stream = std::move(*started);
        pipelines = std::make_unique<PipelineCache>(*stream, layouts);
        materials.resize(materialCount);
        for (uint32_t i = 0; i < materialCount; ++i) makeMaterial(materials[i], i);
        instances.resize(instanceCount);
        for (uint32_t i = 0; i < instanceCount; ++i) {
            instances[i].id = i;
            instances[i].material = &materials[i % materialCount];
            for (backend::BindGroupHandle& group : instances[i].groups) group = stream->allocateBindGroup();
        }
        for (uint32_t i = 0; i < geometryCount; ++i) geometries.push_back(makeGeometry(i));
        context = { { .handle = stream->allocateBindGroup(), .uniforms = 768, .objects = 5 * 16384 },
                    { stream->allocateBindGroup(), stream->allocateBindGroup() },
                    stream->allocateBuffer() };
        slot = pipelines->slot({});
    }

    prepare::DrawCall draw(uint32_t instance, uint32_t geometry, uint32_t firstObject, bool mirrored = false) const {
        return { .material = &instances[instance % instances.size()],
                 .geometry = &geometries[geometry % geometries.size()],
                 .firstObject = firstObject,
                 .instanceCount = 1,
                 .mirrored = mirrored };
    }

    /// One object per draw; neighbours often share geometry or material, as in sorted lists.
    std::vector<prepare::DrawCall> randomDraws(size_t count, uint32_t seed) const {
        std::mt19937 random(seed);
        std::vector<prepare::DrawCall> draws;
        uint32_t instance = 0, geometry = 0;
        for (uint32_t i = 0; i < count; ++i) {
            if (random() % 4 == 0) instance = static_cast<uint32_t>(random());
            if (random() % 2 == 0) geometry = static_cast<uint32_t>(random());
            draws.push_back(draw(instance, geometry, i, random() % 8 == 0));
        }
        return draws;
    }

    /// Runs `beforePass` of a pass, into `setup`.
    std::vector<backend::PipelineHandle> choose(std::span<const prepare::DrawCall> draws, backend::CommandBuffer& setup,
                                                framegraph::RangeRecorder* ranges = nullptr, uint8_t variant = 0) {
        framegraph::PassContext pass(plan, setup, ranges);
        arena.reset();
        const auto chosen = choosePipelines(pass, arena, PipelineSource(*pipelines), slot, draws, variant);
        return { chosen.begin(), chosen.end() };
    }

    std::unique_ptr<backend::CommandStream> stream;
    scene::GeometryLayouts layouts;
    std::unique_ptr<PipelineCache> pipelines;
    std::vector<scene::Material> materials;
    std::vector<scene::MaterialInstance> instances;
    std::vector<scene::Geometry> geometries;
    DrawContext context;
    uint32_t slot = 0;
    framegraph::CompiledGraph plan;
    Arena arena;

private:
    static void makeMaterial(scene::Material& material, uint32_t id) {
        material.id = id;
        material.name = "material " + std::to_string(id);
        if (id % 3 == 2) material.package.shading = shader::ShadingModel::Unlit;
        material.package.variants.push_back({ .key = 0,
                                              .vertex = shader::sharedStage({ { 1 }, "" }),
                                              .fragment = shader::sharedStage({ { 2 }, "" }) });
    }

    /// Some share their buffers, two vertex layouts, both index types.
    scene::Geometry makeGeometry(uint32_t number) {
        if (number % 3 == 0 || geometries.empty()) {
            lastVertices = stream->allocateBuffer();
            lastIndices = stream->allocateBuffer();
        }
        scene::GeometryLayout layout;
        layout.vertices.attributeCount = layout.vertices.bufferCount = 1;
        layout.vertices.buffers[0].stride = number % 2 ? 32 : 16;
        return { .vertices = lastVertices,
                 .indices = lastIndices,
                 .layout = layouts.intern(layout),
                 .firstIndex = number * 10,
                 .indexCount = 3 + number,
                 .indexFormat = number % 5 ? backend::IndexFormat::UInt16 : backend::IndexFormat::UInt32 };
    }

    backend::BufferHandle lastVertices, lastIndices;
};

} // namespace filament_core::passes
