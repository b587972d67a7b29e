// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Trace.h"

#include "backend/layers/Traced.h"
#include "backend/null/NullDriver.h"
#include "tests/backend/layers/LayerTestKit.h"
#include "tests/fuzz/TraceFuzzBody.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

namespace filament_core::backend {
namespace {

using namespace kit;
using testing::HasSubstr;

TraceText textOf(std::function<void(CommandBuffer&)> const& record) {
    std::vector<CommandBuffer> streams(1);
    record(streams[0]);
    return writeAll(streams);
}

std::string bodyOf(TraceText const& trace) {
    return trace.text.substr(traceHeader().size() + std::string_view("Stream\n").size());
}

void recordEverything(CommandBuffer& to) {
    recordObjects(to);
    recordFrame(to);
    recordDestroys(to);
    PassDesc merged = mergedPassDesc(TextureHandle::make(7, 3), TextureHandle::make(8, 4095));
    merged.colors[0].clear = { -0.0f, 1e-45f, std::numeric_limits<float>::infinity(), 0.1f };
    to.record(CmdBeginPass{ merged });
    to.record(CmdNextSubpass{});
    to.record(CmdEndPass{});
}

TEST(Trace, WritesOneReadableLineACommandAndLeavesDefaultsOut) {
    const TraceText trace = textOf([](CommandBuffer& to) {
        to.record(CmdCreateTexture{ TextureHandle::make(3, 2),
                                    { .type = TextureKind::Cube,
                                      .format = Format::RGBA16F,
                                      .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                      .layers = 6,
                                      .width = 64,
                                      .height = 64,
                                      .debugName = "sky \"blue\"" } });
        to.record(CmdUpdateBuffer{ BufferHandle::make(5, 1), 16, bytes(3) });
        to.record(CmdSetViewport{ { 0.5f, 0, 100, 0.1f } });
        to.record(CmdDrawIndexed{ .indexCount = 3, .vertexOffset = -7 });
        to.record(CmdDraw{});
        to.record(CmdBindVertexBuffers{ .buffers = { BufferHandle::make(1, 1), {}, BufferHandle::make(2, 1) },
                                        .count = 3 });
        to.record(CmdEndPass{});
    });
    EXPECT_EQ(bodyOf(trace), "CreateTexture handle=3.2 desc={ type=Cube format=RGBA16F usage=Sampled|TransferTarget "
                             "layers=6 width=64 height=64 "
                             "debugName=\"sky \\x22blue\\x22\" }\n"
                             "UpdateBuffer buffer=5.1 offset=16 bytes=5a5a5a\n"
                             "SetViewport viewport={ x=0.5 width=100 height=0.1 }\n"
                             "DrawIndexed indexCount=3 vertexOffset=-7\n"
                             "Draw\n"
                             "BindVertexBuffers buffers=[ 1.1 0.0 2.1 ] count=3\n"
                             "EndPass\n");
}

TEST(Trace, PutsLargePayloadsIntoTheSideFileInOrder) {
    const TraceText trace = textOf([](CommandBuffer& to) {
        to.record(CmdUpdateBuffer{ kUniforms, 0, bytes(65) });
        to.record(CmdUpdateBuffer{ kUniforms, 0, bytes(64) });
        to.record(CmdUpdateBuffer{ kUniforms, 0, bytes(100) });
    });
    EXPECT_THAT(trace.text, HasSubstr("bytes=@0+65\n"));
    EXPECT_THAT(trace.text, HasSubstr("bytes=@65+100\n"));
    EXPECT_EQ(trace.blob.size(), 165u);
}

TEST(Trace, ReadingAndWritingAgainIsByteIdenticalForEveryCommand) {
    const TraceText first = textOf(recordEverything);
    const Result<std::vector<CommandBuffer>> read = readTrace(first.text, first.blob);
    ASSERT_TRUE(read.ok()) << read.error().message;
    const TraceText second = writeAll(*read);
    EXPECT_EQ(first.text, second.text);
    EXPECT_EQ(first.blob, second.blob);
    for (uint32_t id = 0; id < Commands::kCount; ++id) {
        bool found = false;
        for (CommandChunk const& chunk : read->at(0).view()) {
            for (size_t at = 0; at < chunk.size; at += reinterpret_cast<CommandHeader const*>(chunk.data + at)->bytes) {
                found |= reinterpret_cast<CommandHeader const*>(chunk.data + at)->id == id;
            }
        }
        EXPECT_TRUE(found) << "the stream of this test lacks command " << id;
    }
}

TEST(Trace, WhatWasReadRunsLikeTheOriginal) {
    std::vector<CommandBuffer> streams(2);
    recordObjects(streams[0]);
    recordFrame(streams[1]);
    const TraceText trace = writeAll(streams);
    const Result<std::vector<CommandBuffer>> read = readTrace(trace.text, trace.blob);
    ASSERT_TRUE(read.ok());
    ASSERT_EQ(read->size(), 2u);
    Errors errors;
    DeviceInfo info;
    info.features = { .mergedPasses = true, .timers = true, .depthResolve = true, .textureViews = true };
    Validator validator(info, errors);
    for (CommandBuffer const& stream : *read) EXPECT_TRUE(validator.check(stream.view()));
    EXPECT_THAT(errors.messages, testing::IsEmpty());
}

TEST(Trace, ErrorsNameTheLineAndTheReason) {
    const auto message = [](std::string const& body, std::span<const std::byte> blob = {}) {
        const auto read = readTrace(std::string(traceHeader()) + "# a comment\nStream\n" + body, blob);
        return read.ok() ? std::string("no error") : read.error().message;
    };
    EXPECT_EQ(message("Draw\nDrow\n"), "line 5: there is no command 'Drow'");
    EXPECT_EQ(message("Draw vertexCount=x"), "line 4: Draw: 'x' is no number");
    EXPECT_EQ(message("Draw vertexCount=4294967296"), "line 4: Draw: 4294967296 is out of range");
    EXPECT_EQ(message("Draw vertices=4"), "line 4: Draw: Draw has no field 'vertices'");
    EXPECT_EQ(message("Draw vertexCount=1 vertexCount=2"), "line 4: Draw: field 'vertexCount' is given twice");
    EXPECT_EQ(message("Draw vertexCount"), "line 4: Draw: '=' is missing before ''");
    EXPECT_EQ(message("EndPass }"), "line 4: EndPass: unexpected text after the last field");
    EXPECT_EQ(message("SetStencilReference front=256"), "line 4: SetStencilReference: 256 is out of range");
    EXPECT_EQ(message("DestroyBuffer handle=1048576.1"), "line 4: DestroyBuffer: handle 1048576.1 is out of range");
    EXPECT_EQ(message("CreateTexture desc={ format=RGBA9 }"), "line 4: CreateTexture: 'RGBA9' is no such name");
    EXPECT_EQ(message("CreateTexture desc={ usage=Sampled|Sampler }"),
              "line 4: CreateTexture: 'Sampler' is no such name");
    EXPECT_EQ(message("BindVertexBuffers offsets=[ 1 2 3 4 5 ]"), "line 4: BindVertexBuffers: more than 4 elements");
    EXPECT_EQ(message("UpdateBuffer bytes=5g"), "line 4: UpdateBuffer: '5g' is no byte in hex");
    EXPECT_EQ(message("UpdateBuffer bytes=555"), "line 4: UpdateBuffer: 3 hex digits; bytes have two each");
    EXPECT_EQ(message("UpdateBuffer bytes=@0+9", bytes(8)),
              "line 4: UpdateBuffer: payload @0+9: the side file has only 8 bytes");
    EXPECT_EQ(message("UpdateBuffer bytes=@4+4", bytes(8)),
              "line 4: UpdateBuffer: payload @4+4: the next one begins at byte 0");
    EXPECT_EQ(message("PushGroup name=\"a\\q\""), "line 4: PushGroup: an escape is \\xNN");
    EXPECT_THAT(readTrace("filament-trace 2\n", {}).error().message, HasSubstr("line 1: not a trace of this version"));
    EXPECT_THAT(readTrace(std::string(traceHeader()) + "Draw\n", {}).error().message,
                HasSubstr("before the first 'Stream'"));
}

TEST(Trace, EveryEnumeratorHasANameThatReadsBackAsItself) {
    for (uint32_t format = 0; format < static_cast<uint32_t>(Format::Count); ++format) {
        CommandBuffer commands;
        commands.record(CmdCreateTexture{ {}, { .format = static_cast<Format>(format) } });
        TraceText trace{ std::string(traceHeader()), {} };
        writeTrace(commands.view(), trace);
        const auto read = readTrace(trace.text, trace.blob);
        ASSERT_TRUE(read.ok()) << trace.text << read.error().message;
        auto const* command = reinterpret_cast<CmdCreateTexture const*>(read->at(0).view()[0].data + kCommandAlignment);
        EXPECT_EQ(command->desc.format, static_cast<Format>(format));
    }
    for (uint8_t factor = 0; factor <= static_cast<uint8_t>(BlendFactor::SrcAlphaSaturate); ++factor) {
        PipelineDesc desc;
        desc.blend[7].dstAlpha = static_cast<BlendFactor>(factor);
        const TraceText trace = textOf([&](CommandBuffer& to) { to.record(CmdCreatePipeline{ {}, desc }); });
        EXPECT_TRUE(readTrace(trace.text, trace.blob).ok()) << trace.text;
    }
}

// ---------------------------------------------------------------------------------------------- files

class TraceFile : public testing::Test {
protected:
    std::filesystem::path mPath =
            std::filesystem::path(testing::TempDir()) /
            ("filament_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".trace");
    Errors mErrors;

    ~TraceFile() override {
        std::filesystem::remove(mPath);
        std::filesystem::remove(mPath.string() + ".bin");
    }
    std::string content() const {
        std::ifstream file(mPath, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }
};

TEST_F(TraceFile, HoldsEveryStreamBeforeTheDriverExecutesTheNext) {
    Result<std::unique_ptr<Driver>> driver = trace(createNullDriver(mErrors), mPath);
    ASSERT_TRUE(driver.ok()) << driver.error().message;
    CommandBuffer objects, frame;
    recordObjects(objects);
    recordFrame(frame);
    (*driver)->execute(objects.view());
    EXPECT_THAT(content(), testing::EndsWith("debugName=\"window\" }\n"));
    (*driver)->execute(frame.view());
    const auto loaded = loadTrace(mPath); // the driver still runs: all output has been flushed
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    ASSERT_EQ(loaded->size(), 2u);
    EXPECT_EQ((*loaded)[0].commandCount(), objects.commandCount());
    EXPECT_EQ((*loaded)[1].commandCount(), frame.commandCount());
    EXPECT_EQ((*driver)->statistics().draws, 2u) << "the inner driver saw the stream";
}

TEST_F(TraceFile, ReplaysOnAFreshStreamWithTheTicketsOfTheRecording) {
    {
        Result<std::unique_ptr<Driver>> driver = trace(createNullDriver(mErrors), mPath);
        CommandBuffer objects, frame;
        recordObjects(objects);
        recordFrame(frame, 1, 100);
        (*driver)->execute(objects.view());
        (*driver)->execute(frame.view());
    }
    auto stream = CommandStream::start(
            [&](ResultSink& sink) -> Result<std::unique_ptr<Driver>> { return createNullDriver(sink); });
    ASSERT_TRUE(stream.ok());
    const Result<std::vector<Ticket>> tickets = replayTrace(mPath, **stream);
    ASSERT_TRUE(tickets.ok()) << tickets.error().message;
    EXPECT_THAT(*tickets, testing::ElementsAre(Ticket{ 100 }, Ticket{ 101 }, Ticket{ 102 }));
    EXPECT_EQ((*stream)->waitReadback({ 101 }).value().size(), 16u * 16u * 4u);
    EXPECT_EQ((*stream)->waitReadback({ 102 }).value().size(), 64u);
    (*stream)->waitIdle(); // timers are answered at the end of the frame, after its read-backs
    EXPECT_EQ((*stream)->takeTimer({ 100 }), 0u);
}

TEST_F(TraceFile, MissingAndBrokenFilesAreErrorsThatNameThem) {
    const auto missing = loadTrace(mPath);
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(missing.error().message, HasSubstr(mPath.string()));
    std::ofstream(mPath) << traceHeader() << "Stream\nDraw =\n";
    std::ofstream(mPath.string() + ".bin");
    const auto broken = loadTrace(mPath);
    ASSERT_FALSE(broken.ok());
    EXPECT_EQ(broken.error().code, ErrorCode::Corrupt);
    EXPECT_THAT(broken.error().message, HasSubstr(mPath.string() + ": line 3: Draw"));
    const auto nowhere = trace(createNullDriver(mErrors), "/nonexistent/folder/x.trace");
    ASSERT_FALSE(nowhere.ok());
    EXPECT_EQ(nowhere.error().code, ErrorCode::Unreadable);
}

// ---------------------------------------------------------------------------------------------- fuzzing without a
// fuzzer

std::vector<uint8_t> fuzzSeed() {
    const TraceText trace = textOf(recordEverything);
    std::vector<uint8_t> seed(trace.text.begin(), trace.text.end());
    seed.push_back(0);
    for (const std::byte byte : trace.blob) seed.push_back(static_cast<uint8_t>(byte));
    return seed;
}

// Cuts, copies and flips; words of the grammar are more frequent than noise.
void mutate(std::vector<uint8_t>& input, std::mt19937& random) {
    static constexpr std::string_view kWords[] = { " ",
                                                   "=",
                                                   "{",
                                                   " }",
                                                   "[",
                                                   " ]",
                                                   "\"",
                                                   "@0+64",
                                                   "4294967295",
                                                   "-1",
                                                   "0.0",
                                                   "1.1",
                                                   "count=",
                                                   "desc={",
                                                   "bytes=",
                                                   "\n",
                                                   "Draw",
                                                   "Stream\n",
                                                   "|",
                                                   "255",
                                                   "nan",
                                                   "65535",
                                                   "subpassCount=4" };
    const auto pick = [&](size_t below) { return static_cast<size_t>(random()) % below; };
    const size_t at = pick(input.size());
    const auto here = input.begin() + static_cast<std::ptrdiff_t>(at);
    switch (pick(4)) {
    case 0:
        *here = static_cast<uint8_t>(random());
        break;
    case 1: {
        const std::string_view word = kWords[pick(std::size(kWords))];
        input.insert(here, word.begin(), word.end());
        break;
    }
    case 2:
        input.erase(here, here + static_cast<std::ptrdiff_t>(pick(std::min<size_t>(20, input.size() - at))));
        break;
    default: {
        const std::vector<uint8_t> piece(
                here, here + static_cast<std::ptrdiff_t>(pick(std::min<size_t>(200, input.size() - at))));
        const size_t to = pick(input.size());
        input.insert(input.begin() + static_cast<std::ptrdiff_t>(to), piece.begin(), piece.end());
    }
    }
}

TEST(Trace, SurvivesThousandsOfMutationsAndStaysAFixedPoint) {
    std::mt19937 random(20);
    const std::vector<uint8_t> seed = fuzzSeed();
    ASSERT_TRUE(fuzzTraceOnce(seed));
    int readable = 0;
    for (int i = 0; i < 4000; ++i) {
        std::vector<uint8_t> input = seed;
        for (size_t n = 1 + random() % 3; n > 0; --n) mutate(input, random);
        readable += fuzzTraceOnce(input);
    }
    EXPECT_GT(readable, 100) << "mutations that stay traces reach the validator";
    EXPECT_LT(readable, 3900) << "mutations that break traces reach the errors";
}

TEST(Trace, SurvivesEveryTruncation) {
    const std::vector<uint8_t> seed = fuzzSeed();
    size_t refused = 0;
    for (size_t length = 0; length < seed.size(); ++length) refused += !fuzzTraceOnce(std::span(seed).first(length));
    EXPECT_GT(refused, seed.size() / 2) << "a cut line or a cut payload is an error";
}

} // namespace
} // namespace filament_core::backend
