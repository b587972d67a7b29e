// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a partial film gives an error of one line that
/// names the file, or a film whose nodes are those of its passes. An input without the right hash is also tried with
/// it, so that edits reach what is behind the hash.
#pragma once

#include "base/Assert.h"
#include "base/Hash.h"
#include "tools/reference/FilmFile.h"

#include <cstring>
#include <span>
#include <vector>

namespace filament_core::test {

/// Returns whether it was a partial film.
inline bool fuzzFilmFileOnce(std::span<const std::byte> bytes) {
    const auto part = reference::parsePart(bytes, "fuzz.film");
    if (!part) {
        FILAMENT_ASSERT(part.error().message.starts_with("fuzz.film: "), "an error names its file");
        FILAMENT_ASSERT(part.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    const auto nodes = reference::nodesOf(part->region.passes);
    FILAMENT_ASSERT(nodes.size() == part->nodes.size(), "the nodes of its passes");
    for (size_t i = 0; i < nodes.size(); ++i) {
        FILAMENT_ASSERT(part->nodes[i].passes == nodes[i], "the nodes of its passes");
        FILAMENT_ASSERT(part->nodes[i].pixels.size() == size_t(part->region.size.x) * part->region.size.y,
                        "all pixels");
    }
    return true;
}

inline bool fuzzFilmFile(std::span<const std::byte> bytes) {
    if (fuzzFilmFileOnce(bytes)) return true;
    if (bytes.size() >= sizeof(uint64_t)) {
        std::vector<std::byte> hashed(bytes.begin(), bytes.end());
        const size_t end = hashed.size() - sizeof(uint64_t);
        const uint64_t hash = hashBytes(std::span(hashed).first(end));
        std::memcpy(hashed.data() + end, &hash, sizeof(hash));
        fuzzFilmFileOnce(hashed);
    }
    return false;
}

} // namespace filament_core::test
