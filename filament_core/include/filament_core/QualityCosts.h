// SPDX-License-Identifier: Apache-2.0
/// QualityCosts: the time and the error of every value of every quality choice, measured on one machine. The table that
/// QualityBudget uses.
///   Choices  the options of Quality, all of which may change every frame. Choices made when a model or an environment
///            is loaded are not part of a frame's budget and not in the table.
///   Time     device time of a whole frame with this value and everything else at its default. Only the ratio to the
///            default value of the same choice is used: both are measured in turns, so that the machine's load cancels
///            out. On CPU drivers (llvmpipe) it is a ratio of processor times, which excludes other processes.
///   Error    root mean square of (image - exact) / (exact + 1 % of its mean), in scene-linear luminance, with
///            everything else at its most exact. 0 for the value that the others are compared with. Choices without
///            effect there are compared as displayed, after the tone mapper.
///   File     JSON, see docs/quality.md: { "machine", "driver", "commit", "size", "effects": [ ... ] }.
///   Fails    readQualityCosts(): Corrupt or InvalidArgument with file, element, and what is valid. A table built by
///            other means must use known names, and every choice must have its default.
///   Thread   values; any thread.  Memory: some kilobytes.
#pragma once

#include <filament_core/Backend.h>
#include <filament_core/Math.h>
#include <filament_core/Result.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

class Engine;
class Scene;
struct View;

struct QualityCost {
    struct Time {
        double milliseconds = 0;
        double lowRatio = 1, highRatio = 1; ///< 99 % confidence interval of the ratio to the default value's time
    };
    std::string value; ///< text that setOption() accepts
    double error = 0;  ///< relative, [0, 100]
    Time vulkan{}, gles{};

    Time const& on(Backend backend) const { return backend == Backend::Gles ? gles : vulkan; }
    Time& on(Backend backend) { return backend == Backend::Gles ? gles : vulkan; }
};

struct QualityEffect {
    std::string name; ///< name of the choice
    std::vector<QualityCost> values;
};

struct QualityCosts {
    std::string machine, driver, commit; ///< where it was measured
    uint2 size{ 0 };                     ///< pixels of the measured frame
    std::vector<QualityEffect> effects;

    /// Time of a frame with default values only: the median over all effects.
    double frameMilliseconds(Backend backend) const;
};

/// Every error message begins with `name`.
Result<QualityCosts> readQualityCosts(std::string_view json, std::string_view name);
Result<QualityCosts> loadQualityCosts(std::filesystem::path const& file);
std::string toJson(QualityCosts const& costs);
/// The table included in the library: the showcase on Mesa's CPU drivers.
QualityCosts const& defaultQualityCosts();

struct CostMeasurement {
    uint32_t rounds = 15;               ///< [15, 1000]: a round measures every value of a choice once, in turns
    std::vector<std::string> choices{}; ///< names; empty: all choices
};

/// Measures one scene on the engine's backend; the view's quality provides the values of the other choices. The scene
/// is still, so shadow maps are drawn once and kept: their filters have a price, drawing them has none. Draws about
/// 30 images, each with its own programs, then rounds * 30 frames, which takes seconds to minutes. The other
/// backend's times stay 0; see addBackend(). Fails: InvalidArgument for an unknown choice; errors of the device.
Result<QualityCosts> measureQualityCosts(Engine& engine, Scene const& scene, View const& view,
                                         CostMeasurement const& measurement = {});
/// Copies the times of `backend` from a measurement of the same choices.
void addBackend(QualityCosts& costs, QualityCosts const& other, Backend backend);

} // namespace filament_core
