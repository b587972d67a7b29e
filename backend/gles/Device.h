// SPDX-License-Identifier: Apache-2.0
/// Device: shared by every part of the driver: the functions, the cached state, and the destination of errors.
/// OpenDevice: a context that this driver can use, before anything is created in it.
///   Thread  the driver thread. openDevice() and chooseDevice() leave their context current.
///   Fails   chooseDevice(): DeviceUnavailable, with the reason of the refusal or the list of devices.
#pragma once

#include "backend/gles/Context.h"
#include "backend/gles/ContextState.h"
#include "base/BlobStore.h"

#include <fmt/core.h>

#include <optional>

namespace filament_core::backend::gles {

struct OpenDevice {
    Context context;
    Api gl;
    Quirks quirks;
};
Result<OpenDevice> openDevice(Egl const& egl, DisplaySource source, bool debug);
/// The device that DriverOptions::requireDevice names, or the first usable one.
Result<OpenDevice> chooseDevice(DriverOptions const& options);

/// Disables features of a device, for tests.
using QuirkFilter = void (*)(Quirks&);

struct Device {
    Device(Api const& api, Quirks const& found, ResultSink& results, bool wantsMessages);
    ~Device();
    Device(Device const&) = delete;
    Device& operator=(Device const&) = delete;

    template <class... Args>
    void error(DriverErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
        sink.onError(kind, fmt::vformat(format, fmt::make_format_args(args...)));
    }

    /// The first error since the last call, GL_NO_ERROR if none. Clears the rest.
    GLenum takeError();
    /// Call these around creating an object: created() reports why it failed and returns false.
    void beginCreation();
    bool created(const char* what, std::string_view name);

    /// Checks whether the context still works; reports DeviceLost the first time it does not.
    void checkLost();

    /// Names an object for debuggers; free unless messages are on.
    void label(GLenum type, GLuint object, std::string_view name);

    Api const gl;
    Quirks const quirks;
    ResultSink& sink;
    bool const messages; ///< validation: KHR_debug messages reach the sink
    DeviceInfo const info;
    ContextState state;
    std::optional<BlobStore> programs{}; ///< binaries from run to run; none: disabled, or unsupported by the device
    DriverStatistics statistics;         ///< of this thread; the driver publishes copies
    bool creating = false;               ///< an error is one of beginCreation(): created() tells it
    bool lost = false;                   ///< the context is gone: nothing works any more
};

} // namespace filament_core::backend::gles
