// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "jobsystem/JobSystem.h"
#include "tests/fuzz/MeshFileFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/Points.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace filament_core::assets {
namespace {

std::span<const std::byte> bytesOf(std::string const& text) { return std::as_bytes(std::span(text)); }

/// Without files beside it.
Result<MeshFile> readText(std::string const& text, MeshFormat format) {
    Diagnostics diagnostics;
    return readMeshFile(bytesOf(text), format, {}, diagnostics);
}

std::string refusal(std::string const& text, MeshFormat format) {
    const Result<MeshFile> file = readText(text, format);
    return file ? "was read" : file.error().message;
}

constexpr const char* kQuad = R"(# two materials
mtllib quad.mtl
o floor
v 0 0 0
v 1 0 0 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl red
f 1/1/1 2/2/1 3/3/1 \
  4/4/1
usemtl blue
f -4/-4/-1 -3/-3/-1 -2/-2/-1
)";

constexpr const char* kMaterials = R"(
newmtl red
Kd 0.5 0.25 0.125
Ns 2
d 0.5
newmtl blue
Pr 0.25
Pm 1
Ke 4 2 0
map_Kd -s 1 1 -clamp on wood panel.png
)";

TEST(ObjFile, FacesAreFansOfSharedVertices) {
    Diagnostics diagnostics;
    const std::string materials = kMaterials;
    const auto read = [&](std::string const& name) -> Result<std::vector<std::byte>> {
        EXPECT_EQ(name, "quad.mtl");
        return std::vector<std::byte>(bytesOf(materials).begin(), bytesOf(materials).end());
    };
    const Result<MeshFile> file = readMeshFile(bytesOf(kQuad), MeshFormat::Obj, read, diagnostics);
    ASSERT_TRUE(file.ok()) << file.error().message;
    ASSERT_EQ(file->parts.size(), 2u);
    MeshFilePart const& floor = file->parts[0];
    EXPECT_EQ(floor.name, "floor");
    EXPECT_EQ(floor.material, 0u);
    EXPECT_EQ(floor.positions.size(), 4u);
    EXPECT_EQ(floor.indices, (std::vector<uint32_t>{ 0, 1, 2, 0, 2, 3 }));
    EXPECT_EQ(floor.uvs[0], float2(0, 1)) << "from the top";
    EXPECT_EQ(floor.normals[2], float3(0, 0, 1));
    EXPECT_TRUE(floor.colors.empty()) << "not every vertex has one";
    EXPECT_EQ(file->parts[1].positions[0], float3(0, 0, 0)) << "counted backwards";
    EXPECT_EQ(file->parts[1].indices.size(), 3u);
    ASSERT_EQ(file->materials.size(), 2u);
    EXPECT_EQ(file->materials[0].baseColor, float4(0.5f, 0.25f, 0.125f, 0.5f));
    EXPECT_NEAR(file->materials[0].roughness, 0.8409f, 1e-4f) << "(2 / (2 + 2))^(1/4)";
    EXPECT_EQ(file->materials[1].roughness, 0.25f);
    EXPECT_EQ(file->materials[1].metallic, 1);
    EXPECT_EQ(file->materials[1].emissive, float3(4, 2, 0));
    EXPECT_EQ(file->materials[1].baseColorMap, "wood panel.png");
}

