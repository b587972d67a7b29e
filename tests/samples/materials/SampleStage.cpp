// SPDX-License-Identifier: Apache-2.0
#include "tests/samples/materials/SampleStage.h"

#include "toolkit/paths/Paths.h"
#include "toolkit/pictures/ImageChecks.h"
#include "tools/conformance/Compare.h"
#include "tools/conformance/Stage.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <map>

namespace filament_core::samples {
namespace {

namespace fs = std::filesystem;
using namespace conformance;

std::map<std::string, Image> gSaved; ///< by name

fs::path workFolder() { return tools::buildDir() / "material-samples"; }

Stage* stageOf(Backend backend) {
    static std::unique_ptr<Stage> stages[2];
    std::unique_ptr<Stage>& stage = stages[backend == Backend::Vulkan ? 0 : 1];
    if (!stage) {
        fs::create_directories(workFolder());
        auto opened = Stage::open({ .backend = backend, .validation = true, .work = workFolder() });
        EXPECT_TRUE(opened.ok()) << (opened.ok() ? "" : opened.error().message);
        if (opened.ok()) stage = std::move(*opened);
    }
    return stage.get();
}

SceneSpec sceneOf(Sample const& sample, std::vector<tools::TextEdit> const& edits) {
    SceneSpec spec{ .name = sample.name, .folder = kSampleFolder };
    Json model = { { "material", sample.name + ".mat" } };
    for (auto const& [from, to] : edits) model["edits"][from] = to;
    // The others are compiled by tests of the compiler; these are most of a material.
    model["variantFilter"] = { "skinning", "shadowReceiver" };
    if (!sample.hasLamp) model["variantFilter"].push_back("dynamicLighting");
    spec.modelObject = std::make_shared<const Json>(std::move(model));
    spec.environment = "studio";
    spec.environmentSettings.illuminance = Lux{ 10'000 };
    spec.lights.emplace_back(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 40'000 } });
    if (sample.hasLamp) {
        spec.lights.emplace_back(PointLight{
                .positionWorld = { 1.5, 0.2, 1.8 }, .intensity = Candela{ 30'000 }, .color = { 1, 0.6f, 0.3f } });
    }
    spec.copies = { double4x4(1.0) };
    spec.eye = double3(1.2, 0.9, 2.6);
    spec.view.size = { 96, 96 };
    spec.view.samples = sample.samplesOfAPixel;
    spec.view.timeSeconds = 2.5;
    spec.linear = true;
    return spec;
}

} // namespace

Picture draw(Sample const& sample, std::vector<tools::TextEdit> const& edits, Backend backend) {
    Stage* stage = stageOf(backend);
    if (!stage) return {};
    const Result<void> set = stage->set(sceneOf(sample, edits));
    EXPECT_TRUE(set.ok()) << (set.ok() ? "" : set.error().message);
    if (!set) return {};
    Result<Shot> shot = stage->shoot();
    EXPECT_TRUE(shot.ok()) << (shot.ok() ? "" : shot.error().message);
    if (!shot) return {};
    for (std::string const& error : shot->errors) ADD_FAILURE() << toString(backend) << ": " << error;
    EXPECT_EQ(faultOf(shot->image), "");
    return std::move(shot->image);
}

size_t differingPixels(Picture const& a, Picture const& b) {
    if (a.pixels.size() != b.pixels.size()) return a.pixels.size() + b.pixels.size();
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 8) count += std::memcmp(&a.pixels[i], &b.pixels[i], 8) != 0;
    return count;
}

double mean(Picture const& picture) {
    const Image shown = displayed(picture);
    double sum = 0;
    for (size_t i = 0; i < shown.pixels.size(); ++i) sum += i % 4 < 3 ? static_cast<double>(shown.pixels[i]) : 0;
    return sum / (static_cast<double>(shown.pixels.size()) * 0.75 * 255);
}

float spread(Picture const& picture) {
    const Image shown = displayed(picture);
    const double average = mean(picture);
    double sum = 0;
    for (size_t i = 0; i < shown.pixels.size(); ++i) {
        const double difference = static_cast<double>(shown.pixels[i]) / 255 - average;
        if (i % 4 < 3) sum += difference * difference;
    }
    return static_cast<float>(std::sqrt(sum / (static_cast<double>(shown.pixels.size()) * 0.75)));
}

void save(std::string const& name, Picture const& picture) {
    const Image& shown = gSaved[name] = displayed(picture);
    const Result<void> saved = savePng(workFolder() / (name + ".png"), shown);
    EXPECT_TRUE(saved.ok()) << (saved.ok() ? "" : saved.error().message);
}

void saveSheet() {
    if (gSaved.empty()) return;
    constexpr uint32_t kColumns = 9, kSide = 96;
    const auto rows = (static_cast<uint32_t>(gSaved.size()) + kColumns - 1) / kColumns;
    Image sheet{ .width = kColumns * kSide, .height = rows * kSide };
    sheet.pixels.resize(size_t{ sheet.width } * sheet.height * 4);
    uint32_t index = 0;
    for (auto const& [name, image] : gSaved) {
        const uint32_t left = index % kColumns * kSide, top = index / kColumns * kSide;
        for (uint32_t y = 0; y < std::min(kSide, image.height); ++y) {
            std::memcpy(&sheet.pixels[(size_t{ top + y } * sheet.width + left) * 4],
                        &image.pixels[size_t{ y } * image.width * 4], size_t{ std::min(kSide, image.width) } * 4);
        }
        ++index;
    }
    const Result<void> saved = savePng(workFolder() / "sheet.png", sheet);
    EXPECT_TRUE(saved.ok()) << (saved.ok() ? "" : saved.error().message);
}

} // namespace filament_core::samples
