// SPDX-License-Identifier: Apache-2.0
// One stream of a file may be too slow; those behind it are not decoded.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/Draco.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace filament_core::assets {
namespace {

/// A sound stream of the corpus: the first byte of each file chooses the decoder.
std::vector<std::byte> soundStream() {
    for (auto const& entry :
         std::filesystem::directory_iterator(tools::sourceDir() / "tests/fuzz/corpus/mesh_stream")) {
        const std::vector<std::byte> bytes = *readFileBytes(entry.path());
        DracoPatience patience;
        Diagnostics diagnostics;
        const std::span<const std::byte> stream = std::span(bytes).subspan(1);
        const DracoMesh mesh(stream, "sound", patience, diagnostics);
        if (diagnostics.ok() && mesh.vertexCount() > 0) return { stream.begin(), stream.end() };
    }
    return {};
}

std::string errorOf(std::span<const std::byte> stream, DracoPatience& patience) {
    Diagnostics diagnostics;
    const DracoMesh mesh(stream, "mesh", patience, diagnostics);
    EXPECT_EQ(diagnostics.ok(), mesh.vertexCount() > 0);
    return diagnostics.ok() ? "" : diagnostics.error().message;
}

TEST(DracoPatience, IsLostByOneSlowStreamForAllOfTheFile) {
    const std::vector<std::byte> stream = soundStream();
    ASSERT_FALSE(stream.empty());
    DracoPatience patience;
    EXPECT_EQ(errorOf(stream, patience), "");
    EXPECT_FALSE(patience.isLost);
    patience.seconds = patience.secondsPerVertex = 0; // every stream is too slow
    EXPECT_NE(errorOf(stream, patience).find("mesh: the Draco stream is broken: "), std::string::npos);
    EXPECT_TRUE(patience.isLost);
    patience.seconds = 1000;
    EXPECT_EQ(errorOf(stream, patience), "mesh: the Draco stream is broken: another one of this file took too long");
}

} // namespace
} // namespace filament_core::assets
