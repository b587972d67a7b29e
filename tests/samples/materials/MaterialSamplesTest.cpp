// SPDX-License-Identifier: Apache-2.0
// Draws every material of samples/materials on both APIs: the bits must agree, no validation layer may complain, and
// without the property that the material shows, the image must differ.
// Writes <build>/material-samples/NAME.png, and all of them as sheet.png.
#include "tests/samples/materials/SampleStage.h"
#include "tests/samples/materials/SampleTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace filament_core::samples {
namespace {

namespace fs = std::filesystem;

std::string textOf(fs::path const& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

std::vector<fs::path> sampleFiles() {
    std::vector<fs::path> files;
    for (auto const& entry : fs::directory_iterator(kSampleFolder)) {
        if (entry.path().extension() == ".mat") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class MaterialSamples : public testing::TestWithParam<Sample> {};

TEST_P(MaterialSamples, LookTheSameOnBothApisAndShowWhatTheyAreFor) {
    Sample const& sample = GetParam();
    const Picture vulkan = draw(sample, {}, Backend::Vulkan);
    const Picture gles = draw(sample, {}, Backend::Gles);
    ASSERT_FALSE(vulkan.pixels.empty());
    save(sample.name, vulkan);
    EXPECT_EQ(differingPixels(vulkan, gles), 0u);
    EXPECT_GT(spread(vulkan), 0.05f) << "a picture of one colour shows nothing";

    if (sample.without.first.empty()) return;
    const Picture without = draw(sample, { sample.without }, Backend::Gles);
    ASSERT_FALSE(without.pixels.empty());
    EXPECT_GT(differingPixels(gles, without), 40u) << "the picture does not depend on: " << sample.without.first;
    const double change = mean(gles) - mean(without);
    const double direction = sample.effect == Effect::Brighter ? 1 : sample.effect == Effect::Darker ? -1 : 0;
    EXPECT_TRUE(direction == 0 || change * direction > 1e-3) << "the mean changes by " << change;
}

INSTANTIATE_TEST_SUITE_P(All, MaterialSamples, testing::ValuesIn(samples()),
                         [](auto const& test) { return test.param.name; });

class Sheet : public testing::Environment {
    void TearDown() override { saveSheet(); }
};
const testing::Environment* const gSheet = testing::AddGlobalTestEnvironment(new Sheet); // owned by gtest

TEST(SampleFolder, IsListedInItsReadme) {
    const std::string readme = textOf(kSampleFolder / "README.md");
    for (fs::path const& file : sampleFiles())
        EXPECT_NE(readme.find(fmt::format("`{}`", file.filename().string())), std::string::npos) << file.filename();
}

TEST(SampleFolder, HasAtLeastThirtyMaterialsAndEachIsDrawn) {
    std::set<std::string> drawn, files;
    for (Sample const& sample : samples()) drawn.insert(sample.name);
    for (fs::path const& file : sampleFiles()) files.insert(file.stem().string());
    EXPECT_EQ(drawn, files);
    EXPECT_GE(files.size(), 30u);
}

TEST(SampleFolder, HasEachPropertyOfTheGuideInSomeMaterial) {
    std::string all;
    for (fs::path const& file : sampleFiles()) all += textOf(file);
    for (const char* word : kPropertiesOfTheGuide) EXPECT_NE(all.find(word), std::string::npos) << word;
}

TEST(SampleFolder, SaysInEachMaterialWhatItShows) {
    for (fs::path const& file : sampleFiles()) {
        std::istringstream text(textOf(file));
        std::string licence, comment;
        std::getline(text, licence);
        std::getline(text, comment);
        EXPECT_EQ(licence, "// SPDX-License-Identifier: Apache-2.0") << file;
        EXPECT_TRUE(comment.starts_with("// ") && comment.size() > 30 && !comment.starts_with("// show")) << file;
    }
}

} // namespace
} // namespace filament_core::samples
