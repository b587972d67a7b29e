// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DispatchCache.h"

#include "backend/stream/RecordingGuards.h"
#include "base/Assert.h"

#include <fmt/core.h>

#include <algorithm>

namespace filament_core::passes {

using namespace backend;

DispatchCache::Entry& DispatchCache::entryOf(DispatchStage const& stage) {
    const auto isSame = [](ConstantValue const& a, ConstantValue const& b) { return a.id == b.id && a.bits == b.bits; };
    const auto found = std::ranges::find_if(mEntries, [&](Entry const& entry) {
        return entry.name == stage.name && std::ranges::equal(entry.constants, stage.constants, isSame);
    });
    if (found != mEntries.end()) return *found;
    mEntries.push_back({ stage.name, stage.layout, { stage.constants.begin(), stage.constants.end() }, {}, {} });
    return mEntries.back();
}

void DispatchCache::make(CommandBuffer& setup, Entry& entry) {
    const bool isSpirv = mStream.info().shaderLanguage == ShaderLanguage::SpirV;
    const std::span<const std::byte> code = mFindCode(fmt::format("{}.{}", entry.name, isSpirv ? "spv" : "essl"));
    FILAMENT_ASSERT(!code.empty(), "a dispatch is one of shaders/compute");
    NewHandle program(mStream, mStream.allocateProgram());
    NewHandle pipeline(mStream, mStream.allocatePipeline());
    AllOrNothing both(setup); // only recorded pipelines are known
    setup.record(CmdCreateProgram{
            program,
            { .compute = code, .constants = entry.constants, .layout = entry.layout, .debugName = entry.name } });
    setup.record(CmdCreatePipeline{ pipeline, { .program = program, .debugName = entry.name } });
    both.complete();
    entry.program = program.keep();
    entry.pipeline = pipeline.keep();
}

PipelineHandle DispatchCache::pipelineFor(CommandBuffer& setup, DispatchStage const& stage) {
    Entry& entry = entryOf(stage);
    if (!entry.program) make(setup, entry);
    return entry.pipeline;
}

void DispatchCache::makeExpected(CommandBuffer& setup) {
    for (Entry& entry : mEntries)
        if (!entry.program) make(setup, entry);
}

void DispatchCache::destroy(CommandBuffer& commands) {
    for (Entry const& entry : mEntries) {
        if (!entry.program) continue;
        mStream.destroy(commands, entry.pipeline);
        mStream.destroy(commands, entry.program);
    }
    mEntries.clear();
}

} // namespace filament_core::passes
