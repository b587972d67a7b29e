// SPDX-License-Identifier: Apache-2.0
// EXT_lights_ies: photometric files at nodes.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>

namespace filament_core::assets::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kLuminaire = "IES:LM-63-2019\nTILT=NONE\n1 -1 2 3 1 1 2 0 0 0\n1 1 9\n"
                                        "0 45 90\n0\n100 300 50\n"; // the peak is 600 cd
constexpr const char* kIesMime = "application/x-ies-lm-63";

/// A triangle whose node is a luminaire of a view of the file.
TestFile fileWithLuminaire(std::string_view text = kLuminaire) {
    TestFile file = TestFile::triangle();
    file.root["extensionsUsed"] = { "EXT_lights_ies" };
    file.root["extensionsRequired"] = { "EXT_lights_ies" };
    file.root["extensions"]["EXT_lights_ies"]["lights"] = {
        { { "bufferView", file.addView(std::as_bytes(std::span(text))) }, { "mimeType", kIesMime }, { "name", "lamp" } }
    };
    file.root["nodes"][0]["extensions"]["EXT_lights_ies"] = { { "light", 0 } };
    return file;
}

std::string refusalOf(TestFile const& file, ErrorCode code = ErrorCode::Corrupt) {
    const Result<ModelData> model = file.load({ .name = "broken.glb" });
    if (model) return "was loaded";
    EXPECT_EQ(model.error().code, code) << model.error().message;
    EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    return model.error().message;
}

TEST(GltfLightProfile, ANodeIsAPointWithTheCandelasOfTheFile) {
    const ModelData model = loaded(fileWithLuminaire());
    EXPECT_THAT(model.warnings, IsEmpty());
    ASSERT_EQ(model.profiles.size(), 1u);
    EXPECT_EQ(model.profiles[0].name, "lamp");
    EXPECT_EQ(model.profiles[0].file.peak, 600);
    ASSERT_EQ(model.lights.size(), 1u);
    EXPECT_EQ(model.lights[0].type, LightType::Point);
    EXPECT_EQ(model.lights[0].profile, 0u);
    EXPECT_EQ(model.lights[0].intensity, 600);
    EXPECT_EQ(model.lights[0].color, float3(1));
    EXPECT_EQ(model.lights[0].rangeMeters, 0);
    ASSERT_EQ(model.nodes.size(), 1u);
    EXPECT_EQ(model.nodes[0].profiledLight, 0u);
    EXPECT_EQ(model.nodes[0].light, kNone);
    EXPECT_EQ(model.nodes[0].mesh, 0u);
}

TEST(GltfLightProfile, NodesScaleAndTintItAndMayHaveAPunctualLightBeside) {
    TestFile file = fileWithLuminaire();
    file.root["extensions"]["KHR_lights_punctual"]["lights"] =
            Json::parse(R"([ { "type": "point" }, { "type": "spot" } ])");
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "children": [ 1, 2, 3 ] },
        { "extensions": { "EXT_lights_ies": { "light": 0, "multiplier": 0.5, "color": [ 1, 0.5, 0.25 ] },
                          "KHR_lights_punctual": { "light": 1 } } },
        { "extensions": { "EXT_lights_ies": { "light": 0, "multiplier": 1e38, "color": [ 2, -1, 0.5 ] } } },
        { "extensions": { "EXT_lights_ies": { "light": 0, "multiplier": -3 } } } ])");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.lights.size(), 5u);
    EXPECT_EQ(model.profiles.size(), 1u) << "read once";
    EXPECT_EQ(model.nodes[1].light, 1u);
    EXPECT_EQ(model.nodes[1].profiledLight, 2u);
    EXPECT_EQ(model.lights[2].intensity, 300);
    EXPECT_EQ(model.lights[2].color, float3(1, 0.5f, 0.25f));
    EXPECT_EQ(model.lights[3].intensity, std::numeric_limits<float>::max());
    EXPECT_EQ(model.lights[3].color, float3(1, 0, 0.5f)) << "clamped to [0, 1]";
    EXPECT_EQ(model.lights[4].intensity, 0);
    EXPECT_THAT(model.warnings, testing::Contains(HasSubstr("EXT_lights_ies.multiplier: -3")));
}

