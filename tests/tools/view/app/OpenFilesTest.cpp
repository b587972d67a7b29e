// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/OpenFiles.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tests/filament_core/engine/RenderFixture.h"

namespace filament_core::view {
namespace {

TEST(OpenFiles, AKtx2IsAnEnvironmentIfItIsACube) {
    const std::filesystem::path folder = test::folderOfThisTest();
    for (const uint32_t layers : { 1u, 6u }) {
        assets::Image image{
            .width = 2, .height = 2, .layers = layers, .format = backend::Format::RGBA16F, .data = {}
        };
        image.data.resize(image.levelBytes(0));
        const std::filesystem::path file = folder / (layers == 6 ? "sky.KTX2" : "wood.ktx2");
        ASSERT_TRUE(assets::replaceFile(file, assets::encodeKtx2(image)));
        EXPECT_EQ(kindOf(file), layers == 6 ? FileKind::Environment : FileKind::Picture);
    }
    EXPECT_EQ(kindOf(folder / "missing.ktx2"), FileKind::Environment) << "whose error says that there is none";

    Document document;
    document.environment.prefersModels = true;
    ASSERT_TRUE(showFile(document, folder / "sky.KTX2"));
    EXPECT_EQ(document.environment.file, folder / "sky.KTX2");
    EXPECT_FALSE(document.environment.prefersModels);
}

} // namespace
} // namespace filament_core::view
