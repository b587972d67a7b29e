// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_primitive_restart: one primitive for many strips, loops or fans draws what those draw one by one.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <random>

namespace filament_core::assets::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kLineLoop = 2, kLineStrip = 3, kTriangleList = 4, kTriangleStrip = 5, kTriangleFan = 6;

using Runs = std::vector<std::vector<uint32_t>>;

/// As the specification of glTF defines the topologies (section 3.7.2.1).
std::vector<uint32_t> listOf(int mode, Runs const& runs) {
    std::vector<uint32_t> list;
    for (std::vector<uint32_t> const& run : runs) {
        const size_t count = run.size();
        if (mode == kLineLoop && count > 1) {
            for (size_t i = 0; i < count; ++i) list.insert(list.end(), { run[i], run[(i + 1) % count] });
        } else if (mode == kLineStrip) {
            for (size_t i = 0; i + 1 < count; ++i) list.insert(list.end(), { run[i], run[i + 1] });
        } else if (mode == kTriangleStrip) {
            for (size_t i = 0; i + 2 < count; ++i)
                list.insert(list.end(), { run[i], run[i + 1 + i % 2], run[i + 2 - i % 2] });
        } else if (mode == kTriangleFan) {
            for (size_t i = 1; i + 1 < count; ++i) list.insert(list.end(), { run[i], run[i + 1], run[0] });
        }
    }
    return list;
}

size_t addIndices(TestFile& file, std::vector<uint32_t> const& indices, Component type) {
    if (type == kUInt) return file.add(indices, kUInt, "SCALAR", 1);
    if (type == kUShort) return file.add(std::vector<uint16_t>(indices.begin(), indices.end()), kUShort, "SCALAR", 1);
    return file.add(std::vector<uint8_t>(indices.begin(), indices.end()), kUByte, "SCALAR", 1);
}

TestFile pointsOf(uint32_t count, std::mt19937& random) {
    TestFile file;
    std::vector<float> positions(size_t{ count } * 3);
    for (float& number : positions) number = static_cast<float>(random() % 1000) / 100;
    file.positions(positions);
    return file;
}

/// A primitive for each run, and a group of all of them.
TestFile restarting(TestFile file, int mode, Runs const& runs, Component type) {
    constexpr uint32_t kEnd = 0xFFFFFFFF;
    const uint32_t restart = type == kUByte ? 0xFF : type == kUShort ? 0xFFFF : kEnd;
    const Json common{ { "attributes", file.primitive()["attributes"] }, { "mode", mode } };
    Json primitives = Json::array(), numbers = Json::array();
    std::vector<uint32_t> all;
    for (std::vector<uint32_t> const& run : runs) {
        if (!all.empty()) all.push_back(restart);
        all.insert(all.end(), run.begin(), run.end());
        numbers.push_back(primitives.size());
        primitives.push_back(common);
        primitives.back()["indices"] = addIndices(file, run, type);
    }
    file.root["meshes"][0]["primitives"] = primitives;
    file.root["meshes"][0]["extensions"]["EXT_mesh_primitive_restart"]["primitiveGroups"] = {
        { { "primitives", numbers }, { "indices", addIndices(file, all, type) } }
    };
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = { "EXT_mesh_primitive_restart" };
    return file;
}

Runs runsOf(uint32_t vertices, std::mt19937& random) {
    Runs runs(1 + random() % 6);
    for (std::vector<uint32_t>& run : runs) {
        run.resize(1 + random() % 9);
        for (uint32_t& index : run) index = static_cast<uint32_t>(random() % vertices);
    }
    runs.front() = { 0, 1, 2, 3 }; // something is drawn
    return runs;
}

TEST(GltfRestart, AGroupIsTheListOfItsStripsLoopsAndFans) {
    std::mt19937 random(3);
    for (int turn = 0; turn < 300; ++turn) {
        constexpr std::array kModes{ kLineLoop, kLineStrip, kTriangleStrip, kTriangleFan };
        constexpr std::array kTypes{ kUByte, kUShort, kUInt };
        const int mode = kModes[random() % kModes.size()];
        const Component type = kTypes[random() % kTypes.size()];
        const uint32_t vertices = 4 + static_cast<uint32_t>(random() % 40);
        const Runs runs = runsOf(vertices, random);
        TestFile file = pointsOf(vertices, random), listed = file;
        const PrimitiveData merged = onlyPrimitive(restarting(file, mode, runs, type));
        listed.primitive()["mode"] = mode <= kLineStrip ? 1 : kTriangleList;
        listed.primitive()["indices"] = addIndices(listed, listOf(mode, runs), kUShort);
        EXPECT_EQ(cornersOf(merged), cornersOf(onlyPrimitive(listed))) << "turn " << turn << " mode " << mode;
    }
}

