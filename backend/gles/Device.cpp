// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Device.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace filament_core::backend::gles {
namespace {

// Errors, undefined behaviour and anything severe. Performance hints are not the caller's bug, and the messages of the
// shader compiler appear in the program's own report.
bool isWorthTelling(GLenum source, GLenum type, GLenum severity) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER || type == GL_DEBUG_TYPE_PERFORMANCE) return false;
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           severity == GL_DEBUG_SEVERITY_HIGH;
}

void GL_APIENTRY onMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message,
                           const void* user) {
    auto const* device = static_cast<Device const*>(user);
    if (device->creating || !isWorthTelling(source, type, severity)) return;
    std::string_view text(message, static_cast<size_t>(length));
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    device->sink.onError(DriverErrorKind::Validation, fmt::format("OpenGL ES: {}", text));
}

bool containsIgnoringCase(std::string_view text, std::string_view part) {
    const auto equal = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return part.empty() || std::search(text.begin(), text.end(), part.begin(), part.end(), equal) != text.end();
}

/// Where to look for a device: at the display of the app's windows, if there is one.
Result<std::vector<DisplaySource>> sourcesOf(Egl const& egl, NativeDisplay const& display) {
    if (display.system == WindowSystem::None) return egl.displaySources();
    Result<DisplaySource> source = egl.displaySource(display);
    if (!source) return source.error();
    return std::vector{ *source };
}

} // namespace

// ---------------------------------------------------------------------------------------------- choice

Result<OpenDevice> openDevice(Egl const& egl, DisplaySource source, bool debug) {
    Result<Context> context = Context::create(egl, source, debug);
    if (!context) return context.error();
    Api gl;
    if (const char* missing = gl.load(egl.GetProcAddress)) {
        return fail(ErrorCode::Unsupported, "OpenGL ES: {} is missing, so this is not ES 3.1", missing);
    }
    Result<Quirks> quirks = Quirks::probe(gl);
    if (!quirks) return quirks.error();
    return OpenDevice{ std::move(*context), gl, *quirks };
}

Result<OpenDevice> chooseDevice(DriverOptions const& options) {
    Result<Egl const*> egl = Egl::load();
    if (!egl) return egl.error();
    Error refusal{ ErrorCode::DeviceUnavailable,
                   "OpenGL ES: EGL has no display without a window system; install libegl-mesa0 and libgl1-mesa-dri" };
    std::string others;
    const Result<std::vector<DisplaySource>> sources = sourcesOf(**egl, options.display);
    if (!sources) return sources.error();
    for (DisplaySource source : *sources) {
        Result<OpenDevice> device = openDevice(**egl, source, options.validation);
        if (!device) {
            refusal = { ErrorCode::DeviceUnavailable, device.error().message };
            continue;
        }
        const std::string name = describeDevice(device->gl, device->quirks).deviceName;
        if (containsIgnoringCase(name, options.requireDevice)) return device;
        if (others.find(name) == std::string::npos) others += (others.empty() ? "'" : ", '") + name + "'";
    }
    if (others.empty()) return refusal;
    return fail(ErrorCode::DeviceUnavailable, "no OpenGL ES device is called '{}'; there is {}", options.requireDevice,
                others);
}

// ---------------------------------------------------------------------------------------------- device

Device::Device(Api const& api, Quirks const& found, ResultSink& results, bool wantsMessages)
        : gl(api), quirks(found), sink(results), messages(wantsMessages && found.debugMessages),
          info(describeDevice(gl, quirks)), state(gl, quirks) {
    if (!messages) return;
    gl.DebugMessageCallback(&onMessage, this);
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // reported on this thread, inside the faulty call
}

Device::~Device() {
    if (messages) gl.DebugMessageCallback(nullptr, nullptr);
}

GLenum Device::takeError() {
    const GLenum first = gl.GetError();
    // Some drivers return GL_CONTEXT_LOST for ever once the context is lost, so the loop is bounded.
    for (int i = 0; i < 8 && first != GL_NO_ERROR && gl.GetError() != GL_NO_ERROR; ++i) {
    }
    return first;
}

void Device::beginCreation() {
    takeError();
    creating = true;
}

bool Device::created(const char* what, std::string_view name) {
    creating = false;
    // Errors of earlier calls are not those of the object that is made now.
    const GLenum found = takeError();
    if (found == GL_NO_ERROR) return true;
    const bool memory = found == GL_OUT_OF_MEMORY;
    error(memory ? DriverErrorKind::OutOfMemory : DriverErrorKind::Other, "{} '{}': {}; what uses it is skipped{}",
          what, name, glErrorName(found), memory ? ", free something or make it smaller" : "");
    return false;
}

void Device::checkLost() {
    if (lost) return;
    const bool reset = quirks.resetStatus && gl.GetGraphicsResetStatus() != GL_NO_ERROR;
    if (!reset && (quirks.resetStatus || gl.GetError() != GL_CONTEXT_LOST)) return;
    lost = true;
    error(DriverErrorKind::DeviceLost, "'{}' was reset; make a new engine", info.deviceName);
}

void Device::label(GLenum type, GLuint object, std::string_view name) {
    if (messages && !name.empty()) gl.ObjectLabel(type, object, static_cast<GLsizei>(name.size()), name.data());
}

} // namespace filament_core::backend::gles
