// SPDX-License-Identifier: Apache-2.0
/// FilmFile: a partial film as a file, with all that must be equal among the parts of one image.
///   File    little-endian: 8 bytes "FILMPART", u32 version (1), u32 bytes of the header, the header (JSON, below), for
///           every node of nodesOf(passes) width x height x 6 doubles (sum of red, green, blue; sums of their squares),
///           u64 hash of everything before it (base/Hash.h).
///   Header  { "settings": { "commit", "arguments", "contents", "size", "samplesPerPass", "passes", "warnings" },
///           "settingsHash" (of the text of "settings"), "tile": [x, y, width, height], "passRange": [first, count],
///           "shard": [index, count] if --shard divided the image, "rays", "lostSamples", "seconds" }
///   Fails   Unreadable, or Corrupt with the file, what is wrong with it, and that the part must be rendered again. Any
///           bytes are safe.
///   Thread  any.
#pragma once

#include "toolkit/program/Shard.h"
#include "tools/reference/PartialFilm.h"

#include <filesystem>
#include <optional>
#include <span>

namespace filament_core::reference {

inline constexpr const char* kPartName = "part.film"; ///< in the folder of a part

/// What all parts of an image have in common.
struct PictureSettings {
    std::string commit;                 ///< of the program
    std::vector<std::string> arguments; ///< of the command line that renders the whole image
    uint64_t contents = 0;              ///< hash of what the scene's files contain
    uint2 size{ 1, 1 };
    PassPlan plan{};
    std::vector<std::string> warnings;
};
uint64_t hashOf(PictureSettings const& settings);

struct PartHeader {
    PictureSettings settings;
    FilmRegion region{};
    std::optional<tools::Shard> shard{};
    uint64_t rays = 0, lostSamples = 0;
    double seconds = 0;
};

Result<void> writePart(std::filesystem::path const& file, PictureSettings const& settings, PartialFilm const& part,
                       std::optional<tools::Shard> const& shard);
/// Reads no further than the header, and checks that the file is as long as it says.
Result<PartHeader> readPartHeader(std::filesystem::path const& file);
Result<PartialFilm> readPart(std::filesystem::path const& file);

/// The same from memory; `name` begins every message.
std::vector<std::byte> bytesOf(PictureSettings const& settings, PartialFilm const& part,
                               std::optional<tools::Shard> const& shard);
Result<PartialFilm> parsePart(std::span<const std::byte> bytes, std::string const& name);

} // namespace filament_core::reference
