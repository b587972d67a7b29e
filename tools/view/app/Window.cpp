// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/Window.h"

#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#define GLFW_EXPOSE_NATIVE_X11
#include <GLFW/glfw3native.h>

namespace filament_core::view {
namespace {

Window& ownerOf(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

Modifiers modifiersOf(int bits) {
    return { (bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0,
             (bits & GLFW_MOD_SUPER) != 0 };
}

std::string lastError() {
    const char* text = nullptr;
    return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "no reason given";
}

Error noDisplay() {
    return fail(ErrorCode::DeviceUnavailable,
                "no window: {}; set DISPLAY to an X server (or start one: xvfb-run), or draw without a window: "
                "filament-render",
                lastError());
}

} // namespace

Result<std::unique_ptr<Window>> Window::open(std::string const& title, uint2 size) {
    if (!glfwInit()) return noDisplay();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API); // the engine brings its own
    std::unique_ptr<Window> made(new Window);
    made->mWindow =
            glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
    if (!made->mWindow) return noDisplay();
    made->listen();
    return made;
}

Window::~Window() {
    if (mWindow) glfwDestroyWindow(mWindow);
    glfwTerminate();
}

NativeDisplay Window::display() const { return NativeDisplay::x11(glfwGetX11Display()); }
NativeWindow Window::native() const { return NativeWindow::x11(glfwGetX11Window(mWindow)); }

uint2 Window::pixels() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(mWindow, &width, &height);
    if (glfwGetWindowAttrib(mWindow, GLFW_ICONIFIED)) return uint2(0);
    return { static_cast<uint32_t>(width), static_cast<uint32_t>(height) };
}

float Window::scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(mWindow, &x, &y);
    return std::max(x, y);
}

Clipboard Window::clipboard() const {
    return { .set = [window = mWindow](std::string const& text) { glfwSetClipboardString(window, text.c_str()); },
             .get =
                     [window = mWindow] {
                         const char* text = glfwGetClipboardString(window);
                         return std::string(text ? text : "");
                     } };
}

float2 Window::pixelsOfUnits() const {
    int width = 1, height = 1;
    glfwGetWindowSize(mWindow, &width, &height);
    const uint2 size = pixels();
    return { static_cast<float>(size.x) / static_cast<float>(std::max(width, 1)),
             static_cast<float>(size.y) / static_cast<float>(std::max(height, 1)) };
}

void Window::listen() {
    glfwSetWindowUserPointer(mWindow, this);
    glfwSetKeyCallback(mWindow, [](GLFWwindow* window, int key, int, int action, int bits) {
        ownerOf(window).push(KeyEvent{ key, action != GLFW_RELEASE, modifiersOf(bits) });
    });
    glfwSetCharCallback(mWindow,
                        [](GLFWwindow* window, unsigned character) { ownerOf(window).push(TextEvent{ character }); });
    glfwSetCursorPosCallback(mWindow, [](GLFWwindow* window, double x, double y) {
        Window& owner = ownerOf(window);
        owner.push(MouseMoveEvent{ float2(x, y) * owner.pixelsOfUnits() });
    });
    glfwSetMouseButtonCallback(mWindow, [](GLFWwindow* window, int button, int action, int bits) {
        if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        const MouseButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::Left
                                  : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::Right
                                                                      : MouseButton::Middle;
        ownerOf(window).push(MouseButtonEvent{ which, action != GLFW_RELEASE, modifiersOf(bits) });
    });
    glfwSetScrollCallback(mWindow, [](GLFWwindow* window, double x, double y) {
        ownerOf(window).push(ScrollEvent{ float2(x, y), {} });
    });
    glfwSetDropCallback(mWindow, [](GLFWwindow* window, int count, const char** paths) {
        ownerOf(window).push(DropEvent{ { paths, paths + count } });
    });
    glfwSetFramebufferSizeCallback(mWindow, [](GLFWwindow* window, int, int) {
        Window& owner = ownerOf(window);
        owner.push(ResizeEvent{ owner.pixels(), owner.scale() });
    });
    glfwSetWindowRefreshCallback(mWindow, [](GLFWwindow* window) { // what was hidden has lost its image
        Window& owner = ownerOf(window);
        owner.push(ResizeEvent{ owner.pixels(), owner.scale() });
    });
    glfwSetWindowIconifyCallback(mWindow, [](GLFWwindow* window, int) {
        Window& owner = ownerOf(window);
        owner.push(ResizeEvent{ owner.pixels(), owner.scale() });
    });
    glfwSetWindowFocusCallback(mWindow, [](GLFWwindow* window, int hasFocus) {
        ownerOf(window).push(FocusEvent{ hasFocus == GLFW_TRUE });
    });
    glfwSetWindowCloseCallback(mWindow, [](GLFWwindow* window) { ownerOf(window).push(CloseEvent{}); });
}

std::vector<InputEvent> Window::takeEvents(double waitSeconds) {
    if (waitSeconds > 0)
        glfwWaitEventsTimeout(waitSeconds);
    else
        glfwPollEvents();
    return std::exchange(mEvents, {});
}

void Window::setFullScreen(bool isFullScreen) {
    auto& [x, y, width, height] = mBefore;
    if (!isFullScreen) return glfwSetWindowMonitor(mWindow, nullptr, x, y, std::max(width, 1), std::max(height, 1), 0);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(mWindow, &x, &y);
    glfwGetWindowSize(mWindow, &width, &height);
    glfwSetWindowMonitor(mWindow, monitor, 0, 0, mode->width, mode->height, GLFW_DONT_CARE);
}

} // namespace filament_core::view
