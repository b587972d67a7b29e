// SPDX-License-Identifier: Apache-2.0
// Which images a model reads and decodes, from where, and how much they may take.
#include "filament_core/assets/gltf/GltfImages.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/PngChunks.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <unistd.h>

namespace filament_core::assets::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Bytes png(uint8_t grey) {
    const std::array<uint8_t, 8> pixels{ grey, grey, grey, 255, 255, 255, 255, 255 };
    return glbImageFromPixels("image", 2, 1, std::as_bytes(std::span(pixels)))->file;
}

/// Only the header: an image of size x size pixels that has none.
Bytes pngHeader(uint32_t size) {
    Bytes file = png(0);
    for (const size_t at : { 16, 20 }) {
        for (size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::byte>(size >> (24 - 8 * i));
    }
    return file;
}

/// A triangle with `count` materials, each with a texture of its own image; the caller adds the images.
TestFile manyMaterials(size_t count) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    const Json primitive = file.primitive();
    Json primitives = Json::array();
    for (size_t i = 0; i < count; ++i) {
        file.root["textures"].push_back({ { "source", i } });
        Json material;
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
        file.root["materials"].push_back(material);
        primitives.push_back(primitive);
        primitives.back()["material"] = i;
    }
    file.root["meshes"][0]["primitives"] = std::move(primitives);
    return file;
}

/// A folder "model" in a temporary one.
struct GltfImages : testing::Test {
    fs::path above = fs::temp_directory_path() / fmt::format("gltf-images-{}", ::getpid()), folder = above / "model";

    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(above); }

    Result<ModelData> load(TestFile const& file, GltfOptions const& options = {}) const {
        jobs::JobSystem jobs({ .workers = 0 });
        return loadGltfFromMemory(file.glb(), folder, jobs, options);
    }
    void put(fs::path const& path, Bytes const& bytes) const { ASSERT_TRUE(replaceFile(path, bytes)); }
};

TEST_F(GltfImages, OneFileThatManyImagesNameIsDecodedOnce) {
    put(folder / "grey.png", png(100));
    put(folder / "other.png", png(50));
    TestFile file = manyMaterials(24);
    for (int i = 0; i < 24; ++i) file.root["images"].push_back({ { "uri", i == 7 ? "other.png" : "grey.png" } });
    const auto model = load(file);
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->images.size(), 2u);
    ASSERT_EQ(model->materials.size(), 24u);
    for (size_t i = 0; i < 24; ++i)
        EXPECT_EQ(model->images[model->materials[i].baseColor.image].data[0], std::byte(i == 7 ? 50 : 100));
}

TEST_F(GltfImages, OneRangeOfABufferThatManyViewsNameIsDecodedOnce) {
    TestFile file = manyMaterials(3);
    const size_t view = file.addView(png(100));
    const Json same = file.root["bufferViews"][view];
    file.root["bufferViews"].push_back(same);
    const size_t other = file.addView(png(50));
    for (const size_t i : { view, view + 1, other })
        file.root["images"].push_back({ { "bufferView", i }, { "mimeType", "image/png" } });
    const auto model = load(file);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->images.size(), 2u);
    EXPECT_EQ(model->materials[0].baseColor.image, model->materials[1].baseColor.image);
}

// glTF 2.0, 3.8.3: the colour space of a file is ignored; who exported a wide one learns it.
TEST_F(GltfImages, AColourSpaceOfAFileIsNamedWhereItHoldsColours) {
    Bytes wide = png(100);
    Bytes chunk;
    appendPngChunk(chunk, "cICP", std::array{ std::byte{ 12 }, std::byte{ 13 }, std::byte{ 0 }, std::byte{ 1 } });
    wide.insert(wide.begin() + 33, chunk.begin(), chunk.end()); // behind the header
    put(folder / "wide.png", wide);
    TestFile file = manyMaterials(1);
    file.root["images"].push_back({ { "uri", "wide.png" } });
    const auto model = load(file);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->images[0].data[0], std::byte{ 100 });
    EXPECT_THAT(model->warnings, testing::ElementsAre(HasSubstr(
                                         "images[0] wide.png declares CICP primaries 12 and transfer characteristics "
                                         "13, which glTF ignores")));
    Json& material = file.root["materials"][0];
    material["normalTexture"] = material["pbrMetallicRoughness"]["baseColorTexture"];
    material.erase("pbrMetallicRoughness");
    const auto bumps = load(file);
    ASSERT_TRUE(bumps) << bumps.error().message;
    EXPECT_TRUE(bumps->warnings.empty()) << bumps->warnings.front();
}

