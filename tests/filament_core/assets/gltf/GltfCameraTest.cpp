// SPDX-License-Identifier: Apache-2.0
// Cameras and names of morph targets.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include "jobsystem/Cancellation.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TestFile withCamera(Json const& camera) {
    TestFile file = TestFile::triangle();
    file.root["cameras"] = { camera };
    file.root["nodes"][0]["camera"] = 0;
    return file;
}

CameraData cameraOf(Json const& camera) {
    const ModelData model = loaded(withCamera(camera));
    EXPECT_EQ(model.cameras.size(), 1u);
    return model.cameras.empty() ? CameraData{} : model.cameras[0];
}

TEST(GltfCamera, HasTheLensOfTheFile) {
    const CameraData perspective = cameraOf(Json::parse(R"({ "name": "eye", "type": "perspective",
                             "perspective": { "yfov": 0.75, "znear": 0.5, "zfar": 100, "aspectRatio": 1.5 } })"));
    EXPECT_EQ(perspective.name, "eye");
    EXPECT_FALSE(perspective.isParallel);
    EXPECT_EQ(perspective.verticalFovRadians, 0.75f);
    EXPECT_EQ(perspective.nearMeters, 0.5f);
    EXPECT_EQ(perspective.aspect, 1.5f);
    const CameraData parallel = cameraOf(Json::parse(R"({ "type": "orthographic",
            "orthographic": { "xmag": 4, "ymag": -2, "znear": 0, "zfar": 9 } })"));
    EXPECT_TRUE(parallel.isParallel);
    EXPECT_EQ(parallel.halfHeightMeters, 2);
    EXPECT_EQ(parallel.aspect, 2);
    EXPECT_EQ(parallel.nearMeters, 0);
    EXPECT_EQ(parallel.farMeters, 9);
    const ModelData model =
            loaded(withCamera(Json::parse(R"({ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } })")));
    EXPECT_EQ(model.nodes[0].camera, 0u);
    EXPECT_EQ(model.cameras[0].aspect, 0) << "that of the picture";
    EXPECT_THAT(model.warnings, IsEmpty());
    EXPECT_EQ(loaded(TestFile::triangle()).nodes[0].camera, kNone);
}

// Every combination of numbers that no camera has gives one that can be used, and a warning.
TEST(GltfCamera, WhatIsNoLensIsMendedAndNamed) {
    const Json numbers[] = { 0, -1, 1e300, 1e-300, 4, 0.5 };
    size_t mended = 0;
    for (Json const& a : numbers) {
        for (Json const& b : numbers) {
            for (Json const& c : numbers) {
                for (const bool isParallel : { false, true }) {
                    const Json lens = isParallel ? Json{ { "xmag", a }, { "ymag", b }, { "znear", c }, { "zfar", a } }
                                                 : Json{ { "yfov", a }, { "znear", b }, { "aspectRatio", c } };
                    const char* const type = isParallel ? "orthographic" : "perspective";
                    const ModelData model = loaded(withCamera({ { "type", type }, { type, lens } }));
                    ASSERT_EQ(model.cameras.size(), 1u);
                    CameraData const& camera = model.cameras[0];
                    EXPECT_TRUE(camera.verticalFovRadians > 0 && camera.verticalFovRadians < 3.14159266f) << lens;
                    EXPECT_TRUE(std::isfinite(camera.nearMeters) && std::isfinite(camera.aspect)) << lens;
                    EXPECT_TRUE(camera.aspect > 0 && (isParallel ? camera.nearMeters >= 0 : camera.nearMeters > 0))
                            << lens;
                    if (isParallel) {
                        EXPECT_TRUE(camera.farMeters > camera.nearMeters && std::isfinite(camera.farMeters)) << lens;
                        EXPECT_TRUE(camera.halfHeightMeters > 0 && std::isfinite(camera.halfHeightMeters)) << lens;
                    }
                    mended += !model.warnings.empty();
                }
            }
        }
    }
    EXPECT_GT(mended, 300u);
    const ModelData unknown = loaded(withCamera({ { "type", "panorama" } }));
    EXPECT_THAT(unknown.warnings, ElementsAre(HasSubstr("cameras[0].type: 'panorama' is neither perspective")));
}

TEST(GltfMorphNames, AreThoseOfTheExtrasAndNothingElse) {
    TestFile file = TestFile::triangle();
    const auto namesFor = [&](Json const& extras) {
        file.root["meshes"][0]["extras"] = extras;
        return loaded(file).meshes[0].targetNames;
    };
    EXPECT_THAT(namesFor({ { "targetNames", { "smile", "blink" } } }), ElementsAre("smile", "blink"));
    for (Json const& other : { Json(3), Json("targetNames"), Json::array({ "smile" }), Json::object(), Json(nullptr),
                               Json{ { "targetNames", 3 } }, Json{ { "targetNames", { "smile", 3 } } } })
        EXPECT_THAT(namesFor(other), IsEmpty()) << other << ": extras may hold anything";
}

TEST(GltfCancel, ACancelledLoadEndsAtItsNextStep) {
    jobs::JobSystem jobs({ .workers = 1 });
    const Bytes file = TestFile::triangle().glb();
    for (size_t steps = 0; steps < 5; ++steps) {
        jobs::Cancellation gone;
        size_t seen = 0;
        GltfOptions options;
        options.cancellation = &gone;
        options.progress = [&](GltfStage, size_t, size_t) {
            if (seen++ == steps) gone.request();
        };
        const Result<ModelData> model = loadGltfFromMemory(file, ".", jobs, options);
        if (steps == 4) {
            EXPECT_TRUE(model) << "it has four steps: 0 and 1 of one for the structure, and of one for the content";
            continue;
        }
        ASSERT_FALSE(model);
        EXPECT_EQ(model.error().code, ErrorCode::Cancelled);
        EXPECT_EQ(model.error().message, "model: loading was cancelled");
    }
}

} // namespace
} // namespace filament_core::assets::test
