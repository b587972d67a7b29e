// SPDX-License-Identifier: Apache-2.0
// Textures in the material panel: which of them take images, and what the document says of them.
#include "tests/tools/view/panels/PanelStage.h"
#include "tools/view/panels/MaterialRows.h"

#include <algorithm>

namespace filament_core {
namespace {

using test::PanelStage;
using view::Document;

view::ParameterRow rowOf(PanelStage& stage, std::string_view parameter) {
    const auto materials = view::materialRows(*stage.stage, stage.document);
    const auto material = std::ranges::find(materials, "canvas", &view::MaterialRow::name);
    for (view::ParameterRow& row : view::parameterRows(*stage.stage, *material, stage.document))
        if (row.description.name == parameter) return std::move(row);
    ADD_FAILURE() << "no parameter " << parameter;
    return {};
}

TEST(TextureRows, SayWhatIsEdited) {
    PanelStage stage(Backend::Vulkan, { 400, 300 });
    const view::ParameterRow before = rowOf(stage, "baseColorMap");
    EXPECT_EQ(before.kind, view::ParameterKind::Texture);
    EXPECT_TRUE(view::takesPicture(before.description));
    EXPECT_FALSE(before.isEdited || before.texture);
    setTexture(stage.document, "canvas", "baseColorMap", "cloth.png", false);
    setTexture(stage.document, "canvas", "baseColorMap", "linen.png", true); // one edit of a parameter
    const view::ParameterRow after = rowOf(stage, "baseColorMap");
    ASSERT_TRUE(after.texture.has_value());
    EXPECT_EQ(after.texture->file, "linen.png");
    EXPECT_TRUE(after.isEdited && after.texture->isData);
    EXPECT_EQ(stage.document.textures.size(), 1u);
    EXPECT_FALSE(rowOf(stage, "roughnessFactor").isEdited);
    const auto materials = view::materialRows(*stage.stage, stage.document);
    EXPECT_EQ(std::ranges::find(materials, "canvas", &view::MaterialRow::name)->edits, 1u);
    resetTexture(stage.document, "canvas", "baseColorMap");
    EXPECT_FALSE(rowOf(stage, "baseColorMap").isEdited);
}

TEST(TextureRows, NamesTellColoursFromData) {
    for (const char* name : { "baseColorMap", "emissiveMap", "sheenColorMap", "picture" })
        EXPECT_FALSE(view::holdsData(name)) << name;
    for (const char* name : { "normalMap", "metallicRoughnessMap", "occlusionMap", "clearCoatMap" })
        EXPECT_TRUE(view::holdsData(name)) << name;
    ParameterDescription description{ .name = "map", .type = ParameterType::Sampler2D };
    EXPECT_TRUE(view::takesPicture(description));
    description.format = SamplerFormat::Int;
    EXPECT_FALSE(view::takesPicture(description));
    EXPECT_FALSE(view::takesPicture({ .name = "map", .type = ParameterType::SamplerCube }));
    EXPECT_FALSE(view::takesPicture({ .name = "map", .type = ParameterType::Float4 }));
}

} // namespace
} // namespace filament_core
