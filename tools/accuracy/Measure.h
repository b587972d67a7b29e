// SPDX-License-Identifier: Apache-2.0
/// measure: fills in the rows of the accuracy table.
///   Error  of each value in the effect's own scene against its reference, and of the whole frame against the effect's
///          best value; on the first backend only, because the second has the same bits where exactness is on.
///   Time   on every backend: values take turns (A B C, B C A, ...), so that a machine that slows down affects all of
///          them.
///   Thread one at a time.
///   Fails  errors of loaders and devices. An effect whose assets are missing is skipped, with the reason.
///   Cost   a minute or two for everything on two cores; the first run compiles pipelines.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/SceneLibrary.h"

#include <filament_core/Engine.h>

#include <functional>

namespace filament_core::accuracy {

struct MeasureOptions {
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    std::string frame = kWholeFrame; ///< scene of whole frames for rows without one
    uint2 size{ 960, 540 };          ///< of timed whole frames
    uint2 errorSize{ 640, 360 };     ///< of compared whole frames
    uint32_t rounds = 15;            ///< of frames
    uint32_t loadRounds = 3;         ///< of loads, which take seconds
    uint32_t mostTraced = 1u << 20;  ///< maximum samples per pixel of references
    std::filesystem::path pictures;  ///< folder for every picture that an error was computed from, as PNG; empty: none
    tools::SceneFolders folders{};
};

/// The current step, and the fraction done.
using MeasureProgress = std::function<void(std::string const& what, double done)>;

/// Fills in `effects` and `skipped`; the caller fills in machine, commit and date.
/// `table`: every effect, to find the best of all; `chosen`: names, empty for all.
Result<Results> measure(std::vector<Effect> const& table, std::vector<std::string> const& chosen,
                        SceneLibrary const& scenes, MeasureOptions const& options, MeasureProgress const& progress);

} // namespace filament_core::accuracy
