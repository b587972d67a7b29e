// SPDX-License-Identifier: Apache-2.0
/// Shared by the tests of the frame graph: a graph with its arena, a stream on the null driver, helpers to declare
/// passes.
#pragma once

#include "backend/layers/Validated.h"
#include "backend/null/NullDriver.h"
#include "backend/stream/CommandStream.h"
#include "framegraph/CompileSteps.h"
#include "framegraph/Explain.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::framegraph {

using backend::Format;
using backend::LoadOp;
using backend::StoreOp;
using backend::TextureUsage;

class GraphTest : public testing::Test {
protected:
    GraphTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    TextureId color(std::string_view name, uint32_t width = 64, uint8_t samples = 1) {
        return graph.createTexture(
                { .width = width, .height = 32, .format = Format::RGBA16F, .samples = samples, .name = name });
    }
    TextureId depth(std::string_view name) {
        return graph.createTexture({ .width = 64, .height = 32, .format = Format::D32F, .name = name });
    }
    /// Levels of 64 x 32, 32 x 16, ...
    TextureId chain(std::string_view name, uint8_t levels) {
        return graph.createTexture(
                { .width = 64, .height = 32, .format = Format::RGBA16F, .levels = levels, .name = name });
    }
    TextureId backbuffer(InitialContents contents = InitialContents::Undefined) {
        return graph.importTexture(backend::TextureHandle::make(77, 1),
                                   { .width = 64, .height = 32, .format = Format::RGBA16F, .name = "backbuffer" },
                                   contents);
    }
    /// A pass that only declares.
    uint32_t pass(std::string_view name, std::function<void(PassBuilder&)> const& setup) {
        return graph.addPass(name, setup, [](PassContext&) {}).index();
    }

    /// The steps up to load and store, without a device.
    struct Steps {
        PassOrder order;
        std::span<PassGroup> groups;
        std::span<Lifetime> lifetimes;
        std::span<TextureUsage> usage;
    };
    Steps steps(MergeLimits const& limits = {}) {
        Steps result;
        checkDeclarations(graph);
        result.order = cullUnreadPasses(graph);
        result.groups = mergePasses(graph, result.order, limits);
        result.lifetimes = firstAndLastUse(graph, result.order, result.groups);
        deriveLoadAndStore(graph, result.order, result.groups);
        result.usage = deriveUsage(graph, result.order, result.lifetimes);
        describePasses(graph, result.order, result.groups);
        return result;
    }

    Arena arena;
    FrameGraph graph{ arena };
};

/// With a stream whose validated null driver collects every broken rule.
class DeviceGraphTest : public GraphTest {
protected:
    DeviceGraphTest() {
        backend::DriverFactory factory = [](backend::ResultSink& sink) -> Result<std::unique_ptr<backend::Driver>> {
            return backend::validate(backend::createNullDriver(sink), sink);
        };
        stream = std::move(backend::CommandStream::start(factory, { .ownThread = false })).value();
        pool = std::make_unique<TransientPool>(*stream, 3);
    }
    ~DeviceGraphTest() override {
        backend::CommandBuffer& commands = stream->acquire();
        pool->destroyAll(commands);
        stream->submit(commands);
        stream->waitIdle();
        for (backend::DriverError const& error : stream->takeErrors()) ADD_FAILURE() << error.message;
        EXPECT_EQ(stream->liveHandles(), expectedHandles) << "textures or bind groups were not destroyed";
    }

    /// A real imported texture.
    TextureId target() {
        if (!mTarget) {
            mTarget = stream->allocateTexture();
            ++expectedHandles;
            backend::CommandBuffer& commands = stream->acquire();
            commands.record(backend::CmdCreateTexture{
                    mTarget,
                    { .format = Format::RGBA16F,
                      .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                      .width = 64,
                      .height = 32,
                      .debugName = "target" } });
            stream->submit(commands);
        }
        return graph.importTexture(mTarget, { .width = 64, .height = 32, .format = Format::RGBA16F, .name = "target" },
                                   InitialContents::Undefined);
    }

    std::unique_ptr<backend::CommandStream> stream;
    std::unique_ptr<TransientPool> pool;
    uint32_t expectedHandles = 0;

private:
    backend::TextureHandle mTarget;
};

} // namespace filament_core::framegraph
