// SPDX-License-Identifier: Apache-2.0
// Real and generated files, truncated and damaged: nothing may crash, hang or break a promise. The seeds are fixed; the
// number of rounds depends on the time, which is limited.
#include "filament_core/assets/files/FileBytes.h"
#include "tests/filament_core/assets/gltf/GltfMergeFuzzBody.h"
#include "tests/filament_core/assets/gltf/GltfSpecimens.h"
#include "tests/filament_core/assets/gltf/MeshStreamFuzzBody.h"

#include <filesystem>
#include <random>

namespace filament_core::assets::test {
namespace {

TEST(GltfMutation, ScratchedFilesAreRefusedOrLoadedWhole) {
    const std::vector<Specimen> specimens = allSpecimens();
    constexpr uint32_t kRounds = 100;
    size_t runs = 0, loads = 0;
    for (uint32_t round = 0; round < kRounds; ++round) {
        for (size_t i = 0; i < specimens.size(); ++i) {
            Specimen specimen = specimens[i];
            if (round > 0) Scratcher(round * 1000 + static_cast<uint32_t>(i)).scratch(specimen);
            const bool isLoaded = fuzzGltf(glbFrom(specimen.json, specimen.binary));
            EXPECT_TRUE(isLoaded || round > 0) << "specimen " << i << " must be whole";
            loads += isLoaded;
            ++runs;
        }
    }
    EXPECT_GT(loads, runs / 20); // damage that always breaks the JSON would test nothing
    EXPECT_LT(loads, runs);
}

TEST(GltfMutation, ScratchedFilesThatLoadAreSavedWhole) {
    const std::vector<Specimen> specimens = allSpecimens();
    constexpr uint32_t kRounds = 200;
    size_t saved = 0;
    for (uint32_t round = 0; round < kRounds; ++round) {
        for (size_t i = 0; i < specimens.size(); ++i) {
            Specimen specimen = specimens[i];
            if (round > 0) Scratcher(round * 3000 + static_cast<uint32_t>(i)).scratch(specimen);
            const bool isSaved = fuzzGltfMerge(glbFrom(specimen.json, specimen.binary));
            EXPECT_TRUE(isSaved || round > 0) << "specimen " << i << " must be saved";
            saved += isSaved;
        }
    }
    EXPECT_GT(saved, 2 * specimens.size());
}

TEST(MeshStream, OfTheCorpusIsReadAndDamageIsRefusedOrReadWhole) {
    std::vector<Bytes> streams;
    for (auto const& entry : std::filesystem::directory_iterator(tools::sourceDir() / "tests/fuzz/corpus/mesh_stream"))
        streams.push_back(*readFileBytes(entry.path()));
    ASSERT_GE(streams.size(), 19u);
    size_t read = 0;
    for (Bytes const& stream : streams) read += fuzzMeshStream(stream);
    EXPECT_GE(read, 19u) << "streams that an encoder wrote";
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        Bytes stream = streams[random() % streams.size()];
        for (auto i = 1 + random() % 4; i > 0; --i) stream[random() % stream.size()] = static_cast<std::byte>(random());
        if (random() % 4 == 0) stream.resize(random() % stream.size());
        fuzzMeshStream(stream);
    }
}

TEST(GltfMutation, FilesCutAnywhereAreRefused) {
    const std::vector<Specimen> specimens = allSpecimens();
    for (size_t i = 0; i < specimens.size(); ++i) {
        const Bytes whole = glbFrom(specimens[i].json, specimens[i].binary);
        for (size_t size = 0; size + 4 < whole.size(); size += 64) {
            Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            EXPECT_FALSE(fuzzGltf(cut)) << size;
            if (size < 20) continue;
            const auto length = static_cast<uint32_t>(size); // and with headers that agree with the cut
            std::memcpy(&cut[8], &length, 4);
            EXPECT_FALSE(fuzzGltf(cut)) << size;
        }
    }
}

} // namespace
} // namespace filament_core::assets::test
