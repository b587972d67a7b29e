// SPDX-License-Identifier: Apache-2.0
#include "backend/create/CreateDriver.h"
#include "backend/create/MesaEnvironment.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

namespace filament::backend {
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
    Result<std::unique_ptr<Driver>> driver = createDriver(BackendType::Null, {}, sink);
    ASSERT_TRUE(driver);
    EXPECT_EQ((*driver)->info().backend, BackendType::Null);
}

TEST(CreateDriverTest, TheVectorWidthIsFixedBeforeADriverIsLoaded) {
    listDevices();
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    ASSERT_NE(width, nullptr);
    EXPECT_TRUE(std::string_view(width) == "256" || std::string_view(width) == "128") << width;
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
    EXPECT_EQ(afterChanges({}), (Variables{ { "LP_NATIVE_VECTOR_WIDTH", "256" } }));
    const Variables chosen{ { "LP_NATIVE_VECTOR_WIDTH", "256" }, { "MESA_SHADER_CACHE_DIR", "/c" } };
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

TEST(MesaEnvironmentTest, OtherWidthsFallBackTo256AndSaySo) {
    for (const char* width : { "512", "64", "0", "-256", "wide", "256 " }) {
        const Variables after = afterChanges({ { "LP_NATIVE_VECTOR_WIDTH", width }, { "HOME", "/h" } });
        EXPECT_EQ(after.at("LP_NATIVE_VECTOR_WIDTH"), "256");
        EXPECT_FALSE(after.contains("MESA_SHADER_CACHE_DIR"));
        EXPECT_NE(after.at("note").find(std::string("LP_NATIVE_VECTOR_WIDTH=") + width), std::string::npos);
    }
}

} // namespace
} // namespace filament::backend
