// SPDX-License-Identifier: Apache-2.0
// Captures of probes and bakes beside a viewer that stays live.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/HeadlessViewer.h"

#include <gmock/gmock.h>

namespace filament_core::view {
namespace {

using testing::Contains;
using testing::HasSubstr;

Image pictureOn(Backend backend, Document const& document) {
    auto stage = Stage::create({ .engine = { .backend = backend, .workers = 1 }, .watchesFiles = false });
    EXPECT_TRUE(stage);
    (*stage)->apply(document);
    (*stage)->finishLoading();
    EXPECT_THAT((*stage)->takeMessages(), testing::IsEmpty());
    EXPECT_EQ((*stage)->scene().reflectionProbeCount(), 1u);
    Result<Image> image = (*stage)->renderToImage();
    EXPECT_TRUE(image);
    return image ? std::move(*image) : Image{};
}

ViewerOptions optionsWithEmptyFolder(Backend backend) {
    ViewerOptions options = testOptions(backend);
    options.out = test::folderOfThisTest();
    std::filesystem::remove_all(options.out);
    std::filesystem::create_directories(options.out);
    return options;
}

TEST(LightWork, ACapturedProbeLightsTheSceneAndIsAPartOfTheDocument) {
    const ViewerOptions options = optionsWithEmptyFolder(Backend::Vulkan);
    Headless headless(options, kSmallPicture);
    ASSERT_TRUE(headless.viewer);
    headless.settle();
    Viewer& viewer = *headless.viewer;
    Document& document = viewer.document();
    document.environment.options.faceSize = 64;
    addProbe(document, viewer.stage().bounds());
    headless.settle();
    EXPECT_EQ(viewer.stage().scene().reflectionProbeCount(), 0u) << "it has seen nothing yet";

    viewer.panels().requests.capturesProbe = 0;
    viewer.redraw();
    const uint32_t before = viewer.completeFrames();
    ASSERT_TRUE(headless.stepUntil([&] {
        viewer.redraw(); // the window is live meanwhile
        return !document.probes.front().file.empty();
    }));
    EXPECT_GT(viewer.completeFrames(), before + 1);
    ASSERT_TRUE(headless.stepUntil([&] { return viewer.stage().scene().reflectionProbeCount() == 1; }));
    headless.settle();
    EXPECT_GT(document.probes.front().intensity, 0.0f);
    EXPECT_THAT(probeLines(viewer.stage().renderer().explain()), Contains(HasSubstr("probe 1")));

    const uint64_t generation = viewer.stage().generation();
    document.probes.front().centerWorld.y += 0.25;
    headless.settle();
    EXPECT_EQ(viewer.stage().generation(), generation) << "a probe moves in place";

    const Document kept = documentFromJson(toJson(document), "kept").value();
    const Image vulkan = pictureOn(Backend::Vulkan, kept), gles = pictureOn(Backend::Gles, kept);
    EXPECT_EQ(vulkan.pixels, gles.pixels);
    Document without = kept;
    without.probes.front().isOn = false;
    auto stage = Stage::create({ .engine = { .backend = Backend::Gles, .workers = 1 }, .watchesFiles = false });
    ASSERT_TRUE(stage);
    (*stage)->apply(without);
    (*stage)->finishLoading();
    EXPECT_NE((*stage)->renderToImage()->pixels, gles.pixels) << "its light is seen";
}

TEST(LightWork, ABakedLightmapTakesThePlaceOfTheModel) {
    const ViewerOptions options = optionsWithEmptyFolder(Backend::Gles);
    Headless headless(options, kSmallPicture);
    ASSERT_TRUE(headless.viewer);
    headless.settle();
    Viewer& viewer = *headless.viewer;
    viewer.panels().state.bake = { .texelsPerMeter = 0.5f, .paths = 32 };
    viewer.panels().requests.startsBake = true;
    viewer.redraw();
    viewer.step(0.01);
    EXPECT_TRUE(viewer.lightWork().isBusy());
    ASSERT_TRUE(headless.stepUntil([&] { return !viewer.lightWork().isBusy(); }, std::chrono::seconds(1200)));
    headless.settle();
    EXPECT_EQ(viewer.document().model.file.filename(), "baked.glb");
    EXPECT_EQ(viewer.stage().shownFile(), viewer.document().model.file);
    viewer.perform(Action::Undo);
    headless.settle();
    EXPECT_EQ(viewer.document().model.file, showcaseFiles().model);
}

} // namespace
} // namespace filament_core::view
