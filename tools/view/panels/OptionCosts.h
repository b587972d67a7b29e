// SPDX-License-Identifier: Apache-2.0
/// OptionCosts: what a value of an option costs: by the table that was measured somewhere, and by what frames took here
/// before and after it was changed.
///   Thread  any; plain values.
#pragma once

#include <filament_core/QualityCosts.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

struct ValueCost {
    double milliseconds = 0; ///< a frame with the value less one with the current value
    double error = 0;        ///< of the picture: QualityCost::error
};

/// By the ratios of the table, for frames that take `frameMilliseconds` with `current`. None: the table does not rate
/// the option or one of the values.
std::optional<ValueCost> tabledCost(QualityCosts const& costs, Backend backend, std::string_view option,
                                    std::string_view current, std::string_view value, double frameMilliseconds);

/// The difference between frames before and after a change.
struct MeasuredChange {
    std::string option{}, from{}, to{};
    double milliseconds = 0; ///< median after less median before
    size_t frames = 0;       ///< of each
};

/// Sees every frame's time and every change of an option. Changes that follow each other before enough frames were
/// drawn are not measured: they are indistinguishable.
///   Memory  the last frames, and one result of each option.
class ChangeMeter {
public:
    static constexpr size_t kFrames = 12; ///< on each side of a change; the median of fewer than 4 says nothing
    static constexpr size_t kSkipped = 4; ///< frames after a change that do not count: in flight, or compiling programs

    void frame(double milliseconds);
    void changed(std::string_view option, std::string_view from, std::string_view to);

    /// The latest measured change of an option; null: none.
    MeasuredChange const* changeOf(std::string_view option) const;
    std::optional<double> medianMilliseconds() const; ///< of the last frames with the same settings

private:
    struct Pending {
        MeasuredChange change{};
        std::optional<double> before{};
        size_t skipped = 0;
    };
    void finish();

    std::vector<double> mFrames{}; ///< since the last change, the newest last
    std::optional<Pending> mPending{};
    std::vector<MeasuredChange> mChanges{};
};

} // namespace filament_core::view
