// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/interiors/WithoutMaterial.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>

namespace filament_core::accuracy {
namespace {

using nlohmann::json;

// glTF 2.0, 4.4: a header of three words, then chunks, each of its length, its type and its bytes; JSON is the first.
constexpr size_t kHeader = 12, kChunkHeader = 8;

uint32_t wordAt(std::span<const std::byte> bytes, size_t at) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    return word;
}

void setWord(std::vector<std::byte>& bytes, size_t at, size_t value) {
    const auto word = static_cast<uint32_t>(value);
    std::memcpy(bytes.data() + at, &word, sizeof(word));
}

bool hasMaterial(json const& file, json const& node, size_t material) {
    if (!node.contains("mesh")) return false;
    for (json const& primitive : file.at("meshes").at(node.at("mesh").get<size_t>()).at("primitives")) {
        if (primitive.value("material", SIZE_MAX) == material) return true;
    }
    return false;
}

} // namespace

Result<std::vector<std::byte>> withoutMaterial(std::span<const std::byte> glb, std::string const& material) {
    const size_t begin = kHeader + kChunkHeader;
    const size_t length = glb.size() > begin ? wordAt(glb, kHeader) : 0;
    if (length == 0 || length > glb.size() - begin) return fail(ErrorCode::Corrupt, "expected a .glb");
    const std::string text(reinterpret_cast<const char*>(glb.data()) + begin, length);
    try {
        json file = json::parse(text);
        size_t index = 0;
        json const& materials = file.at("materials");
        while (index < materials.size() && materials[index].value("name", "") != material) ++index;
        if (index == materials.size()) return fail(ErrorCode::NotFound, "no material is named '{}'", material);
        for (json& node : file.at("nodes")) {
            if (hasMaterial(file, node, index)) node.erase("mesh");
        }
        file.erase("animations");
        std::string edited = file.dump();
        edited.resize((edited.size() + 3) / 4 * 4, ' ');
        std::vector<std::byte> made(glb.begin(), glb.begin() + begin);
        const auto bytes = std::as_bytes(std::span(edited.data(), edited.size()));
        made.insert(made.end(), bytes.begin(), bytes.end());
        made.insert(made.end(), glb.begin() + begin + static_cast<ptrdiff_t>(length), glb.end());
        setWord(made, 8, made.size());
        setWord(made, kHeader, edited.size());
        return made;
    } catch (json::exception const& error) {
        return fail(ErrorCode::Corrupt, "{}", error.what());
    }
}

} // namespace filament_core::accuracy
