// SPDX-License-Identifier: Apache-2.0
#include "backend/create/CreateDriver.h"
#include "backend/create/MesaEnvironment.h"
#include "backend/stream/CommandBuffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace filament_core::backend {
namespace {

class SilentSink final : public ResultSink {
public:
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

TEST(CreateDriverTest, EveryListedDeviceCanBeMadeByItsName) {
    const std::vector<DeviceInfo> devices = listDevices();
    EXPECT_FALSE(devices.empty());
    for (DeviceInfo const& device : devices) {
        SilentSink sink;
        Result<std::unique_ptr<Driver>> driver =
                createDriver(device.backend, { .requireDevice = device.deviceName }, sink);
        ASSERT_TRUE(driver) << driver.error().message;
        EXPECT_EQ((*driver)->info().deviceName, device.deviceName);
        EXPECT_EQ((*driver)->info().backend, device.backend);
    }
}

TEST(CreateDriverTest, AnUnknownDeviceIsAnErrorThatNamesItAndWhatThereIs) {
    for (DeviceInfo const& device : listDevices()) {
        SilentSink sink;
        const Result<std::unique_ptr<Driver>> driver =
                createDriver(device.backend, { .requireDevice = "no such card" }, sink);
        ASSERT_FALSE(driver);
        EXPECT_EQ(driver.error().code, ErrorCode::DeviceUnavailable);
        EXPECT_NE(driver.error().message.find("no such card"), std::string::npos);
        EXPECT_NE(driver.error().message.find(device.deviceName), std::string::npos) << driver.error().message;
    }
}

TEST(CreateDriverTest, TheNullBackendNeedsNoDevice) {
    SilentSink sink;
    Result<std::unique_ptr<Driver>> driver = createDriver(Backend::Null, {}, sink);
    ASSERT_TRUE(driver);
    EXPECT_EQ((*driver)->info().backend, Backend::Null);
}

TEST(CreateDriverTest, TheVectorWidthIsFixedBeforeADriverIsLoaded) {
    listDevices();
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    ASSERT_NE(width, nullptr);
    EXPECT_TRUE(std::string_view(width) == "256" || std::string_view(width) == "128") << width;
}

/// The tickets that were answered, in this order.
class AnsweredTickets final : public ResultSink {
public:
    void onReadback(Ticket ticket, std::span<const std::byte>) override { tickets.push_back(ticket.value); }
    void onTimer(Ticket ticket, uint64_t) override { tickets.push_back(ticket.value); }
    void onError(DriverErrorKind, std::string_view message) override { ADD_FAILURE() << message; }

    std::vector<uint64_t> tickets;
};

/// Times two clears, the second also on its own (tickets 1 and 2), then reads the texture (ticket 3).
void recordTimedClears(CommandBuffer& commands, TextureHandle texture) {
    constexpr uint32_t side = 256;
    PassDesc pass;
    pass.layout.colorCount = 1;
    pass.layout.colorFormats[0] = Format::RGBA8;
    pass.colors[0].texture = texture;
    pass.area = { 0, 0, side, side };
    pass.debugName = "timed clear";
    commands.record(CmdCreateTexture{ texture,
                                      { .format = Format::RGBA8,
                                        .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                                        .width = side,
                                        .height = side,
                                        .debugName = "timed" } });
    commands.record(CmdBeginFrame{ 1 });
    commands.record(CmdBeginTimer{ { 1 } });
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdEndPass{});
    commands.record(CmdBeginTimer{ { 2 } });
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdEndPass{});
    commands.record(CmdEndTimer{ { 2 } });
    commands.record(CmdEndTimer{ { 1 } });
    commands.record(CmdReadTexture{ .texture = texture, .rect = { 0, 0, side, side }, .ticket = { 3 } });
    commands.record(CmdEndFrame{});
}

/// In the order in which a driver answers them; `polls`: while it replays, instead of when it idles.
std::vector<uint64_t> answersToTimedClears(Driver& driver, AnsweredTickets& sink, bool polls) {
    sink.tickets.clear();
    const auto texture = TextureHandle::make(1, 1);
    CommandBuffer commands;
    recordTimedClears(commands, texture);
    driver.execute(commands.view());
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (polls && sink.tickets.size() < 3 && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        driver.execute(CommandView{});
    }
    driver.waitIdle();
    commands.reset();
    commands.record(CmdDestroyTexture{ texture });
    driver.execute(commands.view());
    return sink.tickets;
}