TEST(GltfLightProfile, OnlyProfilesThatTheSceneShowsAreRead) {
    TestFile file = fileWithLuminaire();
    file.root["extensions"]["EXT_lights_ies"]["lights"].push_back({ { "uri", "no/such/file.ies" } });
    file.root["extensions"]["EXT_lights_ies"]["lights"].push_back(
            file.root["extensions"]["EXT_lights_ies"]["lights"][0]);
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "children": [ 1 ],
          "extensions": { "EXT_lights_ies": { "light": 2 } } },
        { "extensions": { "EXT_lights_ies": { "light": 1 }, "KHR_node_visibility": { "visible": false } } } ])");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.profiles.size(), 1u);
    EXPECT_EQ(model.lights.size(), 1u);
    EXPECT_EQ(model.lights[0].profile, 0u);
}

TEST(GltfLightProfile, FilesLieBesideTheModelOrInDataUris) {
    const std::filesystem::path folder = tools::buildDir() / "gltf-light-profile";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "lamp one.ies") << kLuminaire;
    TestFile file = fileWithLuminaire();
    for (const char* uri : { "lamp%20one.ies", "data:application/octet-stream;base64,"
                                               "SUVTOkxNLTYzLTIwMTkKVElMVD1OT05FCjEgLTEgMSAyIDEgMSAyIDAgMCAwCjEgMSA5"
                                               "CjAgOTAKMAo2MDAgNTAK" }) {
        file.root["extensions"]["EXT_lights_ies"]["lights"] = { { { "uri", uri } } };
        jobs::JobSystem jobs({ .workers = 0 });
        const Result<ModelData> model = loadGltfFromMemory(file.glb(), folder, jobs, {});
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_EQ(model->lights[0].intensity, 600) << uri;
    }
}

TEST(GltfLightProfile, WhatIsBrokenIsNamed) {
    TestFile file = fileWithLuminaire();
    Json& node = file.root["nodes"][0]["extensions"]["EXT_lights_ies"];
    Json& profile = file.root["extensions"]["EXT_lights_ies"]["lights"][0];
    const Json goodNode = node, goodProfile = profile;
    node["light"] = 1;
    EXPECT_THAT(refusalOf(file), HasSubstr("nodes[0].extensions.EXT_lights_ies.light: index 1 is out of range"));
    node = Json::object();
    EXPECT_THAT(refusalOf(file), HasSubstr("EXT_lights_ies.light"));
    node = goodNode;
    profile["bufferView"] = 7;
    EXPECT_THAT(refusalOf(file), HasSubstr("EXT_lights_ies.lights[0].bufferView: index 7 is out of range"));
    profile = goodProfile;
    profile["uri"] = "lamp.ies";
    EXPECT_THAT(refusalOf(file), HasSubstr("lights[0]: needs a uri or a bufferView, and not both"));
    profile = { { "name", "neither" } };
    EXPECT_THAT(refusalOf(file), HasSubstr("lights[0]: needs a uri or a bufferView, and not both"));
    profile = { { "bufferView", goodProfile["bufferView"] } };
    EXPECT_THAT(refusalOf(file, ErrorCode::Unsupported), HasSubstr("mimeType: '' must be 'application/x-ies-lm-63'"));
    profile = { { "uri", "../lamp.ies" } };
    EXPECT_THAT(refusalOf(file, ErrorCode::InvalidArgument), HasSubstr("EXT_lights_ies.lights[0]: "));
    profile = { { "uri", "missing.ies" } };
    EXPECT_THAT(refusalOf(file, ErrorCode::NotFound), HasSubstr("EXT_lights_ies.lights[0]: "));
    EXPECT_THAT(refusalOf(fileWithLuminaire(kLuminaire.substr(0, 60))),
                HasSubstr("broken.glb: EXT_lights_ies.lights[0]: line "));
}

TEST(GltfLightProfile, MoreThan1024ProfilesAreRefused) {
    TestFile file = fileWithLuminaire();
    Json& profiles = file.root["extensions"]["EXT_lights_ies"]["lights"];
    const Json one = profiles[0];
    Json children = Json::array();
    for (int i = 1; i <= 1024; ++i) {
        profiles.push_back(one);
        file.root["nodes"].push_back({ { "extensions", { { "EXT_lights_ies", { { "light", i } } } } } });
        children.push_back(i);
    }
    file.root["nodes"][0]["children"] = children;
    EXPECT_THAT(refusalOf(file, ErrorCode::Unsupported), HasSubstr("EXT_lights_ies.lights[1024]: more than 1024"));
    file.root["nodes"][1024]["extensions"]["EXT_lights_ies"]["light"] = 3;
    EXPECT_EQ(loaded(file).profiles.size(), 1024u);
}

} // namespace
} // namespace filament_core::assets::test
