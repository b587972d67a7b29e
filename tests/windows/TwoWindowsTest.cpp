// SPDX-License-Identifier: Apache-2.0
// The sample of two windows: it draws the stored images, and each of its windows continues without the other. The
// images are stored by running it there, with xvfb-run:
//   two_windows gles 8 docs/images/samples/two_windows
#include "tests/windows/VirtualDisplay.h"
#include "toolkit/paths/Paths.h"

#include <X11/Xlib.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <thread>

namespace filament_core {
namespace {

using test::VirtualDisplay;

std::string program(const char* name) { return (tools::buildDir() / "bin" / name).string(); }

/// The sample on a display, until the end of this object; what it prints, line by line.
class Sample {
public:
    Sample(VirtualDisplay const& display, std::vector<std::string> arguments) {
        int ends[2] = {};
        if (pipe(ends) != 0) return;
        mProcess = fork();
        if (mProcess == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM);
            setenv("DISPLAY", display.name().c_str(), 1);
            dup2(ends[1], STDOUT_FILENO), dup2(ends[1], STDERR_FILENO);
            arguments.insert(arguments.begin(), program("two_windows"));
            std::vector<char*> words;
            for (std::string& argument : arguments) words.push_back(argument.data());
            words.push_back(nullptr);
            execv(words[0], words.data());
            _exit(127);
        }
        close(ends[1]);
        mPrinted = fdopen(ends[0], "r");
    }
    ~Sample() {
        if (mPrinted) fclose(mPrinted);
        if (mProcess > 0) kill(mProcess, SIGKILL), waitpid(mProcess, nullptr, 0);
    }
    Sample(Sample const&) = delete;
    Sample& operator=(Sample const&) = delete;

    /// Empty: it has ended.
    std::string line() {
        std::string read;
        for (int next = fgetc(mPrinted); next != EOF && next != '\n'; next = fgetc(mPrinted))
            read += static_cast<char>(next);
        return read;
    }
    int status() {
        int ended = -1;
        waitpid(std::exchange(mProcess, -1), &ended, 0);
        return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    }

private:
    pid_t mProcess = -1;
    FILE* mPrinted = nullptr;
};

/// Of the windows that are there; 0: none has this name.
unsigned long windowOf(Display* display, std::string_view name) {
    Window root = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    unsigned long found = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i) {
        char* title = nullptr;
        if (XFetchName(display, children[i], &title) == 0 || !title) continue;
        if (name == title) found = children[i];
        XFree(title);
    }
    XFree(children);
    return found;
}

/// As a window manager does when the user closes it.
void askToClose(Display* display, unsigned long window) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
    XSendEvent(display, window, False, NoEventMask, &event);
    XSync(display, False);
}

/// A minute ends a hang.
bool soon(std::function<bool()> const& isTrue) {
    for (int i = 0; i < 6000; ++i) {
        if (isTrue()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

class TwoWindowsTest : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override { mServer = VirtualDisplay::start(); }

    /// A frame that is not the one before.
    bool moves(unsigned long window, uint2 size) const {
        const std::vector<uint8_t> before = mServer->pixels(window, size);
        return soon([&] { return mServer->pixels(window, size) != before; });
    }
    /// All of it is drawn to: the corners show the background.
    bool fills(unsigned long window, uint2 size, uint3 background) const {
        return soon([&] {
            const std::vector<uint8_t> pixels = mServer->pixels(window, size);
            const auto at = [&](size_t pixel) {
                return uint3(pixels[3 * pixel], pixels[3 * pixel + 1], pixels[3 * pixel + 2]);
            };
            return pixels.size() == size_t{ 3 } * size.x * size.y && at(0) == background &&
                   at(size_t{ size.x } * size.y - 1) == background;
        });
    }

    std::unique_ptr<VirtualDisplay> mServer;
};

INSTANTIATE_TEST_SUITE_P(Apis, TwoWindowsTest, testing::Values("vulkan", "gles"),
                         [](auto const& test) { return std::string(test.param); });

TEST_P(TwoWindowsTest, EachShowsTheStoredImage) {
    if (!mServer) return;
    const std::filesystem::path folder =
            std::filesystem::temp_directory_path() / fmt::format("two-windows-{}", getpid());
    std::filesystem::create_directories(folder);
    Sample sample(*mServer, { GetParam(), "8", (folder / "two_windows").string() });
    std::vector<std::string> lines;
    for (std::string line = sample.line(); !line.empty(); line = sample.line()) lines.push_back(line);
    EXPECT_THAT(lines,
                testing::UnorderedElementsAre("scene: 320 x 200", "plan: 200 x 200", "scene: closed", "plan: closed"));
    EXPECT_EQ(sample.status(), 0);
    for (const std::string name : { "two_windows_scene.png", "two_windows_plan.png" }) {
        const std::string stored = (tools::sourceDir() / "docs/images/samples" / name).string();
        const std::string command = fmt::format("'{}' '{}' '{}'", program("imgdiff"), stored, (folder / name).string());
        EXPECT_EQ(std::system(command.c_str()), 0) << name;
    }
    std::filesystem::remove_all(folder);
}

TEST_P(TwoWindowsTest, OneIsResizedAndClosedAndTheOtherContinues) {
    if (!mServer) return;
    Sample sample(*mServer, { GetParam() });
    ASSERT_EQ(sample.line(), "scene: 320 x 200");
    ASSERT_EQ(sample.line(), "plan: 200 x 200");
    const unsigned long scene = windowOf(mServer->display(), "scene"), plan = windowOf(mServer->display(), "plan");
    ASSERT_NE(scene, 0u);
    ASSERT_NE(plan, 0u);
    ASSERT_TRUE(moves(scene, { 320, 200 }) && moves(plan, { 200, 200 }));
    const std::vector<uint8_t> corner = mServer->pixels(scene, { 1, 1 });
    mServer->resize(scene, { 400, 260 });
    ASSERT_EQ(sample.line(), "scene: 400 x 260");
    EXPECT_TRUE(fills(scene, { 400, 260 }, uint3(corner[0], corner[1], corner[2])));
    EXPECT_TRUE(moves(scene, { 400, 260 }) && moves(plan, { 200, 200 }));
    askToClose(mServer->display(), scene);
    ASSERT_EQ(sample.line(), "scene: closed");
    EXPECT_EQ(windowOf(mServer->display(), "scene"), 0u);
    EXPECT_TRUE(moves(plan, { 200, 200 }));
    mServer->resize(plan, { 150, 240 });
    ASSERT_EQ(sample.line(), "plan: 150 x 240");
    EXPECT_TRUE(moves(plan, { 150, 240 }));
    askToClose(mServer->display(), plan);
    EXPECT_EQ(sample.line(), "plan: closed");
    EXPECT_EQ(sample.line(), "") << "neither an error nor anything else";
    EXPECT_EQ(sample.status(), 0);
}

} // namespace
} // namespace filament_core
