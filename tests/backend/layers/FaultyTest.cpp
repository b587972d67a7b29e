// SPDX-License-Identifier: Apache-2.0
// Which part of a stream reaches the inner driver, and what the sink is told.
#include "backend/layers/Faulty.h"
#include "backend/stream/CommandFields.h"
#include "tests/backend/layers/LayerTestKit.h"

#include <gtest/gtest.h>

namespace filament_core::backend {
namespace {

/// Records the names of the commands that arrive.
class Collector final : public Driver {
public:
    explicit Collector(std::vector<std::string>& names) : mNames(names) {}
    DeviceInfo const& info() const override { return mInfo; }
    void execute(CommandView commands) override { replay(commands, *this); }
    void waitIdle() override {}
    DriverStatistics statistics() const override { return {}; }
    template <class C>
    void execute(C const&) {
        mNames.emplace_back(kFields<C>.name);
    }

private:
    DeviceInfo mInfo;
    std::vector<std::string>& mNames;
};

class FaultyTest : public testing::Test {
protected:
    void SetUp() override { driver = faulty(std::make_unique<Collector>(arrived), injector, errors); }

    /// Two buffers, a sampler and three groups: creations are the commands 1, 3 and 5.
    void run() {
        CommandBuffer commands;
        const BufferHandle first = BufferHandle::make(0, 1), second = BufferHandle::make(1, 1);
        commands.record(CmdCreateBuffer{ first, { 64, BufferUsage::Vertex, "first" } });
        commands.record(CmdPushGroup{ "a" });
        commands.record(CmdCreateBuffer{ second, { 64, BufferUsage::Vertex, "second" } });
        commands.record(CmdPopGroup{});
        commands.record(CmdCreateSampler{ SamplerHandle::make(0, 1), {} });
        commands.record(CmdDestroyBuffer{ first });
        driver->execute(commands.view());
    }

    const std::vector<std::string> all{ "CreateBuffer", "PushGroup",     "CreateBuffer",
                                        "PopGroup",     "CreateSampler", "DestroyBuffer" };
    std::vector<std::string> arrived;
    kit::Errors errors;
    std::shared_ptr<FaultInjector> injector = std::make_shared<FaultInjector>();
    std::unique_ptr<Driver> driver;
};

TEST_F(FaultyTest, UnarmedNothingIsChanged) {
    run();
    EXPECT_EQ(arrived, all);
    EXPECT_TRUE(errors.messages.empty());
    EXPECT_EQ(injector->commandsSeen(), 6u);
    EXPECT_EQ(injector->creationsSeen(), 3u);
    EXPECT_FALSE(injector->hasStruck());
}

TEST_F(FaultyTest, ALostDeviceExecutesWhatCameBeforeAndNothingElse) {
    for (size_t at = 1; at <= all.size(); ++at) {
        SetUp();
        arrived.clear();
        errors = {};
        injector->arm({ .loseDeviceAt = at });
        run();
        run();
        EXPECT_EQ(arrived, std::vector<std::string>(all.begin(), all.begin() + static_cast<ptrdiff_t>(at - 1)));
        ASSERT_EQ(errors.messages.size(), 1u);
        EXPECT_EQ(errors.kinds[0], DriverErrorKind::DeviceLost);
        EXPECT_NE(errors.messages[0].find("command " + std::to_string(at) + ", " + all[at - 1]), std::string::npos)
                << errors.messages[0];
    }
}

TEST_F(FaultyTest, CommandsAreCountedOverStreamsFromTheArmingOn) {
    run();
    injector->arm({ .loseDeviceAt = 8 });
    run();
    EXPECT_TRUE(errors.messages.empty());
    run();
    EXPECT_EQ(errors.messages.size(), 1u);
    EXPECT_EQ(arrived.size(), 6u + 6u + 1u);
}

TEST_F(FaultyTest, ARefusedCreationIsLeftOutAndNamed) {
    injector->arm({ .refuseCreation = 2 });
    run();
    EXPECT_EQ(arrived,
              (std::vector<std::string>{ "CreateBuffer", "PushGroup", "PopGroup", "CreateSampler", "DestroyBuffer" }));
    ASSERT_EQ(errors.messages.size(), 1u);
    EXPECT_EQ(errors.kinds[0], DriverErrorKind::OutOfMemory);
    EXPECT_NE(errors.messages[0].find("CreateBuffer 'second'"), std::string::npos) << errors.messages[0];
    EXPECT_TRUE(injector->hasStruck());
}

TEST_F(FaultyTest, ASlowDriverTakesItsTime) {
    injector->arm({ .streamDelay = std::chrono::milliseconds(5), .commandDelay = std::chrono::milliseconds(2) });
    const auto begin = std::chrono::steady_clock::now();
    run();
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(5 + 6 * 2));
    EXPECT_EQ(arrived, all);
}

} // namespace
} // namespace filament_core::backend
