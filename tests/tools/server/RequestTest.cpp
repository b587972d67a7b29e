// SPDX-License-Identifier: Apache-2.0
// Requests: what is valid, what is refused with which line, and which files scenes may name.
#include "tools/server/RenderRequest.h"

#include "toolkit/json/JsonFile.h"
#include "tools/server/Mcp.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace filament_core::server {
namespace {

namespace fs = std::filesystem;

std::string errorOf(std::string_view json, RequestLimits const& limits = {}) {
    const Result<RenderRequest> request = parseRequest(json, limits);
    return request ? "" : request.error().message;
}

TEST(RenderRequest, HasASceneSettingsAndASize) {
    const Result<RenderRequest> request = parseRequest(
            R"({"id": "a-1", "scene": {"points": [{"at": [0, 1, 0]}]}, "set": {"camera.eye": [0, 1, 4], "effects.fog": "on"},
                "size": [64, 32], "api": "vulkan", "format": "exr"})",
            {});
    ASSERT_TRUE(request) << request.error().message;
    EXPECT_EQ(request->id, "a-1");
    EXPECT_EQ(request->api, Backend::Vulkan);
    EXPECT_EQ(request->format, ImageFormat::Exr);
    EXPECT_EQ(request->scene.contents().view.size, uint2(64, 32));
    EXPECT_EQ(request->scene.contents().camera.eye, double3(0, 1, 4));
    EXPECT_TRUE(request->scene.contents().view.effects.fog.enabled);
}

TEST(RenderRequest, SaysWhatIsWrong) {
    const auto expect = [](std::string_view json, std::string_view part) {
        EXPECT_NE(errorOf(json).find(part), std::string::npos) << json << ": " << errorOf(json);
    };
    expect("", "request");
    expect("[]", "an object");
    expect("{}", "give one of scene and sceneFile");
    expect(R"({"scene": {}, "sceneFile": "a"})", "give one of scene and sceneFile");
    expect(R"({"scene": 1})", "scene: an object");
    expect(R"({"scen": {}})", "scen: no such member; did you mean 'scene'?");
    expect(R"({"scene": {"point": []}})", "points");
    expect(R"({"scene": {}, "api": "metal"})", "\"metal\" is not gles or vulkan");
    expect(R"({"scene": {}, "size": [0, 1]})", "size");
    EXPECT_NE(errorOf(R"({"scene": {}, "size": [2048, 2048]})", { .mostPixels = 1 << 20 })
                      .find("4194304 pixels; this server draws up to 1048576"),
              std::string::npos);
    expect(R"({"scene": {"frames": 60}})", "frames");
    expect(R"({"scene": {}, "set": 1})", "set: an object");
    expect(R"({"scene": {}, "set": {"effects.fogg": "on"}})", "fog");
    expect(R"({"scene": {}, "id": 7})", "id: a name");
    expect(R"({"sceneFile": "a.json"})", "no folder");
}

class ServerFolders : public testing::Test {
protected:
    ServerFolders() {
        std::string name = (fs::path(testing::TempDir()) / "serverXXXXXX").string();
        EXPECT_NE(::mkdtemp(name.data()), nullptr);
        mFolder = name;
        fs::create_directories(mFolder / "scenes/sub");
        fs::create_directories(mFolder / "assets");
        std::ofstream(mFolder / "secret.json") << "{}";
        std::ofstream(mFolder / "scenes/sub/a.json") << R"({"description": "a"})";
        std::ofstream(mFolder / "assets/box.glb") << "x";
        fs::create_symlink(mFolder / "secret.json", mFolder / "scenes/link.json");
        mLimits = { .assets = mFolder / "assets", .scenes = mFolder / "scenes" };
    }
    ~ServerFolders() override { fs::remove_all(mFolder); }
    Result<std::optional<fs::path>> found(SceneFile const& scene, std::string const& name) const {
        return buildOptions(mLimits, scene).find({ SceneFileKind::Model, name });
    }

    fs::path mFolder;
    RequestLimits mLimits;
};

TEST_F(ServerFolders, ScenesLieBelowTheirFolder) {
    const Result<RenderRequest> request = parseRequest(R"({"sceneFile": "sub/a.json"})", mLimits);
    ASSERT_TRUE(request) << request.error().message;
    EXPECT_EQ(request->scene.contents().description, "a");
    for (const char* name : { "../secret.json", "sub/../../secret.json", "link.json", "/etc/passwd", "" }) {
        const std::string error = errorOf(std::string(R"({"sceneFile": ")") + name + "\"}", mLimits);
        EXPECT_TRUE(error.find("outside") != std::string::npos || error.find("no relative name") != std::string::npos)
                << name << ": " << error;
    }
    const std::string missing = errorOf(R"({"sceneFile": "none.json"})", mLimits);
    EXPECT_NE(missing.find("there is no such scene"), std::string::npos);
    EXPECT_EQ(missing.find(mFolder.string()), std::string::npos) << "paths of the server stay there";
}

TEST_F(ServerFolders, SentScenesNameAssetsAlone) {
    const SceneFile sent;
    const Result<std::optional<fs::path>> asset = found(sent, "asset:box.glb");
    ASSERT_TRUE(asset) << asset.error().message;
    EXPECT_EQ(**asset, fs::canonical(mFolder / "assets/box.glb"));
    for (const char* name : { "box.glb", "asset:../secret.json", "/etc/passwd", "asset:/etc/passwd", "asset:" })
        EXPECT_FALSE(found(sent, name)) << name;
    const Result<SceneFile> own = SceneFile::load(mFolder / "scenes/sub/a.json");
    ASSERT_TRUE(own);
    EXPECT_TRUE(found(*own, "b.glb")) << "below the folder of scenes";
    EXPECT_FALSE(found(*own, "../../secret.json"));
}

TEST_F(ServerFolders, ErrorsForClientsNameNoFolder) {
    const std::string path = (fs::canonical(mFolder) / "assets/none.glb").string();
    EXPECT_EQ(withoutFolders("no file '" + path + "', " + path, mLimits), "no file 'assets/none.glb', assets/none.glb");
    EXPECT_EQ(withoutFolders("nothing", {}), "nothing");
}

TEST(Mcp, EncodesBytes) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy"); // RFC 4648, 10
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

} // namespace
} // namespace filament_core::server
