// SPDX-License-Identifier: Apache-2.0
/// runRandom: draws generated materials (--random N, seeds S to S + N - 1) on both backends and compares the bits. A
/// failing material is reduced to a small one that fails in the same way.
///   Out     for each failing seed in `out`/random: the material and its scene as generated and as reduced (both can be
///           copied to tests/conformance/scenes), and the reduced one's images and their difference.
///   Fails   when a stage cannot be opened or a file not be written. A material that does not compile is a finding.
///   Thread  one at a time. Cost: about a second per material, most of it in compilers; a reduction takes minutes.
#pragma once

#include "tools/conformance/Options.h"

namespace filament_core::conformance {

struct RandomFinding {
    uint64_t seed = 0;
    std::string what;               ///< one line
    std::filesystem::path material; ///< the reduced one, if --reduce is on
    size_t trees = 0, tries = 0;    ///< left in it; candidates drawn
};

struct RandomResults {
    uint32_t drawn = 0;
    std::vector<RandomFinding> findings;
};

Result<RandomResults> runRandom(Options const& options);

} // namespace filament_core::conformance
