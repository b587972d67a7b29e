// SPDX-License-Identifier: Apache-2.0
// Windows of X11 show the bits that frames have off screen, on both APIs, whatever becomes of them meanwhile.
#include "tests/filament_core/engine/MisuseLine.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/windows/VirtualDisplay.h"
#include "tests/windows/WindowPicture.h"

#include <gmock/gmock.h>

#include <chrono>
#include <random>
#include <thread>

namespace filament_core {
namespace {

using test::VirtualDisplay;
using test::WindowPicture;

std::string nameOf(testing::TestParamInfo<Backend> const& info) { return toString(info.param); }

class PresentTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mServer = VirtualDisplay::start();
        if (!mServer) return;
        auto made = Engine::create(options());
        if (!made) FAIL() << made.error().message;
        mEngine.emplace(std::move(*made));
    }
    void TearDown() override {
        if (mEngine) test::expectNoErrors(*mEngine);
        mEngine.reset();
    }
    EngineOptions options() const {
        return {
            .backend = GetParam(), .workers = 1, .display = NativeDisplay::x11(mServer->display()), .validation = true
        };
    }
    Owned<SwapChain> chainOf(unsigned long window, uint2 size, PresentMode mode = PresentMode::Fifo) {
        return mEngine->own(mEngine->create(SwapChainDesc{
                .size = size, .window = NativeWindow::x11(window), .presentMode = mode, .name = "window" }));
    }
    bool isReady() const { return mServer && mEngine; }

    std::unique_ptr<VirtualDisplay> mServer;
    std::optional<Engine> mEngine;
};