TEST(GltfRestart, AGroupTakesThePlaceOfItsFirstPrimitive) {
    std::mt19937 random(4);
    TestFile file = restarting(pointsOf(8, random), kTriangleStrip, { { 0, 1, 2 }, { 3, 4, 5 } }, kUShort);
    Json alone = file.root["meshes"][0]["primitives"][0];
    alone["mode"] = kTriangleList;
    alone["indices"] = addIndices(file, { 5, 6, 7 }, kUShort);
    file.root["meshes"][0]["primitives"].insert(file.root["meshes"][0]["primitives"].begin() + 1, alone);
    file.root["meshes"][0]["extensions"]["EXT_mesh_primitive_restart"]["primitiveGroups"][0]["primitives"] = { 2, 0 };
    const ModelData model = loaded(file);
    ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
    EXPECT_EQ(model.meshes[0].primitives[0].indexCount, 6u);
    EXPECT_EQ(model.meshes[0].primitives[1].indexCount, 3u);
}

TEST(GltfRestart, AGroupThatBreaksARuleIsIgnoredWithAWarning) {
    std::mt19937 random(5);
    const TestFile good = restarting(pointsOf(8, random), kTriangleStrip, { { 0, 1, 2 }, { 3, 4, 5 } }, kUShort);
    const auto warningOf = [&](auto const& change) {
        TestFile file = good;
        Json& mesh = file.root["meshes"][0];
        change(file, mesh["primitives"], mesh["extensions"]["EXT_mesh_primitive_restart"]["primitiveGroups"]);
        const ModelData model = loaded(file);
        EXPECT_EQ(model.meshes[0].primitives.size(), 2u) << "they are drawn one by one";
        return model.warnings.empty() ? std::string() : model.warnings.front();
    };
    const std::string where = "meshes[0].extensions.EXT_mesh_primitive_restart.primitiveGroups[";
    EXPECT_THAT(loaded(good).warnings, IsEmpty());
    EXPECT_EQ(warningOf([](TestFile&, Json&, Json& groups) {
                  groups[0]["primitives"] = { 0, 0 };
              }),
              where + "0]: a primitive is named twice; the extension is ignored, and its primitives are drawn one by "
                      "one");
    EXPECT_THAT(warningOf([](TestFile&, Json&, Json& groups) { groups.push_back(groups[0]); }),
                HasSubstr(where + "1]: a primitive is named twice"));
    EXPECT_THAT(warningOf([](TestFile&, Json& primitives, Json&) { primitives[1]["mode"] = kTriangleList; }),
                HasSubstr("a primitive is no strip, loop or fan"));
    EXPECT_THAT(warningOf([](TestFile&, Json& primitives, Json&) { primitives[1]["mode"] = kTriangleFan; }),
                HasSubstr("its primitives differ in more than their indices"));
    EXPECT_THAT(warningOf([](TestFile&, Json& primitives, Json&) { primitives[1].erase("indices"); }),
                HasSubstr("a primitive has no indices"));
    EXPECT_THAT(warningOf([](TestFile& file, Json& primitives, Json&) {
                    primitives[1]["targets"] = Json::array({ file.primitive()["attributes"] });
                }),
                HasSubstr("a primitive has morph targets"));
    EXPECT_THAT(warningOf([](TestFile& file, Json&, Json& groups) {
                    groups[0]["indices"] = file.primitive()["attributes"]["POSITION"];
                }),
                HasSubstr("its accessor does not hold indices"));
    EXPECT_THAT(warningOf([](TestFile&, Json&, Json& groups) { groups[0]["primitives"] = Json::array(); }),
                HasSubstr("it names no primitives"));
    EXPECT_THAT(warningOf([](TestFile&, Json&, Json& groups) {
                    groups[0]["primitives"] = { 0, 7 };
                }),
                HasSubstr("the extension is ignored"));
}

TEST(GltfRestart, IndicesBehindTheVerticesAreRefusedByName) {
    std::mt19937 random(6);
    const TestFile file = restarting(pointsOf(4, random), kLineStrip, { { 0, 1 }, { 2, 9 } }, kUShort);
    EXPECT_THAT(file.load().error().message, HasSubstr("meshes[0].primitives[0].indices: 9 is out of range"));
}

} // namespace
} // namespace filament_core::assets::test
