// SPDX-License-Identifier: Apache-2.0
// ltcfit FILE: writes shaders/interface/LtcTable.h, the transformations of the specular lobe (docs/lights-area.md).
// Exit status 0: written; 1: the file could not be written; 2: bad command line. Takes about a minute.
#include "shaders/lib/LibCppDouble.h"
#include "tools/ltcfit/LtcFit.h"

#include <fmt/format.h>

#include <cstdio>

namespace filament_core::tools {
namespace {

constexpr const char* kHeader = R"(// SPDX-License-Identifier: Apache-2.0
/// The transformations of the GGX lobe (shaders/lib/ltc.glsl): rows of kLtcTableSize entries of three values. Column:
/// sqrt(1 - nov), row: perceptual roughness from 0.045 to 1. Written by tools/ltcfit; see docs/lights-area.md.
#pragma once

#include <array>

namespace filament_core::shader {{

inline constexpr int kLtcTableSize = {0};

// clang-format off
inline constexpr std::array<float, 3 * kLtcTableSize * kLtcTableSize> kLtcTable{{
)";

std::string textOf(std::vector<float3> const& table, int size) {
    std::string text = fmt::format(kHeader, size);
    for (size_t i = 0; i < table.size(); ++i) {
        const float3 entry = table[i];
        text += fmt::format("{}{:.6f}f, {:.6f}f, {:.6f}f,{}", i % 4 == 0 ? "    " : " ", entry.x, entry.y, entry.z,
                            i % 4 == 3 ? "\n" : "");
    }
    return text + "};\n// clang-format on\n\n} // namespace filament_core::shader\n";
}

int write(const char* path) {
    const std::string text = textOf(fitLtcTable(shader::lib64::kLtcTableSize), shader::lib64::kLtcTableSize);
    std::FILE* const file = std::fopen(path, "wb");
    const bool isWritten = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const bool isClosed = file && std::fclose(file) == 0;
    if (isWritten && isClosed) return 0;
    std::fprintf(stderr, "ltcfit: error: %s cannot be written; give a file in a folder that exists\n", path);
    return 1;
}

} // namespace
} // namespace filament_core::tools

int main(int argc, char** argv) {
    if (argc == 2 && argv[1][0] != '-') return filament_core::tools::write(argv[1]); // no option is a file
    std::fputs("ltcfit FILE: writes the table of shaders/interface/LtcTable.h\n", stderr);
    return 2;
}
