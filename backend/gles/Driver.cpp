// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Driver.h"

#include "backend/gles/Executor.h"

#include <algorithm>

namespace filament_core::backend {

Result<std::unique_ptr<Driver>> createGlesDriver(DriverOptions const& options, ResultSink& sink) {
    auto executor = gles::Executor::create(options, sink);
    if (!executor) return executor.error();
    return std::unique_ptr<Driver>(std::move(*executor));
}

std::vector<DeviceInfo> listGlesDevices() {
    Result<gles::Egl const*> egl = gles::Egl::load();
    if (!egl) return {};
    std::vector<DeviceInfo> devices;
    const gles::ThreadBindingGuard guard(**egl);
    for (gles::DisplaySource source : (*egl)->displaySources()) {
        Result<gles::OpenDevice> device = gles::openDevice(**egl, source, false);
        if (!device) continue;
        DeviceInfo info = describeDevice(device->gl, device->quirks);
        // The surfaceless platform and the device enumeration list the same devices.
        const bool known = std::any_of(devices.begin(), devices.end(), [&](DeviceInfo const& other) {
            return other.deviceName == info.deviceName && other.driverName == info.driverName;
        });
        if (!known) devices.push_back(std::move(info));
    }
    return devices;
}

} // namespace filament_core::backend
