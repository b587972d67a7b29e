// SPDX-License-Identifier: Apache-2.0
// Bakes as child processes: their commands, progress, cancellation and what they leave.
#include "tools/view/app/BakeRun.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <gmock/gmock.h>

#include <fstream>
#include <numbers>
#include <thread>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

BakeRequest requestOf(BakeKind kind) {
    BakeRequest request{ .out = "out", .program = "filament-bake" };
    request.settings.kind = kind;
    request.box = { { -1, 0, -2 }, { 1, 3, 2 } };
    request.document.model = { .file = "room.glb", .fit = false };
    request.document.environment.file = "sky.hdr";
    return request;
}

std::string joined(BakeCommand const& command) {
    std::string text;
    for (std::string const& word : command.words) text += word + ' ';
    return text;
}

TEST(BakeCommand, NamesTheLightOfTheDocument) {
    BakeRequest request = requestOf(BakeKind::Lightmap);
    request.document.environment.settings = { .illuminance = Lux{ 500 },
                                              .rotationRadians = 3 * std::numbers::pi_v<float> };
    DocumentLight sun{ .light = SunLight{ .directionWorld = { 0, -1, 0.5f }, .illuminance = Lux{ 7 } } };
    request.document.lights = { { .light = PointLight{} }, { .isOn = false, .light = SunLight{} }, sun };
    const Result<BakeCommand> command = bakeCommand(request);
    ASSERT_TRUE(command) << command.error().message;
    EXPECT_THAT(joined(*command), HasSubstr("filament-bake room.glb --environment sky.hdr --ibl-intensity 500 "));
    EXPECT_THAT(joined(*command), HasSubstr("--sun 7 0 -1 0.5 "));
    EXPECT_THAT(joined(*command), HasSubstr("--density 16 --samples 256 "));
    EXPECT_EQ(command->file, command->folder / "baked.glb");
    const auto rotation = std::ranges::find(command->words, "--ibl-rotation");
    ASSERT_NE(rotation, command->words.end());
    EXPECT_NEAR(std::abs(std::stod(*(rotation + 1))), 180, 1e-3); // within one turn
    request.usesModelEnvironment = true;
    EXPECT_THAT(bakeCommand(request)->words, Not(Contains("--environment")));
}

TEST(BakeCommand, AGridHasTheBoxInMetresOfTheFile) {
    BakeRequest request = requestOf(BakeKind::Grid);
    const Result<BakeCommand> command = bakeCommand(request);
    ASSERT_TRUE(command);
    EXPECT_THAT(command->grid, HasSubstr(R"("at": [0, 1.5, 0], "halfExtent": [1, 1.5, 2])"));
    request.document.model.fit = true;
    EXPECT_THAT(bakeCommand(request).error().message, HasSubstr("fit"));
}

TEST(BakeCommand, OnlyTheSameCommandHasTheSameFolder) {
    const BakeRequest request = requestOf(BakeKind::Lightmap);
    BakeRequest finer = request, moved = requestOf(BakeKind::Grid);
    EXPECT_EQ(bakeCommand(request)->folder, bakeCommand(request)->folder);
    finer.settings.texelsPerMeter = 17;
    EXPECT_NE(bakeCommand(request)->folder, bakeCommand(finer)->folder);
    moved.box.max.x += 1;
    EXPECT_NE(bakeCommand(moved)->folder, bakeCommand(requestOf(BakeKind::Grid))->folder);
}

TEST(BakeCommand, WhatCannotBeTracedIsRefused) {
    BakeRequest request = requestOf(BakeKind::Lightmap);
    request.document.environment.file = "sky.fenv";
    EXPECT_THAT(bakeCommand(request).error().message, HasSubstr("panorama"));
    request.document.model.file = "gold.mat";
    EXPECT_THAT(bakeCommand(request).error().message, HasSubstr(".gltf and .glb"));
}

TEST(BakeProgress, IsThatOfTheLastLine) {
    const BakeProgress progress =
            progressIn("filament-bake:   3 %  1/30 texels  9 s left\nfilament-bake:  42 %  12/30 texels  3 s left\n");
    EXPECT_EQ(progress.share, 0.42);
    EXPECT_EQ(progress.line, "42 %  12/30 texels  3 s left");
    EXPECT_FALSE(progressIn("cutting surfaces into charts\n").isRunning);
    EXPECT_FALSE(progressIn("100000000000 %  ").isRunning);
}

class BakeRuns : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    /// A program of a few lines instead of filament-bake; $OUT is the folder of the bake.
    BakeRequest scripted(std::string const& lines) {
        const fs::path script = folder / "bake.sh";
        std::ofstream(script) << "#!/bin/sh\nfor OUT; do :; done\n" << lines << '\n';
        fs::permissions(script, fs::perms::owner_all);
        BakeRequest request = requestOf(BakeKind::Lightmap);
        request.out = folder;
        request.program = script;
        return request;
    }
    Result<BakeResult> finished(BakeRun& run) {
        for (;;) {
            if (const auto result = run.poll()) return *result;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    const fs::path folder = test::folderOfThisTest();
};

TEST_F(BakeRuns, WhatWasWrittenIsTheResult) {
    BakeRun run;
    const BakeRequest request = scripted("echo room > \"$OUT/baked.glb\"");
    ASSERT_TRUE(run.start(request));
    EXPECT_FALSE(run.start(request)) << "one at a time";
    const Result<BakeResult> result = finished(run);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(fs::exists(result->file));
    EXPECT_FALSE(run.isBusy() || run.progress().isRunning);
}

TEST_F(BakeRuns, AFailureIsTheLastLineOfTheLog) {
    BakeRun run;
    ASSERT_TRUE(run.start(scripted("echo first >&2; echo no such room >&2; exit 1")));
    EXPECT_THAT(finished(run).error().message, HasSubstr("no such room"));
}

TEST_F(BakeRuns, CancelKillsAndTheSameCommandFindsTheFolder) {
    const BakeRequest request = scripted("if [ -e \"$OUT/part\" ]; then echo done > \"$OUT/baked.glb\"; exit 0; fi\n"
                                         "touch \"$OUT/part\"; echo ' 7 %  1/9 texels' >&2; while :; do sleep 1; done");
    BakeRun run;
    ASSERT_TRUE(run.start(request));
    while (!fs::exists(bakeCommand(request)->folder / "part") || run.progress().share < 0.07) ASSERT_FALSE(run.poll());
    run.cancel();
    EXPECT_EQ(finished(run).error().code, ErrorCode::Cancelled);
    ASSERT_TRUE(run.start(request));
    EXPECT_TRUE(finished(run)); // it continued
}

TEST_F(BakeRuns, AProgramThatIsNotThereIsAFailure) {
    BakeRequest request = scripted("");
    request.program = folder / "nothing";
    BakeRun run;
    const Result<void> started = run.start(request);
    EXPECT_TRUE(!started || !finished(run));
}

} // namespace
} // namespace filament_core::view
