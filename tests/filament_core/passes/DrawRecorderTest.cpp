// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/StreamHash.h"
#include "tests/filament_core/passes/DrawFixture.h"

#include <gtest/gtest.h>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::PassContext;
using framegraph::RangeRecorder;
using prepare::DrawCall;

/// A second implementation of binding: tracks what is bound and what every draw sees.
struct BoundState {
    PipelineHandle pipeline;
    CmdBindGroup view{}, pass{}, material{};
    CmdBindVertexBuffers vertices{};
    CmdBindIndexBuffer indices{};
};
struct BindingDevice {
    BoundState now;
    std::vector<std::pair<CmdDrawIndexed, BoundState>> draws;
    uint32_t pipelineBinds = 0, viewBinds = 0, passBinds = 0, materialBinds = 0, vertexBinds = 0, indexBinds = 0;

    void execute(CmdBindPipeline const& c) { now.pipeline = c.pipeline, ++pipelineBinds; }
    void execute(CmdBindGroup const& c) {
        CmdBindGroup* const groups[] = { &now.view, &now.pass, &now.material };
        uint32_t* const counts[] = { &viewBinds, &passBinds, &materialBinds };
        ASSERT_LE(c.index, shader::kGroupMaterial) << "nothing of it is deformed";
        *groups[c.index] = c;
        ++*counts[c.index];
    }
    void execute(CmdBindVertexBuffers const& c) { now.vertices = c, ++vertexBinds; }
    void execute(CmdBindIndexBuffer const& c) { now.indices = c, ++indexBinds; }
    void execute(CmdDrawIndexed const& c) { draws.emplace_back(c, now); }
    void execute(auto const&) { ADD_FAILURE() << "a draw list records binds and draws only"; }
};

BindingDevice runOn(CommandBuffer const& commands) {
    BindingDevice device;
    replay(commands.view(), device);
    return device;
}

void expectDraw(DrawFixture const& fixture, DrawCall const& wanted, PipelineHandle pipeline,
                std::pair<CmdDrawIndexed, BoundState> const& drawn) {
    auto const& [draw, state] = drawn;
    EXPECT_EQ(state.pipeline, pipeline);
    EXPECT_EQ(state.material.group, wanted.material->group(fixture.context.textureFilter));
    ViewGroup const& view = fixture.context.view;
    EXPECT_EQ(state.view.group, view.handle);
    EXPECT_EQ(state.view.dynamicOffsets[0], view.uniforms);
    EXPECT_EQ(state.view.dynamicOffsets[1], view.objects + wanted.firstObject / 256 * sizeof(shader::ObjectUniforms));
    const shader::PassKind kind = shader::passKind(wanted.material->material->package);
    EXPECT_EQ(state.pass.group, fixture.context.passGroups[static_cast<size_t>(kind)]);
    EXPECT_EQ(state.vertices.buffers[0], wanted.geometry->vertices);
    EXPECT_EQ(state.vertices.buffers[1], fixture.context.instanceIds);
    EXPECT_EQ(state.vertices.count, 2);
    EXPECT_EQ(state.indices.buffer, wanted.geometry->indices);
    EXPECT_EQ(state.indices.type, wanted.geometry->indexFormat);
    EXPECT_EQ(draw.indexCount, wanted.geometry->indexCount);
    EXPECT_EQ(draw.firstIndex, wanted.geometry->firstIndex);
    EXPECT_EQ(draw.firstInstance, wanted.firstObject % 256);
    EXPECT_EQ(draw.instanceCount, wanted.instanceCount);
}

TEST(DrawRecorder, EveryDrawFindsItsOwnStateBound) {
    DrawFixture fixture(5, 40, 30);
    const std::vector<DrawCall> draws = fixture.randomDraws(5000, 1);
    CommandBuffer setup, commands;
    const std::vector<PipelineHandle> pipelines = fixture.choose(draws, setup);
    PassContext pass(fixture.plan, commands);
    recordDrawRanges(pass, fixture.context, draws, pipelines);
    const BindingDevice device = runOn(commands);
    ASSERT_EQ(device.draws.size(), draws.size());
    for (size_t i = 0; i < draws.size(); ++i) {
        expectDraw(fixture, draws[i], pipelines[i], device.draws[i]);
        if (testing::Test::HasFailure()) FAIL() << "draw " << i;
    }
}

TEST(DrawRecorder, WhatDoesNotChangeIsBoundOnceARange) {
    DrawFixture fixture(1, 1, 1);
    std::vector<DrawCall> draws;
    for (uint32_t i = 0; i < 3 * kDrawsPerRange; ++i) draws.push_back(fixture.draw(0, 0, i));
    CommandBuffer setup, commands;
    const std::vector<PipelineHandle> pipelines = fixture.choose(draws, setup);
    PassContext pass(fixture.plan, commands);
    recordDrawRanges(pass, fixture.context, draws, pipelines);
    const BindingDevice device = runOn(commands);
    EXPECT_EQ(device.draws.size(), draws.size());
    EXPECT_EQ(device.pipelineBinds, 3u);
    EXPECT_EQ(device.passBinds, 3u);
    EXPECT_EQ(device.materialBinds, 3u);
    EXPECT_EQ(device.vertexBinds, 3u);
    EXPECT_EQ(device.indexBinds, 3u);
    EXPECT_EQ(device.viewBinds, draws.size() / shader::kObjectsPerWindow) << "one a window of objects";
}