TEST(ObjFile, SaysTheLineThatIsWrong) {
    const auto refused = [](const char* text) { return refusal(text, MeshFormat::Obj); };
    EXPECT_EQ(refused("v 0 0 0\nf 1 2 3\n"),
              "line 2: '2' names a vertex, texture coordinate or normal that was not before");
    EXPECT_EQ(refused("v 0 0 0\nf 0 1 1\n"),
              "line 2: '0' names a vertex, texture coordinate or normal that was not before");
    EXPECT_EQ(refused("v 0 0\n"), "line 1: a position needs three numbers");
    EXPECT_EQ(refused("v 0 0 nan\n"), "line 1: 'nan' is not a number");
    EXPECT_EQ(refused("v 0 0 1e39\n"), "line 1: '1e39' is not a number");
    EXPECT_EQ(refused("v 0 0 0\nf 1 1\n"), "line 2: a face needs three corners");
    EXPECT_EQ(refused("v 0 0 0\nvt 0 0\nf 1/1/1/1 1 1\n"),
              "line 3: '1/1/1/1' names a vertex, texture coordinate or normal that was not before");
    EXPECT_EQ(refused(""), "there are no triangles in the file");
}

TEST(ObjFile, ReadsWhatOtherProgramsWrite) {
    const auto read = [](std::string const& name) -> Result<std::vector<std::byte>> {
        if (name != "a.mtl" && name != "b c.mtl") return fail(ErrorCode::NotFound, "no file '{}'", name);
        const std::string text = std::string("\xEF\xBB\xBFnewmtl ") + name[0] + "\nmap_Kd wood.png\nKd 0 0 0\n";
        return std::vector<std::byte>(bytesOf(text).begin(), bytesOf(text).end());
    };
    const auto materials = [&](std::string const& names) {
        Diagnostics diagnostics;
        const std::string text = "\xEF\xBB\xBFmtllib " + names + "\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n";
        const Result<MeshFile> file = readMeshFile(bytesOf(text), MeshFormat::Obj, read, diagnostics);
        EXPECT_TRUE(file.ok());
        std::string found;
        for (MeshFileMaterial const& material : file->materials) {
            found += material.name + " ";
            EXPECT_EQ(material.baseColor, float4(1.0f)) << "the map stands for the colour, in any order";
        }
        for (std::string const& warning : diagnostics.takeWarnings()) found += warning + " ";
        return found;
    };
    EXPECT_EQ(materials("a.mtl"), "a ");
    EXPECT_EQ(materials("b c.mtl"), "b ") << "a name with a blank";
    EXPECT_EQ(materials("a.mtl d.mtl a.mtl"), "a a materials are not read: no file 'd.mtl' ");
    EXPECT_EQ(refusal(std::string("\xFE\xFF\0v", 4), MeshFormat::Obj), "the text is UTF-16: save it as UTF-8");
}

TEST(ObjFile, ConcaveFacesAreFilledOnce) {
    const Result<MeshFile> file =
            readText("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nf 1 2 3 4\nf 2 3 4 1\n", MeshFormat::Obj);
    ASSERT_TRUE(file.ok());
    // vertices are counted as triangles need them: an ear at the third corner comes first, then what is left
    EXPECT_EQ(file->parts[0].indices, (std::vector<uint32_t>{ 0, 1, 2, 3, 0, 2, 0, 1, 2, 0, 2, 3 }));
}

std::string plyText() {
    return "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0.5 255 188 0\n4 0 1 2 3\n";
}

/// The same file in bytes.
std::string plyBinary(bool isBig) {
    std::string text = plyText();
    text = text.substr(0, text.find("end_header\n") + 11);
    text.replace(text.find("ascii"), 5, isBig ? "binary_big_endian" : "binary_little_endian");
    const auto add = [&](auto value) {
        std::array<char, sizeof value> bytes;
        std::memcpy(bytes.data(), &value, sizeof value);
        if (isBig) std::ranges::reverse(bytes);
        text.append(bytes.data(), bytes.size());
    };
    constexpr float kPlaces[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0.5f } };
    for (int i = 0; i < 4; ++i) {
        for (const float number : kPlaces[i]) add(number);
        add(uint8_t{ 255 }), add(uint8_t{ static_cast<uint8_t>(i == 3 ? 188 : 0) }), add(uint8_t{ 0 });
    }
    add(uint8_t{ 4 });
    for (int32_t i = 0; i < 4; ++i) add(i);
    return text;
}

