// SPDX-License-Identifier: Apache-2.0
#include "tests/windows/VirtualCompositor.h"

#include <wayland-client.h>
#include <xdg-shell-client-protocol.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>
#include <vector>

namespace filament_core::test {

struct VirtualCompositor::Window {
    wl_registry* registry = nullptr;
    wl_compositor* compositor = nullptr;
    xdg_wm_base* shell = nullptr;
    wl_surface* surface = nullptr;
    wl_surface* hidden = nullptr;
    xdg_surface* role = nullptr;
    xdg_toplevel* toplevel = nullptr;
    bool isConfigured = false; ///< it may have images from then on

    ~Window() {
        if (toplevel) xdg_toplevel_destroy(toplevel);
        if (role) xdg_surface_destroy(role);
        if (surface) wl_surface_destroy(surface);
        if (hidden) wl_surface_destroy(hidden);
        if (shell) xdg_wm_base_destroy(shell);
        if (compositor) wl_compositor_destroy(compositor);
        if (registry) wl_registry_destroy(registry);
    }
};

namespace {

using Window = VirtualCompositor::Window;
constexpr const char* kSocket = "screen";

void becomeSilent() {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO), dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void becomeServer(std::filesystem::path const& folder, uint2 size) {
    becomeSilent();
    setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
    const std::string width = "--width=" + std::to_string(size.x), height = "--height=" + std::to_string(size.y);
    const std::string config = "--config=" + (folder / "weston.ini").string();
    execlp("weston", "weston", "--backend=headless-backend.so", "--use-pixman", "--debug", "--socket=screen",
           config.c_str(), width.c_str(), height.c_str(), nullptr);
    _exit(127);
}

void onGlobal(void* data, wl_registry* registry, uint32_t name, const char* interface, uint32_t) {
    auto& window = *static_cast<Window*>(data);
    if (!std::strcmp(interface, wl_compositor_interface.name)) {
        window.compositor = static_cast<wl_compositor*>(wl_registry_bind(registry, name, &wl_compositor_interface, 1));
    }
    if (!std::strcmp(interface, xdg_wm_base_interface.name))
        window.shell = static_cast<xdg_wm_base*>(wl_registry_bind(registry, name, &xdg_wm_base_interface, 1));
}
void onGlobalGone(void*, wl_registry*, uint32_t) {}
constexpr wl_registry_listener kRegistryListener{ onGlobal, onGlobalGone };

void onPing(void*, xdg_wm_base* shell, uint32_t serial) { xdg_wm_base_pong(shell, serial); }
constexpr xdg_wm_base_listener kShellListener{ onPing };

void onConfigure(void* data, xdg_surface* role, uint32_t serial) {
    xdg_surface_ack_configure(role, serial);
    static_cast<Window*>(data)->isConfigured = true;
}
constexpr xdg_surface_listener kRoleListener{ onConfigure };

bool openWindow(wl_display* display, Window& window) {
    window.registry = wl_display_get_registry(display);
    wl_registry_add_listener(window.registry, &kRegistryListener, &window);
    wl_display_roundtrip(display);
    if (!window.compositor || !window.shell) return false;
    xdg_wm_base_add_listener(window.shell, &kShellListener, nullptr);
    window.surface = wl_compositor_create_surface(window.compositor);
    window.role = xdg_wm_base_get_xdg_surface(window.shell, window.surface);
    xdg_surface_add_listener(window.role, &kRoleListener, &window);
    window.toplevel = xdg_surface_get_toplevel(window.role);
    xdg_toplevel_set_fullscreen(window.toplevel, nullptr);
    wl_surface_commit(window.surface);
    while (!window.isConfigured)
        if (wl_display_dispatch(display) < 0) return false;
    return true;
}

} // namespace

bool VirtualCompositor::startServer(uint2 size) {
    std::string pattern = (std::filesystem::temp_directory_path() / "filament-wayland-XXXXXX").string();
    if (!mkdtemp(pattern.data())) return false; // puts other letters into the place of each X
    mFolder = pattern;
    std::ofstream(mFolder / "weston.ini") << "[shell]\nstartup-animation=none\nlocking=false\npanel-position=none\n";
    mServer = fork();
    if (mServer == 0) becomeServer(mFolder, size);
    return true;
}

/// Tries until the compositor listens, or has ended.
bool VirtualCompositor::connect() {
    const std::string socket = mFolder / kSocket; // an absolute path needs no XDG_RUNTIME_DIR
    for (int i = 0; i < 600 && !mDisplay && waitpid(mServer, nullptr, WNOHANG) == 0; ++i) {
        mDisplay = wl_display_connect(socket.c_str());
        if (!mDisplay) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    if (!mDisplay) return false;
    mWindow = std::make_unique<Window>();
    return openWindow(mDisplay, *mWindow);
}

std::unique_ptr<VirtualCompositor> VirtualCompositor::start(uint2 size) {
    std::unique_ptr<VirtualCompositor> made(new VirtualCompositor);
    if (made->startServer(size) && made->connect()) return made;
    ADD_FAILURE() << "no Wayland compositor: install weston";
    return nullptr;
}

VirtualCompositor::~VirtualCompositor() {
    mWindow.reset();
    if (mDisplay) wl_display_disconnect(mDisplay);
    if (mServer > 0) {
        kill(mServer, SIGTERM);
        waitpid(mServer, nullptr, 0);
    }
    std::error_code ignored;
    if (!mFolder.empty()) std::filesystem::remove_all(mFolder, ignored);
}

wl_surface* VirtualCompositor::surface() const { return mWindow->surface; }

wl_surface* VirtualCompositor::hiddenSurface() {
    if (!mWindow->hidden) mWindow->hidden = wl_compositor_create_surface(mWindow->compositor);
    return mWindow->hidden;
}

void VirtualCompositor::settle() {
    for (int i = 0; i < 3; ++i) wl_display_roundtrip(mDisplay);
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // the next repaint of the output: 60 a second
}

std::optional<Image> VirtualCompositor::picture() const {
    const pid_t tool = fork();
    if (tool == 0) {
        becomeSilent();
        setenv("XDG_RUNTIME_DIR", mFolder.c_str(), 1);
        setenv("WAYLAND_DISPLAY", kSocket, 1);
        unsetenv("XDG_PICTURES_DIR");
        if (chdir(mFolder.c_str()) == 0) execlp("weston-screenshooter", "weston-screenshooter", nullptr);
        _exit(127);
    }
    waitpid(tool, nullptr, 0);
    for (auto const& file : std::filesystem::directory_iterator(mFolder)) {
        if (file.path().extension() != ".png") continue;
        auto image = loadImage(file.path(), { .content = ImageContent::Data });
        std::filesystem::remove(file.path());
        if (image) return std::move(*image);
        ADD_FAILURE() << image.error().message;
        return std::nullopt;
    }
    ADD_FAILURE() << "weston-screenshooter wrote no picture";
    return std::nullopt;
}

} // namespace filament_core::test
