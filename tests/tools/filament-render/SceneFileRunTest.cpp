// SPDX-License-Identifier: Apache-2.0
// Scene files on the command line: what --set edits, and the image.
#include "tools/filament-render/SceneFileRun.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace filament_core::tools {
namespace {

Result<std::optional<Options>> fromWords(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "filament-render");
    return parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

TEST(SceneFileRun, SetEditsKeysOfTheFile) {
    const auto options = fromWords({ "kitchen.json", "--set", "camera.eye=0,1,4", "--set", "effects.fog=on" });
    ASSERT_TRUE(options.ok()) << options.error().message;
    ASSERT_EQ((*options)->sceneEdits.size(), 2u);
    EXPECT_EQ((*options)->sceneEdits[0], (std::pair<std::string, std::string>("camera.eye", "0,1,4")));
    const auto refused = fromWords({ "kitchen.json", "--fov", "30" });
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message, "--fov: 'kitchen.json' is a scene file: leave it out, or change a key of the "
                                       "file, as --set camera.eye=0,1,4 does");
    EXPECT_FALSE(fromWords({ "kitchen.json", "--copies", "2" }).ok());
    EXPECT_FALSE(fromWords({ "kitchen.json", "--set", "camera.eye" }).ok());
}

TEST(SceneFileRun, DrawsTheFileWithItsEdits) {
    const std::filesystem::path file = buildDir() / "windmill-scene.json";
    std::ofstream(file) << R"({ "model": ")" << (sourceDir() / "samples/animated_gltf/windmill.gltf").string()
                        << R"(", "suns": [ { "direction": [ -0.3, -1, -0.5 ] } ], "view": { "size": [ 64, 48 ] } })";
    Options options = *fromWords({ "windmill-scene.json", "--set", "view.size=40,30" }).value();
    options.model = file;
    const Result<BackendRun> run = runSceneFile(options, Backend::Gles);
    ASSERT_TRUE(run.ok()) << run.error().message;
    EXPECT_EQ(run->image.width, 40u);
    EXPECT_EQ(run->image.height, 30u);
    EXPECT_TRUE(run->errors.empty());
    EXPECT_TRUE(std::ranges::any_of(run->image.pixels, [](std::byte code) {
        return code != std::byte{ 0 } && code != std::byte{ 255 };
    })) << "the windmill is seen";
    options.sceneEdits = { { "view.sice", "1" } };
    EXPECT_NE(runSceneFile(options, Backend::Gles).error().message.find("did you mean 'size'"), std::string::npos);
}

} // namespace
} // namespace filament_core::tools