TEST(PlyFile, TextAndBothByteOrdersAreTheSameMesh) {
    for (std::string const& text : { plyText(), plyBinary(false), plyBinary(true) }) {
        const Result<MeshFile> file = readText(text, MeshFormat::Ply);
        ASSERT_TRUE(file.ok()) << file.error().message;
        MeshFilePart const& part = file->parts.at(0);
        EXPECT_EQ(part.positions.size(), 4u);
        EXPECT_EQ(part.positions[3], float3(0, 1, 0.5f));
        EXPECT_EQ(part.indices, (std::vector<uint32_t>{ 0, 1, 2, 0, 2, 3 }));
        EXPECT_NEAR(part.colors[3].y, 0.5029f, 1e-4f) << "188 of sRGB";
        EXPECT_EQ(part.colors[3].w, 1);
    }
}

TEST(PlyFile, WithoutFacesIsACloudOfPoints) {
    std::string text = plyText();
    text.replace(text.find("element face 1"), 14, "element face 0");
    const Result<MeshFile> file = readText(text, MeshFormat::Ply);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(file->parts.at(0).arePoints);
    EXPECT_EQ(file->parts[0].positions.size(), 4u);
    EXPECT_EQ(file->parts[0].origin, double3(0));
    text.replace(text.find("element vertex 4"), 16, "element vertex 0");
    EXPECT_EQ(refusal(text, MeshFormat::Ply), "the file has no vertices");
}

TEST(PlyFile, OfDoublesIsRelativeToAnOrigin) {
    std::string text = plyText();
    for (size_t at = text.find("property float"); at != std::string::npos; at = text.find("property float"))
        text.replace(at, 14, "property double");
    text.replace(text.find("0 0 0 255"), 5, "6000000.0625 0 -1");
    const Result<MeshFile> file = readText(text, MeshFormat::Ply);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->parts.at(0).origin, double3(6e6, 0, -1));
    EXPECT_EQ(file->parts[0].positions[0], float3(0.0625f, 0, 0));
    EXPECT_EQ(file->parts[0].positions[1], float3(1 - 6e6f, 0, 1));
}

// Depth cameras write NaN where they saw nothing, and normals and curvatures that could not be estimated.
TEST(PlyFile, PointsThatAreNowhereAreLeftOut) {
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                               "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                               "property float curvature\n";
    const std::string vertices = "nan nan nan nan nan nan nan\n9 0 2 nan -nan inf 1e99\n1 -inf 0 0 0 1 0\n"
                                 "4 5 6 0 0 1 -1.#IND\n";
    const Result<MeshFile> cloud = readText(header + "end_header\n" + vertices, MeshFormat::Ply);
    ASSERT_TRUE(cloud.ok()) << cloud.error().message;
    MeshFilePart const& part = cloud->parts.at(0);
    EXPECT_TRUE(part.arePoints);
    EXPECT_EQ(part.origin, double3(9, 0, 2)) << "the first that is somewhere";
    EXPECT_EQ(part.positions, (std::vector<float3>{ { 0, 0, 0 }, { -5, 5, 4 } }));
    EXPECT_EQ(part.normals, (std::vector<float3>{ { 0, 0, 0 }, { 0, 0, 1 } }));
    const auto faces = [&](const char* face) {
        return refusal(header + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + vertices +
                               face,
                       MeshFormat::Ply);
    };
    EXPECT_EQ(faces("3 1 3 3\n"), "was read") << "no face has the others";
    EXPECT_EQ(faces("3 1 3 2\n"), "vertex 2 of a face has no finite position");
}

TEST(PlyFile, ConcaveFacesAreFilledOnce) {
    // an arrow head, whose notch is the third corner
    const Result<MeshFile> file = readText(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement "
            "face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 3 0 1 2\n",
            MeshFormat::Ply);
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->parts[0].indices, (std::vector<uint32_t>{ 0, 1, 2, 3, 0, 2 }));
}

