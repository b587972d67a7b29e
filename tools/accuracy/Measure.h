// SPDX-License-Identifier: Apache-2.0
/// measure: the rows of the accuracy table, filled in.
///   Error  of each value in the effect's own scene against its reference, and of the whole frame against the effect's
///          best value; on the first backend: the pictures of the second have the same bits where exactness is on.
///   Time   on every backend: the values take turns (A B C, B C A, ...), so that a machine that slows down does so for
///          all.
///   Thread one at a time.
///   Fails  what loaders and devices say. An effect whose assets are not there is skipped, with the reason.
///   Cost   a minute or two for everything on two cores; the first run compiles pipelines.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/SceneLibrary.h"

#include <filament/Engine.h>

#include <functional>

namespace filament::accuracy {

struct MeasureOptions {
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    std::string frame = kWholeFrame; ///< another scene of whole frames, for rows that do not have one of their own
    uint2 size{ 960, 540 };          ///< of whole frames that are timed
    uint2 errorSize{ 640, 360 };     ///< of whole frames that are compared
    uint32_t rounds = 15;            ///< of frames
    uint32_t loadRounds = 3;         ///< of loads, which take seconds
    uint32_t mostTraced = 1u << 20;  ///< samples a pixel of references, at most
    std::filesystem::path pictures;  ///< every picture that an error is of, as PNG; empty: none
    conformance::SceneFolders folders{};
};

/// What is being done, and how much of all is.
using MeasureProgress = std::function<void(std::string const& what, double done)>;

/// Fills `effects` and `skipped` in; machine, commit and date are the caller's.
/// `table`: every effect, for the best of all; `chosen`: names, empty for all.
Result<Results> measure(std::vector<Effect> const& table, std::vector<std::string> const& chosen,
                        SceneLibrary const& scenes, MeasureOptions const& options, MeasureProgress const& progress);

} // namespace filament::accuracy
