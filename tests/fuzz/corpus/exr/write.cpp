// SPDX-License-Identifier: Apache-2.0
// Writes the files of this folder by OpenEXR itself, which the engine does not link. Not part of the build:
//   apt-get install libopenexr-dev && g++ write.cpp $(pkg-config --cflags --libs OpenEXR) -o write && ./write
// NAME.decoded.exr has the pixels that OpenEXR reads from the lossy NAME.exr, uncompressed. The test that reads
// piz_WIDTHxHEIGHT_TYPE.exr computes the pixels again.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace Imf;

struct File {
    std::string name;
    Compression compression;
    PixelType type = HALF;
    bool isPerceptual = false, hasLayers = false, isLossy = false;
    int tiles = -1; // a LevelMode
    int height = 37;
};

constexpr int kWidth = 13;

/// Waves, noise, an even corner, and a few bright spots.
float valueAt(int channel, int x, int y) {
    if (x > 8 && y < 8) return 0.25f;
    const double wave = 0.5 + 0.5 * std::sin(0.3 * x + 0.7 * channel) * std::cos(0.2 * y - 0.1 * channel);
    const double noise = (x * 7919 + y * 104729 + channel * 1299709) % 1000 * 1e-4;
    return static_cast<float>(wave + noise + ((x * 7 + y * 13 + channel) % 97 == 0 ? 40 : 0));
}

struct Planes {
    std::map<std::string, std::vector<float>> floats;
    std::map<std::string, std::vector<half>> halves;
    std::vector<unsigned> numbers;
    FrameBuffer slices;

    Planes(File const& file, std::vector<std::string> const& names) : numbers(kWidth * file.height) {
        for (size_t c = 0; c < names.size(); ++c) {
            auto& floatPlane = floats[names[c]];
            auto& halfPlane = halves[names[c]];
            for (int i = 0; i < kWidth * file.height; ++i) {
                floatPlane.push_back(valueAt(static_cast<int>(c), i % kWidth, i / kWidth));
                halfPlane.push_back(half(floatPlane.back()));
            }
            slices.insert(names[c], file.type == FLOAT
                                            ? Slice(FLOAT, reinterpret_cast<char*>(floatPlane.data()), 4, 4 * kWidth)
                                            : Slice(HALF, reinterpret_cast<char*>(halfPlane.data()), 2, 2 * kWidth));
        }
        for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<unsigned>(i / 7 * 3);
        slices.insert("id", Slice(UINT, reinterpret_cast<char*>(numbers.data()), 4, 4 * kWidth));
    }
};

void write(File const& file) {
    std::vector<std::string> names{ "R", "G", "B" };
    if (file.hasLayers) names.insert(names.end(), { "A", "Z", "lamp.B", "lamp.G", "lamp.R", "mask.Y" });
    Header header(kWidth, file.height);
    header.compression() = file.compression;
    for (std::string const& name : names) header.channels().insert(name, Channel(file.type, 1, 1, file.isPerceptual));
    if (file.hasLayers) header.channels().insert("id", Channel(UINT));
    Planes planes(file, names);
    const std::string path = file.name + ".exr";
    if (file.tiles < 0) {
        OutputFile out(path.c_str(), header);
        out.setFrameBuffer(planes.slices);
        out.writePixels(file.height);
        return;
    }
    header.setTileDescription(TileDescription(8, 12, static_cast<LevelMode>(file.tiles)));
    TiledOutputFile out(path.c_str(), header);
    out.setFrameBuffer(planes.slices);
    for (int y = 0; y < out.numYLevels(); ++y) {
        for (int x = 0; x < out.numXLevels(); ++x) {
            if (out.isValidLevel(x, y)) out.writeTiles(0, out.numXTiles(x) - 1, 0, out.numYTiles(y) - 1, x, y);
        }
    }
}

