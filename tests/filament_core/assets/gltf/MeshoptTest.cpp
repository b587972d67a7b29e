// SPDX-License-Identifier: Apache-2.0
// KHR_meshopt_compression and EXT_meshopt_compression: generated streams, the examples of the specification, filters
// beside its formulas, damage, and the rules in which the two extensions differ.
#include "filament_core/assets/gltf/Meshopt.h"
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/assets/gltf/MeshoptWriter.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets::test {
namespace {

using testing::HasSubstr;

constexpr size_t kCounts[] = { 0, 1, 2, 15, 16, 17, 31, 32, 255, 256, 257, 511, 513, 1000 };

MeshoptSource sourceOf(MeshoptMode mode, size_t stride, size_t count, MeshoptFilter filter = MeshoptFilter::None) {
    return { .byteStride = stride, .count = count, .mode = mode, .filter = filter, .isKhr = true };
}

struct Decoded {
    Bytes bytes;
    std::string error;
};

Decoded decode(MeshoptSource const& source, std::span<const std::byte> stream) {
    Diagnostics diagnostics;
    const Bytes exact(stream.begin(), stream.end()); // so that a sanitizer sees every read beyond it
    Decoded decoded{ decodeMeshopt(source, exact, "bufferViews[7]", diagnostics), "" };
    if (!diagnostics.ok()) decoded.error = diagnostics.error().message;
    return decoded;
}

template <class T>
Bytes bytesOf(std::vector<T> const& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return { bytes.begin(), bytes.end() };
}

/// Small steps, constants and noise, by byte.
Bytes elementsOf(MeshoptWriter& writer, size_t stride, size_t count) {
    Bytes elements(stride * count);
    for (size_t k = 0; k < stride; ++k) {
        const uint32_t kind = writer.below(5);
        uint32_t value = writer.below(256);
        for (size_t i = 0; i < count; ++i) {
            if (kind == 1) value += writer.below(3) - 1;
            if (kind == 2) value += writer.below(40) - 20;
            if (kind == 3) value = writer.below(256);
            if (kind == 4 && writer.below(20) == 0) value = writer.below(256);
            elements[i * stride + k] = std::byte(value & 255);
        }
    }
    return elements;
}

struct Stream {
    MeshoptSource source;
    Bytes bytes, elements;
};

Bytes indexBytes(std::vector<uint32_t> const& indices, size_t stride) {
    return stride == 4 ? bytesOf(indices) : bytesOf(std::vector<uint16_t>(indices.begin(), indices.end()));
}

/// One of every kind: attributes in both versions, triangles, indices.
std::vector<Stream> streamsOf(uint32_t seed, size_t stride, size_t count) {
    MeshoptWriter writer(seed);
    std::vector<Stream> streams;
    const Bytes elements = elementsOf(writer, stride, count);
    for (const uint32_t version : { 0u, 1u }) {
        streams.push_back({ sourceOf(MeshoptMode::Attributes, stride, count),
                            writer.attributes(elements, stride, version), elements });
    }
    const size_t indexStride = 2 + 2 * (seed % 2);
    std::vector<uint32_t> corners, indices(count);
    const Bytes triangles = writer.triangles(count, corners);
    streams.push_back(
            { sourceOf(MeshoptMode::Triangles, indexStride, count * 3), triangles, indexBytes(corners, indexStride) });
    for (uint32_t& index : indices) index = writer.below(1u << (1 + writer.below(29)));
    streams.push_back({ sourceOf(MeshoptMode::Indices, indexStride, count), writer.indices(indices),
                        indexBytes(indices, indexStride) });
    return streams;
}

TEST(Meshopt, DecodesGeneratedStreamsOfAllModesStridesAndCounts) {
    uint32_t seed = 0;
    for (size_t stride = 4; stride <= 256; stride += 4) {
        for (const size_t count : kCounts) {
            for (Stream const& stream : streamsOf(++seed, stride, count)) {
                const Decoded decoded = decode(stream.source, stream.bytes);
                ASSERT_EQ(decoded.error, "") << "stride " << stride << ", count " << count;
                ASSERT_TRUE(decoded.bytes == stream.elements) << "stride " << stride << ", count " << count << ", mode "
                                                              << static_cast<int>(stream.source.mode);
            }
        }
    }
}

TEST(Meshopt, DecodesTheExamplesOfTheSpecification) {
    // "For a complete example, assuming 4-bit sentinel coding": in version 0 that is header code 2.
    Bytes stream{ std::byte{ 0xA0 }, std::byte{ 2 } };
    for (const int byte : { 0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5 })
        stream.push_back(std::byte(byte));
    stream.resize(stream.size() + 3 + 32); // three planes of zeros, the tail
    const Decoded decoded = decode(sourceOf(MeshoptMode::Attributes, 4, 16), stream);
    ASSERT_EQ(decoded.error, "");
    int value = 0, i = 0;
    for (const int delta : { -1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0 }) {
        value += delta;
        EXPECT_EQ(std::to_integer<int>(decoded.bytes[static_cast<size_t>(i++) * 4]), value & 255);
    }
    // "Unsigned LEB128": 0x7f and 0x201 as deltas of the second baseline. The third example of the text, 0xff 0xa0
    // 0x05 for 0x1fd005, has the bytes of the number in the other order than the second and every encoder: it is
    // 0x1507f.
    Bytes numbers;
    for (const int byte : { 0xD1, 0x7f, 0x81, 0x04, 0xff, 0xa0, 0x05, 0, 0, 0, 0 }) numbers.push_back(std::byte(byte));
    const uint32_t first = ~(0x7fu >> 2), second = first + (0x201u >> 2), third = second + ~(0x1507fu >> 2);
    EXPECT_EQ(decode(sourceOf(MeshoptMode::Indices, 4, 3), numbers).bytes,
              bytesOf(std::vector<uint32_t>{ first, second, third }));
}

// ------------------------------------------------------------------------------------------------ filters

/// Encoded elements come from a stream without compression; what they become is the formula of appendix B in double.
template <class T>
std::vector<T> filtered(MeshoptFilter filter, std::vector<T> const& encoded, size_t stride) {
    const Bytes bytes = bytesOf(encoded);
    const Decoded decoded = decode(sourceOf(MeshoptMode::Attributes, stride, bytes.size() / stride, filter),
                                   MeshoptWriter(1).attributes(bytes, stride, 1));
    EXPECT_EQ(decoded.error, "");
    std::vector<T> values(decoded.bytes.size() / sizeof(T));
    std::memcpy(values.data(), decoded.bytes.data(), decoded.bytes.size());
    return values;
}

template <class T>
void checkOctahedral(int bits) {
    const int one = (1 << (bits - 1)) - 1;
    std::vector<T> encoded;
    MeshoptWriter writer(static_cast<uint32_t>(bits));
    for (int i = 0; i < 1003; ++i) {
        const auto coordinate = [&] { return static_cast<T>(int(writer.below(uint32_t(2 * one + 1))) - one); };
        encoded.insert(encoded.end(), { coordinate(), coordinate(), static_cast<T>(one), static_cast<T>(i) });
    }
    const std::vector<T> decoded = filtered(MeshoptFilter::Octahedral, encoded, sizeof(T) * 4);
    for (size_t i = 0; i < encoded.size(); i += 4) {
        double x = double(encoded[i]) / one, y = double(encoded[i + 1]) / one;
        const double z = 1 - std::abs(x) - std::abs(y), t = std::min(z, 0.0);
        x -= std::copysign(t, x);
        y -= std::copysign(t, y);
        const double scale = std::numeric_limits<T>::max() / std::sqrt(x * x + y * y + z * z);
        ASSERT_NEAR(decoded[i], x * scale, 0.505) << bits;
        ASSERT_NEAR(decoded[i + 1], y * scale, 0.505) << bits;
        ASSERT_NEAR(decoded[i + 2], z * scale, 0.505) << bits;
        ASSERT_EQ(decoded[i + 3], encoded[i + 3]);
    }
}

TEST(Meshopt, OctahedralVectorsAreThoseOfTheFormula) {
    for (int bits = 2; bits <= 16; ++bits) {
        if (bits <= 8) checkOctahedral<int8_t>(bits);
        checkOctahedral<int16_t>(bits);
    }
}

TEST(Meshopt, QuaternionsAreThoseOfTheFormula) {
    for (int bits = 4; bits <= 16; ++bits) {
        const int one = (1 << (bits - 1)) - 1;
        std::vector<int16_t> encoded;
        MeshoptWriter writer(static_cast<uint32_t>(bits));
        for (int i = 0; i < 1003; ++i) {
            for (int k = 0; k < 3; ++k) {
                encoded.push_back(static_cast<int16_t>(int(writer.below(uint32_t(2 * one + 1))) - one));
            }
            encoded.push_back(static_cast<int16_t>((one & ~3) | (i & 3)));
        }
        const std::vector<int16_t> decoded = filtered(MeshoptFilter::Quaternion, encoded, 8);
        for (size_t i = 0; i < encoded.size(); i += 4) {
            const double scale = std::sqrt(0.5) / (encoded[i + 3] | 3);
            const double x = encoded[i] * scale, y = encoded[i + 1] * scale, z = encoded[i + 2] * scale;
            const double w = std::sqrt(std::max(0.0, 1 - x * x - y * y - z * z));
            const size_t largest = encoded[i + 3] & 3;
            // of w, whose square is a small difference, float gives fewer bits; the specification allows one unit
            ASSERT_NEAR(decoded[i + largest], w * 32767, w < 0.2 ? 40 : 1) << bits;
            ASSERT_NEAR(decoded[i + (largest + 1) % 4], x * 32767, 0.51) << bits;
            ASSERT_NEAR(decoded[i + (largest + 2) % 4], y * 32767, 0.51) << bits;
            ASSERT_NEAR(decoded[i + (largest + 3) % 4], z * 32767, 0.51) << bits;
        }
    }
}

TEST(Meshopt, ExponentialFloatsAreExact) {
    std::vector<int32_t> encoded;
    MeshoptWriter writer(1);
    for (int e = -100; e <= 100; ++e) {
        for (const int m : { 0, 1, -1, 0x7FFFFF, -0x800000, int(writer.below(0x800000)) }) {
            encoded.push_back(static_cast<int32_t>(uint32_t(e) << 24 | (uint32_t(m) & 0xFFFFFF)));
        }
    }
    const std::vector<int32_t> decoded = filtered(MeshoptFilter::Exponential, encoded, 4);
    for (size_t i = 0; i < encoded.size(); ++i) {
        const auto m = static_cast<int32_t>(uint32_t(encoded[i]) << 8) >> 8;
        ASSERT_EQ(std::bit_cast<float>(decoded[i]), std::ldexp(float(m), encoded[i] >> 24)) << encoded[i];
    }
    EXPECT_EQ(filtered(MeshoptFilter::Exponential, std::vector<int32_t>(5, 3), 20)[4], std::bit_cast<int32_t>(3.0f));
}

template <class T>
void checkColors(uint32_t bits) {
    const uint32_t all = (1u << bits) - 1;
    std::vector<T> encoded;
    std::vector<std::array<uint32_t, 4>> colors;
    MeshoptWriter writer(bits);
    for (int i = 0; i < 1003; ++i) { // luma and chroma that stand for integers of K bits
        const int r = int(writer.below(all + 1)), g = int(writer.below(all + 1)), b = int(writer.below(all + 1));
        const int co = (r - b) / 2, t = b + co, cg = (g - t) / 2, y = t + cg;
        const uint32_t a = writer.below((all >> 1) + 1);
        const std::array<int, 3> rgb{ y + co - cg, y + cg, y - co - cg };
        if (std::ranges::any_of(rgb, [&](int c) { return c < 0 || c > int(all); })) continue;
        encoded.insert(encoded.end(), { static_cast<T>(y), static_cast<T>(co), static_cast<T>(cg),
                                        static_cast<T>(a | ((all >> 1) + 1)) });
        colors.push_back({ uint32_t(rgb[0]), uint32_t(rgb[1]), uint32_t(rgb[2]), a << 1 | (a & 1) });
    }
    ASSERT_GT(colors.size(), 100u);
    const std::vector<T> decoded = filtered(MeshoptFilter::Color, encoded, sizeof(T) * 4);
    for (size_t i = 0; i < encoded.size(); ++i) {
        const double exact = double(colors[i / 4][i % 4]) * std::numeric_limits<T>::max() / all;
        ASSERT_NEAR(decoded[i], exact, 0.51) << bits << " bits, component " << i;
    }
}

TEST(Meshopt, ColorsAreThoseOfTheFormula) {
    for (uint32_t bits = 2; bits <= 16; ++bits) {
        if (bits <= 8) checkColors<uint8_t>(bits);
        checkColors<uint16_t>(bits);
    }
}

/// "The behavior of decoding values outside of that range is unspecified": any bits, but no undefined behaviour.
TEST(Meshopt, FiltersTakeAnyBits) {
    MeshoptWriter writer(5);
    for (const MeshoptFilter filter :
         { MeshoptFilter::Octahedral, MeshoptFilter::Quaternion, MeshoptFilter::Exponential, MeshoptFilter::Color }) {
        for (const size_t stride : { 4u, 8u }) {
            if (filter == MeshoptFilter::Quaternion && stride == 4) continue;
            std::vector<uint8_t> any(stride * 1000, 0);
            for (size_t i = stride * 10; i < any.size(); ++i) any[i] = static_cast<uint8_t>(writer.below(256));
            EXPECT_EQ(filtered(filter, any, stride).size(), any.size());
        }
    }
}

// ------------------------------------------------------------------------------------------------- damage

TEST(Meshopt, StreamsThatAreCutOrLongerAreRefused) {
    for (const size_t count : { 1u, 17u, 40u }) {
        for (Stream const& stream : streamsOf(static_cast<uint32_t>(count), 12, count)) {
            for (size_t size = 0; size < stream.bytes.size(); ++size) {
                EXPECT_NE(decode(stream.source, std::span(stream.bytes).first(size)).error, "") << size;
            }
            Bytes longer = stream.bytes;
            longer.push_back(std::byte{});
            EXPECT_NE(decode(stream.source, longer).error, "");
            for (const int header : { 0x00, 0xA2, 0xE0, 0xD0, 0xE2, 0xD2, 0xF1 }) {
                Bytes other = stream.bytes;
                other[0] = std::byte(header);
                EXPECT_THAT(decode(stream.source, other).error,
                            AllOf(HasSubstr("bufferViews[7]: the meshopt stream is broken: its first byte"),
                                  HasSubstr("compress the model again")));
            }
        }
    }
}

TEST(Meshopt, DamageIsRefusedOrReadWhole) {
    for (uint32_t round = 0; round < 300; ++round) {
        MeshoptWriter random(round);
        for (Stream const& stream : streamsOf(round, 4 + 4 * random.below(20), random.below(300))) {
            Bytes damaged = stream.bytes;
            for (uint32_t i = 1 + random.below(4); i > 0; --i) {
                damaged[1 + random.below(static_cast<uint32_t>(damaged.size() - 1))] = std::byte(random.below(256));
            }
            const Decoded decoded = decode(stream.source, damaged);
            EXPECT_EQ(decoded.bytes.size(), decoded.error.empty() ? stream.elements.size() : 0);
        }
    }
}

std::string errorOf(MeshoptMode mode, size_t stride, size_t count, std::initializer_list<int> bytes, size_t tail) {
    Bytes stream;
    for (const int byte : bytes) stream.push_back(std::byte(byte));
    stream.resize(stream.size() + tail);
    return decode(sourceOf(mode, stride, count), stream).error;
}

TEST(Meshopt, TailsFifosAndNumbersOutOfRangeAreNamed) {
    constexpr auto kTriangles = MeshoptMode::Triangles, kIndices = MeshoptMode::Indices;
    const Bytes sound = MeshoptWriter(1).attributes(Bytes(4), 4, 1);
    for (const int mode : { 3, 15, 0x10, 0x21, 0xF3 }) {
        Bytes stream = sound;
        stream.back() = std::byte(mode);
        EXPECT_THAT(decode(sourceOf(MeshoptMode::Attributes, 4, 1), stream).error, HasSubstr("unknown channel mode"));
    }
    EXPECT_EQ(errorOf(kTriangles, 2, 3, { 0xE1, 0xF0 }, 16), "") << "0, 1, 2";
    EXPECT_THAT(errorOf(kTriangles, 2, 3, { 0xE1, 0x00 }, 16), HasSubstr("names an edge or vertex")) << "no edge yet";
    EXPECT_THAT(errorOf(kTriangles, 2, 6, { 0xE1, 0xF0, 0x30 }, 16), HasSubstr("names an edge or vertex"));
    EXPECT_THAT(errorOf(kTriangles, 2, 6, { 0xE1, 0xF0, 0x03 }, 16), HasSubstr("names an edge or vertex"));
    EXPECT_EQ(errorOf(kTriangles, 2, 6, { 0xE1, 0xF0, 0x22 }, 16), "") << "the oldest edge and vertex";
    EXPECT_THAT(errorOf(kTriangles, 2, 3, { 0xE1, 0xFF, 0xFF, 128, 128, 128, 128, 128, 0, 0, 0 }, 16),
                HasSubstr("the meshopt stream is broken"));
    for (const size_t at : { 0u, 13u, 14u, 15u }) {
        std::vector<uint8_t> stream(1 + 1 + 16);
        stream[0] = 0xE1;
        stream[1] = 0xF0;
        stream[2 + at] = at < 14 ? 0x0F : 0x01;
        EXPECT_THAT(decode(sourceOf(kTriangles, 4, 3), bytesOf(stream)).error, HasSubstr("its tail is not a table"));
    }
    EXPECT_THAT(errorOf(kIndices, 4, 1, { 0xD1, 255, 255, 255, 255, 255, 1 }, 4), HasSubstr("more than five bytes"));
    EXPECT_EQ(errorOf(kIndices, 4, 1, { 0xD1, 255, 255, 255, 255, 127 }, 4), "") << "bits beyond 32 are ignored";
}

// -------------------------------------------------------------------------------------- the two extensions

/// A triangle whose positions are compressed.
TestFile compressedTriangle(const char* extension, uint32_t version) {
    TestFile file = TestFile::triangle();
    const Bytes stream = MeshoptWriter(1).attributes(file.binary, 12, version);
    const size_t view = file.addView(stream);
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = { extension };
    file.root["bufferViews"][0]["extensions"][extension] = { { "buffer", 0 },
                                                             { "byteOffset",
                                                               file.root["bufferViews"][view]["byteOffset"] },
                                                             { "byteLength", stream.size() },
                                                             { "byteStride", 12 },
                                                             { "count", 3 },
                                                             { "mode", "ATTRIBUTES" } };
    return file;
}

std::string refusal(TestFile const& file) {
    const Result<ModelData> model = file.load();
    return model ? "" : model.error().message;
}

TEST(Meshopt, VersionOneAndColorsNeedTheExtensionOfKhronos) {
    EXPECT_EQ(refusal(compressedTriangle("EXT_meshopt_compression", 0)), "");
    EXPECT_EQ(refusal(compressedTriangle("KHR_meshopt_compression", 0)), "");
    EXPECT_EQ(refusal(compressedTriangle("KHR_meshopt_compression", 1)), "");
    EXPECT_THAT(refusal(compressedTriangle("EXT_meshopt_compression", 1)),
                HasSubstr("bufferViews[0]: the meshopt stream is broken: its codec version 1 needs "
                          "KHR_meshopt_compression"));
    TestFile file = compressedTriangle("EXT_meshopt_compression", 0);
    Json& view = file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
    view.update({ { "filter", "COLOR" }, { "byteStride", 4 }, { "count", 9 } });
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: the filter COLOR needs KHR_meshopt_compression"));
}

TEST(Meshopt, AViewOfBothExtensionsIsThatOfKhronosWithAWarning) {
    TestFile file = compressedTriangle("KHR_meshopt_compression", 1);
    file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = { { "buffer", 7 } };
    const Result<ModelData> model = file.load();
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, testing::ElementsAre(HasSubstr("bufferViews[0]: EXT_meshopt_compression is ignored")));
}

TEST(Meshopt, DescriptionsThatBreakARuleNameIt) {
    using enum MeshoptFilter;
    const auto error = [](MeshoptMode mode, size_t stride, size_t count, MeshoptFilter filter) {
        return decode(sourceOf(mode, stride, count, filter), Bytes(1000)).error;
    };
    for (const size_t stride : { 0u, 2u, 6u, 260u }) {
        EXPECT_THAT(error(MeshoptMode::Attributes, stride, 3, None), HasSubstr("must be a multiple of 4"));
    }
    EXPECT_THAT(error(MeshoptMode::Attributes, 12, 3, Octahedral), HasSubstr("byteStride of 4 or 8"));
    EXPECT_THAT(error(MeshoptMode::Attributes, 16, 3, Color), HasSubstr("byteStride of 4 or 8"));
    EXPECT_THAT(error(MeshoptMode::Attributes, 4, 3, Quaternion), HasSubstr("byteStride of 8"));
    EXPECT_THAT(error(MeshoptMode::Triangles, 8, 3, None), HasSubstr("must be 2 or 4, not 8"));
    EXPECT_THAT(error(MeshoptMode::Triangles, 2, 4, None), HasSubstr("divisible by 3"));
    EXPECT_THAT(error(MeshoptMode::Indices, 4, 4, Exponential), HasSubstr("only the mode ATTRIBUTES has filters"));
}

/// Of gltfpack 1.3: both are quantised alike, so that they are the same numbers.
TEST(Meshopt, TheFoxInVersionOneIsTheFoxInVersionZero) {
    SKIP_WITHOUT_FAULT_FILES();
    jobs::JobSystem jobs;
    const GltfOptions options{ .deformation = GltfDeformation::Kept };
    const Result<ModelData> one = loadGltf(faultFile("meshopt_khr_v1.glb"), jobs, options);
    const Result<ModelData> zero = loadGltf(faultFile("meshopt_ext_v0_same_model.glb"), jobs, options);
    ASSERT_TRUE(one) << one.error().message;
    ASSERT_TRUE(zero) << zero.error().message;
    ASSERT_EQ(one->meshes.size(), zero->meshes.size());
    for (size_t i = 0; i < one->meshes.size(); ++i) {
        ASSERT_EQ(one->meshes[i].primitives.size(), zero->meshes[i].primitives.size());
        for (size_t k = 0; k < one->meshes[i].primitives.size(); ++k) {
            PrimitiveData const &a = one->meshes[i].primitives[k], &b = zero->meshes[i].primitives[k];
            EXPECT_GT(a.vertexCount, 100u);
            EXPECT_TRUE(a.vertices == b.vertices);
            EXPECT_TRUE(a.indices == b.indices);
        }
    }
    ASSERT_EQ(one->animations.size(), zero->animations.size());
    EXPECT_EQ(one->animations.size(), 3u);
    for (size_t i = 0; i < one->animations.size(); ++i) {
        ASSERT_EQ(one->animations[i].samplers.size(), zero->animations[i].samplers.size());
        for (size_t k = 0; k < one->animations[i].samplers.size(); ++k) {
            EXPECT_EQ(one->animations[i].samplers[k].times, zero->animations[i].samplers[k].times);
            EXPECT_EQ(one->animations[i].samplers[k].values, zero->animations[i].samplers[k].values);
        }
    }
}

} // namespace
} // namespace filament_core::assets::test
