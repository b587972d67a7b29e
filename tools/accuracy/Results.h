// SPDX-License-Identifier: Apache-2.0
/// Results: the measurements, as values, as JSON and as CSV. QualityBudget reads the JSON.
///   JSON    { "program", "version", "machine", "driver", "commit", "date", "frame", "size", "rounds", "effects": [ {
///             "name", "title", "question", "reference", "command", "cost", "frame", "linear", "standard", "best",
///             "values": [ {
///               "value", "set", "error" (whole frame), "ownError", "ownMax", "ownFlip", "frameFlip", "totalError",
///               "milliseconds", "millisecondsInterval", "ratio", "interval" (of the ratio) } ] } ],
///           "skipped" }. The last four fields of a value are objects, one entry per backend.
///   CSV     one line per value and backend.
///   Thread  any; pure.
#pragma once

#include "toolkit/json/JsonReader.h"
#include "toolkit/pictures/Picture.h"
#include "tools/accuracy/Effect.h"
#include "tools/accuracy/Statistics.h"

#include <filament_core/Math.h>

#include <map>
#include <string>
#include <vector>

namespace filament_core::accuracy {

using namespace tools; // the toolkit

struct Timing {
    Estimate milliseconds;
    Estimate ratio; ///< to the standard value, round by round
};

struct ValueResult {
    Value value;
    ErrorFigures own;                      ///< in the effect's scene, against its reference
    ErrorFigures frame;                    ///< of the whole frame, against the best value of the effect
    double total = 0;                      ///< rms of the whole frame against the best value of every effect
    std::map<std::string, Timing> timings; ///< by backend
};

struct EffectResult {
    Effect effect;
    std::vector<ValueResult> values; ///< as effect.values
    bool linear = true;              ///< pictures are scene-linear, not display-referred
    double referenceError = 0;       ///< standard error of a traced reference; 0: none
    std::string command;             ///< repeats the measurement of this row
};

struct Skipped {
    std::string name, reason; ///< the row, and which file it lacks
};

struct Results {
    std::string machine, commit, date;
    std::map<std::string, std::string> drivers; ///< by backend
    std::string frame;                          ///< scene of whole frames
    uint2 size{ 0, 0 };
    uint32_t rounds = 0;
    std::vector<EffectResult> effects;
    std::vector<Skipped> skipped;
};

tools::Json jsonOf(Results const& results);
/// Of such JSON; throws its exception where a value lacks a number.
std::string csvOf(tools::Json const& data);

} // namespace filament_core::accuracy
