// SPDX-License-Identifier: Apache-2.0
// Windows of Wayland show the bits that frames have off screen, on both APIs.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/windows/VirtualCompositor.h"
#include "tests/windows/WindowPicture.h"

namespace filament_core {
namespace {

using test::VirtualCompositor;

class WaylandTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, WaylandTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& each) { return std::string(toString(each.param)); });

std::vector<uint8_t> colorsOf(Image const& image) {
    std::vector<uint8_t> colors;
    for (size_t i = 0; i + 3 < image.pixels.size(); i += 4)
        for (size_t c = 0; c < 3; ++c) colors.push_back(static_cast<uint8_t>(image.pixels[i + c]));
    return colors;
}

TEST_P(WaylandTest, WindowsShowTheBitsOfTheImage) {
    const uint2 size(320, 200);
    const auto compositor = VirtualCompositor::start(size);
    if (!compositor) return;
    auto engine = Engine::create({ .backend = GetParam(),
                                   .workers = 1,
                                   .display = NativeDisplay::wayland(compositor->display()),
                                   .validation = true });
    ASSERT_TRUE(engine.ok()) << engine.error().message;
    for (PresentMode mode : { PresentMode::Mailbox, PresentMode::Fifo }) {
        const Owned<SwapChain> chain =
                engine->own(engine->create(SwapChainDesc{ .size = size,
                                                          .window = NativeWindow::wayland(compositor->surface()),
                                                          .presentMode = mode,
                                                          .name = "wayland" }));
        test::WindowPicture picture(*engine);
        for (uint32_t frame = 0; frame < 4; ++frame) picture.draw(chain, size, frame * 7);
        engine->waitIdle();
        compositor->settle();
        const std::optional<Image> shown = compositor->picture();
        ASSERT_TRUE(shown.has_value());
        EXPECT_EQ(uint2(shown->width, shown->height), size);
        EXPECT_EQ(colorsOf(*shown), picture.pixels(chain)) << "mode " << static_cast<int>(mode);
        EXPECT_EQ(engine->statistics().presents % 4, 0u);
    }
    test::expectNoErrors(*engine);
}

// A compositor does not ask for images of hidden windows. Drivers wait for it; the driver thread must not.
TEST_P(WaylandTest, AHiddenWindowDoesNotHoldBackAnother) {
    const uint2 size(160, 100);
    const auto compositor = VirtualCompositor::start(size);
    if (!compositor) return;
    auto engine = Engine::create({ .backend = GetParam(),
                                   .workers = 1,
                                   .display = NativeDisplay::wayland(compositor->display()),
                                   .validation = true });
    ASSERT_TRUE(engine.ok()) << engine.error().message;
    const auto chainOf = [&](wl_surface* surface, const char* name) {
        return engine->own(
                engine->create(SwapChainDesc{ .size = size, .window = NativeWindow::wayland(surface), .name = name }));
    };
    const Owned<SwapChain> shown = chainOf(compositor->surface(), "shown"),
                           hidden = chainOf(compositor->hiddenSurface(), "hidden");
    test::WindowPicture picture(*engine);
    constexpr uint32_t kFrames = 20;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        picture.draw(hidden, size, frame); // without asking canPresent(): waits once, then no more
        picture.draw(shown, size, frame);
    }
    engine->waitIdle();
    EXPECT_FALSE(picture.renderer().canPresent(hidden));
    EXPECT_GE(engine->statistics().presents, uint64_t{ kFrames } + 1);
    EXPECT_LE(engine->statistics().presents, uint64_t{ kFrames } + 3) << "the hidden window took one or two";
    compositor->settle();
    const std::optional<Image> seen = compositor->picture();
    ASSERT_TRUE(seen.has_value());
    EXPECT_EQ(colorsOf(*seen), picture.pixels(shown));
    test::expectNoErrors(*engine);
}

} // namespace
} // namespace filament_core