/// A minute ends a hang.
bool soonCanPresent(Renderer const& renderer, SwapChain chain) {
    for (int i = 0; i < 60'000 && !renderer.canPresent(chain); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return renderer.canPresent(chain);
}

INSTANTIATE_TEST_SUITE_P(Apis, PresentTest, testing::ValuesIn(test::kBothApis), nameOf);

TEST_P(PresentTest, WindowsShowTheBitsOfTheImage) {
    if (!isReady()) return;
    for (PresentMode mode : { PresentMode::Fifo, PresentMode::Mailbox, PresentMode::Immediate }) {
        const uint2 size(317, 203);
        const unsigned long window = mServer->openWindow(size);
        const Owned<SwapChain> chain = chainOf(window, size, mode);
        WindowPicture picture(*mEngine);
        for (uint32_t frame = 0; frame < 5; ++frame) {
            picture.draw(chain, size, frame);
            mEngine->waitIdle();
            const std::vector<uint8_t> drawn = picture.pixels(chain);
            ASSERT_EQ(drawn.size(), size_t{ 3 } * size.x * size.y);
            EXPECT_EQ(mServer->pixels(window, size), drawn) << "mode " << static_cast<int>(mode) << " frame " << frame;
        }
    }
}

TEST_P(PresentTest, ImagesFollowTheSizeOfTheWindow) {
    if (!isReady()) return;
    const unsigned long window = mServer->openWindow({ 200, 100 });
    const Owned<SwapChain> chain = chainOf(window, { 200, 100 });
    WindowPicture picture(*mEngine);
    std::mt19937 random(7);
    std::uniform_int_distribution<uint32_t> side(1, 900);
    for (uint32_t i = 0; i < 20; ++i) {
        const uint2 size = i == 0 ? uint2(1, 1) : uint2(side(random), side(random));
        mServer->resize(window, size);
        mEngine->resize(chain, size);
        picture.draw(chain, size, i); // the device may find out here that the window has changed
        picture.draw(chain, size, i);
        mEngine->waitIdle();
        EXPECT_EQ(mServer->pixels(window, size), picture.pixels(chain)) << size.x << " x " << size.y;
    }
}

TEST_P(PresentTest, ImagesOfAnotherSizeLieInTheUpperLeftCornerOnBlack) {
    if (!isReady()) return;
    const uint2 windowSize(150, 120);
    const unsigned long window = mServer->openWindow(windowSize);
    for (uint2 size : { uint2(100, 80), uint2(100, 200), uint2(300, 80), uint2(300, 200) }) {
        const Owned<SwapChain> chain = chainOf(window, size);
        WindowPicture picture(*mEngine);
        picture.draw(chain, size, 7);
        mEngine->waitIdle();
        const std::vector<uint8_t> drawn = picture.pixels(chain);
        std::vector<uint8_t> expected(size_t{ 3 } * windowSize.x * windowSize.y, 0);
        const uint2 common = min(size, windowSize);
        for (uint32_t y = 0; y < common.y; ++y) {
            std::copy_n(drawn.begin() + size_t{ 3 } * y * size.x, 3 * common.x,
                        expected.begin() + size_t{ 3 } * y * windowSize.x);
        }
        EXPECT_EQ(mServer->pixels(window, windowSize), expected) << size.x << " x " << size.y;
    }
}

TEST_P(PresentTest, TwoWindowsOfAnEngineShowTheirOwnImages) {
    if (!isReady()) return;
    const uint2 sizes[] = { { 160, 90 }, { 90, 160 } };
    const unsigned long windows[] = { mServer->openWindow(sizes[0]), mServer->openWindow(sizes[1], { 300, 0 }) };
    const Owned<SwapChain> chains[] = { chainOf(windows[0], sizes[0]), chainOf(windows[1], sizes[1]) };
    WindowPicture picture(*mEngine);
    for (uint32_t frame = 0; frame < 12; ++frame)
        for (int i : { 0, 1 }) picture.draw(chains[i], sizes[i], frame * 2 + static_cast<uint32_t>(i));
    mEngine->waitIdle();
    for (int i : { 0, 1 }) EXPECT_EQ(mServer->pixels(windows[i], sizes[i]), picture.pixels(chains[i])) << i;
}

Format leastFormat(OutputSpace space) {
    return space == OutputSpace::LinearRec709 ? Format::RGBA16F
           : space == OutputSpace::Rec2020Pq  ? Format::RGB10A2
                                              : Format::RGBA8;
}

// Xvfb has sRGB alone. A colour space that the window lacks is one line with the cure, and the window can be used.
TEST_P(PresentTest, ColorSpacesOfAWindowAreAnsweredAndOthersRefused) {
    if (!isReady()) return;
    const uint2 size(64, 48);
    const unsigned long window = mServer->openWindow(size);
    const Result<std::vector<OutputSpace>> spaces = mEngine->outputSpaces(NativeWindow::x11(window));
    ASSERT_TRUE(spaces.ok()) << spaces.error().message;
    EXPECT_THAT(*spaces, testing::Contains(OutputSpace::Srgb));
    WindowPicture picture(*mEngine);
    for (const OutputSpace space : { OutputSpace::LinearRec709, OutputSpace::DisplayP3, OutputSpace::Rec2020Pq }) {
        if (std::ranges::find(*spaces, space) != spaces->end()) continue;
        const Owned<SwapChain> chain = mEngine->own(mEngine->create(SwapChainDesc{ .size = size,
                                                                                   .format = leastFormat(space),
                                                                                   .window = NativeWindow::x11(window),
                                                                                   .outputSpace = space,
                                                                                   .name = "wide" }));
        for (uint32_t frame = 0; frame < 3; ++frame) picture.draw(chain, size, frame);
        mEngine->waitIdle();
        const std::vector<std::string> errors = mEngine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << toString(space);
        EXPECT_THAT(errors[0], testing::HasSubstr("window 'wide' shows no"));
        EXPECT_THAT(errors[0], testing::HasSubstr(toString(space)));
        EXPECT_THAT(errors[0], testing::HasSubstr("it has srgb: set SwapChainDesc::outputSpace to one of those"));
    }
    const Owned<SwapChain> chain = chainOf(window, size);
    picture.draw(chain, size, 3);
    mEngine->waitIdle();
    EXPECT_EQ(mServer->pixels(window, size), picture.pixels(chain));
}

TEST_P(PresentTest, ThreeHundredFramesCostNoMemoryAndNoMessage) {
    if (!isReady()) return;
    const uint2 size(128, 128);
    const unsigned long window = mServer->openWindow(size);
    const Owned<SwapChain> chain = chainOf(window, size, PresentMode::Immediate);
    WindowPicture picture(*mEngine);
    for (uint32_t frame = 0; frame < 20; ++frame) picture.draw(chain, size, frame);
    mEngine->waitIdle();
    const EngineStatistics before = mEngine->statistics();
    for (uint32_t frame = 0; frame < 300; ++frame) picture.draw(chain, size, frame);
    mEngine->waitIdle();
    const EngineStatistics after = mEngine->statistics();
    EXPECT_EQ(after.presents - before.presents, 300u);
    EXPECT_GT(after.lastPresentSeconds, before.lastPresentSeconds);
    EXPECT_EQ(after.deviceBytes, before.deviceBytes);
}

TEST_P(PresentTest, TheAppIsAtMostTwoImagesAhead) {
    if (!isReady()) return;
    const uint2 size(640, 480);
    const unsigned long window = mServer->openWindow(size);
    const Owned<SwapChain> chain = chainOf(window, size);
    WindowPicture picture(*mEngine);
    EXPECT_TRUE(picture.renderer().canPresent(chain));
    for (uint64_t frame = 1; frame <= 40; ++frame) {
        picture.draw(chain, size, static_cast<uint32_t>(frame));
        EXPECT_LE(frame, mEngine->statistics().presents + 2);
    }
    mEngine->waitIdle();
    EXPECT_TRUE(soonCanPresent(picture.renderer(), chain)) << "with the next refresh";
}

// One waits for its display, the other does not: each image of both is shown, and neither is presented in vain.
TEST_P(PresentTest, AWindowThatWaitsForItsDisplayDoesNotHoldBackAnother) {
    if (!isReady()) return;
    const uint2 size(64, 48);
    const unsigned long windows[] = { mServer->openWindow(size), mServer->openWindow(size, { 200, 0 }) };
    const Owned<SwapChain> waiting = chainOf(windows[0], size, PresentMode::Fifo),
                           free = chainOf(windows[1], size, PresentMode::Immediate);
    WindowPicture picture(*mEngine);
    uint64_t shown = 0;
    for (uint32_t frame = 0; frame < 200; ++frame) {
        picture.draw(free, size, frame);
        if (!picture.renderer().canPresent(waiting)) continue;
        picture.draw(waiting, size, frame);
        ++shown;
    }
    mEngine->waitIdle();
    EXPECT_GT(shown, 0u);
    EXPECT_EQ(mEngine->statistics().presents, 200 + shown);
    EXPECT_TRUE(soonCanPresent(picture.renderer(), waiting));
    picture.draw(waiting, size, 300);
    mEngine->waitIdle();
    EXPECT_EQ(mServer->pixels(windows[0], size), picture.pixels(waiting));
}

TEST_P(PresentTest, WindowsThatShowNothingDoNotStopTheApp) {
    if (!isReady()) return;
    const uint2 size(200, 150);
    const unsigned long window = mServer->openWindow(size);
    const Owned<SwapChain> chain = chainOf(window, size);
    WindowPicture picture(*mEngine);
    picture.draw(chain, size, 1);
    mServer->hide(window);
    const auto begin = std::chrono::steady_clock::now();
    for (uint32_t frame = 0; frame < 10; ++frame) picture.draw(chain, size, frame);
    mEngine->waitIdle();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    mServer->show(window);
    for (uint32_t frame = 0; frame < 4; ++frame) picture.draw(chain, size, 21);
    mEngine->waitIdle();
    EXPECT_EQ(mServer->pixels(window, size), picture.pixels(chain));
}

TEST_P(PresentTest, AWindowMayBeShownAgainByAnotherSwapChain) {
    if (!isReady()) return;
    const uint2 size(80, 60);
    const unsigned long window = mServer->openWindow(size);
    for (uint32_t i = 0; i < 5; ++i) {
        const Owned<SwapChain> chain = chainOf(window, size);
        WindowPicture picture(*mEngine);
        picture.draw(chain, size, i);
        mEngine->waitIdle();
        EXPECT_EQ(mServer->pixels(window, size), picture.pixels(chain));
    }
    mServer->closeWindow(window); // nothing refers to it any more
    mEngine->waitIdle();
}

TEST_P(PresentTest, AWindowThatIsClosedTooEarlyIsAtMostALineEach) {
    if (!isReady()) return;
    const uint2 size(80, 60);
    const unsigned long window = mServer->openWindow(size);
    const Owned<SwapChain> chain = chainOf(window, size);
    WindowPicture picture(*mEngine);
    picture.draw(chain, size, 1);
    mEngine->waitIdle();
    mServer->closeWindow(window);
    for (uint32_t frame = 0; frame < 8; ++frame) picture.draw(chain, size, frame);
    EXPECT_EQ(picture.pixels(chain).size(), size_t{ 3 } * size.x * size.y) << "drawing goes on";
    EXPECT_LE(mEngine->takeErrors().size(), 1u);
}

TEST_P(PresentTest, PixelsOfAResizedSwapChainStillArrive) {
    if (!isReady()) return;
    const uint2 size(64, 48);
    const Owned<SwapChain> chain = mEngine->own(mEngine->create(SwapChainDesc{ .size = size }));
    WindowPicture picture(*mEngine);
    picture.draw(chain, size, 3); // headless: present() does nothing
    const PixelTicket ticket = picture.renderer().readPixels(chain);
    mEngine->resize(chain, { 10, 20 });
    const auto image = picture.renderer().waitPixels(ticket);
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(uint2(image->width, image->height), size);
    picture.draw(chain, { 10, 20 }, 4);
    EXPECT_EQ(picture.pixels(chain).size(), 3u * 10 * 20);
    EXPECT_EQ(mEngine->statistics().presents, 0u);
}

TEST_P(PresentTest, BothApisShowTheSameBits) {
    if (!isReady() || GetParam() == Backend::Gles) return; // one run compares both
    const uint2 size(333, 111);
    std::vector<uint8_t> shown[2];
    for (size_t i = 0; i < 2; ++i) {
        EngineOptions choice = options();
        choice.backend = test::kBothApis[i];
        auto engine = Engine::create(choice);
        ASSERT_TRUE(engine.ok()) << engine.error().message;
        const unsigned long window = mServer->openWindow(size);
        {
            const Owned<SwapChain> chain = engine->own(
                    engine->create(SwapChainDesc{ .size = size, .window = NativeWindow::x11(window), .name = "both" }));
            WindowPicture picture(*engine);
            picture.draw(chain, size, 12);
            engine->waitIdle();
            shown[i] = mServer->pixels(window, size);
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_FALSE(shown[0].empty());
    EXPECT_EQ(shown[0], shown[1]);
}

// ---------------------------------------------------------------------------------------------- misuse

TEST_P(PresentTest, WindowsNeedAnEngineWithTheirDisplay) {
    if (!isReady()) return;
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const unsigned long window = mServer->openWindow({ 10, 10 });
    auto headless = Engine::create({ .backend = Backend::Null });
    ASSERT_TRUE(headless.ok());
    EXPECT_DEATH(
            headless->create(SwapChainDesc{ .window = NativeWindow::x11(window), .name = "main" }),
            "Engine::create\\(SwapChainDesc\\) of 'main': a window of X11 needs an engine whose EngineOptions::display "
            "is of X11, not of no window system");
    EXPECT_DEATH(mEngine->create(SwapChainDesc{
                         .format = Format::RGBA16F, .window = NativeWindow::x11(window), .name = "main" }),
                 "a window shows RGBA8 or RGB10A2");
    EXPECT_DEATH(mEngine->resize(SwapChain{}, { 1, 1 }), "Engine::resize\\(SwapChain, uint2\\)");
    const Owned<SwapChain> chain = chainOf(window, { 10, 10 });
    EXPECT_DEATH(mEngine->resize(chain, { 0, 1 }), "a swap chain has at least one pixel");
    Renderer renderer(*mEngine);
    EXPECT_DEATH(renderer.present(SwapChain{}), "Renderer::present\\(SwapChain\\)");
    EXPECT_DEATH((void)renderer.canPresent(SwapChain{}), "Renderer::canPresent\\(SwapChain\\)");
}

} // namespace
} // namespace filament_core