TEST(PlyFile, SaysWhatIsWrong) {
    const auto refused = [](std::string const& from, std::string const& to) {
        std::string text = plyText();
        text.replace(text.find(from), from.size(), to);
        return refusal(text, MeshFormat::Ply);
    };
    EXPECT_EQ(refused("4 0 1 2 3", "4 0 1 2 4"), "a face names vertex 4 of 4");
    EXPECT_EQ(refused("4 0 1 2 3", "4 0 1 2 -1"), "face 0 names a vertex below 0");
    EXPECT_EQ(refused("4 0 1 2 3", "9 0 1 2 3"), "element 0 of 'face' ends before its numbers, or has a wrong one");
    EXPECT_EQ(refused("element face 1", "element face 99999"), "99999 elements 'face' are not in 11 bytes");
    EXPECT_EQ(refused("property float x\n", ""), "vertices have no x, y and z");
    EXPECT_NE(refused("1.0", "2.0").find("the format is not"), std::string::npos);
    EXPECT_EQ(refusal("plx", MeshFormat::Ply), "the file does not begin with \"ply\"");
}

TEST(StlFile, TextAndBinaryAreTheSameTriangle) {
    std::string binary("solid of a program that writes this before binary triangles");
    binary.resize(80, ' ');
    const uint32_t count = 1;
    const float triangle[12] = { 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    binary.append(reinterpret_cast<const char*>(&count), 4);
    binary.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
    binary.append(2, '\0');
    const std::string text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                             "endloop\nendfacet\nendsolid a\n";
    for (std::string const& one : { binary, text }) {
        const Result<MeshFile> file = readText(one, MeshFormat::Stl);
        ASSERT_TRUE(file.ok()) << file.error().message;
        EXPECT_EQ(file->parts.at(0).positions, (std::vector<float3>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }));
    }
    EXPECT_EQ(refusal(binary.substr(0, 100), MeshFormat::Stl), "there are no triangles in the file");
    EXPECT_EQ(refusal("solid a\nvertex 0 0 0\n", MeshFormat::Stl), "1 vertices are no triangles");
    EXPECT_EQ(refusal("solid a\nvertex 0 x 0\n", MeshFormat::Stl), "line 2: a vertex needs three finite numbers");
}

TEST(MeshFile, PassesThroughTheLoaderOfGltfFiles) {
    const std::filesystem::path folder = tools::buildDir() / "mesh-files";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "quad.obj") << kQuad;
    std::ofstream(folder / "quad.mtl") << kMaterials;
    std::ofstream(folder / "quad.PLY") << plyText();
    std::ofstream(folder / "broken.obj") << "v 0\n";
    jobs::JobSystem jobs;
    const Result<ModelData> obj = loadGltf(folder / "quad.obj", jobs);
    ASSERT_TRUE(obj.ok()) << obj.error().message;
    EXPECT_EQ(obj->meshes.size(), 2u);
    ASSERT_EQ(obj->materials.size(), 2u);
    EXPECT_EQ(obj->materials[0].name, "red");
    EXPECT_EQ(obj->materials[0].alphaMode, AlphaMode::Blend);
    EXPECT_EQ(obj->materials[1].emissiveStrength, 4);
    ASSERT_EQ(obj->warnings.size(), 2u);
    EXPECT_EQ(obj->warnings[0], "options of maps are not read");
    EXPECT_NE(obj->warnings[1].find("wood panel.png"), std::string::npos) << obj->warnings[1];
    const Result<ModelData> ply = loadGltf(folder / "quad.PLY", jobs);
    ASSERT_TRUE(ply.ok()) << ply.error().message;
    EXPECT_EQ(ply->meshes.size(), 1u);
    EXPECT_EQ(ply->materials.at(0).metallicFactor, 0);
    EXPECT_TRUE(ply->materials.at(0).doubleSided);
    EXPECT_TRUE(obj->materials[0].doubleSided);
    std::string points = plyText();
    std::ofstream(folder / "points.ply") << points.replace(points.find("element face 1"), 14, "element face 0");
    const Result<ModelData> cloud = loadGltf(folder / "points.ply", jobs);
    ASSERT_TRUE(cloud.ok()) << cloud.error().message;
    EXPECT_EQ(cloud->meshes.at(0).primitives.at(0).topology, backend::PrimitiveType::Points);
    EXPECT_EQ(loadGltf(folder / "broken.obj", jobs).error().message,
              "broken.obj: line 1: a position needs three numbers");
}

