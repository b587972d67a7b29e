// SPDX-License-Identifier: Apache-2.0
// Pictures that are dropped on the window take the place of the texture that is chosen, can be undone, and both APIs
// show them.
#include "tests/tools/view/app/HeadlessViewer.h"

#include <gmock/gmock.h>

namespace filament_core::view {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::filesystem::path writeStripes() {
    Image image{ .width = 16, .height = 16 };
    for (uint32_t i = 0; i < 256; ++i)
        for (const uint32_t code : { 255u * (i / 2 % 2), 255u * (i / 32 % 2), 40u, 255u })
            image.pixels.push_back(static_cast<std::byte>(code));
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "viewer-stripes.png";
    EXPECT_TRUE(savePng(file, image).ok());
    return file;
}

TEST(ViewerTextures, ThatAreDroppedAreShownByBothApisAndUndone) {
    const std::filesystem::path file = writeStripes();
    std::vector<Image> images;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Headless headless(backend);
        if (!headless.viewer) return;
        headless.viewer->panels().state.showsPanels = false;
        const Image before = headless.picture();
        headless.viewer->handle(DropEvent{ { file } });
        headless.settle();
        EXPECT_THAT(headless.viewer->takeMessages(), ElementsAre(HasSubstr("choose a texture")));
        EXPECT_TRUE(headless.viewer->document().textures.empty());
        headless.viewer->panels().state.textureTarget = TextureTarget{ "brick", "baseColorMap" };
        headless.viewer->handle(DropEvent{ { file } });
        images.push_back(headless.picture());
        ASSERT_EQ(headless.viewer->document().textures.size(), 1u);
        EXPECT_FALSE(headless.viewer->document().textures.front().isData) << "by the parameter's name";
        EXPECT_NE(images.back().pixels, before.pixels);
        const Result<Document> saved = documentFromJson(toJson(headless.viewer->document()), "saved");
        ASSERT_TRUE(saved.ok());
        EXPECT_EQ(saved->textures, headless.viewer->document().textures);
        headless.press('Z', { .control = true });
        EXPECT_TRUE(headless.viewer->document().textures.empty());
        EXPECT_EQ(headless.picture().pixels, before.pixels);
        EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

} // namespace
} // namespace filament_core::view
