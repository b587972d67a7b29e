// SPDX-License-Identifier: Apache-2.0
// How far defects come: in streams made up for it, and in cases that claim a defect that nothing of theirs reads.
#include "toolkit/mutations/DefectTrace.h"
#include "backend/stream/CommandBuffer.h"
#include "toolkit/mutations/Mutations.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Runner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

namespace filament_core::conformance {
namespace {

using namespace backend;
using testing::HasSubstr;

template <class Handle>
Handle handleOf(uint32_t slot) {
    return Handle::make(slot, 1);
}

/// Adds 1 to the first number of each buffer, and turns culling off.
class TracedDefect final : public StreamEdit {
public:
    explicit TracedDefect(bool changesNumbers) : mChangesNumbers(changesNumbers) {}
    using StreamEdit::edit;
    void edit(CmdUpdateBuffer& command) override {
        if (!mChangesNumbers) return;
        std::memcpy(mNumbers.data(), command.bytes.data(), sizeof(mNumbers));
        mNumbers[0] += 1;
        command.bytes = std::as_bytes(std::span(mNumbers));
    }
    void edit(CmdCreatePipeline& command) override { command.desc.raster.cull = CullMode::None; }

private:
    bool mChangesNumbers;
    std::array<float, 2> mNumbers{};
};

/// A pass with one draw, whose bind group has one of two buffers.
class TracedStream {
public:
    explicit TracedStream(bool changesNumbers, bool exaggerated = false)
            : trace(std::make_unique<TracedDefect>(changesNumbers), exaggerated) {}

    void create(CullMode cull) {
        for (const uint32_t slot : { 1u, 2u })
            mCommands.record(CmdCreateBuffer{ handleOf<BufferHandle>(slot), { .debugName = slot == 1 ? "a" : "b" } });
        PipelineDesc pipeline{ .program = handleOf<ProgramHandle>(1), .debugName = "box" };
        pipeline.raster.cull = cull;
        mCommands.record(CmdCreatePipeline{ handleOf<PipelineHandle>(1), pipeline });
        const BindGroupEntry entry{ .buffer = handleOf<BufferHandle>(1), .size = 8 };
        mCommands.record(CmdCreateBindGroup{ handleOf<BindGroupHandle>(1), { .entries = std::span(&entry, 1) } });
        send();
    }
    void update(uint32_t buffer, std::array<float, 2> const& numbers) {
        mCommands.record(CmdUpdateBuffer{ handleOf<BufferHandle>(buffer), 0, std::as_bytes(std::span(numbers)) });
        send();
    }
    void draw() {
        mCommands.record(CmdBeginPass{});
        mCommands.record(CmdBindPipeline{ handleOf<PipelineHandle>(1) });
        mCommands.record(CmdBindGroup{ handleOf<BindGroupHandle>(1) });
        mCommands.record(CmdDraw{ .vertexCount = 3 });
        mCommands.record(CmdEndPass{});
        send();
    }

    DefectTrace trace;
    std::vector<float> written; // by the last update

    template <class C>
    void execute(C const& command) {
        C copy = command;
        if constexpr (requires { trace.edit(copy); }) trace.edit(copy);
        if constexpr (std::same_as<C, CmdUpdateBuffer>) {
            written.resize(copy.bytes.size() / sizeof(float));
            std::memcpy(written.data(), copy.bytes.data(), copy.bytes.size());
        }
    }

private:
    void send() {
        trace.inspect(mCommands.view());
        replay(mCommands.view(), *this);
        mCommands.reset();
    }