TEST(PointCloudFile, HasThePointsOfAGltfFileWhereItsNodesAre) {
    const std::filesystem::path folder = tools::buildDir() / "mesh-files";
    std::filesystem::create_directories(folder);
    const float numbers[] = { 0, 0, 0, 1, 0, 0, 0.25f, 0.5f, 1, 1, 0, 0 }; // two positions, two colours
    std::ofstream(folder / "points.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(numbers), sizeof numbers);
    std::ofstream(folder / "points.gltf")
            << R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ],
        "nodes": [ { "mesh": 0, "translation": [ 10, 20, 30 ], "scale": [ 2, 2, 2 ] } ],
        "materials": [ { "pbrMetallicRoughness": { "baseColorFactor": [ 0.5, 1, 1, 1 ] } } ],
        "meshes": [ { "primitives": [ { "mode": 0, "material": 0, "attributes": { "POSITION": 0, "COLOR_0": 1 } } ] } ],
        "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 0, 0 ] },
                       { "bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3" } ],
        "bufferViews": [ { "buffer": 0, "byteOffset": 0, "byteLength": 24 }, { "buffer": 0, "byteOffset": 24, "byteLength": 24 } ],
        "buffers": [ { "uri": "points.bin", "byteLength": 48 } ] })";
    const Result<PointCloudData> cloud = loadPointCloud(folder / "points.gltf");
    ASSERT_TRUE(cloud.ok()) << cloud.error().message;
    EXPECT_EQ(cloud->positions, (std::vector<double3>{ { 10, 20, 30 }, { 12, 20, 30 } }));
    EXPECT_EQ(cloud->colors, (std::vector<float4>{ { 0.125f, 0.5f, 1, 1 }, { 0.5f, 0, 0, 1 } }));
    std::ofstream(folder / "quad.obj") << kQuad;
    EXPECT_EQ(loadPointCloud(folder / "quad.obj").error().message, "quad.obj: there are no points in the file");
}

// The fuzzer's body on edits of small files.
TEST(MeshFile, EveryEditOfAFileIsReadOrRefused) {
    std::mt19937 random(7);
    size_t meshes = 0;
    const std::string stl = "solid a\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendsolid\n";
    const std::pair<char, std::string> files[] = {
        { '\0', std::string(kQuad) + kMaterials },
        { '\1', plyText() },
        { '\1', plyBinary(false) },
        { '\1', plyBinary(true) },
        { '\2', stl },
    };
    for (auto const& [format, text] : files) {
        for (int round = 0; round < 2000; ++round) {
            std::string edited = format + text;
            for (uint32_t edits = random() % 4; edits > 0; --edits) {
                const size_t at = 1 + random() % (edited.size() - 1);
                if (random() % 3 == 0)
                    edited.erase(at, random() % 8);
                else if (random() % 2 == 0)
                    edited.insert(at, edited.substr(1 + random() % (edited.size() - 1), random() % 16));
                else
                    edited[at] = static_cast<char>(random());
                if (edited.size() < 3) break;
            }
            meshes += fuzzMeshFileOnce({ reinterpret_cast<const uint8_t*>(edited.data()), edited.size() });
        }
    }
    EXPECT_GT(meshes, 2000u);
}

} // namespace
} // namespace filament_core::assets
