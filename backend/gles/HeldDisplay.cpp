// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/HeldDisplay.h"

#include <algorithm>
#include <mutex>

namespace filament_core::backend::gles {
namespace {

struct Holders {
    EGLDisplay display;
    uint32_t count;
    bool isOurs; ///< we initialised it
};

/// Of window systems, those that are held.
struct DisplayTable {
    std::mutex mutex; ///< also held while a display is initialised or terminated
    std::vector<Holders> held;

    auto find(EGLDisplay display) { return std::ranges::find(held, display, &Holders::display); }
};

DisplayTable& displayTable() {
    static DisplayTable& table = *new DisplayTable;
    return table;
}

bool isOfWindowSystem(DisplaySource source) {
    return source.platform == EGL_PLATFORM_X11_EXT || source.platform == EGL_PLATFORM_WAYLAND_EXT;
}

} // namespace

Result<HeldDisplay> HeldDisplay::open(Egl const& egl, DisplaySource source) {
    DisplayTable& table = displayTable();
    const std::scoped_lock lock(table.mutex);
    Result<EGLDisplay> found = egl.findDisplay(source);
    if (!found) return found.error();
    const EGLDisplay display = *found;
    const auto known = table.find(display);
    if (known != table.held.end()) {
        ++known->count;
        return HeldDisplay(egl, display);
    }
    // Asked before we initialise it: an answer means that the app, or another library, has done so.
    const bool isOthers = egl.QueryString(display, EGL_VERSION) != nullptr;
    if (isOfWindowSystem(source)) table.held.push_back({ display, 1, !isOthers });
    if (Result<void> ready = egl.initialize(display); !ready) {
        std::erase_if(table.held, [&](Holders const& each) { return each.display == display; });
        return ready.error();
    }
    return HeldDisplay(egl, display);
}

HeldDisplay::~HeldDisplay() {
    if (mDisplay == EGL_NO_DISPLAY) return;
    DisplayTable& table = displayTable();
    const std::scoped_lock lock(table.mutex);
    const auto known = table.find(mDisplay);
    if (known == table.held.end() || --known->count > 0) return; // the former: without a window system
    if (known->isOurs) mEgl->Terminate(mDisplay);
    table.held.erase(known);
}

} // namespace filament_core::backend::gles
