// SPDX-License-Identifier: Apache-2.0
// Draws every row of the table on both APIs. The images are in <build>/hard/.
#include "tests/numerics/scenes/HardCase.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace filament_core::hard {
namespace {

constexpr Backend kBothApis[] = { Backend::Vulkan, Backend::Gles };

std::vector<HardCase> const& allRows() {
    static const std::vector<HardCase> rows = [] {
        std::vector<HardCase> all;
        for (auto const& part : { distanceRows(), shapeRows(), lightRows(), lensRows(), fileRows() })
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return rows;
}

// Letters and digits; signs of exponents stay apart.
std::string fileName(std::string name) {
    std::ranges::replace(name, '-', 'm');
    std::ranges::replace(name, '+', 'p');
    std::ranges::replace_if(
            name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

void save(std::string const& name, Image const& display) {
    const std::filesystem::path folder = tools::buildDir() / "hard";
    std::filesystem::create_directories(folder);
    const Result<void> saved = savePng(folder / (fileName(name) + ".png"), display);
    EXPECT_TRUE(saved.ok());
}

/// One device per API for all rows, destroyed before main() returns.
class Devices : public testing::Test {
protected:
    static void SetUpTestSuite() {
        for (Backend backend : kBothApis) sDevices.push_back(std::make_unique<Device>(backend));
    }
    static void TearDownTestSuite() { sDevices.clear(); }

    static inline std::vector<std::unique_ptr<Device>> sDevices;
};

class HardCases : public Devices, public testing::WithParamInterface<HardCase> {};

Picture draw(Device& device, SceneBuilder const& build) {
    Picture picture;
    {
        Stage stage(device);
        build(stage);
        picture = stage.take();
    }
    device.engine().waitIdle();
    for (std::string const& error : device.engine().takeErrors())
        ADD_FAILURE() << toString(device.engine().device().backend) << ": " << error;
    return picture;
}

void expectTwin(HardCase const& row, Device& device, Picture const& picture) {
    const Picture twin = draw(device, row.twin);
    const Image expected = row.mirrored ? mirroredLeftRight(twin.display) : twin.display;
    const Difference difference = compare(picture.display, expected, row.tolerance);
    EXPECT_GT(twin.coveredCount(), 0u) << "the twin shows something";
    EXPECT_EQ(difference.pixels, 0u) << "pixels differ, the most by " << difference.largest << " of 255";
    if (difference.pixels > 0) save(row.name + " twin", twin.display);
}

TEST_P(HardCases, AreDrawnAsTheyMustBe) {
    HardCase const& row = GetParam();
    std::vector<Picture> pictures;
    for (auto const& device : sDevices) {
        ASSERT_TRUE(*device);
        pictures.push_back(draw(*device, row.scene));
        EXPECT_EQ(pictures.back().notFinite, "");
        EXPECT_GE(pictures.back().scannedAttachments, 2u) << "the colour of each frame";
    }
    EXPECT_EQ(pictures[0].linear.pixels, pictures[1].linear.pixels) << "Vulkan and OpenGL ES disagree";
    EXPECT_EQ(pictures[0].display.pixels, pictures[1].display.pixels) << "Vulkan and OpenGL ES disagree";
    save(row.name, pictures[0].display);
    if (row.twin) expectTwin(row, *sDevices[0], pictures[0]);
    if (row.holds) row.holds(pictures[0]);
}

INSTANTIATE_TEST_SUITE_P(Rows, HardCases, testing::ValuesIn(allRows()),
                         [](auto const& test) { return fileName(test.param.name); });

} // namespace

// GoogleTest prints parameters; a row prints its claim.
void PrintTo(HardCase const& row, std::ostream* stream) { *stream << row.name; }

} // namespace filament_core::hard
