// SPDX-License-Identifier: Apache-2.0
/// The driver behind GlesDriver.h: a context, and the commands that run in it.
///   Thread  as backend/api/Driver.h; makes its context current whenever it is entered, so that several drivers may
///           live on one thread.
#pragma once

#include "backend/gles/Commands.h"
#include "backend/gles/Context.h"
#include "backend/gles/GlesDriver.h"

#include <mutex>

namespace filament::backend::gles {

/// Takes away what the device has, to run the ways around; nothing else than tests needs it.
using QuirkFilter = void (*)(Quirks&);

/// createGlesDriver() with a filter.
Result<std::unique_ptr<Driver>> createFilteredDriver(DriverOptions const& options, ResultSink& sink,
                                                     QuirkFilter filter);

/// A context that this driver can work with.
struct OpenDevice {
    Context context;
    GlApi gl;
    Quirks quirks;
};

class GlesDriver final : public Driver {
public:
    GlesDriver(OpenDevice device, DriverOptions const& options, ResultSink& sink);
    ~GlesDriver() override;

    DeviceInfo const& info() const override { return mDevice.info; }
    void execute(CommandView commands) override;
    void waitIdle() override;
    DriverStatistics statistics() const override;

private:
    void publishStatistics();

    Context mContext; // outlives everything that is deleted in it
    Device mDevice;
    Commands mCommands;
    mutable std::mutex mMutex;
    DriverStatistics mPublished; // under mMutex
};

} // namespace filament::backend::gles
