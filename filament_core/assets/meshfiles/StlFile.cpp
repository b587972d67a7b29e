// SPDX-License-Identifier: Apache-2.0
// 3D Systems, "StereoLithography Interface Specification" (1989).
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/assets/meshfiles/MeshWords.h"

#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr size_t kHead = 80, kTriangle = 50;

Result<MeshFile> readBinary(std::span<const std::byte> bytes, uint32_t count) {
    MeshFilePart part;
    part.positions.reserve(size_t{ count } * 3);
    for (uint32_t i = 0; i < count; ++i) {
        std::array<float, 9> corners; // NOLINT(cppcoreguidelines-pro-type-member-init): copied into
        std::memcpy(corners.data(), bytes.data() + kHead + 4 + i * kTriangle + 12, sizeof corners); // behind the normal
        for (const float number : corners)
            if (!std::isfinite(number)) return fail(ErrorCode::Corrupt, "triangle {}: a corner is not finite", i);
        for (size_t c = 0; c < 9; c += 3) part.positions.push_back({ corners[c], corners[c + 1], corners[c + 2] });
    }
    return MeshFile{ .parts = { std::move(part) } };
}

Result<MeshFile> readText(std::string_view text) {
    MeshFilePart part;
    for (size_t line = 1; !text.empty(); ++line) {
        std::string_view words = takeLine(text);
        if (takeWord(words) != "vertex") continue; // facet, outer loop and their ends
        float3 position(0.0f);
        for (int i = 0; i < 3; ++i) {
            const std::optional<float> number = floatOf(takeWord(words));
            if (!number) return fail(ErrorCode::Corrupt, "line {}: a vertex needs three finite numbers", line);
            position[i] = *number;
        }
        part.positions.push_back(position);
    }
    if (part.positions.size() % 3 != 0)
        return fail(ErrorCode::Corrupt, "{} vertices are no triangles", part.positions.size());
    return MeshFile{ .parts = { std::move(part) } };
}

} // namespace

Result<MeshFile> readStl(std::span<const std::byte> bytes) {
    uint32_t count = 0;
    const bool hasHead = bytes.size() >= kHead + 4;
    if (hasHead) std::memcpy(&count, bytes.data() + kHead, 4);
    const uint64_t wanted = kHead + 4 + uint64_t{ count } * kTriangle;
    // Binary files may begin with "solid", too: their size says what they are.
    if (hasHead && wanted == bytes.size()) return readBinary(bytes, count);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (trimmed(text.substr(0, 512)).starts_with("solid")) return readText(text);
    if (hasHead && wanted < bytes.size()) return readBinary(bytes, count);
    return fail(ErrorCode::Corrupt, "neither text (\"solid\") nor {} triangles in {} bytes", count, bytes.size());
}

} // namespace filament_core::assets