// Nine images of 16384 x 16384 would take 9 GiB; the file has a kilobyte.
TEST_F(GltfImages, PicturesBeyondTheBudgetAreRefusedBeforeTheyAreDecoded) {
    TestFile file = manyMaterials(9);
    for (uint32_t i = 0; i < 9; ++i) {
        Bytes bytes = pngHeader(16384);
        bytes.push_back(std::byte(i)); // distinct
        file.root["images"].push_back({ { "bufferView", file.addView(bytes) }, { "mimeType", "image/png" } });
    }
    const auto model = load(file, { .name = "bomb.glb" });
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(model.error().message, "bomb.glb: images: the 9 textures have 2415919104 pixels, more than 2147483648; "
                                     "use smaller ones");
}

TEST_F(GltfImages, LinksThatLeaveTheFolderAreFollowedOnlyWhereThatIsAllowed) {
    put(above / "outside.png", png(100));
    put(folder / "inside.png", png(50));
    fs::create_symlink("../outside.png", folder / "leads-out.png");
    fs::create_symlink("inside.png", folder / "stays.png");
    fs::create_directory_symlink("..", folder / "up");
    TestFile file = manyMaterials(1);
    for (const char* uri : { "leads-out.png", "up/outside.png" }) {
        file.root["images"] = { { { "uri", uri } } };
        const auto model = load(file);
        ASSERT_FALSE(model) << uri;
        EXPECT_EQ(model.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(model.error().message, HasSubstr("images[0]: '" + std::string(uri) + "' lies outside the folder"));
        EXPECT_TRUE(load(file, { .files = FilesFrom::Anywhere })) << uri;
    }
    for (std::string const& uri : { std::string("../outside.png"), (above / "outside.png").string() }) {
        file.root["images"] = { { { "uri", uri } } };
        EXPECT_FALSE(load(file)) << uri;
        EXPECT_TRUE(load(file, { .files = FilesFrom::Anywhere })) << uri;
    }
    file.root["images"] = { { { "uri", "stays.png" } } };
    EXPECT_TRUE(load(file));
}

TEST_F(GltfImages, BuffersBehindLinksStayInTheFolderToo) {
    put(above / "outside.bin", Bytes(36));
    fs::create_symlink("../outside.bin", folder / "data.bin");
    TestFile file = TestFile::triangle();
    file.root["buffers"] = { { { "byteLength", 36 }, { "uri", "data.bin" } } };
    EXPECT_THAT(load(file).error().message, HasSubstr("buffers[0]: 'data.bin' lies outside the folder"));
    EXPECT_TRUE(load(file, { .files = FilesFrom::Anywhere }));
}

TEST_F(GltfImages, AUriWithAZeroByteIsNamedAsSuch) {
    TestFile file = manyMaterials(1);
    file.root["images"] = { { { "uri", "a%00.png" } } };
    EXPECT_THAT(load(file).error().message, HasSubstr("images[0]: the path 'a' has a zero byte"));
}

TEST_F(GltfImages, APngThatIsCutShortIsNamedAsSuch) {
    Bytes bytes = png(100);
    TestFile file = manyMaterials(1);
    file.root["images"] = { { { "uri", "cut.png" } } };
    for (const size_t size : { bytes.size() - 1, bytes.size() - 13, bytes.size() / 2, size_t(34) }) {
        put(folder / "cut.png", Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
        const auto model = load(file);
        if (model) continue; // all pixels were there
        EXPECT_THAT(model.error().message, HasSubstr("images[0] cut.png' cannot be decoded: the file is cut short"));
    }
    put(folder / "cut.png", Bytes(bytes.begin(), bytes.begin() + 40));
    EXPECT_FALSE(load(file));
}

} // namespace
} // namespace filament_core::assets::test
