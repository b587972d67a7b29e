// SPDX-License-Identifier: Apache-2.0
/// Effect: one row of the accuracy table: a choice, its values, the reference for each value, and the cost. Rows are
/// objects in effects.json; docs/accuracy.md says where it is told how to add one.
///   Value    one word ("fast": CHOICE=fast) or settings separated by spaces ("diffuseIrradiance=sphericalHarmonics
///            shBands=2"). Without "values": all values that Settings.h knows for the choice.
///   Fails    InvalidArgument, NotFound: row, field, what is valid. Every word of every value is checked.
///   Thread   any; pure except for reading the file.
#pragma once

#include "base/Result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::accuracy {

struct Value {
    std::string name;
    std::vector<std::string> set; ///< NAME=VALUE
};

enum class ReferenceKind : uint8_t {
    Setting,      ///< the engine with `set`: its most exact result
    Scene,        ///< the engine in another scene without the difficulty
    Supersampled, ///< the engine with `set` at `factor` times the resolution, averaged in linear light
    Traced,       ///< tools/reference: one reflection of unoccluded light, or whole paths, with the terms of `set`
    OtherBackend, ///< the engine with the same value on the second backend: how far the two APIs differ
    Furnace,      ///< a white furnace: a surface that reflects everything looks like its environment
    Integral,     ///< numbers instead of an image: an integral in double precision, by name
};

struct Reference {
    ReferenceKind kind = ReferenceKind::Setting;
    std::vector<std::string> set;
    std::string scene;     ///< Scene
    std::string integral;  ///< Integral
    uint32_t factor = 8;   ///< Supersampled, [2, 16]
    uint32_t samples = 64; ///< Traced: per pixel
    bool hasPaths = false; ///< Traced: all light, with every bounce
};

/// The scene of whole frames, unless a row or the command line names another.
inline constexpr const char* kWholeFrame = "frame";

enum class Cost : uint8_t {
    Frame,       ///< device milliseconds for a whole frame
    Environment, ///< milliseconds to load the environment, from its file and without a cache
    Model,       ///< milliseconds to load the model
};

struct Effect {
    std::string name; ///< the name for --effect
    std::string title;
    std::string question;          ///< answered by the row, one sentence
    std::string scene;             ///< scenes/NAME.json or NAME/FEATURE, in which the error is measured
    std::vector<std::string> base; ///< settings of all values, in that scene and in the frame
    std::vector<Value> values;
    size_t standard = 0; ///< the engine's default; times are ratios to it
    size_t best = 0;     ///< whole frames are compared with those of this value
    Reference reference{};
    Cost cost = Cost::Frame;
    std::string frame = kWholeFrame; ///< the scene in which the frame is timed; the values differ in it
};

const char* toString(Cost cost);
/// One sentence for the report.
std::string describe(Reference const& reference);

Result<std::vector<Effect>> readEffects(std::filesystem::path const& file);

} // namespace filament_core::accuracy
