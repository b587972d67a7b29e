// SPDX-License-Identifier: Apache-2.0
#include "backend/create/CreateDriver.h"

#include "backend/create/MesaEnvironment.h"
#include "backend/create/SelfTest.h"
#include "backend/gles/Driver.h"
#include "backend/null/NullDriver.h"
#include "backend/vulkan/Driver.h"

#include <iterator>
#include <utility>

namespace filament_core::backend {
namespace {

Result<std::unique_ptr<Driver>> makeDriver(Backend type, DriverOptions const& options, ResultSink& sink) {
    switch (type) {
    case Backend::Null:
        return createNullDriver(sink);
    case Backend::Vulkan:
        return createVulkanDriver(options, sink);
    case Backend::Gles:
        return createGlesDriver(options, sink);
    }
    return fail(ErrorCode::InvalidArgument, "there is no backend number {}", static_cast<int>(type));
}

} // namespace

Result<std::unique_ptr<Driver>> createDriver(Backend type, DriverOptions const& options, ResultSink& sink) {
    // Before the first driver is loaded: Mesa reads these variables once.
    applyMesaEnvironment();
    const auto make = [&](ResultSink& results) { return makeDriver(type, options, results); };
    return options.selfTest ? makeTestedDriver(make, sink, options.selfTestNotes) : make(sink);
}

std::vector<DeviceInfo> listDevices() {
    applyMesaEnvironment();
    std::vector<DeviceInfo> devices = listVulkanDevices();
    std::vector<DeviceInfo> gles = listGlesDevices();
    devices.insert(devices.end(), std::make_move_iterator(gles.begin()), std::make_move_iterator(gles.end()));
    return devices;
}

} // namespace filament_core::backend
