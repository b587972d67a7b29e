// SPDX-License-Identifier: Apache-2.0
#include "tests/windows/VirtualDisplay.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::test {
namespace {

/// Ends with this process, whatever becomes of it.
[[noreturn]] void becomeServer(int numberPipe, uint2 size) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO), dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    const std::string pipe = std::to_string(numberPipe);
    const std::string screen = std::to_string(size.x) + "x" + std::to_string(size.y) + "x24";
    execlp("Xvfb", "Xvfb", "-displayfd", pipe.c_str(), "-screen", "0", screen.c_str(), "-nolisten", "tcp", nullptr);
    _exit(127);
}

/// The line that the server writes once it accepts clients; empty: it ended before.
std::string readLine(int descriptor) {
    std::string line;
    char next = 0;
    while (read(descriptor, &next, 1) == 1 && next != '\n') line += next;
    return line;
}

/// Other events of the window are dropped: those of earlier changes of its size, say.
void waitFor(int type, Display* display, unsigned long window) {
    XEvent event;
    do {
        XWindowEvent(display, window, StructureNotifyMask, &event);
    } while (event.type != type);
}

} // namespace

std::unique_ptr<VirtualDisplay> VirtualDisplay::start(uint2 size) {
    static const bool threads = XInitThreads() != 0;
    EXPECT_TRUE(threads);
    int ends[2] = {};
    if (pipe(ends) != 0) return nullptr;
    std::unique_ptr<VirtualDisplay> made(new VirtualDisplay);
    made->mServer = fork();
    if (made->mServer == 0) becomeServer(ends[1], size);
    close(ends[1]);
    const std::string number = readLine(ends[0]);
    close(ends[0]);
    made->mName = ":" + number;
    if (!number.empty()) made->mDisplay = XOpenDisplay(made->mName.c_str());
    if (made->mDisplay) return made;
    ADD_FAILURE() << "no X server: install xvfb";
    return nullptr;
}

VirtualDisplay::~VirtualDisplay() {
    if (mDisplay) XCloseDisplay(mDisplay);
    if (mServer <= 0) return;
    kill(mServer, SIGTERM);
    waitpid(mServer, nullptr, 0);
}

unsigned long VirtualDisplay::openWindow(uint2 size, int2 place) {
    const unsigned long window = XCreateSimpleWindow(mDisplay, DefaultRootWindow(mDisplay), place.x, place.y, size.x,
                                                     size.y, 0, 0, 0x336699);
    XSelectInput(mDisplay, window, StructureNotifyMask);
    show(window);
    return window;
}

void VirtualDisplay::closeWindow(unsigned long window) {
    XDestroyWindow(mDisplay, window);
    XSync(mDisplay, 0);
}

void VirtualDisplay::resize(unsigned long window, uint2 size) {
    XResizeWindow(mDisplay, window, size.x, size.y);
    XSync(mDisplay, 0);
}

void VirtualDisplay::hide(unsigned long window) {
    XSelectInput(mDisplay, window, StructureNotifyMask); // of a window that another connection opened, too
    XUnmapWindow(mDisplay, window);
    waitFor(UnmapNotify, mDisplay, window);
}

void VirtualDisplay::show(unsigned long window) {
    XSelectInput(mDisplay, window, StructureNotifyMask);
    XMapWindow(mDisplay, window);
    waitFor(MapNotify, mDisplay, window);
}

std::vector<uint8_t> VirtualDisplay::pixels(unsigned long window, uint2 size) const {
    XImage* image = XGetImage(mDisplay, window, 0, 0, size.x, size.y, AllPlanes, ZPixmap);
    if (!image) return {};
    std::vector<uint8_t> bytes;
    bytes.reserve(size_t{ 3 } * size.x * size.y);
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const unsigned long pixel = XGetPixel(image, static_cast<int>(x), static_cast<int>(y));
            for (int shift : { 16, 8, 0 }) bytes.push_back(static_cast<uint8_t>(pixel >> shift));
        }
    }
    XDestroyImage(image);
    return bytes;
}

} // namespace filament_core::test