TEST(CreateDriverTest, AReadbackIsAnsweredAfterTheTimersThatEndedBeforeIt) {
    std::vector<DeviceInfo> devices = listDevices();
    devices.push_back({ .backend = Backend::Null });
    for (DeviceInfo const& device : devices) {
        AnsweredTickets sink;
        Result<std::unique_ptr<Driver>> driver =
                createDriver(device.backend, { .requireDevice = device.deviceName }, sink);
        ASSERT_TRUE(driver) << driver.error().message;
        for (const bool polls : { true, false }) {
            EXPECT_THAT(answersToTimedClears(**driver, sink, polls), testing::ElementsAre(2, 1, 3))
                    << toString(device.backend) << (polls ? ", polled" : ", idle");
        }
    }
}

using Variables = std::map<std::string, std::string>;

/// The environment after the changes.
Variables afterChanges(Variables variables) {
    const MesaEnvironment environment = mesaEnvironment([&](const char* name) {
        const auto found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
    });
    for (EnvironmentChange const& change : environment.changes) variables[change.name] = change.value;
    if (!environment.note.empty()) variables["note"] = environment.note;
    return variables;
}

TEST(MesaEnvironmentTest, AWidthOf256IsTheDefaultAndSharesMesasCache) {
    EXPECT_EQ(afterChanges({}),
              (Variables{ { "GALLIVM_PERF", "no_aos_sampling" }, { "LP_NATIVE_VECTOR_WIDTH", "256" } }));
    const Variables chosen{ { "GALLIVM_PERF", "no_aos_sampling" },
                            { "LP_NATIVE_VECTOR_WIDTH", "256" },
                            { "MESA_SHADER_CACHE_DIR", "/c" } };
    EXPECT_EQ(afterChanges(chosen), chosen);
}

TEST(MesaEnvironmentTest, AWidthOf128StaysAndNeverMeetsShadersOfAnother) {
    const auto cacheOf128 = [](Variables variables) {
        variables["LP_NATIVE_VECTOR_WIDTH"] = "128";
        const Variables after = afterChanges(variables);
        EXPECT_EQ(after.at("LP_NATIVE_VECTOR_WIDTH"), "128");
        return after.contains("MESA_SHADER_CACHE_DISABLE") ? "disabled" : after.at("MESA_SHADER_CACHE_DIR");
    };
    EXPECT_EQ(cacheOf128({ { "HOME", "/h" } }), "/h/.cache/mesa_vectors_128");
    EXPECT_EQ(cacheOf128({ { "HOME", "/h" }, { "XDG_CACHE_HOME", "/x" } }), "/x/mesa_vectors_128");
    EXPECT_EQ(cacheOf128({ { "XDG_CACHE_HOME", "/x" }, { "MESA_SHADER_CACHE_DIR", "/m" } }), "/m/mesa_vectors_128");
    EXPECT_EQ(cacheOf128({ { "MESA_SHADER_CACHE_DIR", "/m/mesa_vectors_128" } }), "/m/mesa_vectors_128")
            << "a child process inherits what its parent set";
    EXPECT_EQ(cacheOf128({}), "disabled");
    const Variables child =
            afterChanges({ { "LP_NATIVE_VECTOR_WIDTH", "256" }, { "MESA_SHADER_CACHE_DIR", "/m/mesa_vectors_128" } });
    EXPECT_EQ(child.at("MESA_SHADER_CACHE_DIR"), "/m") << "a child of 256 bits leaves it again";
}

TEST(MesaEnvironmentTest, TexturesAreFilteredInFloatingPointWhateverElseWasChosen) {
    const auto optionsAfter = [](const char* options) {
        return afterChanges({ { "GALLIVM_PERF", options } }).at("GALLIVM_PERF");
    };
    EXPECT_EQ(optionsAfter(""), "no_aos_sampling");
    EXPECT_EQ(optionsAfter("nopt"), "nopt,no_aos_sampling");
    EXPECT_EQ(optionsAfter("nopt,no_aos_sampling"), "nopt,no_aos_sampling") << "a child process inherits it";
}

TEST(MesaEnvironmentTest, OtherWidthsFallBackTo256WithAMessage) {
    for (const char* width : { "512", "64", "0", "-256", "wide", "256 " }) {
        const Variables after = afterChanges({ { "LP_NATIVE_VECTOR_WIDTH", width }, { "HOME", "/h" } });
        EXPECT_EQ(after.at("LP_NATIVE_VECTOR_WIDTH"), "256");
        EXPECT_FALSE(after.contains("MESA_SHADER_CACHE_DIR"));
        EXPECT_NE(after.at("note").find(std::string("LP_NATIVE_VECTOR_WIDTH=") + width), std::string::npos);
    }
}

} // namespace
} // namespace filament_core::backend