    CommandBuffer mCommands;
};

TEST(DefectTrace, KnowsWhatChangedAndWhetherADrawHasIt) {
    TracedStream stream(true);
    stream.create(CullMode::None);
    EXPECT_EQ(stream.trace.reach().changed, "");
    stream.update(2, { 5, 6 });
    stream.draw();
    EXPECT_EQ(stream.trace.reach().changed, "buffer 'b'");
    EXPECT_FALSE(stream.trace.reach().isDrawn) << "the draw reads the other one";
    stream.update(1, { 5, 6 });
    EXPECT_EQ(stream.trace.reach().changed, "buffer 'a', buffer 'b'");
    EXPECT_TRUE(stream.trace.reach().isDrawn);
    EXPECT_TRUE(stream.trace.reach().hasNumbers);
    stream.trace.begin();
    EXPECT_FALSE(stream.trace.reach().isDrawn) << "not since then";
    stream.draw();
    EXPECT_TRUE(stream.trace.reach().isDrawn) << "what was changed before stays changed";
}

TEST(DefectTrace, FollowsStatesOfPipelinesToDraws) {
    TracedStream stream(false);
    stream.create(CullMode::Back);
    stream.update(1, { 5, 6 });
    EXPECT_EQ(stream.trace.reach().changed, "pipeline 'box'");
    EXPECT_FALSE(stream.trace.reach().isDrawn);
    stream.draw();
    EXPECT_TRUE(stream.trace.reach().isDrawn);
    EXPECT_FALSE(stream.trace.reach().hasNumbers);
}

TEST(DefectTrace, ExaggeratesOnlyTheNumbersThatTheDefectChanges) {
    TracedStream plain(true), exaggerated(true, true);
    for (TracedStream* stream : { &plain, &exaggerated }) stream->update(1, { 5, 6 });
    EXPECT_EQ(plain.written, (std::vector<float>{ 6, 6 }));
    EXPECT_EQ(exaggerated.written, (std::vector<float>{ 0, 6 }));
    exaggerated.update(1, { 0, 6 });
    EXPECT_EQ(exaggerated.written, (std::vector<float>{ 1, 6 })) << "0 would not be a change";
}

Options tracedOptions() {
    Options options;
    options.scenes = tools::sourceDir() / "tests/conformance/scenes";
    options.out = tools::buildDir() / "conformance-defects";
    options.threads = false;
    options.build = "test";
    options.cases = { "diffuse-sky" };
    return options;
}

std::vector<SceneSpec> diffuseSky(std::vector<std::string> kills) {
    const Options options = tracedOptions();
    auto scenes = readScenes(options.scenes);
    EXPECT_TRUE(scenes.ok());
    std::vector<SceneSpec> cases = casesOf(scenes.ok() ? std::move(*scenes) : std::vector<SceneSpec>(), options);
    for (SceneSpec& spec : cases) spec.kills = kills;
    return cases;
}

// Its diffuse light is a cube. The coefficients are in the uniforms of every draw, and no draw reads them.
TEST(Mutants, ThatNoDrawReadsAreErrors) {
    const auto results =
            runCases(tracedOptions(), diffuseSky({ "irradiance", "irradianceSh", "fogDensity", "stencilOff", "bump" }));
    ASSERT_TRUE(results.ok()) << results.error().message;
    ASSERT_EQ(results->cases.size(), 1u);
    CaseResult const& result = results->cases.front();
    EXPECT_EQ(result.status, Status::Failed);
    ASSERT_EQ(result.reasons.size(), 4u) << "'irradiance' is noticed";
    EXPECT_THAT(result.reasons[0], HasSubstr("'irradianceSh' (irradiance in harmonics + 1 %) proves nothing: no draw "
                                             "reads what it changes in buffer 'frame'; let it change"));
    EXPECT_THAT(result.reasons[1], HasSubstr("'fogDensity' (fog 1 % denser) proves nothing: no draw reads"));
    EXPECT_THAT(result.reasons[2], HasSubstr("'stencilOff' (stencil test off) proves nothing: no command has"));
    EXPECT_THAT(result.reasons[3], HasSubstr("'bump' (bumps 5 % higher) proves nothing"));
}

// One list of lights changes nothing where there are no froxels. It is no result of such a case, neither good nor bad.
TEST(Mutants, OfOneListCountWhereThereAreFroxels) {
    Options options = tracedOptions();
    options.cases = { "many-lights", "quality/sh-3" };
    auto scenes = readScenes(options.scenes);
    ASSERT_TRUE(scenes.ok());
    const auto results = runCases(options, casesOf(std::move(*scenes), options));
    ASSERT_TRUE(results.ok()) << results.error().message;
    ASSERT_EQ(results->cases.size(), 2u);
    const auto hasOneList = [](CaseResult const& result) {
        return std::ranges::count(result.kills, kOneList, &Kill::mutation) == 1;
    };
    EXPECT_TRUE(hasOneList(results->cases[0]));
    EXPECT_FALSE(hasOneList(results->cases[1]));
    EXPECT_EQ(summaryOf(*results).failed, 0u);
}

TEST(Mutants, ThatReachNoDrawAreErrorsOfABisectionToo) {
    Options options = tracedOptions();
    options.bisect = "diffuse-sky";
    options.mutate = "stencilOff";
    const Result<std::string> found = bisectCase(options, diffuseSky({}));
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, HasSubstr("diffuse-sky: 'stencilOff' (stencil test off) proves nothing"));
    options.mutate = "irradiance";
    const Result<std::string> noticed = bisectCase(options, diffuseSky({}));
    ASSERT_TRUE(noticed.ok()) << noticed.error().message;
    EXPECT_THAT(*noticed, HasSubstr("pass 'color"));
}

} // namespace
} // namespace filament_core::conformance
