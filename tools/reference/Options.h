// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-reference.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "toolkit/program/SceneOptions.h"
#include "toolkit/program/Shard.h"
#include "tools/reference/PartialFilm.h"

#include <optional>

namespace filament_core::reference {

struct Options : tools::SceneOptions {
    ReferenceSettings settings{};
    int workers = -1;                         ///< as JobSystemOptions::workers
    bool writesErrors = false;                ///< error.exr
    uint32_t probeSize = 0;                   ///< --probe: texels of a side of probe.ktx2, instead of an image; 0: none
    double rotationDegrees = 0;               ///< of the environment around +Y
    std::optional<FilmRegion> part;           ///< --tile, --samples, --shard: this instead of the whole image
    std::optional<tools::Shard> shard;        ///< --shard: that this part is
    std::vector<std::filesystem::path> merge; ///< parts to merge; empty: render
    /// Of the whole image: all options but those of the part, --out and --threads, in the order of the help text.
    std::vector<std::string> arguments;
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::reference