void writeDecoded(File const& file) {
    File decoded{ file.name + ".decoded", NO_COMPRESSION, file.type };
    decoded.height = file.height;
    Planes planes(decoded, { "R", "G", "B" });
    InputFile in((file.name + ".exr").c_str());
    in.setFrameBuffer(planes.slices);
    in.readPixels(0, file.height - 1);
    Header header(kWidth, file.height);
    header.compression() = NO_COMPRESSION;
    for (const char* name : { "R", "G", "B" }) header.channels().insert(name, Channel(file.type));
    OutputFile out((decoded.name + ".exr").c_str(), header);
    out.setFrameBuffer(planes.slices);
    out.writePixels(file.height);
}

/// PIZ numbers the words that occur in a block, and transforms 2^14 of them and more in another way: in blocks of 300
/// columns there are so many. Pixels are bits that count up, one in 32 of them at random.
void writePiz(int width, int height, PixelType type) {
    std::mt19937 random(5);
    const size_t bytes = type == FLOAT ? 4 : 2;
    const unsigned one = type == FLOAT ? 0x3F800000 : 0x3C00, half = type == FLOAT ? 0x3F000000 : 0x3800,
                   first = type == FLOAT ? one : 0x0400;
    std::map<std::string, std::vector<char>> planes;
    const auto add = [&](const char* name, unsigned bits) { // little-endian
        for (size_t i = 0; i < bytes; ++i) planes[name].push_back(static_cast<char>(bits >> 8 * i));
    };
    for (unsigned i = 0; i < static_cast<unsigned>(width * height); ++i) {
        const unsigned number = i % 32 == 0 ? static_cast<unsigned>(random() % 12000) : i;
        add("R", first + 2 * number);
        add("G", i % 11 == 0 ? one : half);
        add("B", first + 2 * number + 1);
    }
    Header header(width, height);
    header.compression() = PIZ_COMPRESSION;
    FrameBuffer slices;
    for (auto& [name, plane] : planes) {
        header.channels().insert(name, Channel(type));
        slices.insert(name, Slice(type, plane.data(), bytes, bytes * static_cast<size_t>(width)));
    }
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    OutputFile out(("piz_" + size + (type == HALF ? "_half.exr" : "_float.exr")).c_str(), header);
    out.setFrameBuffer(slices);
    out.writePixels(height);
}

int main() {
    const File files[] = {
        { "plain", NO_COMPRESSION },
        { "plain_float", NO_COMPRESSION, FLOAT },
        { "rle_half", RLE_COMPRESSION },
        { "rle_float", RLE_COMPRESSION, FLOAT },
        { "zips_half", ZIPS_COMPRESSION },
        { "zips_float", ZIPS_COMPRESSION, FLOAT },
        { "zip_half", ZIP_COMPRESSION },
        { "zip_float", ZIP_COMPRESSION, FLOAT },
        { "piz_half", PIZ_COMPRESSION },
        { "piz_float", PIZ_COMPRESSION, FLOAT },
        { "pxr24_half", PXR24_COMPRESSION, HALF, false, true },
        { "pxr24_float", PXR24_COMPRESSION, FLOAT, false, true, true },
        { "b44", B44_COMPRESSION, HALF, false, true, true },
        { "b44a", B44A_COMPRESSION, HALF, false, false, true },
        { "b44_perceptual", B44_COMPRESSION, HALF, true, false, true },
        { "dwaa", DWAA_COMPRESSION, HALF, false, true, true },
        { "dwaa_float", DWAA_COMPRESSION, FLOAT, false, false, true },
        { "dwaa_one_block", DWAA_COMPRESSION, FLOAT, false, false, true, -1, 32 },
        { "dwab", DWAB_COMPRESSION, HALF, true, false, true },
        { "tiled_zip", ZIP_COMPRESSION, HALF, false, true, false, ONE_LEVEL },
        { "tiled_piz_mips", PIZ_COMPRESSION, HALF, false, false, false, MIPMAP_LEVELS },
        { "tiled_dwaa_rips", DWAA_COMPRESSION, HALF, false, false, true, RIPMAP_LEVELS },
    };
    for (File const& file : files) {
        write(file);
        if (file.isLossy) writeDecoded(file);
    }
    for (const auto& [width, height] : { std::pair(1, 1), { 1, 40 }, { 200, 1 }, { 64, 64 }, { 131, 70 }, { 300, 40 } })
        for (const PixelType type : { HALF, FLOAT }) writePiz(width, height, type);
}
