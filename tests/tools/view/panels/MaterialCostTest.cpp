// SPDX-License-Identifier: Apache-2.0
// The cost of a .mat file, compiled beside the interface.
#include "tools/view/panels/MaterialCost.h"
#include "shaders/compiler/Cost.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace filament_core::view {
namespace {

constexpr const char* kCheap =
        "material { name : a, shadingModel : unlit,\n"
        "variantFilter : [ skinning, fog, ssr, vsm ] }\n"
        "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }";

void finish(MaterialCost& cost, std::filesystem::path const& file) {
    cost.follow(file);
    for (int i = 0; i < 60000 && cost.isCompiling(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        cost.follow(file);
    }
}

TEST(MaterialCost, IsWhatMatcPrintsAndFollowsTheFile) {
    const std::filesystem::path file = test::folderOfThisTest() / "a.mat";
    std::ofstream(file) << kCheap;
    MaterialCost cost;
    finish(cost, file);
    const auto expected = shader::costReport(kCheap, "a.mat");
    ASSERT_TRUE(expected);
    EXPECT_EQ(cost.text(), *expected);
    std::ofstream(file) << "material { nothing }";
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(1));
    cost.follow(file);
    EXPECT_TRUE(cost.isCompiling());
    EXPECT_EQ(cost.text(), *expected) << "until the new one is known";
    finish(cost, file);
    EXPECT_NE(cost.text().find("a.mat:1"), std::string::npos) << cost.text();
    cost.follow("model.glb");
    EXPECT_EQ(cost.text(), "");
    EXPECT_FALSE(cost.isCompiling());
    cost.follow(file.parent_path() / "not there.mat");
    EXPECT_FALSE(cost.isCompiling());
}

} // namespace
} // namespace filament_core::view
