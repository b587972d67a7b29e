// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Captured.h"
#include "backend/null/NullDriver.h"
#include "tests/backend/layers/LayerTestKit.h"

#include <gtest/gtest.h>

namespace filament_core::backend {
namespace {

/// Records what reached the driver.
class Witness final : public Driver {
public:
    explicit Witness(ResultSink& sink) : mNull(createNullDriver(sink)) {}
    DeviceInfo const& info() const override { return mNull->info(); }
    void execute(CommandView commands) override {
        replay(commands, *this);
        mNull->execute(commands);
    }
    void waitIdle() override { mNull->waitIdle(); }
    DriverStatistics statistics() const override { return mNull->statistics(); }

    template <class C>
    void execute(C const&) {}
    void execute(CmdDraw const&) { ++draws; }
    void execute(CmdReadTexture const& command) { reads.push_back(command.texture); }
    void execute(CmdCreateTexture const& command) { textures.push_back(command.desc); }
    void execute(CmdBeginPass const& command) { depthStore = command.desc.depth.store; }
    void execute(CmdCreatePipeline const& command) { pipelines.push_back(command.desc); }

    uint32_t draws = 0;
    std::vector<TextureHandle> reads;
    std::vector<DeviceTextureDesc> textures;
    std::vector<PipelineDesc> pipelines;
    StoreOp depthStore = StoreOp::Discard;

private:
    std::unique_ptr<Driver> mNull;
};

struct Answers final : ResultSink {
    std::vector<Ticket> tickets;
    void onReadback(Ticket ticket, std::span<const std::byte>) override { tickets.push_back(ticket); }
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

class CapturedLayer : public testing::Test {
protected:
    void open(std::unique_ptr<StreamEdit> edit = nullptr) {
        capture = std::make_shared<FrameCapture>(std::move(edit));
        auto made = captured(capture, answers, [this](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
            auto inner = std::make_unique<Witness>(sink);
            witness = inner.get();
            return std::unique_ptr<Driver>(std::move(inner));
        });
        ASSERT_TRUE(made.ok());
        driver = std::move(*made);
        CommandBuffer objects;
        const TextureUsage color = TextureUsage::ColorAttachment | TextureUsage::Transient;
        objects.record(
                CmdCreateTexture{ kit::kColor, { .usage = color, .width = 4, .height = 2, .debugName = "hdr" } });
        objects.record(CmdCreateTexture{ kit::kDepth,
                                         { .format = Format::D32F,
                                           .usage = TextureUsage::DepthAttachment,
                                           .width = 4,
                                           .height = 2,
                                           .debugName = "depth" } });
        objects.record(CmdCreatePipeline{ kit::kPipeline, kit::pipelineDesc() });
        driver->execute(objects.view());
    }

    void frame(uint32_t draws) {
        CommandBuffer commands;
        commands.record(CmdBeginFrame{ 7 });
        PassDesc pass = kit::passDesc();
        pass.depth.store = StoreOp::Discard;
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ kit::kPipeline });
        for (uint32_t i = 0; i < draws; ++i) commands.record(CmdDraw{ 3 });
        commands.record(CmdEndPass{});
        commands.record(CmdReadTexture{ kit::kColor, 0, 0, { 0, 0, 4, 2 }, { 5 } });
        commands.record(CmdEndFrame{ 7 });
        driver->execute(commands.view());
        driver->waitIdle();
    }

    Answers answers;
    std::shared_ptr<FrameCapture> capture;
    Witness* witness = nullptr;
    std::unique_ptr<Driver> driver;
};

TEST_F(CapturedLayer, LeavesUnrequestedFramesAlone) {
    open();
    frame(3);
    EXPECT_EQ(witness->draws, 3u);
    EXPECT_EQ(witness->reads.size(), 1u);
    EXPECT_EQ(witness->depthStore, StoreOp::Discard);
    EXPECT_FALSE(capture->take());
}

TEST_F(CapturedLayer, ReadsEveryAttachmentAndKeepsTheAnswersFromTheApplication) {
    open();
    capture->arm({});
    frame(2);
    const auto captured = capture->take();
    ASSERT_TRUE(captured);
    ASSERT_EQ(captured->passes.size(), 1u);
    CapturedPass const& pass = captured->passes[0];
    EXPECT_EQ(pass.name, "main");
    ASSERT_EQ(pass.attachments.size(), 2u);
    EXPECT_EQ(pass.attachments[0].name, "hdr");
    EXPECT_FALSE(pass.attachments[0].isDepth);
    EXPECT_EQ(pass.attachments[0].bytes.size(), 4u * 2 * 4);
    EXPECT_TRUE(pass.attachments[1].isDepth);
    EXPECT_EQ(pass.attachments[1].bytes.size(), 4u * 2 * 4);
    EXPECT_EQ(witness->depthStore, StoreOp::Store);
    EXPECT_EQ(answers.tickets, std::vector{ Ticket{ 5 } });
    EXPECT_FALSE(capture->take()) << "a frame is taken once";
}

TEST_F(CapturedLayer, NamesThePositionsOfPassesAndDraws) {
    open();
    capture->arm({});
    frame(2);
    const auto captured = capture->take();
    ASSERT_TRUE(captured);
    EXPECT_EQ(captured->frame, 7u);
    EXPECT_EQ(captured->passes[0].first, 1u); // BeginFrame is 0
    EXPECT_EQ(captured->passes[0].last, 5u);
    ASSERT_EQ(captured->draws.size(), 2u);
    EXPECT_EQ(captured->draws[1].position, 4u);
    EXPECT_EQ(captured->draws[1].pipeline, "painted");
}

TEST_F(CapturedLayer, LeavesOutTheDrawsBeyondTheLimitAndStillNamesThem) {
    open();
    capture->arm({ .drawLimit = 2 });
    frame(5);
    EXPECT_EQ(witness->draws, 2u);
    EXPECT_EQ(capture->take()->draws.size(), 5u);
    frame(5);
    EXPECT_EQ(witness->draws, 7u) << "the limit holds for one frame";
}

TEST_F(CapturedLayer, MakesAttachmentsReadable) {
    open();
    for (DeviceTextureDesc const& desc : witness->textures) {
        EXPECT_TRUE(has(desc.usage, TextureUsage::TransferSource)) << desc.debugName;
        EXPECT_FALSE(has(desc.usage, TextureUsage::Transient)) << desc.debugName;
    }
}

TEST_F(CapturedLayer, AnEditChangesWhatReachesTheDriver) {
    struct NoDepthTest final : StreamEdit {
        using StreamEdit::edit;
        void edit(CmdCreatePipeline& command) override { command.desc.depthStencil.depthCompare = CompareOp::Always; }
    };
    open(std::make_unique<NoDepthTest>());
    ASSERT_EQ(witness->pipelines.size(), 1u);
    EXPECT_EQ(witness->pipelines[0].depthStencil.depthCompare, CompareOp::Always);
}

TEST_F(CapturedLayer, AReasonWhyThereIsNoDriverComesThrough) {
    auto made = captured(std::make_shared<FrameCapture>(), answers, [](ResultSink&) -> Result<std::unique_ptr<Driver>> {
        return fail(ErrorCode::DeviceUnavailable, "no such device");
    });
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().message, "no such device");
}

} // namespace
} // namespace filament_core::backend
