// SPDX-License-Identifier: Apache-2.0
// A material file that is loaded again: compiled only if something changed on which its code depends.
#include "toolkit/materials/MaterialFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace filament_core::tools {
namespace {

class MaterialFileTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(mFolder);
        write("paint.inc", "const float kGrey = 0.5;");
        writeMaterial("shadingModel : unlit", "gloss=1");
        forgetCompiledMaterialFiles();
    }
    void write(const char* name, std::string const& text) { std::ofstream(mFolder / name) << text; }
    void writeMaterial(std::string const& property, std::string const& show) {
        write("paint.mat", "material { " + property + " }\n// show: " + show +
                                   "\nfragment {\n#include \"paint.inc\"\n" +
                                   "void material(inout MaterialInputs material) {\n"
                                   "    prepareMaterial(material); material.baseColor.r = kGrey; } }\n");
    }
    MaterialFile load(uint16_t filteredVariants = 0) {
        Result<MaterialFile> file = compileMaterialFile(mFolder / "paint.mat", {}, filteredVariants);
        if (!file) ADD_FAILURE() << file.error().message;
        return file ? std::move(*file) : MaterialFile{};
    }
    /// Whether loading the file compiled it.
    bool compiles(uint16_t filteredVariants = 0) {
        const uint64_t before = compiledMaterialFiles();
        load(filteredVariants);
        return compiledMaterialFiles() != before;
    }

    const std::filesystem::path mFolder = std::filesystem::path(testing::TempDir()) / "material-file-test";
};

TEST_F(MaterialFileTest, IsCompiledAgainOnlyIfItsCodeChanged) {
    EXPECT_TRUE(compiles());
    EXPECT_FALSE(compiles());
    const std::vector<std::byte> bytes = load().bytes;
    ASSERT_FALSE(bytes.empty());

    writeMaterial("shadingModel : unlit", "gloss=0.25 mesh=plane"); // how it is shown
    EXPECT_FALSE(compiles());
    const MaterialFile shown = load();
    EXPECT_EQ(shown.bytes, bytes);
    EXPECT_EQ(shown.show.mesh, "plane");
    forgetCompiledMaterialFiles();
    EXPECT_TRUE(compiles());
    EXPECT_EQ(load().bytes, bytes) << "compiled from the other words about showing it";

    writeMaterial("shadingModel : unlit, culling : none", "gloss=1");
    EXPECT_TRUE(compiles());
    EXPECT_NE(load().bytes, bytes);
    writeMaterial("shadingModel : unlit", "gloss=1"); // as it was
    EXPECT_FALSE(compiles());
    EXPECT_EQ(load().bytes, bytes);
}

TEST_F(MaterialFileTest, IsCompiledAgainIfAFileThatItIncludesChangedOrWentAway) {
    const std::vector<std::byte> bytes = load().bytes;
    write("paint.inc", "const float kGrey = 0.75;");
    EXPECT_TRUE(compiles());
    EXPECT_NE(load().bytes, bytes);
    std::filesystem::remove(mFolder / "paint.inc");
    EXPECT_FALSE(compileMaterialFile(mFolder / "paint.mat"));
}

TEST_F(MaterialFileTest, IsCompiledForEachSetOfVariants) {
    EXPECT_TRUE(compiles());
    EXPECT_TRUE(compiles(shader::kVariantSkinning));
    EXPECT_FALSE(compiles(shader::kVariantSkinning));
    EXPECT_FALSE(compiles());
}

TEST_F(MaterialFileTest, TheOldestOfNineIsForgotten) {
    for (int i = 0; i < 9; ++i) {
        writeMaterial("shadingModel : unlit, name : paint" + std::to_string(i), "gloss=1");
        EXPECT_TRUE(compiles()) << i;
    }
    EXPECT_FALSE(compiles());
    writeMaterial("shadingModel : unlit, name : paint0", "gloss=1");
    EXPECT_TRUE(compiles());
}

} // namespace
} // namespace filament_core::tools
