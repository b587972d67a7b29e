// SPDX-License-Identifier: Apache-2.0
// What people do to a window, in rounds that end where they began: with the same image, and without more memory.
#include "tests/tools/view/app/WindowStage.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace filament_core::view {
namespace {

constexpr uint32_t kRounds = 4;
constexpr size_t kImagesOnTheirWay = 2; ///< of the window's size: one more or less may wait for it
/// Bytes in two rounds, of history and caches. Rounds differ by 4 MB either way; an engine that stays has 20 MB.
constexpr size_t kHeapGrowth = 5'000'000;

/// What malloc() has given and nobody has freed, in the arenas of all threads (mallinfo2() knows the first one alone).
size_t heapBytes() {
    char* text = nullptr;
    size_t length = 0;
    FILE* const stream = open_memstream(&text, &length);
    malloc_info(0, stream);
    std::fclose(stream);
    const std::string report(text, length);
    std::free(text);
    const auto total = [&](const char* row) { // the last one is that of all arenas
        const size_t at = report.find("size=\"", report.rfind(row));
        return at == std::string::npos ? 0 : std::strtoull(&report[at + 6], nullptr, 10);
    };
    return total("<system type=\"current\"") + total("<total type=\"mmap\"") - total("<total type=\"fast\"") -
           total("<total type=\"rest\"");
}

class WindowStormTest : public WindowStage {
protected:
    void orbit(float2 from, float2 to) {
        mViewer->handle(MouseMoveEvent{ from });
        mViewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
        mViewer->handle(MouseMoveEvent{ to });
        handle(MouseButtonEvent{ MouseButton::Left, false, {} });
        done("orbit");
    }
    void resize(uint2 size) {
        mServer->resize(window(), size);
        settle();
        EXPECT_EQ(mWindow->pixels(), size);
        expectShown(fmt::format("{} x {}", size.x, size.y));
        done("resize");
    }
    void minimiseAndRestore() {
        mServer->hide(window());
        mViewer->handle(ResizeEvent{ uint2(0), 1 });
        EXPECT_FALSE(mViewer->step(0.1));
        mServer->show(window());
        handle(ResizeEvent{ mWindow->pixels(), 1 });
        expectShown("restored");
        done("restore");
    }
    void open(std::filesystem::path const& file) {
        handle(DropEvent{ { file } });
        expectShown(file.filename().string());
        done("open");
    }
    void changeBackend() {
        mViewer->perform(Action::ChangeBackend);
        settle();
        expectShown("another backend");
        done("backend");
    }
    void setOption(QualityPreset preset) {
        mViewer->document().view.quality = qualityPreset(preset);
        mViewer->redraw();
        settle();
        expectShown("another quality");
        done("quality");
    }
    void setEnvironment(std::filesystem::path const& file) {
        mViewer->document().environment.file = file;
        mViewer->redraw();
        settle();
        expectShown("another environment");
        done("environment");
    }
    void done(const char* what) {
        ++mSteps;
        expectNoMessages(what);
    }
    void resizeTo20Sizes() {
        std::mt19937 random(11);
        std::uniform_int_distribution<uint32_t> width(50, 800), height(50, 500);
        for (int i = 0; i < 20; ++i) {
            const uint32_t x = width(random);
            resize({ x, height(random) });
        }
        resize(kFirstSize);
    }
    /// 14 steps, the same in every round.
    void playRound() {
        const Document before = mViewer->document();
        for (float x : { 60.0f, -40.0f }) orbit({ 300, 200 }, { 300 + x, 210 });
        resize({ 700, 300 });
        minimiseAndRestore();
        open(showcaseFiles().model); // 64 materials
        setOption(QualityPreset::Low);
        setEnvironment({});
        changeBackend();
        setOption(QualityPreset::High);
        setEnvironment(before.environment.file);
        open(before.model.file);
        changeBackend();
        resize(kFirstSize);
        mViewer->document() = before;
        mViewer->redraw();
        settle();
        done("the document of the beginning");
        forgetOtherSizes();
    }
    /// What frames keep for the next ones is dropped after some frames without a use.
    void forgetOtherSizes() {
        for (int frame = 0; frame < 100;) {
            mViewer->redraw();
            frame += mViewer->step(0.001);
        }
        settle();
    }

    uint32_t mSteps = 0;
};

// Each round changes to the other API and back.
INSTANTIATE_TEST_SUITE_P(Apis, WindowStormTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(WindowStormTest, SixtyStepsLeaveNothingBehind) {
    if (!isReady()) return;
    mViewer->perform(Action::TogglePanels);                        // they name times
    open(tools::sourceDir() / "samples/materials/clear_coat.mat"); // a sphere, quickly drawn
    const Result<Image> first = mViewer->screenshot();
    ASSERT_TRUE(first.ok());
    resizeTo20Sizes();
    std::vector<size_t> heap, device;
    for (uint32_t round = 0; round < kRounds; ++round) {
        playRound();
        const Result<Image> last = mViewer->screenshot();
        ASSERT_TRUE(last.ok());
        EXPECT_EQ(last->pixels, first->pixels) << "round " << round;
        heap.push_back(heapBytes());
        device.push_back(mViewer->stage().engine().statistics().deviceBytes);
        std::printf("[          ] round %u: heap %.2f MB, device %.2f MB\n", round,
                    1e-6 * static_cast<double>(heap.back()), 1e-6 * static_cast<double>(device.back()));
    }
    EXPECT_GE(mSteps, 60u);
    // Now and then a round ends with 10 to 15 MB more, which the next one does not have: the lesser of two counts.
    EXPECT_LE(std::min(heap[2], heap[3]), std::min(heap[0], heap[1]) + kHeapGrowth);
    EXPECT_LE(std::min(device[2], device[3]),
              std::min(device[0], device[1]) + kImagesOnTheirWay * 4 * kFirstSize.x * kFirstSize.y);
}

} // namespace
} // namespace filament_core::view
