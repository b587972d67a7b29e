// SPDX-License-Identifier: Apache-2.0
#include "backend/create/SelfTest.h"
#include "backend/create/CreateDriver.h"
#include "backend/layers/Validated.h"
#include "backend/null/NullDriver.h"
#include "backend/stream/CommandBuffer.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::backend {
namespace {

using testing::HasSubstr;

class SilentSink final : public ResultSink {
public:
    void onReadback(Ticket, std::span<const std::byte>) override { ++readbacks; }
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view message) override { ADD_FAILURE() << message; }

    uint32_t readbacks = 0;
};

/// Counts the frames that reach a driver, and changes a byte of what it answers.
class Meddler final : public Driver, public ResultSink {
public:
    Meddler(Backend type, ResultSink& sink, uint64_t ticket, size_t byte) : mSink(sink), mTicket(ticket), mByte(byte) {
        auto made = createDriver(type, {}, *this);
        if (made) mDriver = std::move(*made);
    }

    bool isMade() const { return mDriver != nullptr; }
    DeviceInfo const& info() const override { return mDriver->info(); }
    void execute(CommandView commands) override { mDriver->execute(commands); }
    void waitIdle() override { mDriver->waitIdle(); }
    DriverStatistics statistics() const override { return mDriver->statistics(); }

    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        std::vector<std::byte> changed(bytes.begin(), bytes.end());
        if (ticket.value == mTicket) changed[mByte] ^= std::byte{ 1 };
        mSink.onReadback(ticket, changed);
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override { mSink.onTimer(ticket, nanoseconds); }
    void onError(DriverErrorKind kind, std::string_view message) override { mSink.onError(kind, message); }

private:
    ResultSink& mSink;
    uint64_t mTicket;
    size_t mByte;
    std::unique_ptr<Driver> mDriver;
};

/// The outcome of the test, if byte `byte` of its image `ticket` is another one. No ticket: none is changed.
Result<std::unique_ptr<Driver>> testWith(Backend type, uint64_t ticket, size_t byte, ResultSink& sink) {
    return makeTestedDriver(
            [&](ResultSink& results) -> Result<std::unique_ptr<Driver>> {
                auto driver = std::make_unique<Meddler>(type, results, ticket, byte);
                if (!driver->isMade()) return Error{ ErrorCode::DeviceUnavailable, "no device" };
                return std::unique_ptr<Driver>(std::move(driver));
            },
            sink, {});
}

class SelfTest : public testing::TestWithParam<Backend> {};

TEST_P(SelfTest, ADriverThatDrawsRightIsAsNewAfterIt) {
    SilentSink sink;
    const auto driver = createDriver(GetParam(), { .validation = true, .selfTest = true }, sink);
    ASSERT_TRUE(driver) << driver.error().message;
    EXPECT_EQ(sink.readbacks, 0u);
    const DriverStatistics statistics = (*driver)->statistics();
    EXPECT_EQ(statistics.commands + statistics.draws + statistics.pipelinesCreated + statistics.passes, 0u);
}

TEST_P(SelfTest, ItsUserGetsTheResultsOfALaterFrame) {
    SilentSink sink;
    const auto driver = createDriver(GetParam(), { .selfTest = true }, sink);
    ASSERT_TRUE(driver) << driver.error().message;
    CommandBuffer commands;
    const auto buffer = BufferHandle::make(1, 1);
    commands.record(
            CmdCreateBuffer{ buffer, { .size = 16, .usage = BufferUsage::Storage | BufferUsage::TransferSource } });
    commands.record(CmdReadBuffer{ .buffer = buffer, .size = 16, .ticket = { 1 } });
    commands.record(CmdDestroyBuffer{ buffer });
    (*driver)->execute(commands.view());
    (*driver)->waitIdle();
    EXPECT_EQ(sink.readbacks, 1u);
    EXPECT_EQ((*driver)->statistics().commands, 3u);
}

TEST_P(SelfTest, ItsFrameKeepsTheRulesOfStreams) {
    SilentSink sink;
    const auto driver = makeTestedDriver(
            [](ResultSink& results) -> Result<std::unique_ptr<Driver>> {
                auto made = createDriver(GetParam(), {}, results);
                if (!made) return made;
                return validate(std::move(*made), results);
            },
            sink, {});
    EXPECT_TRUE(driver) << driver.error().message;
}

