// SPDX-License-Identifier: Apache-2.0
#include "backend/create/CreateDriver.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

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
    EXPECT_STREQ(width, "256");
}

} // namespace
} // namespace filament::backend
