// SPDX-License-Identifier: Apache-2.0
#include "backend/create/CreateDriver.h"

#include "backend/gles/Driver.h"
#include "backend/null/NullDriver.h"
#include "backend/vulkan/Driver.h"

#include <cstdlib>
#include <iterator>
#include <mutex>
#include <utility>

namespace filament::backend {
namespace {

/// Mesa's software rasteriser computes with vectors as wide as the processor has, and their width shows in the last bit
/// of some pixels: 256 is what every x86-64 machine of the last decade has, and what stored images were made with. A
/// value that the user set stays. Once, before the first Mesa driver is loaded, because it reads the value when it
/// starts.
void fixSoftwareVectorWidth() {
    static std::once_flag once;
    std::call_once(once, [] { setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0); });
}

} // namespace

Result<std::unique_ptr<Driver>> createDriver(BackendType type, DriverOptions const& options, ResultSink& sink) {
    fixSoftwareVectorWidth();
    switch (type) {
    case BackendType::Null:
        return createNullDriver(sink);
    case BackendType::Vulkan:
        return createVulkanDriver(options, sink);
    case BackendType::Gles:
        return createGlesDriver(options, sink);
    }
    return fail(ErrorCode::InvalidArgument, "there is no backend number {}", static_cast<int>(type));
}

std::vector<DeviceInfo> listDevices() {
    fixSoftwareVectorWidth();
    std::vector<DeviceInfo> devices = listVulkanDevices();
    std::vector<DeviceInfo> gles = listGlesDevices();
    devices.insert(devices.end(), std::make_move_iterator(gles.begin()), std::make_move_iterator(gles.end()));
    return devices;
}

} // namespace filament::backend