/// Every byte of both images is one that the test looks at.
TEST_P(SelfTest, OneWrongBitInAnyByteRefusesTheDriver) {
    SilentSink sink;
    ASSERT_TRUE(testWith(GetParam(), 0, 0, sink));
    for (const uint64_t ticket : { 1, 2 }) {
        for (const size_t byte : { 0, 7, 64, 130, 255 }) {
            const auto driver = testWith(GetParam(), ticket, byte, sink);
            ASSERT_FALSE(driver) << ticket << " " << byte;
            EXPECT_EQ(driver.error().code, ErrorCode::Unsupported);
            EXPECT_THAT(driver.error().message, HasSubstr(fmt::format("pixel {}, {}", byte / 4 % 8, byte / 32)));
            EXPECT_THAT(driver.error().message, HasSubstr(ticket == 1 ? "blended" : "input attachment"));
        }
    }
}

TEST_P(SelfTest, ADriverThatPassedIsNotTestedAgain) {
    const std::filesystem::path notes =
            tools::buildDir() / "test-files" / fmt::format("SelfTest{}", toString(GetParam()));
    std::filesystem::remove_all(notes);
    SilentSink sink;
    const auto make = [](ResultSink& results) -> Result<std::unique_ptr<Driver>> {
        return std::unique_ptr<Driver>(std::make_unique<Meddler>(GetParam(), results, 1, 0));
    };
    EXPECT_FALSE(makeTestedDriver(make, sink, notes)) << "a driver that fails is not noted";
    ASSERT_TRUE(createDriver(GetParam(), { .selfTest = true, .selfTestNotes = notes }, sink));
    EXPECT_TRUE(makeTestedDriver(make, sink, notes));
}

INSTANTIATE_TEST_SUITE_P(Apis, SelfTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& each) { return each.param == Backend::Vulkan ? "Vulkan" : "Gles"; });

TEST(SelfTestMessage, NamesTheDeviceTheDriverAndTheCure) {
    SilentSink sink;
    const auto driver = testWith(Backend::Gles, 1, 0, sink);
    ASSERT_FALSE(driver);
    const auto used = createDriver(Backend::Gles, {}, sink);
    ASSERT_TRUE(used);
    EXPECT_THAT(driver.error().message, HasSubstr((*used)->info().deviceName + " with " + (*used)->info().driverName));
    EXPECT_THAT(driver.error().message, HasSubstr("(66, 134, 99, 51) at pixel 0, 0 instead of (67, 134, 99, 51)"));
    EXPECT_THAT(driver.error().message, HasSubstr("EngineOptions::driverSelfTest"));
}

TEST(SelfTestOf, TheNullDriverIsMadeWithoutOne) {
    SilentSink sink;
    const auto driver = createDriver(Backend::Null, { .selfTest = true }, sink);
    ASSERT_TRUE(driver);
    CommandBuffer commands;
    const auto buffer = BufferHandle::make(1, 1);
    commands.record(CmdCreateBuffer{ buffer, { .size = 16, .usage = BufferUsage::TransferSource } });
    commands.record(CmdReadBuffer{ .buffer = buffer, .size = 16, .ticket = { 1 } });
    (*driver)->execute(commands.view());
    (*driver)->waitIdle();
    EXPECT_EQ(sink.readbacks, 1u);
}

/// What a driver says while it is made is for its user, and no reason to refuse it.
TEST(SelfTestOf, ADriverThatReportsSomethingWhenItIsMadePassesThatOn) {
    class Listener final : public ResultSink {
    public:
        void onReadback(Ticket, std::span<const std::byte>) override {}
        void onTimer(Ticket, uint64_t) override {}
        void onError(DriverErrorKind, std::string_view message) override { messages.emplace_back(message); }
        std::vector<std::string> messages;
    } listener;
    const auto driver = makeTestedDriver(
            [](ResultSink& results) {
                auto made = createDriver(Backend::Gles, {}, results);
                results.onError(DriverErrorKind::Other, "a cache was damaged");
                return made;
            },
            listener, {});
    EXPECT_TRUE(driver);
    EXPECT_THAT(listener.messages, testing::ElementsAre("a cache was damaged"));
}

} // namespace
} // namespace filament_core::backend
