// SPDX-License-Identifier: Apache-2.0
/// GltfTestFile: small glTF files written by tests, and access to the loaded result.
#pragma once

#include "filament_core/assets/gltf/GltfLoader.h"
#include "shaders/interface/ShaderInterface.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

inline Bytes glbFrom(std::string text, Bytes binary) {
    text.resize((text.size() + 3) & ~size_t{ 3 }, ' ');
    binary.resize((binary.size() + 3) & ~size_t{ 3 });
    Bytes file(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    const auto put = [&](size_t at, uint32_t word) { std::memcpy(&file[at], &word, 4); };
    put(0, 0x46546C67), put(4, 2), put(8, static_cast<uint32_t>(file.size()));
    put(12, static_cast<uint32_t>(text.size())), put(16, 0x4E4F534A);
    std::memcpy(&file[20], text.data(), text.size());
    if (!binary.empty()) {
        put(20 + text.size(), static_cast<uint32_t>(binary.size())), put(24 + text.size(), 0x004E4942);
        std::memcpy(&file[28 + text.size()], binary.data(), binary.size());
    }
    return file;
}

enum Component : int { kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126 };

/// A file with one buffer, one scene, one node, one mesh; tests change `root` as they like.
struct TestFile {
    Json root = Json::parse(R"({ "asset": { "version": "2.0" }, "scenes": [ { "nodes": [ 0 ] } ],
        "nodes": [ { "mesh": 0 } ], "meshes": [ { "primitives": [ { "attributes": {} } ] } ] })");
    Bytes binary;

    size_t addView(std::span<const std::byte> bytes, size_t stride = 0) {
        binary.resize((binary.size() + 3) & ~size_t{ 3 });
        Json view{ { "buffer", 0 }, { "byteOffset", binary.size() }, { "byteLength", bytes.size() } };
        if (stride > 0) view["byteStride"] = stride;
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        root["bufferViews"].push_back(view);
        return root["bufferViews"].size() - 1;
    }

    size_t addAccessor(Json accessor) {
        root["accessors"].push_back(std::move(accessor));
        return root["accessors"].size() - 1;
    }

    template <class T>
    size_t add(std::vector<T> const& values, Component component, const char* type, size_t perElement,
               bool normalized = false) {
        const size_t view = addView(std::as_bytes(std::span(values)));
        return addAccessor({ { "bufferView", view },
                             { "componentType", int(component) },
                             { "count", values.size() / perElement },
                             { "type", type },
                             { "normalized", normalized } });
    }

    Json& primitive() { return root["meshes"][0]["primitives"][0]; }

    template <class T>
    void attribute(const char* name, std::vector<T> const& values, Component component, const char* type,
                   size_t perElement, bool normalized = false) {
        primitive()["attributes"][name] = add(values, component, type, perElement, normalized);
    }
    void positions(std::vector<float> const& values) { attribute("POSITION", values, kFloat, "VEC3", 3); }
    void normals(std::vector<float> const& values) { attribute("NORMAL", values, kFloat, "VEC3", 3); }
    void indices(std::vector<uint16_t> const& values) { primitive()["indices"] = add(values, kUShort, "SCALAR", 1); }

    /// A unit right triangle in the xy plane, facing +z.
    static TestFile triangle() {
        TestFile file;
        file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
        return file;
    }

    Bytes glb() const {
        Json finished = root;
        if (!binary.empty() && !finished.contains("buffers"))
            finished["buffers"] = { { { "byteLength", binary.size() } } };
        return glbFrom(finished.dump(), binary);
    }

    Result<ModelData> load(GltfOptions const& options = {}) const {
        jobs::JobSystem jobs({ .workers = 0 });
        return loadGltfFromMemory(glb(), ".", jobs, options);
    }
};

/// Loads or fails the test.
inline ModelData loaded(TestFile const& file) {
    Result<ModelData> model = file.load();
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    return std::move(*model);
}

inline PrimitiveData onlyPrimitive(TestFile const& file) {
    ModelData model = loaded(file);
    if (model.meshes.size() != 1 || model.meshes[0].primitives.size() != 1) {
        ADD_FAILURE() << "expected one primitive";
        return {};
    }
    return std::move(model.meshes[0].primitives[0]);
}

inline backend::VertexFormat formatOf(PrimitiveData const& primitive, uint8_t location) {
    for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
        if (primitive.layout.attributes[i].location == location) return primitive.layout.attributes[i].format;
    }
    return backend::VertexFormat::None;
}

/// What the shader reads: floats, normalised integers converted, missing components (0, 0, 0, 1).
inline float4 vertexValue(PrimitiveData const& primitive, uint8_t location, uint32_t vertex) {
    using backend::VertexFormat;
    float4 value(0, 0, 0, 1);
    for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
        backend::VertexAttribute const& attribute = primitive.layout.attributes[i];
        if (attribute.location != location) continue;
        std::byte const* bytes =
                &primitive.vertices[size_t{ vertex } * primitive.layout.buffers[0].stride + attribute.offset];
        const auto read = [&]<class T>(T, float one, int count) {
            for (int c = 0; c < count; ++c) {
                T component;
                std::memcpy(&component, bytes + static_cast<size_t>(c) * sizeof(T), sizeof(T));
                value[c] = std::max(static_cast<float>(component) / one, std::is_same_v<T, float> ? -1e38f : -1.0f);
            }
        };
        switch (attribute.format) {
        case VertexFormat::Float2:
            read(float{}, 1, 2);
            break;
        case VertexFormat::Float3:
            read(float{}, 1, 3);
            break;
        case VertexFormat::Float4:
            read(float{}, 1, 4);
            break;
        case VertexFormat::Byte4N:
            read(int8_t{}, 127, 4);
            break;
        case VertexFormat::UByte4N:
            read(uint8_t{}, 255, 4);
            break;
        case VertexFormat::Short2N:
            read(int16_t{}, 32767, 2);
            break;
        case VertexFormat::UShort2N:
            read(uint16_t{}, 65535, 2);
            break;
        case VertexFormat::Short4N:
            read(int16_t{}, 32767, 4);
            break;
        case VertexFormat::UShort4N:
            read(uint16_t{}, 65535, 4);
            break;
        default:
            ADD_FAILURE() << "a format that the shader does not read as floats";
            break;
        }
    }
    return value;
}

inline float3 positionOf(PrimitiveData const& primitive, uint32_t vertex) {
    return float3(vertexValue(primitive, shader::kAttributePosition, vertex));
}

inline std::vector<uint32_t> indicesOf(PrimitiveData const& primitive) {
    std::vector<uint32_t> indices(primitive.indexCount);
    for (size_t i = 0; i < indices.size(); ++i) {
        uint16_t narrow = 0;
        if (primitive.indexFormat == backend::IndexFormat::UInt16) {
            std::memcpy(&narrow, &primitive.indices[i * 2], 2);
            indices[i] = narrow;
        } else {
            std::memcpy(&indices[i], &primitive.indices[i * 4], 4);
        }
    }
    return indices;
}

/// The corners of the triangles (or lines, or points) as positions.
inline std::vector<float3> cornersOf(PrimitiveData const& primitive) {
    std::vector<float3> corners;
    for (const uint32_t index : indicesOf(primitive)) corners.push_back(positionOf(primitive, index));
    return corners;
}

} // namespace filament_core::assets::test
