// SPDX-License-Identifier: Apache-2.0
// Cameras and camera paths as texts of their own.
#include "tools/view/document/TextForms.h"

#include <gmock/gmock.h>

#include <unistd.h>

#include <fstream>

namespace filament_core::view {
namespace {

CameraPath somePath() {
    CameraPath path{ .name = "round the \"table\"\n", .isClosed = true, .closingSeconds = 0.125 };
    for (int i = 0; i < 4; ++i) {
        Camera camera = Camera::lookAt({ i, 1.0 / 3, 5 }, { 0, 0, 0 });
        camera.lens.verticalFovDegrees = 30.1f + static_cast<float>(i);
        camera.exposure.iso = 100.0f / 3;
        path.keys.push_back({ .seconds = i * 0.7, .camera = camera });
    }
    return path;
}

std::filesystem::path fileOfThisTest() {
    return std::filesystem::path(testing::TempDir()) /
           (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + std::to_string(::getpid()));
}

TEST(TextForms, EachIsReadAsWhatItIs) {
    const CameraPath path = somePath();
    const Result<AnyText> read = anyFromJson(toJson(path), "text");
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_TRUE(std::holds_alternative<CameraPath>(*read));
    EXPECT_TRUE(std::get<CameraPath>(*read) == path) << "to the bit";
    const Result<AnyText> camera = anyFromJson(toJson(path.keys[2].camera), "text");
    ASSERT_TRUE(camera.ok()) << camera.error().message;
    ASSERT_TRUE(std::holds_alternative<Camera>(*camera));
    EXPECT_TRUE(isEqual(std::get<Camera>(*camera), path.keys[2].camera));
    Document document;
    document.paths.push_back(path);
    const Result<AnyText> whole = anyFromJson(toJson(document), "text");
    ASSERT_TRUE(whole.ok()) << whole.error().message;
    ASSERT_TRUE(std::holds_alternative<Document>(*whole));
    EXPECT_TRUE(std::get<Document>(*whole) == document);
}

TEST(TextForms, ErrorsNameThePlace) {
    const std::pair<const char*, const char*> cases[] = {
        { "no text", "text: this is no JSON text" },
        { "{}", "text: version: " },
        { R"({"version": 9, "camera": {}})", "text: version: " },
        { R"({"version": 1, "camera": []})", "text: camera: expected an object" },
        { R"({"version": 1, "camera": {"lens": {"nearMeters": "far"}}})", "text: camera.lens.nearMeters: " },
        { R"({"version": 1, "camera": {}, "model": {}})", "text: model: expected nothing beside camera" },
        { R"({"version": 1, "path": {"key": []}})", "text: path: there is no field 'key'; did you mean 'keys'?" },
        { R"({"version": 1, "path": {"closingSeconds": 0}})", "text: path.closingSeconds: " },
        { R"({"version": 1, "path": {"keys": [{"seconds": 1}, {"seconds": 1}]}})", "text: path.keys[1].seconds: " },
    };
    for (auto const& [text, part] : cases) {
        const Result<AnyText> read = anyFromJson(text, "text");
        ASSERT_FALSE(read.ok()) << text;
        EXPECT_THAT(read.error().message, testing::StartsWith(part)) << text;
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    }
}

TEST(TextForms, PathsAreSavedAndLoaded) {
    const std::filesystem::path file = fileOfThisTest();
    ASSERT_TRUE(saveCameraPath(file, somePath()).ok());
    const Result<CameraPath> loaded = loadCameraPath(file);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_TRUE(*loaded == somePath());
    Document document;
    document.paths = { somePath(), CameraPath{ .name = "another" } };
    ASSERT_TRUE(saveDocument(file, document).ok());
    const Result<CameraPath> first = loadCameraPath(file);
    ASSERT_TRUE(first.ok()) << first.error().message;
    EXPECT_TRUE(*first == somePath()) << "the first one of a document";
    ASSERT_TRUE(saveDocument(file, Document{}).ok());
    const Result<CameraPath> none = loadCameraPath(file);
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, testing::HasSubstr("has no camera path"));
    std::filesystem::remove(file);
    EXPECT_FALSE(loadCameraPath(file).ok());
    std::ofstream(file).close();
    std::filesystem::resize_file(file, (uintmax_t{ 64 } << 20) + 1); // without bytes on the disk
    EXPECT_THAT(loadAny(file).error().message, testing::HasSubstr("longer than 64 MiB"));
    ASSERT_TRUE(saveCameraPath(file, somePath()).ok());
    EXPECT_FALSE(saveCameraPath(file / "below", somePath()).ok()) << "a file is no folder";
}

} // namespace
} // namespace filament_core::view
