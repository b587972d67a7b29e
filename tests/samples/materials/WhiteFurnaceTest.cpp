// SPDX-License-Identifier: Apache-2.0
// White furnace of every shading model and layer as drawn: an entirely white sphere in a white environment is nowhere
// brighter than the background, on both APIs. Prints the largest loss.
#include "base/math/Half.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/materials/MaterialTerms.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/scenes/SceneAssets.h"

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

namespace filament_core::tools {
void PrintTo(MaterialTerm const& term, std::ostream* out) { *out << term.name; }
} // namespace filament_core::tools

namespace filament_core::samples {
namespace {

using tools::MaterialTerm;

/// How much filtering and half floats may add to radiance 1.
constexpr float kNoGain = 1.005f;

struct Extremes {
    float least = 1e9f, most = -1e9f;
};

/// An engine with a white environment.
class Furnace {
public:
    explicit Furnace(Backend backend) {
        const std::filesystem::path work = tools::buildDir() / "material-samples";
        std::filesystem::create_directories(work);
        auto engine = Engine::create({ .backend = backend, .validation = true, .cacheDirectory = work });
        const tools::SceneSpec white{ .environment = "white" };
        const auto file = tools::environmentFile(white, { work, {} });
        EXPECT_TRUE(engine.ok() && file.ok());
        mEngine.emplace(std::move(*engine));
        auto environment = loadEnvironment(*mEngine, *file, { .faceSize = 16, .samples = 128 });
        EXPECT_TRUE(environment.ok());
        mEnvironment.emplace(std::move(*environment));
        mView.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        mView.size = { 48, 48 };
    }

    Engine& engine() { return *mEngine; }

    /// The range over all pixels, in units of the environment's radiance.
    Extremes draw(tools::MaterialStand const& stand) {
        Scene scene(*mEngine);
        stand.addTo(scene);
        scene.setEnvironment(*mEnvironment, { .illuminance = Lux{ 1 / mView.camera.exposure.factor() } });
        const Owned<SwapChain> target = mEngine->own(mEngine->create(
                SwapChainDesc{ .size = mView.size, .imageCount = 1, .format = Format::RGBA16F, .name = "furnace" }));
        Renderer renderer(*mEngine);
        renderer.render(scene, mView, target);
        const Result<Image> image = renderer.waitPixels(renderer.readPixels(target));
        EXPECT_TRUE(image.ok());
        for (std::string const& error : mEngine->takeErrors()) ADD_FAILURE() << error;
        return image ? extremesOf(*image) : Extremes{};
    }

private:
    static Extremes extremesOf(Image const& image) {
        Extremes found;
        for (size_t i = 0; i + 8 <= image.pixels.size(); i += 8) {
            uint16_t bits[3];
            std::memcpy(bits, image.pixels.data() + i, sizeof(bits));
            for (const uint16_t half : bits) {
                const float value = floatFromHalf(half);
                EXPECT_TRUE(std::isfinite(value));
                found.least = std::min(found.least, value);
                found.most = std::max(found.most, value);
            }
        }
        return found;
    }

    std::optional<Engine> mEngine;
    std::optional<Environment> mEnvironment;
    View mView;
};

Furnace& furnaceOf(Backend backend) {
    static std::unique_ptr<Furnace> furnaces[2];
    std::unique_ptr<Furnace>& furnace = furnaces[backend == Backend::Vulkan ? 0 : 1];
    if (!furnace) furnace = std::make_unique<Furnace>(backend);
    return *furnace;
}

std::vector<tools::MaterialValues> whiteMaterials(shader::MaterialPackage const& package) {
    std::vector<tools::MaterialValues> all;
    for (const char* metallic : { "0", "0.5", "1" }) {
        if (std::string_view(metallic) != "0" && package.shading != ShadingModel::Lit &&
            package.shading != ShadingModel::Subsurface)
            continue;
        for (const char* roughness : { "0", "0.25", "0.5", "0.75", "1" }) {
            for (const char* strength : { "0.3", "1" })
                all.push_back({ { "color", "1,1,1" },
                                { "tint", "1,1,1" },
                                { "metallic", metallic },
                                { "roughness", roughness },
                                { "smallRoughness", roughness },
                                { "strength", strength } });
        }
    }
    return all;
}

std::string wordsOf(tools::MaterialValues const& values) {
    std::string words;
    for (auto const& [name, value] : values) words += name + "=" + value + " ";
    return words;
}

class WhiteFurnace : public testing::TestWithParam<MaterialTerm> {};

TEST_P(WhiteFurnace, NoSphereIsBrighterThanItsSurroundings) {
    constexpr uint16_t kNotDrawn = shader::kAllVariantBits & ~shader::kVariantDepth; // no lights in a furnace
    const auto file = tools::readMaterialTerm(GetParam(), kNotDrawn);
    ASSERT_TRUE(file.ok()) << file.error().message;
    Extremes all[2];
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Furnace& furnace = furnaceOf(backend);
        auto stand = tools::MaterialStand::make(furnace.engine(), **file, {}, "sphere");
        ASSERT_TRUE(stand.ok()) << stand.error().message;
        Extremes& found = all[backend == Backend::Vulkan ? 0 : 1];
        for (tools::MaterialValues const& values : whiteMaterials((*file)->package)) {
            const Result<void> set = stand->set(furnace.engine(), **file, values);
            ASSERT_TRUE(set.ok()) << set.error().message;
            const Extremes drawn = furnace.draw(*stand);
            EXPECT_LE(drawn.most, kNoGain) << toString(backend) << ' ' << wordsOf(values);
            found.least = std::min(found.least, drawn.least);
            found.most = std::max(found.most, drawn.most);
        }
        EXPECT_GT(found.least, 0.2f) << "something of a white surface must come back";
    }
    EXPECT_EQ(all[0].least, all[1].least);
    EXPECT_EQ(all[0].most, all[1].most);
    std::printf("| %s | %.3f | %.3f |\n", GetParam().name.c_str(), static_cast<double>(all[0].least),
                static_cast<double>(all[0].most));
}

std::string testName(testing::TestParamInfo<MaterialTerm> const& test) {
    std::string name = test.param.name;
    std::erase(name, ',');
    std::ranges::replace_if(
            name, [](char c) { return c == ' ' || c == '-'; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, WhiteFurnace, testing::ValuesIn(tools::materialTerms()), testName);

} // namespace
} // namespace filament_core::samples
