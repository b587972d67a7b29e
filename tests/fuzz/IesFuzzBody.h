// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a photometric file gives an error of one line that
/// names the file, or candelas and a table that are finite, in range, and agree at the entries of the table.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/tables/LightProfileTable.h"

#include <cmath>
#include <cstdint>

namespace filament_core::assets {

/// Returns whether it was a photometric file.
inline bool fuzzIesOnce(std::span<const uint8_t> input) {
    const Result<IesFile> file = readIes(std::as_bytes(input), "fuzz");
    if (!file) {
        FILAMENT_ASSERT(file.error().message.starts_with("fuzz: "), "an error names its file");
        FILAMENT_ASSERT(file.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    FILAMENT_ASSERT(file->candelas.size() == file->vertical.size() * file->horizontal.size(), "a value for each angle");
    FILAMENT_ASSERT(file->peak > 0 && file->peak <= 1e9f, "the peak is in its range");
    for (int i = 0; i < 64; ++i) { // a spiral over the sphere
        const double z = 1 - (2 * i + 1) / 64.0, turn = 2.4 * i, side = std::sqrt(1 - z * z);
        const double3 direction(side * std::cos(turn), side * std::sin(turn), z);
        const double candelas = file->candelasAt(direction);
        FILAMENT_ASSERT(candelas >= 0 && candelas <= static_cast<double>(file->peak) * (1 + 1e-6),
                        "candelas lie between zero and the peak");
    }
    if (file->candelas.size() > 4096) return true; // a table of them takes long
    const LightProfileTable table = makeLightProfileTable(*file);
    FILAMENT_ASSERT(table.rows >= 2 && table.columns >= 1 &&
                            table.words.size() == (size_t{ table.rows } * table.columns + 1) / 2,
                    "a table has a word for two entries");
    FILAMENT_ASSERT(std::isfinite(table.lumens) && table.lumens >= 0, "flux is finite");
    for (int i = 0; i < 16; ++i) {
        const double share = table.shareAt({ std::sin(0.4 * i), 0.0, -std::cos(0.4 * i) });
        FILAMENT_ASSERT(share >= 0 && share <= 1, "shares are shares");
    }
    return true;
}

} // namespace filament_core::assets
