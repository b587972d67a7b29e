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

} // namespace
} // namespace filament_core
