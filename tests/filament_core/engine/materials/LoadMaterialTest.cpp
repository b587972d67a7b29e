// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/LoadMaterial.h"

#include "filament_core/engine/materials/CheckSpirv.h"
#include "shaders/interface/SamplerBudget.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/GroupLayouts.h"
#include "tests/shaders/EditStage.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <iterator>
#include <random>

namespace filament_core::engine {
namespace {

scene::Material load(std::vector<MaterialConstant> constants) {
    auto material = loadMaterial(
            { .package = shader::engineMaterial("gltf_layered_opaque"), .constants = std::move(constants) });
    EXPECT_TRUE(material) << (material ? "" : material.error().message);
    return material ? std::move(*material) : scene::Material{};
}

/// Of the maps of gltf_layered, with some packed in pairs.
constexpr const char* kMaps[] = { "hasBaseColorMap",       "hasMetallicRoughnessMap", "hasNormalMap",
                                  "hasOcclusionMap",       "hasEmissiveMap",          "hasClearCoatMap",
                                  "hasClearCoatNormalMap", "hasSheenColorMap",        "hasSpecularFactorMap",
                                  "hasAnisotropyMap",      "hasIridescenceMap",       "hasDiffuseTransmissionMap" };

TEST(LoadMaterial, TakesOutTheTexturesThatTheConstantsSwitchOff) {
    const scene::Material plain = load({ { "hasNormalMap", true } });
    EXPECT_TRUE(plain.package.findParameter("normalMap")->isBound);
    EXPECT_FALSE(plain.package.findParameter("clearCoatMap")->isBound);
    EXPECT_FALSE(load({}).package.findParameter("normalMap")->isBound);
}

TEST(LoadMaterial, SaysHowManyTexturesAMaterialSamplesAndHowManyThereMayBe) {
    std::vector<MaterialConstant> constants;
    for (const char* map : kMaps) constants.push_back({ map, true });
    const scene::Material all = load(constants);
    const uint32_t engines = shader::samplersOfEngine(shader::passKind(all.package));
    const auto count = static_cast<uint32_t>(std::size(kMaps)) + engines;
    EXPECT_TRUE(checkSamplers(all, 32, "a desktop"));
    EXPECT_TRUE(checkSamplers(all, count, "a device"));
    const Result<void> refused = checkSamplers(all, count - 1, "a device");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(refused.error().message,
              fmt::format("material 'gltf_layered_opaque' samples {} textures, {} of them the engine's, and a device "
                          "has {} a stage; leave some out, or load it with constants that switch them off (usedIf)",
                          count, engines, count - 1));
    constants.pop_back();
    EXPECT_TRUE(checkSamplers(load(constants), count - 1, "a device"));
}

std::vector<std::byte> copyOf(const char* name) {
    const auto bytes = shader::engineMaterial(name);
    return { bytes.begin(), bytes.end() };
}

TEST(LoadMaterial, TrustsOnlyThePackagesOfThisProgram) {
    EXPECT_TRUE(shader::isEnginePackage(shader::engineMaterial("gltf_lit_opaque")));
    EXPECT_FALSE(shader::isEnginePackage(copyOf("gltf_lit_opaque")));
    const std::vector<std::byte> copy = copyOf("gltf_lit_opaque");
    EXPECT_TRUE(loadMaterial({ .package = copy })) << "what the compiler wrote is valid, wherever it comes from";
}

/// The package with one word of one variant's SPIR-V changed and a right checksum.
std::vector<std::byte> changedSpirv(shader::MaterialPackage package, std::mt19937& random) {
    shader::Variant& variant = package.variants[random() % package.variants.size()];
    std::vector<uint32_t>& words = shader::test::editable(random() % 2 == 0 ? variant.vertex : variant.fragment).spirv;
    words[random() % words.size()] ^= 1u << random() % 32;
    return shader::writePackage(package);
}

TEST(LoadMaterial, RefusesChangedSpirvThatIsNotValid) {
    const auto package = shader::readPackage(shader::engineMaterial("gltf_unlit_opaque"));
    ASSERT_TRUE(package);
    std::mt19937 random(7);
    uint32_t refused = 0;
    for (int i = 0; i < 100; ++i) {
        const auto material = loadMaterial({ .package = changedSpirv(*package, random), .name = "changed" });
        if (material) continue; // another constant, for example
        EXPECT_TRUE(material.error().message.starts_with("material package 'changed': variant "))
                << material.error().message;
        ++refused;
    }
    EXPECT_GT(refused, 50u);
}

// Valid for SPIRV-Tools, and yet nothing for a driver.
TEST(LoadMaterial, RefusesSpirvThatReachesBeyondItsPackage) {
    auto package = shader::readPackage(shader::engineMaterial("gltf_unlit_opaque"));
    ASSERT_TRUE(package);
    std::vector<uint32_t>& words = shader::test::editable(package->variants[0].fragment).spirv;
    bool changed = false;
    for (size_t at = 5; at < words.size() && !changed; at += words[at] >> 16) {
        if ((words[at] & 0xFFFF) != 71 || words[at + 2] != 33) continue; // OpDecorate Binding
        words[at + 3] += 77;
        changed = true;
    }
    ASSERT_TRUE(changed);
    const std::vector<std::byte> bytes = shader::writePackage(*package);
    const auto material = loadMaterial({ .package = bytes });
    ASSERT_FALSE(material);
    EXPECT_NE(material.error().message.find("which the package does not have"), std::string::npos)
            << material.error().message;
    std::swap(package->variants[0].vertex, package->variants[0].fragment);
    EXPECT_FALSE(loadMaterial({ .package = shader::writePackage(*package) }));
}

} // namespace
} // namespace filament_core::engine