TEST(DrawRecorder, ARangeDoesNotDependOnTheOneBeforeIt) {
    DrawFixture fixture(3, 10, 10);
    const std::vector<DrawCall> draws = fixture.randomDraws(2 * kDrawsPerRange, 2);
    CommandBuffer setup, whole, second;
    const std::vector<PipelineHandle> pipelines = fixture.choose(draws, setup);
    PassContext pass(fixture.plan, whole);
    recordDrawRanges(pass, fixture.context, draws, pipelines);

    const auto upper = std::span(draws).subspan(kDrawsPerRange);
    recordDraws(second, fixture.context, upper, std::span(pipelines).subspan(kDrawsPerRange));
    CommandBuffer first;
    recordDraws(first, fixture.context, std::span(draws).first(kDrawsPerRange), pipelines);
    first.append(std::move(second));
    EXPECT_EQ(hashStream(whole.view()), hashStream(first.view()));
}

// Of two records an object, instances read every second one.
TEST(DrawRecorder, PairsOfRecordsHaveInstanceIdsOfTheirOwn) {
    DrawFixture fixture(1, 1, 1);
    fixture.context.hasPairs = true;
    std::vector<DrawCall> draws{ fixture.draw(0, 0, 0), fixture.draw(0, 0, 6), fixture.draw(0, 0, 256 + 250) };
    draws[1].instanceCount = 122;
    CommandBuffer setup, commands;
    const std::vector<PipelineHandle> pipelines = fixture.choose(draws, setup);
    recordDraws(commands, fixture.context, draws, pipelines);
    const BindingDevice device = runOn(commands);
    ASSERT_EQ(device.draws.size(), 3u);
    EXPECT_EQ(device.draws[0].first.firstInstance, kFirstPairId);
    EXPECT_EQ(device.draws[1].first.firstInstance, kFirstPairId + 3);
    EXPECT_EQ(device.draws[1].first.instanceCount, 122u);
    EXPECT_EQ(device.draws[2].first.firstInstance, kFirstPairId + 125);
    EXPECT_EQ(device.viewBinds, 2u);
}

TEST(DrawRecorder, DrawsWithoutAPipelineAreSkippedWithTheirState) {
    DrawFixture fixture(2, 2, 2);
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0), fixture.draw(1, 1, 1), fixture.draw(0, 0, 2) };
    const std::vector<PipelineHandle> pipelines{ PipelineHandle::make(1, 1), {}, PipelineHandle::make(1, 1) };
    CommandBuffer commands;
    recordDraws(commands, fixture.context, draws, pipelines);
    const BindingDevice device = runOn(commands);
    ASSERT_EQ(device.draws.size(), 2u);
    expectDraw(fixture, draws[2], pipelines[2], device.draws[1]);
    EXPECT_EQ(device.materialBinds, 1u);
    EXPECT_EQ(device.vertexBinds, 1u);
}

class SameBits : public testing::TestWithParam<int> {
protected:
    /// Chooses pipelines and records draws from scratch; returns the hash of both streams.
    static std::pair<uint64_t, uint64_t> record(RangeRecorder* ranges, size_t count) {
        DrawFixture fixture(7, 100, 60);
        const std::vector<DrawCall> draws = fixture.randomDraws(count, 3);
        CommandBuffer setup, commands;
        const std::vector<PipelineHandle> pipelines = fixture.choose(draws, setup, ranges);
        PassContext pass(fixture.plan, commands, ranges);
        recordDrawRanges(pass, fixture.context, draws, pipelines);
        return { hashStream(setup.view()), hashStream(commands.view()) };
    }
};
INSTANTIATE_TEST_SUITE_P(DrawRecorder, SameBits, testing::Values(0, 1, 2, 3, 16),
                         [](auto const& workers) { return std::to_string(workers.param) + "Workers"; });

TEST_P(SameBits, TheStreamIsTheOneRecordedWithoutAJobSystem) {
    jobs::JobSystem jobs{ { .workers = GetParam() } };
    RangeRecorder ranges(jobs);
    for (const size_t count : { size_t{ 0 }, size_t{ 1 }, kDrawsPerRange, kDrawsPerRange + 1, size_t{ 30'000 } }) {
        const auto expected = record(nullptr, count);
        for (int repeat = 0; repeat < 3; ++repeat) EXPECT_EQ(record(&ranges, count), expected) << count << " draws";
    }
}

} // namespace
} // namespace filament_core::passes
