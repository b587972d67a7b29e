// SPDX-License-Identifier: Apache-2.0
/// OptionTable: every setting of a View that has a name, as a row of a panel: made of the engine's own tables, so that
/// a new option appears by itself. What kind of widget it gets follows from the words that say what is valid.
///   Names    those of `filament-render --set` but for what is chosen at loading, and toneMapper, dither, samples and
///            debugView.
///   Thread   any.   Memory: a row is some words.   Fails: setOption() as setQuality(), setEffect(), setColorGrading().
#pragma once

#include "base/Result.h"

#include <filament/View.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament::view {

enum class OptionGroup : uint8_t { Picture, Quality, Effects, Grading };
const char* toString(OptionGroup group);

enum class OptionKind : uint8_t {
    Switch, ///< "off" or "on"
    Choice, ///< one of `words`
    Number, ///< `components` of them, in [least, most]
    Text,   ///< anything: the words of its range say nothing that is understood here
};

struct Option {
    OptionGroup group = OptionGroup::Picture;
    std::string name{};
    std::string range{}; ///< in words, for help
    OptionKind kind = OptionKind::Text;
    std::vector<std::string> words{}; ///< of a choice; of a number those worth trying, if the engine names some
    double least = 0, most = 0;
    uint32_t components = 1;
    bool isWhole = false;
    std::string standard{}; ///< the value of a View that nobody changed

    /// "fog" of "fog.density": what belongs together. Without a dot: the name.
    std::string_view family() const { return std::string_view(name).substr(0, name.find('.')); }
};

/// In the order of the engine's tables.
std::vector<Option> makeOptions();

/// Understands "off or on", "a, b or c", "a number from 0 to 8", "R,G,B, each from -1 to 1". The others: Text.
Option optionFromRange(std::string_view range, std::string_view standard);

std::string optionValue(View const& view, Option const& option);
Result<void> setOption(View& view, Option const& option, std::string_view value);

/// Numbers of "1,0.5,2"; empty if they are not as many as the option has.
std::vector<float> optionNumbers(Option const& option, std::string_view value);
std::string optionText(Option const& option, std::span<const float> numbers);

} // namespace filament::view
