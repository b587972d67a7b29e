// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Driver.h"

#include "backend/gles/ProgramBinary.h"
#include "base/Hash.h"

#include <algorithm>
#include <cctype>
#include <new>
#include <string_view>

namespace filament::backend {
namespace gles {
namespace {

struct Counting {
    Commands& commands;
    uint64_t count = 0;

    template <class C>
    requires Executes<Commands, C>
    void execute(C const& command) {
        ++count;
        commands.execute(command);
    }
};

bool containsIgnoringCase(std::string_view text, std::string_view part) {
    const auto equal = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return part.empty() || std::search(text.begin(), text.end(), part.begin(), part.end(), equal) != text.end();
}

Result<OpenDevice> openDevice(Egl const& egl, DisplaySource source, bool debug) {
    Result<Context> context = Context::create(egl, source, debug);
    if (!context) return context.error();
    GlApi gl;
    if (const char* missing = gl.load(egl.GetProcAddress)) {
        return fail(ErrorCode::Unsupported, "OpenGL ES: {} is missing, so this is not ES 3.1", missing);
    }
    Result<Quirks> quirks = Quirks::probe(gl);
    if (!quirks) return quirks.error();
    return OpenDevice{ std::move(*context), gl, *quirks };
}

} // namespace

GlesDriver::GlesDriver(OpenDevice device, DriverOptions const& options, ResultSink& sink)
        : mContext(std::move(device.context)), mDevice(device.gl, device.quirks, sink, options.validation),
          mCommands(mDevice) {
    if (options.cacheDirectory.empty() || !hasProgramBinaries(mDevice.gl)) return;
    const uint64_t identity = hashString(mDevice.info.driverName, hashString(mDevice.info.deviceName));
    mDevice.programs.emplace(options.cacheDirectory / fmt::format("gles-{:016x}.programs", identity), identity,
                             kProgramCacheBytes);
}

GlesDriver::~GlesDriver() {
    try {
        waitIdle(); // every ticket that can be answered is
        if (mDevice.programs) mDevice.programs->save();
    } catch (std::bad_alloc const&) { // then not
    }
    mContext.makeCurrent();
}

void GlesDriver::execute(CommandView commands) {
    mContext.makeCurrent();
    if (mDevice.lost) return;
    Counting counting{ mCommands };
    replay(commands, counting);
    mDevice.statistics.commands += counting.count;
    mCommands.poll(false);
    publishStatistics();
}

void GlesDriver::waitIdle() {
    mContext.makeCurrent();
    if (mDevice.lost) return;
    mDevice.gl.Finish();
    mCommands.poll(true);
    mDevice.checkLost();
}

void GlesDriver::publishStatistics() {
    const std::lock_guard lock(mMutex);
    mPublished = mDevice.statistics;
}

DriverStatistics GlesDriver::statistics() const {
    const std::lock_guard lock(mMutex);
    return mPublished;
}

Result<std::unique_ptr<Driver>> createFilteredDriver(DriverOptions const& options, ResultSink& sink,
                                                     QuirkFilter filter) {
    Result<Egl const*> egl = Egl::load();
    if (!egl) return egl.error();
    Error refusal{ ErrorCode::DeviceUnavailable,
                   "OpenGL ES: EGL has no display without a window system; install libegl-mesa0 and libgl1-mesa-dri" };
    std::string others;
    for (DisplaySource source : (*egl)->displaySources()) {
        Result<OpenDevice> device = openDevice(**egl, source, options.validation);
        if (!device) {
            refusal = { ErrorCode::DeviceUnavailable, device.error().message };
            continue;
        }
        const std::string name = describeDevice(device->gl, device->quirks).deviceName;
        if (containsIgnoringCase(name, options.requireDevice)) {
            if (filter) filter(device->quirks);
            return std::unique_ptr<Driver>(std::make_unique<GlesDriver>(std::move(*device), options, sink));
        }
        if (others.find(name) == std::string::npos) others += (others.empty() ? "'" : ", '") + name + "'";
    }
    if (others.empty()) return refusal;
    return fail(ErrorCode::DeviceUnavailable, "no OpenGL ES device is called '{}'; there is {}", options.requireDevice,
                others);
}

} // namespace gles

Result<std::unique_ptr<Driver>> createGlesDriver(DriverOptions const& options, ResultSink& sink) {
    return gles::createFilteredDriver(options, sink, nullptr);
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
        // The surfaceless platform and the device enumeration lead to the same devices.
        const bool known = std::any_of(devices.begin(), devices.end(), [&](DeviceInfo const& other) {
            return other.deviceName == info.deviceName && other.driverName == info.driverName;
        });
        if (!known) devices.push_back(std::move(info));
    }
    return devices;
}

} // namespace filament::backend
