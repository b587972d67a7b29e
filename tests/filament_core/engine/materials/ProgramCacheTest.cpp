// SPDX-License-Identifier: Apache-2.0
// EngineOptions::cachePrograms: a device's compiled programs serve the next engine, and a damaged cache costs nothing
// but time.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include "base/Log.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace filament_core {
namespace {

using testing::IsEmpty;
namespace fs = std::filesystem;

constexpr const char* kMaterial =
        R"(material { name : kept, shadingModel : lit, constants : [ { name : red, type : float, default : 0.5 } ] }
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = vec4(materialConstants_red, 0.6, 0.3, 1.0);
        material.roughness = 0.4;
        material.emissive = vec4(0.01, 0.02, 0.03, 0.0);
    }
}
)";

class ProgramCache : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mPackage = test::compiledPackage(kMaterial);
        mBefore = setLogSink([this](Severity, std::string_view line) { mLines.emplace_back(line); });
    }
    void TearDown() override {
        setLogSink(mBefore);
        fs::remove_all(mFolder);
    }

    struct Outcome {
        std::vector<std::byte> pixels;
        EngineStatistics statistics;
        double milliseconds = 0;
    };

    /// From creating an engine to an image, and back.
    Outcome run(bool isCached = true, float red = 0.5f) {
        const auto begin = std::chrono::steady_clock::now();
        Outcome outcome;
        {
            auto engine = Engine::create({ .backend = GetParam(),
                                           .workers = 0,
                                           .validation = true,
                                           .cacheDirectory = mFolder,
                                           .cachePrograms = isCached });
            EXPECT_TRUE(engine) << engine.error().message;
            if (!engine) return outcome;
            const Owned<Material> material =
                    engine->own(*engine->create(MaterialDesc{ .package = mPackage, .constants = { { "red", red } } }));
            const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
            const test::SquareMesh square(*engine);
            Scene scene(*engine);
            square.add(scene, instance);
            scene.add(SunLight{ .directionWorld = { 0, -0.3f, -1 } });
            outcome.pixels = test::renderLinear(*engine, scene, test::SquareMesh::view()).pixels;
            engine->waitIdle();
            outcome.statistics = engine->statistics();
            test::expectNoErrors(*engine);
        }
        outcome.milliseconds =
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        return outcome;
    }

    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        if (!fs::exists(mFolder)) return found;
        for (auto const& entry : fs::directory_iterator(mFolder)) {
            if (entry.path().filename() != "tested-drivers") found.push_back(entry.path()); // of the self-test
        }
        return found;
    }

    const fs::path mFolder =
            fs::temp_directory_path() / ("program_cache_test_" + std::to_string(getpid()) + "_" + toString(GetParam()));
    std::span<const std::byte> mPackage; // kept by compiledPackage()
    LogSink mBefore;
    std::vector<std::string> mLines;
};

TEST_P(ProgramCache, TheSecondEngineDrawsTheSamePictureAndCompilesNothingThatTheFirstOneKept) {
    const Outcome without = run(false);
    EXPECT_THAT(files(), IsEmpty()) << "nobody asked for it";
    const Outcome first = run(), second = run();
    EXPECT_EQ(first.pixels, without.pixels);
    EXPECT_EQ(second.pixels, without.pixels);
    EXPECT_EQ(first.statistics.programsFromCache, 0u);
    ASSERT_EQ(files().size(), 1u);
    std::printf("%s: without %.0f ms, first %.0f ms, second %.0f ms; %llu bytes kept, %llu of %llu programs taken from "
                "them\n",
                toString(GetParam()), without.milliseconds, first.milliseconds, second.milliseconds,
                static_cast<unsigned long long>(fs::file_size(files()[0])),
                static_cast<unsigned long long>(second.statistics.programsFromCache),
                static_cast<unsigned long long>(second.statistics.programsCreated));
    // lavapipe stores no more than the header of a pipeline cache.
    if (GetParam() == Backend::Gles) {
        EXPECT_EQ(second.statistics.programsFromCache, second.statistics.programsCreated);
    }
    EXPECT_THAT(mLines, IsEmpty());
}

TEST_P(ProgramCache, AnotherValueOfAConstantIsAnotherProgram) {
    const Outcome half = run(true, 0.5f);
    const Outcome full = run(true, 1.0f), plain = run(false, 1.0f);
    EXPECT_EQ(full.pixels, plain.pixels);
    EXPECT_NE(full.pixels, half.pixels);
}

TEST_P(ProgramCache, ADamagedFileIsIgnoredWithOneWarningAndReplaced) {
    const Outcome first = run();
    ASSERT_EQ(files().size(), 1u);
    {
        std::fstream file(files()[0], std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(40);
        file << "not what was written";
    }
    const Outcome damaged = run();
    EXPECT_EQ(damaged.pixels, first.pixels);
    EXPECT_EQ(damaged.statistics.programsFromCache, 0u);
    EXPECT_THAT(mLines, testing::ElementsAre(testing::HasSubstr("is damaged or from another device")));
    mLines.clear();
    const Outcome again = run();
    EXPECT_EQ(again.pixels, first.pixels);
    EXPECT_THAT(mLines, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(BothApis, ProgramCache, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
